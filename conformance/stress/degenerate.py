"""Degenerate geometry: floors with slivers, folds, copies, gaps, polygons of no area, and lopsided trees.

Every scene is a floor on which a human walks and lands; what is wrong with it lies across the human's way.
The unstressed answer is that on a floor without it.
"""

from __future__ import annotations

import math
import random
from functools import partial
from typing import TYPE_CHECKING, Final, TypeAlias

from conformance.scenes.algebra import add, scale, subtract
from conformance.scenes.bounds import Bounds
from conformance.scenes.model import Geometry, Leaf, Node
from conformance.scenes.polygons import merge
from conformance.scenes.rotations import rotate, rows_from_quaternion
from conformance.strategies.human import RADIUS
from conformance.stress.asking import ErrorSweep
from conformance.stress.effect import Effect
from conformance.stress.moves import CENTER, Move, room_query
from conformance.stress.sweep import Probe
from conformance.stress.translation import YAW

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from conformance.scenes.model import Tree, Vec3
    from conformance.scenes.polygons import Corners, Shape
    from conformance.stress.settings import Settings

    Make: TypeAlias = Callable[[float], Geometry]

FAMILY: Final = "degenerate"
ORIGIN: Final[Vec3] = (90.0, 45.0, 12.0)
"""Of the cell, metres: in the middle of a landblock."""
HALF: Final = 4.0
"""Half of the floor's side, metres."""
NORMAL: Final[Vec3] = (0.0, 0.0, 1.0)
"""Of the floor, before it is turned."""
TILT: Final = rows_from_quaternion((1.0, 0.05, 0.08, 0.0))
"""How the floors are turned in the cell's frame: by 11 degrees, so that no part of a normal is 0 or 1."""
BOUND: Final = (0.0, 0.0, 0.0, 3e6)
"""Bounding sphere of trees whose bounds are not what is stressed, metres."""
THINNESS: Final = tuple(float(10**power) for power in range(8))
"""One over a width in metres, or over an angle in radians."""
COPIES: Final = (1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0)
GAPS: Final = (0.0, *(10.0**power for power in range(-7, -1)))
"""Metres."""
SIZES: Final = tuple(float(10**power) for power in range(1, 7))
"""Metres."""
DEPTHS: Final = (1.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0)
"""Nodes above the floor's leaf; real cells stay below a hundred."""


def sweeps(settings: Settings) -> Sequence[ErrorSweep]:
    """Return the family."""
    plans: Mapping[str, tuple[str, tuple[float, ...], Make]] = {
        "sliver": ("1 / width of the sliver (1/m)", THINNESS, sliver),
        "fold": ("1 / angle between neighbours (1/rad)", THINNESS, fold),
        "copies": ("copies of the floor", COPIES, copies),
        "gap": ("gap at a T-junction (m)", GAPS, t_junction),
        "no area": ("polygons without area", (0.0, *COPIES), without_area),
        "needle": ("1 / width of the ramp (1/m)", THINNESS, needle),
        "huge": ("side of the floor (m)", SIZES, huge),
        "deep": ("nodes above the leaf", DEPTHS, deep),
    }
    return [
        ErrorSweep(FAMILY, name, axis, settings.thinned(severities), partial(_probes, settings, make))
        for name, (axis, severities, make) in plans.items()
    ]


def _probes(settings: Settings, make: Make, severity: float) -> Iterator[Probe]:
    geometry, plain = make(severity), in_one_leaf("plain", [_tile(-HALF, HALF)])
    for move in _floor_moves(settings.seed, settings.probes):
        ideal = room_query(move, plain, rotation=YAW, origin=ORIGIN)
        yield Probe(room_query(move, geometry, rotation=YAW, origin=ORIGIN), Effect(ideal))


def _floor_moves(seed: int, count: int) -> Iterator[Move]:
    """Yield walks and landings near the middle of the floor, across the line x = 0."""
    numbers = random.Random(seed)  # noqa: S311
    for number in range(count):
        x, y, size = (numbers.random() for _ in range(3))
        start = (0.8 * (x - 0.5), 2.0 * (y - 0.5), 0.0)
        stride = (math.copysign(0.05 + 0.3 * size, -start[0]), 0.3 * (numbers.random() - 0.5))
        begin = resting(start)
        if number % 3 == 2:
            begin = add(begin, (0.0, 0.0, 0.25 * numbers.random()))
            yield Move(begin, add(begin, (*stride, -0.4)), None)
        else:
            end = resting((start[0] + stride[0], start[1] + stride[1], 0.0))
            yield Move(begin, end, (rotate(TILT, NORMAL), (0.0, 0.0, 0.0)))


def resting(point: Vec3) -> Vec3:
    """Return the feet of a human whose lower sphere rests on a point of the floor before it is turned."""
    return subtract(rotate(TILT, add(point, scale(RADIUS, NORMAL))), CENTER)


def sliver(thinness: float) -> Geometry:
    """Make a floor of two halves with a strip between them."""
    half = 0.5 / thinness
    return in_one_leaf("sliver", [_tile(-HALF, -half), _tile(-half, half), _tile(half, HALF)])


def fold(thinness: float) -> Geometry:
    """Make a floor whose right half rises by a small angle."""
    rise = HALF * math.tan(min(1.0 / thinness, 0.5))
    right = ((0.0, -HALF, 0.0), (HALF, -HALF, rise), (HALF, HALF, rise), (0.0, HALF, 0.0))
    return in_one_leaf("fold", [_tile(-HALF, 0.0), right])


def copies(count: float) -> Geometry:
    """Make a floor that is there several times."""
    return in_one_leaf("copies", [_tile(-HALF, HALF)] * int(count))


def t_junction(gap: float) -> Geometry:
    """Make a floor of a left half and two right quarters that fall short of it, each in its own way."""
    front = ((gap, -HALF, 0.0), (HALF, -HALF, 0.0), (HALF, 0.1, 0.0), (0.0, 0.1, 0.0))
    back = ((gap, 0.1, 0.0), (HALF, 0.1, 0.0), (HALF, HALF, 0.0), (0.0, HALF, 0.0))
    return in_one_leaf("t-junction", [_tile(-HALF, 0.0), front, back])


def without_area(count: float) -> Geometry:
    """Make a floor with polygons whose corners lie on a line, or on each other: their plane is NaN."""
    line: Corners = ((-0.5, -1.0, 0.0), (0.0, 0.0, 0.0), (0.5, 1.0, 0.0))
    point: Corners = ((0.1, 0.1, 0.0), (0.1, 0.1, 0.0), (0.1, 0.1, 0.0))
    flat = [(line, point)[number % 2] for number in range(int(count))]
    return in_one_leaf("no-area", [*flat, _tile(-HALF, HALF)])


def needle(thinness: float) -> Geometry:
    """Make a floor with a very narrow ramp on it, 1 m long, that climbs to the right."""
    half = 0.5 / thinness
    ramp = ((-0.5, 0.1 - half, 0.0), (0.5, 0.1 - half, 0.4), (0.5, 0.1 + half, 0.4), (-0.5, 0.1 + half, 0.0))
    return in_one_leaf("needle", [ramp, _tile(-HALF, HALF)])


def huge(side: float) -> Geometry:
    """Make a floor that reaches far at one corner, with a palm-sized plate on it."""
    far, small = side / 2.0, 0.05
    floor = ((-HALF, -HALF, 0.0), (far, -HALF / 3.0, 0.0), (far, far, 0.0), (-HALF / 7.0, far / 3.0, 0.0))
    plate = ((-small, -small, 0.01), (small, -small, 0.01), (small, small, 0.01), (-small, small, 0.01))
    return in_one_leaf("huge", [floor, plate])


def deep(depth: float) -> Geometry:
    """Make a floor below a tree with one long side: every plane has the floor in front of it."""
    corners = _tile(-HALF, HALF)
    vertices, polygons = merge(_turned([corners]))
    tree: Tree = Leaf(0, solid=False, sphere=BOUND, polygons=(0,))
    for number in range(int(depth)):
        empty = Leaf(number + 1, solid=False, sphere=BOUND, polygons=())
        tree = Node((0.0, 0.6, 0.8, 8.0 + 0.25 * number), BOUND, (), tree, empty)
    return Geometry("deep", vertices, polygons, tree, kind="stress")


def in_one_leaf(name: str, shape: Shape) -> Geometry:
    """Turn a shape by `TILT` and put all its polygons into one leaf, in their order, checked by nobody."""
    there = _turned(shape)
    vertices, polygons = merge(there)
    order = tuple(range(len(polygons)))
    leaf = Leaf(0, solid=False, sphere=Bounds(there).sphere(order), polygons=order)
    return Geometry(name, vertices, polygons, leaf, kind="stress")


def _turned(shape: Shape) -> Shape:
    return [tuple(rotate(TILT, corner) for corner in corners) for corners in shape]


def _tile(west: float, east: float) -> Corners:
    return ((west, -HALF, 0.0), (east, -HALF, 0.0), (east, HALF, 0.0), (west, HALF, 0.0))
