"""The moves of the sweeps: a human in a room with ramps, steps and a pillar, put where it touches something.

A move is laid out once in the room's own frame. A sweep then puts the same move into the frame it stresses:
far out, turned, on other geometry. Everything is rounded to float32 there, and from there on taken as exact.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, Final

from conformance.scenes.algebra import add, dot, scale, subtract
from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.planes import unit_normal
from conformance.scenes.polygons import place
from conformance.scenes.primitives import room
from conformance.scenes.rotations import rotate, rows_from_quaternion
from conformance.scenes.solids import pillar, ramp, stairs
from conformance.strategies.human import HUMAN, MOVER, RADIUS
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.query import Query
    from conformance.scenes.model import Geometry, Quaternion, Vec3

CELL: Final = 0x01000100
"""Id of the cell that every scene is."""
IDENTITY: Final[Quaternion] = (1.0, 0.0, 0.0, 0.0)
ON_GROUND: Final = 0x303
"""State bits of a mover with contact, on walkable, a player that slides along edges (FORMAT.md, MOVER)."""
IN_AIR: Final = 0x300
CENTER: Final[Vec3] = (0.0, 0.0, RADIUS)
"""Centre of the lower sphere above the mover's feet, metres."""
STRIDES: Final = (0.05, 0.35)
"""Lengths of a move, metres: 1.5 to 10 m/s at thirty ticks a second."""
_WALKABLE: Final = 0.7
"""Least z of the normal of a polygon that moves begin on: a little above retail's limit."""
_INWARDS: Final = 0.8
"""How much of a polygon's extent a move may begin on: the rest are its rims."""


@dataclass(frozen=True, slots=True)
class Move:
    """A move in the room's frame.

    Attributes
    ----------
    start, end : Vec3
        The mover's feet, metres.
    ground : (Vec3, Vec3) or None
        Unit normal and a point of the plane that it stands on.
    """

    start: Vec3
    end: Vec3
    ground: tuple[Vec3, Vec3] | None


@cache
def furnished_room() -> Geometry:
    """Make the room: 12 m wide, two ramps, three steps and a pillar, all at odd angles."""
    shape = room(size=(12.0, 12.0, 6.0))
    shape += place(ramp(width=3.0, run=4.0, degrees=20.0), (-3.0, -2.0, 0.0), 27.0)
    shape += place(ramp(width=2.5, run=2.5, degrees=41.0), (2.5, 1.0, 0.0), -63.0)
    shape += place(stairs(width=2.0, rise=0.4, run=0.6, count=3), (0.5, -5.0, 0.0), 11.0)
    shape += place(pillar(radius=0.5, height=3.0, sides=6, capped=False), (-0.5, 3.5, 0.0), 17.0)
    return build("furnished", shape, style=TreeStyle.BOTH, kind="stress")


def room_moves(geometry: Geometry, seed: int, count: int) -> Iterator[Move]:
    """Yield moves that take turns in kind: along the ground, and out of the air onto it."""
    # Only random() and arithmetic: the same on every platform.
    numbers = random.Random(seed)  # noqa: S311
    floors = [i for i in range(len(geometry.polygons)) if unit_normal(geometry.corners(i))[2] > _WALKABLE]
    for number in range(count):
        polygon = floors[number % len(floors)]
        yield _move(geometry.corners(polygon), numbers, airborne=number % 4 == 3)


def _move(corners: tuple[Vec3, ...], numbers: random.Random, *, airborne: bool) -> Move:
    """Return a move from above a point of a polygon: the lower sphere touches its plane, or is above it."""
    normal, point = unit_normal(corners), _point(corners, numbers)
    x, y = (2.0 * numbers.random() - 1.0 for _ in range(2))
    size = STRIDES[0] + (STRIDES[1] - STRIDES[0]) * numbers.random()
    along = scale(size / max(math.sqrt(x * x + y * y), size), (x, y, 0.0))
    start = subtract(add(point, scale(RADIUS, normal)), CENTER)
    if airborne:
        start = add(start, (0.0, 0.0, 0.2 * numbers.random()))
        return Move(start, add(start, (along[0], along[1], -0.4)), None)
    # A step along the ground, as contact makes it: what would lead into it is taken off.
    return Move(start, add(start, subtract(along, scale(dot(along, normal), normal))), (normal, point))


def _point(corners: tuple[Vec3, ...], numbers: random.Random) -> Vec3:
    """Return a point well inside a convex polygon."""
    weights = [numbers.random() for _ in corners]
    total = sum(weights)
    middle = scale(1.0 / len(corners), _sum(list(corners)))
    anywhere = _sum([scale(weight / total, corner) for weight, corner in zip(weights, corners, strict=True)])
    return add(middle, scale(_INWARDS, subtract(anywhere, middle)))


def _sum(points: list[Vec3]) -> Vec3:
    total = (0.0, 0.0, 0.0)
    for point in points:
        total = add(total, point)
    return total


def room_query(
    move: Move,
    geometry: Geometry,
    *,
    rotation: Quaternion = IDENTITY,
    origin: Vec3 = (0.0, 0.0, 0.0),
    within: Vec3 = (0.0, 0.0, 0.0),
) -> Query:
    """Return a move as a transition in a cell.

    Parameters
    ----------
    move : Move
    geometry : Geometry
        Of the cell.
    rotation, origin : Quaternion, Vec3
        Of the cell's pose.
    within : Vec3
        Where the room lies in the geometry, metres: it may be modelled far from the geometry's origin.
    """
    rows = rows_from_quaternion(rotation)

    def to_block(point: Vec3) -> Vec3:
        return add(rotate(rows, add(point, within)), origin)

    # The feet are where they must be for the upright mover's lower sphere to be where the room has it.
    lifted = subtract(rotate(rows, CENTER), CENTER)
    start, end = (add(to_block(place), lifted) for place in (move.start, move.end))
    record: dict[str, Any] = {
        "op": "transition",
        "cells": [{"id": CELL, "pose": pose(rotation, origin), "geometry": geometry.name}],
        "mover": {**MOVER, "spheres": HUMAN, "state": IN_AIR if move.ground is None else ON_GROUND},
        "from": pose(IDENTITY, start),
        "to": pose(IDENTITY, end),
        "begin_cell": CELL,
        "seed": {},
    }
    if move.ground is not None:
        normal = rotate(rows, move.ground[0])
        known = {"plane": [*normal, -dot(normal, to_block(move.ground[1]))], "cell": CELL, "is_water": 0}
        record["seed"] = {"contact": known, "last_known": known}
    return query_from_record(record, {geometry.name: geometry})


def pose(rotation: Quaternion, origin: Vec3) -> dict[str, Any]:
    """Return a POSE block in the cell."""
    return {"cell": CELL, "rotation": list(rotation), "origin": list(origin)}
