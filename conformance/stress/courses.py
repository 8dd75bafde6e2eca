"""The courses of drifting walks: a slope in a turned cell, and velocities to walk on it with."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, Final

from conformance.floats import to_float32
from conformance.scenes.algebra import add, cross, dot, length, round_point, scale, subtract
from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.planes import unit_normal
from conformance.scenes.rotations import rotate, round_quaternion, rows_from_quaternion
from conformance.strategies.human import HUMAN, RADIUS
from conformance.stress.moves import CELL, CENTER, IDENTITY, pose
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Query
    from conformance.scenes.model import Geometry, Vec3
    from conformance.scenes.rotations import Rows

QUANTUM: Final = to_float32(1.0 / 30.0)
"""Of a tick, seconds: retail's shortest."""
SPEED: Final = 3.0
"""Of a walk, m/s."""
SETTLED: Final = 120
"""Ticks in which a body lands and comes to rest, before it walks."""
LEG: Final = 30
"""Ticks of a walk in one direction."""
RADIAN: Final = 20.0
"""Ticks in which a circle turns by one radian."""
GOLDEN: Final = math.pi * (3.0 - math.sqrt(5.0))
"""The golden angle, radians: its multiples never repeat."""
HALF: Final = 20.0
"""Half of the slope's side, metres."""
TILT: Final = rows_from_quaternion((1.0, 0.11, 0.13, 0.0))
"""How the slope is turned in the cell's frame: by 19 degrees."""
TURN: Final = round_quaternion((0.9375, 0.0, 0.0, 0.348))
"""Of the cell in its block."""
ORIGIN: Final[Vec3] = (90.3, 45.7, 12.1)
"""Of the cell, metres: in the middle of a landblock."""
STATE: Final = 0x400408
"""Object state: reports collisions, has gravity, slides along edges (04 1.5)."""
ACTIVE: Final = 0x80
"""Transient state of a body that is moved at all (04 1.4)."""
DROP: Final = 0.2
"""How high above the slope a body begins, metres."""
BEFORE_WALL: Final = 0.8
"""How far from the wall a body begins that pushes at it, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """A walk.

    Attributes
    ----------
    name : str
        What it is called.
    velocity : callable or None
        From the number of a tick to what is set as the body's velocity, m/s; None to leave it alone.
    geometry : callable
        Makes the scene; its first polygon is what the body stands on.
    free : bool
        Whether nothing is in the way: then the body goes where its velocities lead.
    share : int
        What the number of ticks is divided by, where one takes long.
    """

    name: str
    velocity: Callable[[int], Vec3] | None
    geometry: Callable[[], Geometry]
    free: bool = True
    share: int = 1

    def query(self) -> Query:
        """Return the walk, without its ticks."""
        geometry = self.geometry()
        start = add(subtract(add(ORIGIN, scale(RADIUS, up())), CENTER), (0.0, 0.0, DROP))
        body = {
            "spheres": HUMAN,
            "scale": 1.0,
            "step_up_height": 0.6,
            "step_down_height": 1.5,
            "position": pose(IDENTITY, start),
            "state": STATE,
            "transient_state": ACTIVE,
            "acceleration": (0.0, 0.0, -9.8),
            "movement_manager": 1,
        }
        cells = [{"id": CELL, "pose": pose(TURN, ORIGIN), "geometry": geometry.name}]
        record = {"op": "body_walk", "cells": cells, "body": body, "ticks": []}
        return query_from_record(record, {geometry.name: geometry})

    def tick(self, number: int) -> Mapping[str, Any]:
        """Return a tick of the walk; velocities are float32."""
        if self.velocity is None or number < SETTLED:
            return {"q": QUANTUM}
        return {"q": QUANTUM, "set_velocity": round_point(self.velocity(number))}

    def plane(self) -> tuple[Vec3, float]:
        """Return normal and constant of the plane that the body stands on, in the block's frame, float64."""
        corners = self.geometry().corners(0)
        rows = _matrix()
        # The cell's pose is float32, as it is given; from there on nothing is rounded. Rounded corners do not
        # lie in one plane: as in retail, the constant is their mean (02 MP-6).
        normal = rotate(rows, unit_normal(corners))
        distances = [dot(normal, add(rotate(rows, corner), round_point(ORIGIN))) for corner in corners]
        return normal, -sum(distances) / len(distances)


def _matrix() -> Rows:
    """Return the matrix of `TURN` as retail makes it, from the quaternion as it is (01 4.2); float64."""
    w, _, _, z = TURN
    c, s = 1.0 - 2.0 * z * z, 2.0 * w * z
    return (c, s, 0.0), (-s, c, 0.0), (0.0, 0.0, 1.0)


@cache
def slope() -> Geometry:
    """Make the slope, one polygon."""
    return _turned("slope", [_square()])


@cache
def slope_with_wall() -> Geometry:
    """Make the slope with a wall that stands on it, across the way."""
    west, east = (-HALF, BEFORE_WALL, -1.0), (HALF, BEFORE_WALL, -1.0)
    top = [(x, y, 4.0) for x, y, _ in (east, west)]
    return _turned("slope-with-wall", [_square(), (west, east, top[0], top[1])])


def _square() -> tuple[Vec3, ...]:
    return ((-HALF, -HALF, 0.0), (HALF, -HALF, 0.0), (HALF, HALF, 0.0), (-HALF, HALF, 0.0))


def _turned(name: str, shape: list[tuple[Vec3, ...]]) -> Geometry:
    turned = [tuple(rotate(TILT, corner) for corner in corners) for corners in shape]
    return build(name, turned, style=TreeStyle.BOTH, kind="stress")


@cache
def up() -> Vec3:
    """Return the slope's normal in the block's frame, float64."""
    return rotate(rows_from_quaternion(TURN), rotate(TILT, (0.0, 0.0, 1.0)))


@cache
def _along() -> tuple[Vec3, Vec3]:
    """Return two directions along the slope, at right angles, in the block's frame."""
    one = cross((0.36, 0.48, 0.8), up())
    one = scale(1.0 / length(one), one)
    return one, cross(up(), one)


def _towards(angle: float) -> Vec3:
    """Return a velocity along the slope."""
    one, other = _along()
    return scale(SPEED, add(scale(math.cos(angle), one), scale(math.sin(angle), other)))


def _to_and_fro(tick: int) -> Vec3:
    """Walk a second there and a second back, each time in another direction: no two rounds are the same."""
    there = _towards(GOLDEN * (tick // (2 * LEG)))
    return there if tick % (2 * LEG) < LEG else scale(-1.0, there)


def _in_circles(tick: int) -> Vec3:
    """Walk circles of about 4 m across, in four seconds and a bit: no two rounds are the same."""
    return _towards(tick / RADIAN)


def _at_the_wall(_tick: int) -> Vec3:
    """Walk straight into the wall, and go on walking."""
    return scale(SPEED, rotate(rows_from_quaternion(TURN), rotate(TILT, (0.0, 1.0, 0.0))))


COURSES: Final = (
    Course("standstill", None, slope),
    Course("to and fro", _to_and_fro, slope),
    Course("circles", _in_circles, slope),
    Course("push at a wall", _at_the_wall, slope_with_wall, free=False, share=10),
)
"""What bodies do for long."""
