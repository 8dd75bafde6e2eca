"""Worlds: records where the header says, shared shapes once, wrong cells refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from engine_scenes import CELL, R, floor_and_wall, triangle

from engine import Cell, Pose, PoseError, StaticObject, World, WorldError
from engine import layout as at

OTHER = CELL + 1


def test_shared_shapes_are_stored_once() -> None:
    """Two cells and an object with the same geometry have the same tree."""
    shape = triangle()
    cells = [
        Cell(CELL, Pose(CELL), shape, [StaticObject(shape, Pose(CELL, (1, 2, 3)))], [OTHER]),
        Cell(OTHER, Pose(CELL), shape),
    ]
    world = World(cells)
    assert world.shapes == (shape,)
    assert world.tree_of(0) == world.tree_of(1) == at.FIRST_NODE
    assert world.objects_of(0) == (0, 1)
    assert world.objects_of(1) == (1, 0)
    assert repr(world) == "<World: 2 cells, 1 objects, 1 shapes>"


def test_polygons_and_trees_are_relocated() -> None:
    """The second shape's leaf lists name its own polygons, its nodes its own children."""
    first, second = triangle(), floor_and_wall()
    world = World([Cell(CELL, Pose(CELL), first), Cell(OTHER, Pose(CELL), second)])
    root = world.tree_of(1)
    assert root == at.FIRST_NODE + 1
    positive = world.ints[at.NODE_INTS * root + at.NODE_POSITIVE]
    assert positive == root + 1
    start, count = world.ints[at.NODE_INTS * positive + at.LEAF_FIRST :][:2]
    listed = world.ints[start : start + count].tolist()
    assert listed == [world.polygon(1, 0), world.polygon(1, 1)]
    assert world.floats[listed[1] + at.POLYGON_ID] == 1
    assert world.floats[listed[1] + at.POLYGON_SHAPE] == 1


def test_a_cell_without_geometry_has_no_tree() -> None:
    """It collides with nothing and contains every point."""
    world = World([Cell(CELL, Pose(CELL), None)])
    assert world.tree_of(0) == at.NO_TREE
    assert world.cell_index(CELL) == 0
    assert world.cell_index(OTHER) == at.NO_CELL


def test_a_row_has_room_for_what_the_world_needs() -> None:
    """The deepest tree's levels, every cell, every object, and the trace."""
    shape = floor_and_wall()
    world = World([Cell(CELL, Pose(CELL), shape, [StaticObject(shape, Pose(CELL))])])
    assert len(world.new_row()) == at.STATE_SIZE + shape.depth + 1 + 1
    row = world.new_row(trace_capacity=7)
    assert len(row) == len(world.new_row()) + 7
    assert row[at.TRACE_CAPACITY] == 7


def test_poses_keep_their_rotation_unnormalised() -> None:
    """Retail copies the quaternion as it is, if it is near enough to unit length."""
    pose = Pose(CELL, (R, 0, 0), (1.0002, 0, 0, 0))
    world = World([Cell(CELL, pose, None)])
    begin = world.ints[at.WORLD_CELL_FLOATS]
    assert world.floats[begin + at.QUATERNION] == np.float32(1.0002)
    assert world.floats[begin + at.ORIGIN] == R
    assert world.floats[begin + at.CELL_ID] == CELL


SHAPE = triangle()


def test_a_world_has_a_cell() -> None:
    """Nothing can be in a world without one."""
    with pytest.raises(WorldError, match="world: has no cells"):
        World([])


WRONG: list[tuple[list[Cell], str]] = [
    ([Cell(0xA9B40001, Pose(CELL), SHAPE)], "cell 0: 0xa9b40001 is not the id of an indoor cell"),
    ([Cell(-1, Pose(CELL), SHAPE)], "cell 0: -0x1 is not the id of an indoor cell"),
    ([Cell(CELL, Pose(CELL), SHAPE)] * 2, "cell 1: id 0xa9b40111 is used twice"),
    (
        [Cell(CELL, Pose(CELL), SHAPE, portals=[OTHER])],
        "cell 0xa9b40111: a portal leads to 0xa9b40112, which is not in the world",
    ),
]
WRONG_POSES: list[tuple[Pose, str]] = [
    (Pose(1 << 32), "pose: cell id 4294967296 is not a 32-bit number"),
    (Pose(CELL, (0, 0, np.inf)), "pose, origin: inf at (2,) is not a finite float32"),
    (Pose(CELL, (0, 0)), "pose, origin: shape (2,) where (3,) is needed"),
    (Pose(CELL, rotation=(1.001, 0, 0, 0)), "pose, rotation: squared length 1.0020010471343994 is not 1"),
    (Pose(CELL, rotation=(0, 0, 0, 0)), "pose, rotation: squared length 0.0 is not 1 within 0.001"),
]
WRONG_OBJECTS: list[tuple[dict[str, Any], str]] = [
    ({"scale": 0.0}, "object 0, scale: 0.0 is not greater than 0"),
    ({"scale": np.nan}, "object 0, scale: nan at (0,) is not a finite float32"),
    ({"state": -1}, "object 0, state: -1 is not a set of PhysicsState bits"),
    ({"pose": Pose(CELL, rotation=(2, 0, 0, 0))}, "object 0, pose, rotation: squared length 4.0"),
]


@pytest.mark.parametrize(("cells", "message"), WRONG)
def test_wrong_cells_are_refused(cells: list[Cell], message: str) -> None:
    """The error names the cell."""
    with pytest.raises(WorldError) as caught:
        World(cells)
    assert str(caught.value) == message


@pytest.mark.parametrize(("pose", "message"), WRONG_POSES)
def test_wrong_poses_are_refused(pose: Pose, message: str) -> None:
    """The error names the cell and the number."""
    with pytest.raises(PoseError) as caught:
        World([Cell(CELL, pose, SHAPE)])
    assert str(caught.value).startswith(f"cell 0xa9b40111, {message}")


@pytest.mark.parametrize(("changed", "message"), WRONG_OBJECTS)
def test_wrong_objects_are_refused(changed: dict[str, Any], message: str) -> None:
    """The error names the cell, the object and the number."""
    thing = StaticObject(**{"shape": SHAPE, "pose": Pose(CELL), **changed})
    with pytest.raises((WorldError, PoseError)) as caught:
        World([Cell(CELL, Pose(CELL), SHAPE, [thing])])
    assert str(caught.value).startswith(f"cell 0xa9b40111, {message}")
