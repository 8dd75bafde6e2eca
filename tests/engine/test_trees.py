"""Trees asked directly: many at once as one by one, and errors instead of nonsense."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from engine_scenes import CELL, R, floor_and_wall, world_of

from engine import Cell, Pose, QueryError, World, step_down_many, strike_many
from engine.kernels.bsp_poly import sphere_intersects_poly
from engine.kernels.bsp_walkable import find_walkable
from engine.layout import NO_POLYGON, POLYGON_ID, WALK_INTERP, WALKABLE_ALLOWANCE

SPHERES = np.array(
    [[0.0, 0.0, 0.25, R], [0.75, 0.0, 1.0, R], [0.75, 0.0, 0.25, R], [-3.0, 1.0, 2.0, R]], dtype=np.float64
)
WAYS = np.array([[0, 0, -0.5], [0.25, 0, 0], [-0.25, 0, 0.125], [0, 0, -1]], dtype=np.float64)
UPS = np.tile((0.0, 0.0, 1.0), (4, 1))


def test_striking_equals_single_walks() -> None:
    """The same polygon, and the same answer, for every sphere."""
    world = world_of(floor_and_wall())
    struck, polygons = strike_many(world, 0, SPHERES, WAYS)
    assert struck.tolist() == [1, 1, 0, 0]
    assert polygons.tolist()[3] == -1
    for i in range(4):
        row = world.new_row()
        hit, poly = sphere_intersects_poly(
            world.floats, world.ints, row, world.tree_of(0), tuple(SPHERES[i]), tuple(WAYS[i]), NO_POLYGON
        )
        assert (int(hit), _id(world, poly)) == (struck[i], polygons[i])


def test_stepping_down_equals_single_walks() -> None:
    """The same centre, rest of the movement and polygon; the arguments are left alone."""
    world = world_of(floor_and_wall())
    allowances, interps = np.full(4, 0.5), np.ones(4)
    centers, left, polygons = step_down_many(world, 0, SPHERES, WAYS, UPS, allowances, interps)
    assert polygons[0] == 0
    assert centers[0].tolist() == [0.0, 0.0, R]
    assert interps.tolist() == [1.0] * 4
    for i in range(4):
        row = world.new_row()
        row[WALKABLE_ALLOWANCE], row[WALK_INTERP] = allowances[i], interps[i]
        asked = (tuple(given[i]) for given in (SPHERES, WAYS, UPS))
        poly, (x, y, z) = find_walkable(world.floats, world.ints, row, world.tree_of(0), *asked)
        assert ([x, y, z], row[WALK_INTERP], _id(world, poly)) == (centers[i].tolist(), left[i], polygons[i])


def _id(world: World, poly: int) -> int:
    return int(world.floats[poly + POLYGON_ID]) if poly != NO_POLYGON else -1


def test_numbers_are_rounded_to_float32() -> None:
    """A centre that no float32 has is taken for the nearest one."""
    world = world_of(floor_and_wall())
    exact = [[float(np.float32(0.1)), 0.0, 0.25, R]]
    ones = ([[0, 0, -0.5]], [[0, 0, 1]], [0.5], [1.0])
    rounded, given = (step_down_many(world, 0, s, *ones)[0] for s in (exact, [[0.1, 0.0, 0.25, 0.48]]))
    assert given.tolist() == rounded.tolist()


@pytest.mark.parametrize("threads", [1, 2, 3, 9])
def test_threads_change_nothing(threads: int) -> None:
    """Not even more threads than spheres."""
    world = world_of(floor_and_wall())
    alone = strike_many(world, 0, SPHERES, WAYS)
    shared = strike_many(world, 0, SPHERES, WAYS, threads=threads)
    for one, many in zip(alone, shared, strict=True):
        assert one.tobytes() == many.tobytes()


WRONG: list[tuple[Any, Any, Any, str]] = [
    (1, SPHERES, WAYS, "cell: 1 does not exist"),
    (0, SPHERES[:, :3], WAYS, "spheres: shape"),
    (0, SPHERES, WAYS[:3], "movements: 3 of them for 4 spheres"),
    ("a", SPHERES, WAYS, "cell: 'a' where a whole number is needed"),
    (0, "many", WAYS, "spheres: not an array of numbers"),
    (0, np.full((4, 4), np.nan), WAYS, "spheres: not all of them are finite"),
    (0, SPHERES, np.full((4, 3), 1e39), "movements: not all of them are finite"),
    (0, SPHERES, np.full((4, 3), -np.inf), "movements: not all of them are finite"),
]


@pytest.mark.parametrize(("cell", "spheres", "ways", "message"), WRONG)
def test_what_does_not_fit_is_refused(cell: Any, spheres: Any, ways: Any, message: str) -> None:
    """Naming it."""
    with pytest.raises(QueryError, match=message.replace("(", r"\(")):
        strike_many(world_of(floor_and_wall()), cell, spheres, ways)


def test_a_cell_without_a_tree_cannot_be_asked() -> None:
    """There is nothing to strike."""
    with pytest.raises(QueryError, match="no tree"):
        strike_many(World([Cell(CELL, Pose(CELL), None)]), 0, SPHERES, WAYS)


def test_every_sphere_has_one_allowance() -> None:
    """Numbers are not spread over spheres."""
    with pytest.raises(QueryError, match="allowances: shape"):
        step_down_many(world_of(floor_and_wall()), 0, SPHERES, WAYS, UPS, [0.5], np.ones(4))
