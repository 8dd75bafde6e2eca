"""Motions drawn from a seed: rigid ones, and shifts by whole landblocks; the same on every platform."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, Final, TypeAlias

from conformance.scenes.algebra import ORIGIN, round_point
from conformance.scenes.rigid import IDENTITY, Transform
from conformance.scenes.rotations import round_quaternion
from oracle.constants import BLOCK_EDGE

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.scenes.model import Quaternion, Vec3

NEAR: Final = 200.0
"""Largest ordinary translation along an axis, metres: a landblock and a bit."""
BLOCKS: Final = 10
"""Largest block-scale translation, landblocks: up to 2 km float32 still resolves retail's EPS."""
HALF_ROOT: Final = 0.7071067690849304
"""Square root of one half, float32: cosine and sine of half a quarter turn."""

Shift: TypeAlias = tuple[int, int]
"""Landblocks to the east and to the north."""
Room: TypeAlias = tuple[tuple[int, int], tuple[int, int]]
"""The least and the greatest shift, to the east and to the north."""


def seeded_shifts(count: int, seed: int, room: Room) -> list[Shift]:
    """Return shifts that take turns in kind: to anywhere, to the north-eastern and the south-western corner.

    Parameters
    ----------
    count : int
        How many; more of the same seed begin with the same.
    seed : int
        Any whole number.
    room : Room
        How far there is map.
    """
    numbers = random.Random(seed)  # noqa: S311
    shifts: list[Shift] = []
    for i in range(count):
        anywhere = [low + int((high - low + 1) * numbers.random()) for low, high in room]
        corner = [high for _, high in room] if i % 4 == 1 else [low for low, _ in room]
        x, y = anywhere if i % 4 in {0, 2} else corner
        shifts.append((x, y))
    return shifts


def seeded_poses(count: int, seed: int) -> list[Transform]:
    """Return motions that take turns in kind: the same for a seed on every platform.

    Rotations go identity, yaw, quarter turn, any; translations go up to `NEAR`, none, whole landblocks.

    Parameters
    ----------
    count : int
        How many; more of the same seed begin with the same.
    seed : int
        Any whole number.
    """
    # Only random() and arithmetic that IEEE 754 fixes: no library function may differ between platforms.
    numbers = random.Random(seed)  # noqa: S311
    poses = []
    for i in range(count):
        rotation = _rotation(i % 4, numbers)
        poses.append(Transform(rotation, _translation((i + i // 4) % 3, numbers)))
    return poses


def _rotation(kind: int, numbers: random.Random) -> Quaternion:
    if kind == 0:
        return IDENTITY.rotation
    if kind == 1:
        w, z = _unit(2, numbers)
        return round_quaternion((w, 0.0, 0.0, z))
    if kind == 2:
        return _quarter_turn(numbers)
    return round_quaternion(_unit(4, numbers))


def _quarter_turn(numbers: random.Random) -> Quaternion:
    """Return a turn by 90, 180 or 270 degrees about one of the axes."""
    axis = int(3 * numbers.random())
    turns = ((HALF_ROOT, HALF_ROOT), (0.0, 1.0), (HALF_ROOT, -HALF_ROOT))
    w, part = turns[int(3 * numbers.random())]
    x, y, z = (part if k == axis else 0.0 for k in range(3))
    return (w, x, y, z)


def _translation(kind: int, numbers: random.Random) -> Vec3:
    if kind == 0:
        return round_point(NEAR * part for part in _signed(3, numbers))
    if kind == 1:
        return ORIGIN
    x, y = (BLOCK_EDGE * round(BLOCKS * part) for part in _signed(2, numbers))
    return (x, y, 0.0)


def _signed(dimensions: int, numbers: random.Random) -> Iterator[float]:
    """Yield numbers between -1 and 1."""
    for _ in range(dimensions):
        yield 2.0 * numbers.random() - 1.0


def _unit(dimensions: int, numbers: random.Random) -> list[float]:
    """Return a direction, evenly distributed: a point of the unit ball, not yet of length 1."""
    while True:
        point = list(_signed(dimensions, numbers))
        if 0.0 < sum(part * part for part in point) <= 1.0:
            return point
