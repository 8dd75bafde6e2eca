"""What leaves know of slopes: too steep a polygon is never read, and everything else is asked as ever."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_scenes import CELL, floor_and_wall, world_of

from engine import Cell, Leaf, Node, Obstacle, Part, Pose, Shape, World
from engine import layout as at
from engine.constants import FLOOR_Z, HAS_PHYSICS_BSP, UP_SLACK, Z_LANDING
from engine.kernels.bsp_node import knows_slopes, slopes
from engine.kernels.bsp_walkable import find_walkable
from engine.tracing_interpreter import Interpreter

if TYPE_CHECKING:
    from engine.kernels.types import Array

UPRIGHT = (0.0, 0.0, 1.0)
HALF = float(np.float32(np.sqrt(0.5)))
ON_ITS_SIDE = (HALF, 0.0, HALF, 0.0)
"""A quarter turn about y, as w, x, y, z: up in the block is -x in the cell, where the wall faces."""
ASKED = Interpreter({})
UNMEASURED = Interpreter({knows_slopes: lambda *_: False})
"""Walks that know nothing of slopes."""
SIZE = 12
SPHERES = 1000


def noted(world: World, leaf: int) -> int:
    """Return which polygons of a leaf may be walked on."""
    return int(world.ints[at.NODE_INTS * leaf + at.NODE_NEXT] >> at.LEAF_SLOPES_SHIFT)


def measured(world: World, root: int) -> list[float]:
    """Return along which up the slopes of a tree are known."""
    up = at.NODE_FLOATS * (root + at.GATE) + at.GATE_UP
    along: list[float] = world.floats[up : up + 3].tolist()
    return along


def asked(world: World, up: tuple[float, ...], allowance: float) -> int:
    """Return the polygons that the first leaf of `floor_and_wall` has looked at for a question."""
    root = world.tree_of(0)
    known = ASKED.function(knows_slopes)(world.floats, root, up, allowance)
    mask: int = ASKED.function(slopes)(world.ints, root + 1, 2, known)
    return mask


def leaning(z: float) -> Shape:
    """Return one triangle with a normal of that z, less by what rounding takes."""
    x = float(np.sqrt(1.0 - z * z))
    corners = [(0.0, 0.0, 0.0), (z, 0.0, -x), (0.0, 1.0, 0.0)]
    return Shape(corners, [(0, 1, 2)], Leaf((0.0, 0.0, 0.0, 2.0), (0,)))


@pytest.mark.parametrize(
    ("rotation", "mask", "up"),
    [((1.0, 0.0, 0.0, 0.0), 0b01, [0.0, 0.0, 1.0]), (ON_ITS_SIDE, 0b10, [-1.0, 0.0, 0.0])],
    ids=["upright", "on its side"],
)
def test_leaves_tell_floors_from_walls(rotation: tuple[float, ...], mask: int, up: list[float]) -> None:
    """By the up of the cell: laid on its side, its wall is what one walks on."""
    world = World([Cell(CELL, Pose(CELL, (0.0, 0.0, 0.0), rotation), floor_and_wall())])
    root = world.tree_of(0)
    assert [noted(world, leaf) for leaf in (root + 1, root + 2)] == [mask, mask]
    assert measured(world, root) == pytest.approx(up, abs=1e-6)


def test_the_tree_of_a_part_is_measured_along_the_up_of_the_part() -> None:
    """Not of the cell that it is in."""
    pose = Pose(CELL, rotation=ON_ITS_SIDE)
    thing = Obstacle(pose, state=int(HAS_PHYSICS_BSP), parts=(Part(floor_and_wall()),))
    world = World([Cell(CELL, Pose(CELL), None, (thing,))])
    root = int(world.ints[world.ints[at.WORLD_PART_INTS] + at.PART_TREE])
    assert noted(world, root + 1) == 0b10


def test_a_common_tree_is_measured_along_the_up_of_the_first_cell() -> None:
    """Who asks in the other has every polygon looked at."""
    shape = floor_and_wall()
    world = World([Cell(CELL, Pose(CELL), shape), Cell(CELL + 1, Pose(CELL, rotation=ON_ITS_SIDE), shape)])
    assert noted(world, world.tree_of(1) + 1) == 0b01
    assert asked(world, UPRIGHT, float(FLOOR_Z)) == 0b01
    assert asked(world, (-1.0, 0.0, 0.0), float(FLOOR_Z)) == 0b11


@pytest.mark.parametrize(
    ("z", "mask"),
    [(float(FLOOR_Z) + 1e-4, 1), (float(FLOOR_Z) - UP_SLACK, 1), (float(FLOOR_Z) - 3.0 * UP_SLACK, 0)],
    ids=["flat", "steep by little", "steep"],
)
def test_what_is_steep_by_less_than_ups_may_differ_is_looked_at(z: float, mask: int) -> None:
    """Along another up that is near enough it may be flat."""
    world = world_of(leaning(z))
    assert noted(world, world.tree_of(0)) == mask


def test_a_polygon_without_area_is_looked_at() -> None:
    """Its normal is NaN, of which nothing is known beforehand."""
    corners = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0)]
    world = world_of(Shape(corners, [(0, 1, 2)], Leaf((0.0, 0.0, 0.0, 2.0), (0,))))
    assert noted(world, world.tree_of(0)) == 1


@pytest.mark.parametrize(
    ("up", "allowance", "mask"),
    [
        (UPRIGHT, float(FLOOR_Z), 0b01),
        (UPRIGHT, 1.0, 0b01),
        ((UP_SLACK / 4, -UP_SLACK / 4, 1.0 - UP_SLACK / 4), float(FLOOR_Z), 0b01),
        ((UP_SLACK, UP_SLACK, 1.0), float(FLOOR_Z), 0b11),
        ((float("nan"), 0.0, 1.0), float(FLOOR_Z), 0b11),
        (UPRIGHT, float(Z_LANDING), 0b11),
        (UPRIGHT, float("nan"), 0b11),
    ],
    ids=["walking", "steeper", "an up nearby", "another up", "no up", "landing", "no allowance"],
)
def test_other_questions_are_put_to_each_polygon(up: tuple[float, ...], allowance: float, mask: int) -> None:
    """Of another up, or for a smaller allowance, as the landing's is, nothing is known beforehand."""
    assert asked(world_of(floor_and_wall()), up, allowance) == mask


def random_world(rng: np.random.Generator) -> World:
    """Return a tree of leaves that list triangles of any facing, in a cell that is turned."""
    corners = rng.uniform(-1.0, 1.0, (3 * SIZE, 3)).astype(np.float32).astype(float)
    bounds = (0.0, 0.0, 0.0, 4.0)
    few, more = Leaf(bounds, tuple(range(0, SIZE, 3))), Leaf(bounds, tuple(range(SIZE)))
    tree = Node((0.0, 0.0, 1.0, 0.0), bounds, few, Node((1.0, 0.0, 0.0, 0.0), bounds, more, few))
    triangles = [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(SIZE)]
    shape = Shape([tuple(corner) for corner in corners], triangles, tree)
    turned = rng.normal(size=4)
    rotation = (turned / np.linalg.norm(turned)).astype(np.float32).tolist()
    return World([Cell(CELL, Pose(CELL, rotation=rotation), shape)])


def answered(
    walk: Any, world: World, ball: Array, way: Array, up: Array, allowance: float
) -> tuple[bytes, bytes]:
    """Return the answer of a walk, and the state that it leaves."""
    row = world.new_row()
    row[at.WALKABLE_ALLOWANCE], row[at.WALK_INTERP] = allowance, 1.0
    arguments = (tuple(values.tolist()) for values in (ball, way, up))
    with np.errstate(all="ignore"):
        poly, center = walk(world.floats, world.ints, row, world.tree_of(0), *arguments)
    return np.array([poly, *center], dtype=np.float64).tobytes(), row[: at.STATE_SIZE].tobytes()


def test_knowing_slopes_changes_nothing() -> None:
    """Neither answer nor row, counters included, along the cell's up or another; and ground is found."""
    found = 0
    for seed in range(5):
        rng = np.random.default_rng(seed)
        world = random_world(rng)
        up = np.array(measured(world, world.tree_of(0)))
        assert noted(world, world.tree_of(0) + 1) < (1 << (SIZE // 3)) - 1
        for k in range(SPHERES // 5):
            ball = (
                np.append(rng.uniform(-1.2, 1.2, 3), rng.uniform(0.1, 0.8)).astype(np.float32).astype(float)
            )
            way = rng.uniform(-0.5, 0.5, 3).astype(np.float32).astype(float)
            along = up + rng.uniform(-1.0, 1.0, 3) * (0.0, UP_SLACK, 0.5)[k % 3]
            allowance = (float(FLOOR_Z), float(Z_LANDING))[k % 2]
            answers = [
                answered(walk, world, ball, way, along, allowance)
                for walk in (find_walkable, ASKED.function(find_walkable), UNMEASURED.function(find_walkable))
            ]
            assert answers[0] == answers[1] == answers[2]
            found += answers[0][0][:8] != np.float64(at.NO_POLYGON).tobytes()
    assert found > SPHERES // 20


def test_a_wide_leaf_has_no_slopes() -> None:
    """Its planes are computed abreast."""
    size = int(at.WIDE_LEAF)
    shape = Shape(
        [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)] * size, Leaf((0.0, 0.0, 0.0, 2.0), tuple(range(size)))
    )
    world = world_of(shape)
    assert noted(world, world.tree_of(0)) == 0
