"""Grids of clearances: each is as large as it may be, and none says more than a walk through the tree."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_scenes import CELL, floor_and_wall, prepared, triangle, world_of
from hypothesis import given
from hypothesis import strategies as st

from engine import Cell, Leaf, Pose, Shape, World
from engine import layout as at
from engine.compiling import clearance
from engine.kernels.broad import tree_beyond
from engine.kernels.clearance import known_clear
from engine.tracing_interpreter import Interpreter

if TYPE_CHECKING:
    from engine.kernels.types import Array

INTERPRETER = Interpreter({})


def corner_world() -> World:
    """Return a floor and a wall with a grid that is finer than two polygons pay for."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(clearance, "_CUBES_PER_POLYGON", 2048)
        return world_of(floor_and_wall())


CORNER = corner_world()


def grid_of(world: World) -> Array:
    """Return the record of the grid of a world's only cell."""
    first = int(world.ints[world.ints[at.WORLD_CLEARANCES]])
    return world.floats[first : first + int(at.CLEARANCE_SIZE)]


def levels_of(world: World) -> Array:
    """Return the levels of all cubes, shape (x, y, z)."""
    grid = grid_of(world)
    counts = grid[at.CLEARANCE_COUNTS : at.CLEARANCE_COUNTS + 3].astype(int)
    first = int(grid[at.CLEARANCE_LEVELS]) // 8
    packed = world.ints[first : first + -(-int(counts.prod()) // 8)]
    levels = packed[:, np.newaxis] >> 8 * np.arange(8) & 0xFF
    return levels.ravel()[: int(counts.prod())].reshape(counts)


def middles_of(world: World) -> Array:
    """Return the middles of all cubes, shape (x, y, z, 3), metres."""
    grid = grid_of(world)
    counts = grid[at.CLEARANCE_COUNTS : at.CLEARANCE_COUNTS + 3].astype(int)
    cubes = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), axis=-1)
    return grid[:3] + grid[at.CLEARANCE_EDGE] * (cubes + 0.5)


def asked(kernel: Any, *arguments: Any) -> bool:
    """Ask a kernel that Python cannot call."""
    numbers = [np.float64(value) if isinstance(value, float) else value for value in arguments]
    return bool(INTERPRETER.function(kernel)(*numbers))


def test_clearances_are_as_large_as_steps_allow() -> None:
    """Above a floor and beside a wall: that of the nearer one is less than a step more than the level."""
    levels, middles = levels_of(CORNER), middles_of(CORNER)
    step = grid_of(CORNER)[at.CLEARANCE_EDGE] / at.CLEARANCE_STEPS
    x, y, z = np.moveaxis(middles, -1, 0)
    inside = (np.abs(x) < 4.0) & (np.abs(y) < 2.0) & (z < 3.0)
    distance = np.minimum(z, np.abs(x - 1.0))[inside]
    assert inside.sum() > 50
    assert (levels[inside] * step < distance).all()
    assert (distance < (levels[inside] + 1) * step + 1e-3).all()


@given(
    st.tuples(st.floats(-6.0, 6.0), st.floats(-6.0, 6.0), st.floats(-1.0, 4.0)),
    st.floats(0.0, 3.0),
)
def test_what_is_known_to_be_clear_is(center: tuple[float, float, float], radius: float) -> None:
    """A ball that the grid calls clear is clear for the walk through the tree, too."""
    floats, ints = CORNER.floats, CORNER.ints
    if asked(known_clear, floats, ints, 0, *center, radius):
        assert asked(tree_beyond, floats, ints, CORNER.new_row(), CORNER.tree_of(0), (*center, radius))


@pytest.mark.parametrize(
    ("center", "radius", "clear"),
    [
        ((-1.5, 0.0, 1.5), 1.0, True),
        ((-1.5, 0.0, 1.5), 1.6, False),
        ((0.0, 0.0, 1.5), 1.1, False),
        ((-1.5, 0.0, 9.0), 1.0, False),
        ((float("nan"), 0.0, 1.5), 1.0, False),
        ((-1.5, 0.0, 1.5), float("nan"), False),
    ],
    ids=["clear", "the floor", "the wall", "outside of the box", "nowhere", "of no size"],
)
def test_what_the_grid_knows(center: tuple[float, float, float], radius: float, clear: bool) -> None:
    """It knows balls inside the box; of all others the tree is asked."""
    assert asked(known_clear, CORNER.floats, CORNER.ints, 0, *center, radius) == clear


def test_cells_of_one_shape_share_a_grid() -> None:
    """And a cell without polygons has none."""
    shape = triangle()
    world = prepared(
        World(
            [
                Cell(CELL, Pose(CELL), shape),
                Cell(CELL + 1, Pose(CELL), Shape([], [], Leaf((0, 0, 0, 1)))),
                Cell(CELL + 2, Pose(CELL), shape),
                Cell(CELL + 3, Pose(CELL), None),
            ]
        )
    )
    first = world.ints[at.WORLD_CLEARANCES]
    one, none, same, no_shape = world.ints[first : first + 4]
    assert one == same > 0
    assert none == no_shape == at.NO_CLEARANCE


@pytest.mark.parametrize("size", [0.1, 10.0, 1e6])
def test_a_grid_is_not_larger_than_its_geometry_pays_for(size: float) -> None:
    """However large the box is; cubes of a small one are not made smaller."""
    grid = clearance._grid_about(triangle(size))
    counts = grid[at.CLEARANCE_COUNTS : at.CLEARANCE_COUNTS + 3]
    assert 1 <= counts.prod() <= clearance._CUBES_PER_POLYGON
    assert (counts * grid[at.CLEARANCE_EDGE] >= (2 * size, 2 * size, 0.0)).all()


def test_a_leaf_that_lists_many_has_few_cubes() -> None:
    """Each cube may have to look at all of it: a floor of 4,096 tiles without a tree takes no minutes."""
    side = 8.0 * np.arange(65)
    corners = [(x, y, x * y / 4096.0) for x in side for y in side]
    tiles = [(k, k + 65, k + 66, k + 1) for k in range(65 * 64) if k % 65 != 64]
    world = world_of(Shape(corners, tiles, Leaf((256.0, 256.0, 32.0, 400.0), range(len(tiles)))))
    counts = grid_of(world)[at.CLEARANCE_COUNTS : at.CLEARANCE_COUNTS + 3]
    assert len(tiles) == 4096
    assert (
        1 <= counts.prod() <= clearance._MOST_TESTS // len(tiles) < clearance._CUBES_PER_POLYGON * len(tiles)
    )
