"""Walks through trees with wide leaves: the same answers, polygon by polygon, as the plain walks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_scenes import floor_and_wall, world_of
from hypothesis import given, settings
from hypothesis import strategies as st

from engine import Leaf, Node, Shape, World
from engine import layout as at
from engine.kernels.abreast import flat_planes, lowest, near_planes
from engine.kernels.bsp_node import is_wide
from engine.kernels.bsp_poly import sphere_intersects_poly, sphere_intersects_solid
from engine.kernels.bsp_walkable import find_walkable
from engine.kernels.polygon import along_normal, plane_distance
from engine.tracing_interpreter import Interpreter

if TYPE_CHECKING:
    from engine.kernels.types import Array

HOSTILE = (0.0, -0.0, 1.0, 1e-45, 1e30, float("inf"), float("-inf"), float("nan"))
NUMBERS = st.sampled_from(HOSTILE) | st.floats(-2.0, 2.0, width=32)
PLAIN = Interpreter({is_wide: lambda *_: False})
"""Walks that take no leaf for a wide one."""
AS_WRITTEN = Interpreter({})
COMPILING = settings(deadline=None)
"""The first example may compile a kernel."""
SPHERES = 80


def random_leaf(rng: np.random.Generator, bounds: tuple[float, ...], corners: list[Any], size: int) -> Leaf:
    """Return a leaf that lists triangles of any facing; their corners are added."""
    first = len(corners) // 3
    corners += list(rng.uniform(-1.0, 1.0, (3 * size, 3)).astype(np.float32).astype(float))
    return Leaf(bounds, tuple(range(first, first + size)))


def random_world() -> World:
    """Return a tree of a wide leaf, whose last block has one polygon, and of one that is not wide."""
    rng = np.random.default_rng(24)
    corners: list[Any] = []
    bounds = (0.0, 0.0, 0.0, 4.0)
    wide = random_leaf(rng, bounds, corners, int(at.WIDE_LEAF + at.ABREAST + 1))
    few = random_leaf(rng, bounds, corners, int(at.ABREAST - 1))
    tree = Node((0.0, 0.0, 1.0, 0.0), bounds, few, Node((1.0, 0.0, 0.0, 0.0), bounds, wide, few))
    triangles = [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(corners) // 3)]
    return world_of(Shape([tuple(corner) for corner in corners], triangles, tree))


def walks(world: World, rng: np.random.Generator) -> list[tuple[Any, tuple[Any, ...]]]:
    """Return for one sphere each walk with its arguments behind the row."""
    root = world.tree_of(0)
    center = rng.uniform(-1.2, 1.2, 3).astype(np.float32).astype(float).tolist()
    way = tuple(rng.uniform(-0.5, 0.5, 3).astype(np.float32).astype(float).tolist())
    sphere = (*center, float(np.float32(rng.uniform(0.05, 0.5))))
    return [
        (sphere_intersects_poly, (root, sphere, way, at.NO_POLYGON)),
        (sphere_intersects_solid, (root, sphere, 1)),
        (find_walkable, (root, sphere, way, (0.0, 0.0, 1.0))),
    ]


def answered(walk: Any, world: World, arguments: tuple[Any, ...]) -> tuple[Any, bytes]:
    """Return the answer of a walk, and the state that it leaves; the stack behind it is not cleared."""
    row = world.new_row()
    row[at.WALKABLE_ALLOWANCE], row[at.WALK_INTERP] = 0.25, 1.0
    with np.errstate(all="ignore"):
        answer = walk(world.floats, world.ints, row, *arguments)
    parts = answer if isinstance(answer, tuple) else (answer,)
    return np.hstack(parts).astype(np.float64).tobytes(), row[: at.STATE_SIZE].tobytes()


def test_a_wide_leaf_changes_nothing() -> None:
    """Neither answer nor row, counters included; and every kind of answer occurs."""
    world, rng = random_world(), np.random.default_rng(7)
    answers: dict[Any, set[bytes]] = {}
    for _ in range(SPHERES):
        for walk, arguments in walks(world, rng):
            answer, row = answered(walk, world, arguments)
            assert (answer, row) == answered(PLAIN.function(walk), world, arguments)
            assert (answer, row) == answered(AS_WRITTEN.function(walk), world, arguments)
            answers.setdefault(walk, set()).add(answer)
    assert len(answers[sphere_intersects_poly]) > SPHERES // 10
    assert len(answers[sphere_intersects_solid]) == 2
    assert len(answers[find_walkable]) > SPHERES // 10


def block(numbers: list[float]) -> Array:
    """Return a block of planes behind a number that does not belong to it."""
    return np.array([0.5, *numbers], dtype=np.float64)


@COMPILING
@given(
    st.lists(NUMBERS, min_size=32, max_size=32),
    st.tuples(NUMBERS, NUMBERS, NUMBERS),
    NUMBERS,
    st.integers(1, 9),
)
def test_planes_abreast_have_the_bits_of_one(
    numbers: list[float], point: tuple[float, float, float], bound: float, count: int
) -> None:
    """Each plane of a block is near, or flat, as it is by itself; what is not of the leaf is neither."""
    planes = np.array(numbers).reshape(4, 8).T
    floats, first = block(numbers), min(count, 8)
    with np.errstate(all="ignore"):
        distance, along = AS_WRITTEN.function(plane_distance), AS_WRITTEN.function(along_normal)
        near = [not bound < abs(distance(plane.copy(), 0, *map(np.float64, point))) for plane in planes]
        flat = [bool(along(plane.copy(), 0, *map(np.float64, point)) > bound) for plane in planes]
        asked = AS_WRITTEN.function(near_planes)(floats, 1, count, *point, bound)
        level = AS_WRITTEN.function(flat_planes)(floats, 1, *point, bound)
    expected = sum(1 << k for k in range(first) if near[k])
    assert near_planes(floats, 1, count, *point, bound) == asked == expected
    assert flat_planes(floats, 1, *point, bound) == level == sum(1 << k for k in range(8) if flat[k])


@pytest.mark.parametrize(("mask", "bit"), [(1, 0), (2, 1), (0b1100, 2), (1 << 40, 40), (-1, 0)])
def test_the_lowest_bit(mask: int, bit: int) -> None:
    """Compiled as interpreted."""
    assert lowest(mask) == AS_WRITTEN.function(lowest)(mask) == bit


def test_a_tree_without_a_wide_leaf_has_no_blocks() -> None:
    """Its planes lie in the polygons' records alone: a leaf says nothing of them."""
    world = world_of(floor_and_wall())
    leaves = [world.tree_of(0) + 1, world.tree_of(0) + 2]
    assert [float(world.floats[at.NODE_FLOATS * leaf + at.LEAF_PLANES]) for leaf in leaves] == [0.0, 0.0]
