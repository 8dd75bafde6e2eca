"""Worlds for random queries hold together: doors fit, land meets, retail finds the same ground."""

from __future__ import annotations

import math
from collections import Counter
from typing import Any

import pytest

from conformance.candidates.oracle_ops.world import oracle_world
from conformance.floats import is_float32
from conformance.scenes.planes import plane_of, signed_distance
from conformance.strategies.world_queries import DRAWN_THING
from conformance.strategies.worlds.land import BLOCK, CELL, LANDS, WATERS, landblock, surface
from conformance.strategies.worlds.plans import plans
from conformance.strategies.worlds.sites import SITES, site
from conformance.strategies.worlds.things import KINDS, thing_geometries
from oracle.land_cell import LandCell
from oracle.vector import Vector3

HIGHEST = 800.0
"""Greatest height that retail accepts, metres (10 1)."""


def numbers(value: Any) -> list[float]:
    """Return every float of a record."""
    if isinstance(value, dict):
        return [number for item in value.values() for number in numbers(item)]
    if isinstance(value, list | tuple):
        return [number for item in value for number in numbers(item)]
    return [value] if isinstance(value, float) else []


def test_there_are_sites() -> None:
    """With and without houses and land, at both ends of the world, all blocks loaded or not."""
    worlds = [site(name).world for name in SITES]
    assert len(worlds) >= 15
    assert {len(world["landblocks"]) for world in worlds} >= {0, 1, 2, 4}
    assert any(not world["cells"] for world in worlds)
    blocks = {land["block"] for world in worlds for land in world["landblocks"]}
    assert {0x0000, 0xFEFE} <= blocks
    assert all(block >> 8 < 0xFF and block & 0xFF < 0xFF for block in blocks)


@pytest.mark.parametrize("name", SITES)
def test_a_site_is_made_once(name: str) -> None:
    """Asked again it is the same object, with the same world, so that candidates compile it once."""
    assert site(name) is site(name)
    assert site(name).name == name


@pytest.mark.parametrize("name", SITES)
def test_a_world_is_whole(name: str) -> None:
    """Its numbers are float32, its names resolve, its ids are unique, its heights are retail's."""
    place = site(name)
    world = place.world
    assert all(is_float32(number) for number in numbers(world))
    ids = [thing["id"] for thing in world["objects"]]
    assert len(set(ids)) == len(ids)
    assert DRAWN_THING not in ids
    assert {ident for cell in world["shadow"].values() for ident in cell} == set(ids)
    assert all(0.0 <= height <= HIGHEST for land in world["landblocks"] for height in land["heights"])
    assert all(len(land["heights"]) == len(land["terrain"]) == 81 for land in world["landblocks"])
    for cell_id in map(int, world["shadow"]):
        assert cell_id in place.rooms or cell_id >> 16 in place.blocks


@pytest.mark.parametrize("name", SITES)
def test_doors_fit(name: str) -> None:
    """A room is on the stated side of its doors, and what is behind a door leads back through it."""
    place = site(name)
    rooms = {cell["id"]: cell for cell in place.world["cells"]}
    for cell in rooms.values():
        for index, portal in enumerate(cell["portals"]):
            plane = plane_of(portal["polygon"])
            low, high = (
                [ends(axis) for axis in zip(*place.geometries[cell["geometry"]].vertices, strict=True)]
                for ends in (min, max)
            )
            middle = tuple(0.5 * (a + b) for a, b in zip(low, high, strict=True))
            behind = signed_distance(plane, (middle[0], middle[1], middle[2])) < 0.0
            assert portal["side"] == int(behind)
            if portal["other"] in rooms:
                back = rooms[portal["other"]]["portals"][portal["other_portal"]]
                assert (back["other"], back["other_portal"]) == (cell["id"], index)


@pytest.mark.parametrize("name", SITES)
def test_buildings_lead_to_outer_doors(name: str) -> None:
    """Each portal of a building names an exterior portal of a room, loaded or not."""
    rooms = {cell["id"]: cell for cell in site(name).world["cells"]}
    for building in site(name).world["buildings"]:
        assert building["portals"]
        for portal in building["portals"]:
            if portal["other"] in rooms:
                assert rooms[portal["other"]]["portals"][portal["other_portal"]]["other"] is None


@pytest.mark.parametrize("name", SITES)
def test_rooms_hold_their_middle(name: str) -> None:
    """A point above the middle of a room's floor is in that room, for retail too."""
    place = site(name)
    world = oracle_world(place.world, place.geometries)
    for cell in place.world["cells"]:
        x, y, z = cell["pose"]["origin"]
        assert place.cell_at(cell["id"] >> 16, (x, y, z + 0.5), otherwise=0) == cell["id"]
        assert world.cells[cell["id"]].point_in_cell(Vector3(x, y, z + 0.5))


@pytest.mark.parametrize("land", LANDS)
@pytest.mark.parametrize("block", [0x0000, 0xA9B4, 0xFEFE])
def test_the_surface_is_retails(land: str, block: int) -> None:
    """Height and normal of the ground are those of the triangle that retail finds at a point."""
    record = landblock(block, land, WATERS[0], {})
    world = {"kind": "world", "name": "land", "landblocks": [record], "cells": [], "buildings": []}
    made = oracle_world({**world, "objects": [], "shadow": {}}, {})
    for k in range(40):
        x, y = (k * 61.8 + 5.0) % BLOCK, (k * k * 17.3 + 3.0) % BLOCK
        cell = made.get_visible((block << 16) + 8 * int(x // CELL) + int(y // CELL) + 1)
        assert isinstance(cell, LandCell)
        polygon = cell.find_terrain_poly(Vector3(x, y, 0.0))
        assert polygon is not None
        height, normal = surface(record, x, y)
        plane = polygon.plane
        assert math.isclose(plane.N.z, normal[2], abs_tol=1e-6)
        assert math.isclose(plane.N.x * x + plane.N.y * y + plane.N.z * height + plane.d, 0.0, abs_tol=1e-3)


def test_landblocks_meet() -> None:
    """Neighbours have the same heights along their border."""
    west, east = (landblock(block, "rolling", "ponds", {}) for block in (0xA9B4, 0xAAB4))
    assert west["heights"][72:] == east["heights"][:9]
    assert west["terrain"][72:] == east["terrain"][:9]


def test_plans_are_closed() -> None:
    """Every room has a door, and each door is on the border of the rooms that it joins."""
    for plan in plans().values():
        for k, room in enumerate(plan.rooms):
            doors = [door for door in plan.doors if k in {door.room, door.other}]
            assert doors
            planes = room.geometry.cell_planes
            assert planes is not None
            for door in doors:
                for corner in door.corners:
                    local = (corner[0] - room.at[0], corner[1] - room.at[1], corner[2] - room.at[2])
                    nearest = min(signed_distance(plane, local) for plane in planes)
                    assert math.isclose(nearest, 0.0, abs_tol=1e-5)


def test_things_have_every_family_and_exemption() -> None:
    """There are kinds for every row of document 08, section 11, and of more than one family of shapes."""
    kinds = KINDS.values()
    families = Counter(
        family for kind in kinds for family in ("parts", "cylspheres", "spheres") if getattr(kind, family)
    )
    assert min(families.values()) >= 4
    assert any(kind.parts and kind.cylspheres for kind in kinds)
    assert any(kind.cylspheres and kind.spheres for kind in kinds)
    assert {flag for kind in kinds for flag in kind.weenie or ()} >= {"creature", "player", "pk", "pklite"}
    named = {part.geometry for kind in kinds for part in kind.parts} - {None}
    assert {f"thing-{name}" for name in named} <= set(thing_geometries())
