"""Furniture: things put about a world by a fixed rule, in rooms, beside houses and on the land."""

from __future__ import annotations

import math
from itertools import cycle
from typing import TYPE_CHECKING, Any, Final

from conformance.scenes.rotations import yaw_quaternion
from conformance.strategies.poses import to_world
from conformance.strategies.worlds.land import BLOCK, land_cell, surface
from conformance.strategies.worlds.shadows import registered
from conformance.strategies.worlds.things import KINDS, thing_geometries, write_object

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.scenes.model import Geometry

FIRST_THING: Final = 0x70000001
"""Id of the first object; below are ids of movers."""
_BESIDE: Final = 8.0
"""Distance of what stands beside a house from its origin, metres."""
_STEP: Final = 61.8
"""Distance of what lies about on the land, metres: it meets borders and corners in time."""
_TURN: Final = 137.5
"""Degrees by which each thing is turned against the one before."""


def furnished(world: dict[str, Any], geometries: Mapping[str, Geometry], count: int) -> dict[str, Any]:
    """Return a world with `count` more objects, each of another kind, in the shadow lists around them."""
    known = {**geometries, **thing_geometries()}
    places = _places(world)
    for number, (kind, place) in enumerate(zip(cycle(KINDS.values()), places, strict=False)):
        if number == count:
            break
        pose = {**place, "rotation": yaw_quaternion(_TURN * number % 360.0)}
        scale = 1.0 if number % 3 else 1.25
        world = registered(world, known, write_object(kind, FIRST_THING + number, pose, scale))
    return world


def _places(world: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield where things are put, without end: cell and origin."""
    sources = [_in_rooms(world), _beside_houses(world), _on_the_land(world)]
    while sources:
        for source in list(sources):
            place = next(source, None)
            if place is None:
                sources.remove(source)
            else:
                yield place


def _in_rooms(world: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield a place in each room, off its middle."""
    for number, cell in enumerate(world["cells"]):
        aside = (1.5, -1.0 + 0.5 * (number % 5), 0.0)
        yield {"cell": cell["id"], "origin": to_world(cell["pose"], aside, 1.0)}


def _beside_houses(world: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield places around each building, on the ground."""
    for number, building in enumerate(world["buildings"]):
        x, y, _ = building["pose"]["origin"]
        for turn in range(number, 8, 3):
            angle = math.pi / 4.0 * turn
            yield from _at(
                world,
                building["pose"]["cell"] >> 16,
                x + _BESIDE * math.cos(angle),
                y + _BESIDE * math.sin(angle),
            )


def _on_the_land(world: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield places on every landblock, without end."""
    step = 0
    while world["landblocks"]:
        for block in world["landblocks"]:
            step += 1
            yield from _at(world, block["block"], step * _STEP % BLOCK, step * step * _STEP % BLOCK)


def _at(world: Mapping[str, Any], block: int, x: float, y: float) -> Iterator[dict[str, Any]]:
    """Yield a place on the ground, if the point is in its block and the block is loaded."""
    found = next((land for land in world["landblocks"] if land["block"] == block), None)
    if found is not None and 0.0 <= x < BLOCK and 0.0 <= y < BLOCK:
        height, _ = surface(found, x, y)
        yield {"cell": land_cell(block, x, y), "origin": (x, y, height)}
