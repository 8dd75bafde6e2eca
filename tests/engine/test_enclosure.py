"""Which trees need no bounding spheres: those with nothing outside of one, and nothing odd in them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from engine_scenes import floor_and_wall, triangle, world_of

from engine import Leaf, Node, Shape
from engine import layout as at
from engine.compiling.enclosure import gate_radius
from engine.constants import EPS, GATE_MOST

WIDE = (0.0, 0.0, 0.0, 10.0)
"""Sphere about whatever is near the origin."""
SQUARE = [(-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (-1.0, 1.0, 0.0)]
FAR = 4000.0
"""Where float32 counts by 0.2 mm, which is too much for EPS, metres."""
NEEDLE = [(3.8062, 0.9624, -0.8287), (4.6657, -2.0198, 1.3263), (4.0715, 0.0420, -0.1636)]
"""Three points of a line, but for a tenth of a millimetre."""
TWICE_AROUND = [(math.cos(4 * math.pi * k / 5), math.sin(4 * math.pi * k / 5), 0.0) for k in range(5)]
"""A star: it turns left at every corner, and by two circles in all."""


def leaf(*corners: tuple[float, ...], sphere: tuple[float, ...] = WIDE) -> Shape:
    """Return one polygon in a leaf."""
    return Shape(corners, [range(len(corners))], Leaf(sphere, (0,)))


@pytest.mark.parametrize(
    "shape",
    [
        triangle(),
        floor_and_wall(),
        leaf(*SQUARE),
        leaf(*SQUARE[:2], (1.0, 0.3, 0.0), (1.0, 0.7, 0.0), *SQUARE[2:]),
        leaf(*SQUARE[:2], (1.0 - 1e-6, 0.5, 0.0), *SQUARE[2:]),
        Shape([], [], Leaf((0.0, 0.0, 0.0, 0.0))),
    ],
    ids=["a triangle", "two polygons", "a square", "corners on an edge", "a rounded one", "nothing"],
)
def test_bounding_spheres_decide_nothing(shape: Shape) -> None:
    """Where all is inside of them, corners on a straight edge as well; the gate before the root says so."""
    assert gate_radius(shape) == GATE_MOST
    world = world_of(shape)
    assert world.floats[at.NODE_FLOATS * (world.tree_of(0) + at.GATE) + at.GATE_RADIUS] == GATE_MOST


@pytest.mark.parametrize(
    "corners",
    [
        [(-1, -1, 1e-3), (1, -1, -1e-3), (1, 1, 1e-3), (-1, 1, -1e-3)],
        [*SQUARE[:2], (0.9, 0.0, 0.0), *SQUARE[2:]],
        [SQUARE[0], SQUARE[1], SQUARE[2], SQUARE[2]],
        NEEDLE,
        SQUARE[:2],
        [SQUARE[0], SQUARE[1], (0.0, -1.0, 0.0)],
        TWICE_AROUND,
        [(x + FAR, y + FAR, z) for x, y, z in SQUARE],
    ],
    ids=["warped", "dented", "no edge", "a needle", "no area", "a line", "twice around", "far away"],
)
def test_odd_polygons_need_them(corners: list[tuple[float, ...]]) -> None:
    """What is not flat and convex, or rounded by too much, may be hit from farther away than it seems."""
    assert gate_radius(leaf(*corners, sphere=(0.0, 0.0, 0.0, 1e4))) == at.NO_GATE


@pytest.mark.parametrize(("short", "radius"), [(0.0, GATE_MOST), (0.25, GATE_MOST), (0.75, at.NO_GATE)])
def test_a_sphere_may_be_short_of_a_corner_by_a_part_of_eps(short: float, radius: float) -> None:
    """By as much as retail's slack leaves when all roundings have had theirs."""
    sphere = (0.0, 0.0, 0.0, math.sqrt(2.0) - short * EPS)
    assert gate_radius(leaf(*SQUARE, sphere=sphere)) == radius


def test_every_node_has_to_hold_what_is_below() -> None:
    """A leaf's polygons are outside of the root's sphere, or of one between."""
    near, far = Leaf(WIDE, (0,)), Leaf(WIDE)
    small = Node((0.0, 0.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0), near, far)
    for tree in (
        small,
        Node((0.0, 0.0, 1.0, 2.0), WIDE, small, far),
        Node((0.0, 0.0, -1.0, 2.0), WIDE, far, small),
    ):
        assert gate_radius(Shape(SQUARE, [range(4)], tree)) == at.NO_GATE


def test_a_leaf_of_nothing_may_be_anywhere() -> None:
    """Its sphere is never read."""
    empty = Leaf((99.0, 0.0, 0.0, 0.0))
    tree = Node((0.0, 0.0, 1.0, 1.0), WIDE, Leaf(WIDE, (0,)), empty)
    assert gate_radius(Shape(np.array(SQUARE), [range(4)], tree)) == GATE_MOST
