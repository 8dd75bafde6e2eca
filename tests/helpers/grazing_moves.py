"""Moves that hardly touch something, or hardly miss it: where a bound that is too small shows.

A random move is seldom within a sphere's rounding of a cylinder's edge, so that thousands of them say
nothing about the last centimetre of a bound. Each of these is aimed: one of the mover's spheres ends, or
passes, at a gap near zero from a face, edge or corner of a shape, from a plane of a cell, or from the ground.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import numpy.typing as npt
from engine_scenes import prepared
from random_moves import give_mover, rotations, single

from conformance.candidates.engine_ops.worlds import engine_world
from conformance.inputs import read_block
from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.cell_planes import box_planes
from conformance.scenes.planes import area_vector, signed_distance
from conformance.scenes.primitives import make
from conformance.strategies.numbers import along, unit
from conformance.strategies.poses import to_world, turned
from conformance.strategies.worlds.land import BLOCK, surface
from conformance.strategies.worlds.shadows import registered
from conformance.strategies.worlds.sites import Site, site
from conformance.strategies.worlds.things import STATIC, Kind, write_object
from engine import layout as at
from engine.constants import CONTACT

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from numpy.random import Generator

    from conformance.scenes.model import Geometry
    from engine.query import Rows
    from engine.world import World

Floats = npt.NDArray[np.float64]

LITTER: Final = (
    Kind(STATIC, cylspheres=((0.0, 0.0, 0.0, 0.5, 0.0625),)),
    Kind(STATIC, cylspheres=((0.25, 0.0, 0.0, 1.5, 0.015625),)),
    Kind(STATIC, cylspheres=((0.0, 0.0, 0.0, 0.0625, 0.03125), (0.0, 0.5, 0.5, 0.125, 0.0625))),
    Kind(STATIC, cylspheres=((0.0, 0.0, 0.0, 0.03125, 3.0),)),
    Kind(STATIC, spheres=((0.0, 0.0, 0.5, 0.03125), (0.0, 0.25, 1.5, 0.0625))),
)
"""Low, wide, small and thin: what the sites' own things are not. Beside it a mover's size decides."""
FIRST_LITTER: Final = 0x71000001
BESIDE: Final = (1.25, 0.5, 0.0)
"""Where litter is from what it lies beside, metres."""
HALL: Final = 0xA9B40100
SMALLEST, LARGEST = -5.0, 0.5
"""Of the radii that movers have besides a human's, metres, as powers of two."""


@dataclass(frozen=True, slots=True)
class Grazed:
    """A shape, a cell's planes or the ground: in which block, and where a sphere of a radius grazes it."""

    pose: Mapping[str, Any]
    draw: Callable[[float, Generator], Floats]


@dataclass(frozen=True, slots=True)
class Ground:
    """A site with litter: its world as the engine has it, and all that can be grazed there."""

    place: Site
    world: World
    shapes: tuple[Grazed, ...]


@cache
def littered(name: str) -> Ground:
    """Return a site with a piece of litter beside each of its things, and in each of its rooms."""
    place = site(name)
    places = [thing["pose"] for thing in place.world["objects"]]
    places += [cell["pose"] | {"cell": cell["id"]} for cell in place.world["cells"]]
    return _with_litter(place, [{**at, "origin": along(at["origin"], BESIDE, 1.0)} for at in places])


@cache
def hall() -> Ground:
    """Return a room in which litter hangs so far apart that one flies freely in between, and near it."""
    shape, planes = (
        make("room", {"size": (40.0, 40.0, 24.0)}),
        box_planes((-20.0, -20.0, 0.0), (20.0, 20.0, 24.0)),
    )
    room = build("hall", shape, style=TreeStyle.BOTH, kind="room", cell_planes=planes)
    pose = {"cell": HALL, "origin": (96.0, 96.0, 20.0), "rotation": (0.8, 0.0, 0.0, 0.6)}
    world = {
        "kind": "world",
        "name": "hall",
        "landblocks": [],
        "cells": [{"id": HALL, "pose": pose, "geometry": room.name, "portals": [], "stab": []}],
        "buildings": [],
        "objects": [],
        "shadow": {},
    }
    whole = Site(world, {room.name: room}, rooms=frozenset({HALL}))
    hung = itertools.product((-12.0, 0.0, 12.0), (-12.0, 0.0, 12.0), (6.0, 16.0))
    return _with_litter(whole, [{**pose, "origin": to_world(pose, point, 1.0)} for point in hung])


def _with_litter(place: Site, poses: Iterable[Mapping[str, Any]]) -> Ground:
    world: Mapping[str, Any] = place.world
    for number, pose in enumerate(poses):
        litter = write_object(LITTER[number % len(LITTER)], FIRST_LITTER + number, pose, 1.0)
        world = registered(world, place.geometries, litter)
    world = read_block(world)
    compiled = prepared(engine_world(world, place.geometries))
    return Ground(place, compiled, tuple(_shapes_of(world, place.geometries)))


def grazing_moves(ground: Ground, rng: Generator, count: int) -> Rows:
    """Return rows of moves, each of which grazes something; fewer where cells are missing."""
    rows = np.zeros(count, dtype=at.QUERY_DTYPE)
    give_mover(rows, rng)
    _give_other_sizes(rows, rng)
    rows["start"][:, 1:5], rows["end"][:, 1:5] = _two_rotations(rng, count)
    for row in rows:
        _aim(row, ground, ground.shapes[rng.integers(len(ground.shapes))], rng)
    rows["start"][:, -3:], rows["end"][:, -3:] = single(rows["start"][:, -3:]), single(rows["end"][:, -3:])
    _stand(rows, rng)
    inside: Rows = rows[rows["begin_cell"] != at.NO_CELL]
    return inside


def _aim(row: Any, ground: Ground, shape: Grazed, rng: Generator) -> None:
    """Put a move's begin and end so that one of its spheres grazes a shape at its end, or on its way."""
    number = rng.integers(int(row["num_sphere"]))
    centre = turned(row["end"][1:5].tolist(), (row["spheres"][number, :3] * row["scale"]).tolist())
    point = shape.draw(float(row["spheres"][number, 3] * row["scale"]), rng)
    length = rng.choice([0.0, 0.1, 1.5, 4.0]) * rng.random()
    way = length * (_direction(rng) if rng.random() < 0.7 else _level(rng))
    passed = rng.choice([0.0, 0.0, 0.5, rng.random()])
    start = point - centre - (1.0 - passed) * way
    block = int(shape.pose["cell"]) >> 16
    cell = ground.place.cell_at(block, tuple(start + centre), otherwise=int(shape.pose["cell"]))
    row["start"][0] = row["end"][0] = cell
    row["start"][-3:], row["end"][-3:] = start, start + way
    row["begin_cell"] = ground.world.cell_index(cell)


def _give_other_sizes(rows: Rows, rng: Generator) -> None:
    """Make a third of the movers smaller or larger than people."""
    other = rng.random(len(rows)) < 0.3
    size = (int(other.sum()), 1)
    radii = 2.0 ** rng.uniform(SMALLEST, LARGEST, size=size)
    spheres = rows["spheres"][other]
    spheres[:, 0, 2:] = single(radii * np.hstack([rng.integers(2, size=size), np.ones(size)]))
    spheres[:, 1, 2:] = single(radii * np.hstack([np.full(size, 2.5), rng.uniform(0.3, 1.5, size=size)]))
    rows["spheres"][other] = spheres


def _two_rotations(rng: Generator, count: int) -> tuple[Floats, Floats]:
    """Return the rotations at begin and end: a third upright, a third without a turn."""
    begin, end = rotations(rng, count), rotations(rng, count)
    kind = rng.integers(3, size=count)
    begin[kind == 0] = (1.0, 0.0, 0.0, 0.0)
    end[kind <= 1] = begin[kind <= 1]
    return begin, end


def _stand(rows: Rows, rng: Generator) -> None:
    """Give most of those in contact a level plane through their feet."""
    has = (rows["state"].astype(int) & CONTACT > 0) & (rng.random(len(rows)) < 0.7)
    for plane in ("contact_plane", "last_known_contact_plane"):
        rows[f"{plane}_valid"] = has
        rows[plane][has, 2] = 1.0
        rows[plane][has, 3] = -rows["start"][has, -1]
        rows[f"{plane}_cell_id"][has] = rows["start"][has, 0]


def _gap(rng: Generator) -> float:
    """Return a gap as a multiple of a radius: none, a few roundings, retail's slacks, or a part."""
    near = rng.choice([-1.0, 1.0]) * 2.0 ** -rng.integers(4, 24)
    slack = rng.choice([0.0002, -0.0002, 0.01, -0.01])
    return float(rng.choice([0.0, near, slack, rng.uniform(-0.02, 0.02), rng.uniform(-0.5, 1.5)]))


def _direction(rng: Generator) -> Floats:
    vector = rng.normal(size=3)
    return np.asarray(vector / np.linalg.norm(vector))


def _level(rng: Generator) -> Floats:
    angle = rng.uniform(0.0, 2.0 * np.pi)
    return np.array([np.cos(angle), np.sin(angle), 0.0])


def _shapes_of(world: Mapping[str, Any], geometries: Mapping[str, Geometry]) -> list[Grazed]:
    shapes = []
    for thing in world["objects"]:
        pose, scale = thing["pose"], thing["scale"]
        shapes += [_cylinder(pose, scale, cylinder) for cylinder in thing.get("cylspheres", ())]
        shapes += [_ball(pose, scale, ball) for ball in thing.get("spheres", ())]
        for part in thing.get("parts", ()):
            if part["geometry"] is not None:
                shape = geometries[part["geometry"]]
                shapes.append(_polygons(part.get("pose", pose), part.get("scale", scale), shape))
    for cell in world["cells"]:
        room = geometries[cell["geometry"]]
        shapes += [_polygons(cell["pose"], 1.0, room), _planes(cell["pose"], room)]
    return shapes + [_ground(landblock) for landblock in world["landblocks"]]


def _cylinder(pose: Any, scale: float, cylinder: Any) -> Grazed:
    """Return an upright cylinder: grazed at its side, a cap, or both at once, which is at its edge."""
    low = _placed(pose, np.array(cylinder[:3]) * scale)
    radius, height = cylinder[3] * scale, cylinder[4] * scale

    def draw(r: float, rng: Generator) -> Floats:
        away = radius + r * (1.0 + _gap(rng)) if rng.random() < 0.8 else rng.uniform(0.0, radius + r)
        beyond = r * (1.0 + _gap(rng))
        rise = rng.choice([height + beyond, -beyond, rng.uniform(-r, height + r)])
        return low + away * _level(rng) + (0.0, 0.0, rise)

    return Grazed(pose, draw)


def _ball(pose: Any, scale: float, ball: Any) -> Grazed:
    centre, radius = _placed(pose, np.array(ball[:3]) * scale), ball[3] * scale
    return Grazed(pose, lambda r, rng: centre + (radius + r * (1.0 + _gap(rng))) * _direction(rng))


def _polygons(pose: Any, scale: float, shape: Geometry) -> Grazed:
    """Return a shape's polygons: grazed at a corner, an edge or the face, along its normal or aslant."""

    def draw(r: float, rng: Generator) -> Floats:
        corners = shape.corners(int(rng.integers(len(shape.polygons))))
        weights = rng.dirichlet(np.ones(len(corners)))
        weights[rng.integers(1, len(corners)) :] *= rng.integers(2)
        point = scale / weights.sum() * (weights @ np.array(corners))
        front = unit(area_vector(corners))
        away = rng.choice([1.0, 1.0, -1.0]) * np.array(front) if rng.random() < 0.6 else _direction(rng)
        return _placed(pose, point + r * (1.0 + _gap(rng)) * away)

    return Grazed(pose, draw)


def _planes(pose: Any, room: Geometry) -> Grazed:
    """Return a cell's planes: grazed from within, from without, or with the centre."""
    vertices = np.array(room.vertices)
    planes = room.cell_planes or ()

    def draw(r: float, rng: Generator) -> Floats:
        point = rng.uniform(vertices.min(axis=0), vertices.max(axis=0))
        plane = planes[rng.integers(len(planes))]
        height = rng.choice([r * (1.0 + _gap(rng)), -r * (1.0 + _gap(rng)), r * _gap(rng)])
        away = height - signed_distance(plane, tuple(point))
        return _placed(pose, point + away * np.array(plane[:3]))

    return Grazed(pose, draw)


def _ground(landblock: Any) -> Grazed:
    """Return the ground of a landblock, grazed from above or from below."""
    pose = {"cell": (landblock["block"] << 16) + 1}

    def draw(r: float, rng: Generator) -> Floats:
        x, y = rng.uniform(0.0, BLOCK, size=2)
        height, normal = surface(landblock, x, y)
        beyond = r * (1.0 + _gap(rng))
        return np.array((x, y, height)) + rng.choice([beyond, beyond, -beyond]) * np.array(normal)

    return Grazed(pose, draw)


def _placed(pose: Any, point: Floats) -> Floats:
    return np.array(pose["origin"]) + turned(pose["rotation"], tuple(point.tolist()))
