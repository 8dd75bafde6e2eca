"""Worlds: records where the header says, shared shapes once, wrong cells refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from engine_scenes import CELL, R, floor_and_wall, mover, triangle

from engine import (
    Building,
    Cell,
    LandBlock,
    Move,
    Obstacle,
    Part,
    Portal,
    Pose,
    PoseError,
    QueryError,
    World,
    WorldError,
    resolve,
)
from engine import layout as at
from engine.kernels.cell_ids import find_cell
from engine.memory import CACHE_LINE

OTHER = CELL + 1


def test_shared_shapes_are_stored_once() -> None:
    """Two cells and an object with the same geometry have the same tree."""
    shape = triangle()
    cells = [
        Cell(CELL, Pose(CELL), shape, [Obstacle.solid(shape, Pose(CELL, (1, 2, 3)))], [OTHER]),
        Cell(OTHER, Pose(CELL), shape),
    ]
    world = World(cells)
    assert world.shapes == (shape,)
    assert world.tree_of(0) == world.tree_of(1) == at.FIRST_NODE + at.GATE_NODES
    assert world.objects_of(0) == (0,)
    assert world.objects_of(1) == ()
    assert repr(world) == "<World: 2 cells, 1 objects, 1 shapes>"


def test_polygons_and_trees_are_relocated() -> None:
    """The second shape's leaf lists name its own polygons, its nodes its own children."""
    first, second = triangle(), floor_and_wall()
    world = World([Cell(CELL, Pose(CELL), first), Cell(OTHER, Pose(CELL), second)])
    root = world.tree_of(1)
    assert root == at.FIRST_NODE + 1 + 2 * at.GATE_NODES
    nodes = world.ints[at.NODE_INTS * root : at.NODE_INTS * (root + 2)].reshape(2, at.NODE_INTS)
    negative, (start, leaf) = nodes[0, at.NODE_NEXT], nodes[1].tolist()
    assert nodes[0, at.NODE_LEAF] == 0
    assert negative == root + 2
    assert leaf & at.LEAF_BIT
    assert not leaf & at.SOLID_BIT
    first_listed = start & at.LEAF_FIRST_MASK
    listed = world.ints[first_listed : first_listed + (leaf >> at.LEAF_COUNT_SHIFT)].tolist()
    assert listed == [world.polygon(1, 0), world.polygon(1, 1)]
    assert world.floats[listed[1] + at.POLYGON_ID] == 1
    assert world.floats[listed[1] + at.POLYGON_SHAPE] == 1


def test_records_that_are_walked_begin_with_a_cache_line() -> None:
    """Nodes, and polygons of whatever size, wherever the allocator puts the world."""
    world = World([Cell(CELL, Pose(CELL), triangle()), Cell(OTHER, Pose(CELL), floor_and_wall())])
    assert world.floats.ctypes.data % CACHE_LINE == world.ints.ctypes.data % CACHE_LINE == 0
    for shape, polygon in ((0, 0), (1, 0), (1, 1)):
        assert world.polygon(shape, polygon) % at.POLYGON_ALIGNMENT == 0


def test_a_cell_without_geometry_has_no_tree() -> None:
    """It collides with nothing and contains every point."""
    world = World([Cell(CELL, Pose(CELL), None)])
    assert world.tree_of(0) == at.NO_TREE
    assert world.cell_index(CELL) == 0
    assert world.cell_index(OTHER) == at.NO_CELL


def test_a_row_has_room_for_what_the_world_needs() -> None:
    """The deepest tree's levels, every cell, the land about ten balls, every object, and the trace."""
    shape = floor_and_wall()
    world = World([Cell(CELL, Pose(CELL), shape, [Obstacle.solid(shape, Pose(CELL))])])
    assert len(world.new_row()) == at.STATE_SIZE + shape.depth + 1 + 9 * 10 + 1
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


def test_a_world_may_be_empty() -> None:
    """As one whose blocks are all loaded with less detail: nobody can be in it."""
    world = World([])
    assert (world.cell_ids, world.num_objects) == ((), 0)
    with pytest.raises(QueryError, match="move 0, begin cell: 0xa9b40111 is not in the world"):
        resolve(world, Move(mover(), Pose(CELL), CELL))


def test_cells_are_found_by_their_ids() -> None:
    """Environment cells come first, then the land cells of each block; low words 0 and 0x41 are no cells."""
    blocks = [LandBlock(block, [0.0] * 81) for block in (0xA9B4, 0xA9B5)]
    world = World([Cell(CELL, Pose(CELL), None), Cell(0x01000100, Pose(CELL), None)], blocks)
    assert len(world.cell_ids) == 2 + 2 * 64
    for index, cell_id in enumerate(world.cell_ids):
        assert world.cell_index(cell_id) == find_cell(world.ints, float(cell_id)) == index
    for cell_id in (0xA9B40000, 0xA9B40041, 0xA9B400FF, OTHER, 0xA9B4FFFF, 0xA9B60001, 0):
        assert world.cell_index(cell_id) == find_cell(world.ints, float(cell_id)) == at.NO_CELL
    assert world.tree_of(2) == at.NO_TREE


def test_an_obstacle_in_several_cells_is_one() -> None:
    """Its index is the same in each list; own objects come before those of `shadows`."""
    shape = triangle()
    wall, post, rider = (Obstacle.solid(shape, Pose(CELL)) for _ in range(3))
    rider = Obstacle(Pose(CELL), has_parent=True)
    land = 0xA9B40001
    world = World(
        [Cell(CELL, Pose(CELL), shape, [wall])],
        [LandBlock(0xA9B4, [0.0] * 81)],
        shadows={CELL: [post, rider], land: [post]},
    )
    assert world.objects == (wall, post, rider)
    assert world.objects_of(0) == (0, 1)
    assert world.objects_of(world.cell_index(land)) == (1,)
    with pytest.raises(WorldError, match="shadows, 0xa9b40112: is not a cell of the world"):
        World([Cell(CELL, Pose(CELL), shape)], shadows={OTHER: [post]})


@pytest.mark.parametrize(
    ("obstacle", "family", "count"),
    [
        (Obstacle(Pose(CELL), state=0x10001, parts=[Part(None)], spheres=[(0, 0, 0, 1)]), at.FAMILY_PARTS, 0),
        (Obstacle(Pose(CELL), cylspheres=[(0, 0, 0, 1, 2)], spheres=[(0, 0, 0, 1)]), at.FAMILY_CYLSPHERES, 1),
        (Obstacle(Pose(CELL), spheres=[(0, 0, 0, 1)] * 3), at.FAMILY_SPHERES, 3),
        (Obstacle(Pose(CELL)), at.FAMILY_NONE, 0),
        (Obstacle(Pose(CELL), spheres=[(0, 0, 0, 1)], has_part_array=False), at.FAMILY_NONE, 0),
    ],
)
def test_one_family_of_shapes_is_chosen(obstacle: Obstacle, family: int, count: int) -> None:
    """By the state bit first, whether there are such parts or not; then cylspheres, then spheres."""
    world = World([Cell(CELL, Pose(CELL), None, [obstacle])])
    record = world.ints[world.ints[at.WORLD_OBJECT_INTS] :][: at.OBJECT_INTS]
    assert record[at.OBJECT_FAMILY] == family
    assert record[at.OBJECT_COUNT] == count


def test_a_building_belongs_to_the_land_cell_under_it() -> None:
    """200 metres east in its block's frame is the next block; the first building of a cell stays."""
    blocks = [LandBlock(block, [0.0] * 81) for block in (0xA9B4, 0xAAB4)]
    poses = [Pose(0xA9B40001, (200.0, 3.0, 0.0)), Pose(0xAAB40001, (9, 4, 0)), Pose(0xA9B40001, (-1, 0, 0))]
    world = World((), blocks, [Building(pose, triangle()) for pose in poses])
    houses = world.ints[world.ints[at.WORLD_CELL_INTS] :][: 128 * at.CELL_INTS].reshape(128, -1)
    owned = houses[:, at.LAND_BUILDING]
    assert owned[64] == 0
    assert (np.delete(owned, 64) == at.NO_BUILDING).all()


WRONG: list[tuple[list[Cell], str]] = [
    ([Cell(0xA9B40001, Pose(CELL), SHAPE)], "cell 0: 0xa9b40001 is not the id of an indoor cell"),
    ([Cell(-1, Pose(CELL), SHAPE)], "cells[0], id: -1 is not a 32-bit number"),
    ([Cell(CELL, Pose(CELL), SHAPE)] * 2, "cell 1: id 0xa9b40111 is used twice"),
    (
        [Cell(CELL, Pose(CELL), SHAPE, portals=[OTHER])],
        "cell 0xa9b40111, portal 0: leads to 0xa9b40112, which is not in the world: its polygon is needed",
    ),
    (
        [Cell(CELL, Pose(CELL), SHAPE, portals=[Portal(None)])],
        "cell 0xa9b40111, portal 0: leads outside: its polygon is needed",
    ),
    (
        [Cell(CELL, Pose(CELL), SHAPE, portals=[Portal(None, [(0, 0, 0), (1, 0, 0), (2, 0, 0)])])],
        "cell 0xa9b40111, portal 0, polygon: has no area, and so no plane",
    ),
    (
        [Cell(CELL, Pose(CELL), SHAPE, portals=[Portal(CELL, side=2)])],
        "cells[0], portals[0], side: 2 is not between 0 and 1",
    ),
    ([Cell(CELL, Pose(CELL), SHAPE, portals=[0])], "cells[0], portals[0]: 0 is not between 1 and 4294967295"),
]
WRONG_POSES: list[tuple[Pose, str]] = [
    (Pose(CELL, (0, 0, np.inf)), "pose, origin: inf at (2,) is not a finite float32"),
    (Pose(CELL, (0, 0)), "pose, origin: shape (2,) where (3,) is needed"),
    (Pose(CELL, rotation=(1.001, 0, 0, 0)), "pose, rotation: squared length 1.0020010471343994 is not 1"),
    (Pose(CELL, rotation=(0, 0, 0, 0)), "pose, rotation: squared length 0.0 is not 1 within 0.001"),
]
WRONG_OBJECTS: list[tuple[dict[str, Any], str]] = [
    ({"scale": 0.0}, "object 0, scale: 0.0 is not greater than 0"),
    ({"scale": np.nan}, "object 0, scale: nan at (0,) is not a finite float32"),
    ({"pose": Pose(CELL, rotation=(2, 0, 0, 0))}, "object 0, pose, rotation: squared length 4.0"),
    ({"parts": [Part(SHAPE, scale=-1.0)]}, "object 0, part 0, scale: -1.0 is not greater than 0"),
    ({"state": 1, "spheres": [(0, 0, 1)]}, "object 0, spheres: shape (1, 3) where ('n', 4) is needed"),
    ({"state": 1, "spheres": [(0, 0, 0, -1)]}, "object 0, spheres, 0: a radius of -1.0"),
    ({"state": 1, "cylspheres": [(0, 0, 0, 1, -2)]}, "object 0, cylspheres, 0: a height of -2.0"),
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
    thing = Obstacle(**{"pose": Pose(CELL), "state": 0x10001, "parts": [Part(SHAPE)], **changed})
    with pytest.raises((WorldError, PoseError)) as caught:
        World([Cell(CELL, Pose(CELL), SHAPE, [thing])])
    assert str(caught.value).startswith(f"cell 0xa9b40111, {message}")


LAND, EAST = 0xA9B4, 0xAAB4


def flat(block: int, **more: Any) -> LandBlock:
    """Return a level landblock."""
    return LandBlock(block, [0.0] * 81, **more)


@pytest.mark.parametrize("detail", [4, 2, 1])
def test_a_block_with_less_detail_is_as_if_not_loaded(detail: int) -> None:
    """10 4.1: its cells are not found; one alone makes a world all the same."""
    world = World(landblocks=[flat(LAND, side_cell_count=detail), flat(EAST)])
    assert world.cell_index(LAND << 16 | 1) == at.NO_CELL
    assert len(world.cell_ids) == at.LAND_CELLS
    assert World(landblocks=[flat(LAND, side_cell_count=detail)]).cell_ids == ()


def test_a_block_has_as_many_cells_as_retail_loads() -> None:
    """8, 4, 2 or 1 along an edge."""
    with pytest.raises(WorldError, match="landblock 0xa9b4, side_cell_count: 3 is none of"):
        World(landblocks=[flat(LAND, side_cell_count=3)])


def building_of(world: World, cell: int) -> int:
    """Return the index of the building of a land cell, or NO_BUILDING."""
    record = world.ints[at.WORLD_CELL_INTS] + at.CELL_INTS * world.cell_index(cell)
    return int(world.ints[record + at.LAND_BUILDING])


@pytest.mark.parametrize(("block", "expected"), [(None, 0), (LAND, 0), (EAST, at.NO_BUILDING)])
def test_a_building_is_listed_by_the_block_under_it(block: int | None, expected: int) -> None:
    """09 3.7: another block does not find the land cell, and drops it."""
    house = Building(Pose(LAND << 16 | 1, (1, 1, 0)), None, block=block)
    world = World(landblocks=[flat(LAND), flat(EAST)], buildings=[house])
    assert building_of(world, LAND << 16 | 1) == expected


def test_the_first_building_of_a_land_cell_wins() -> None:
    """09 3.6: any other is as if it were not there."""
    first, second = (Building(Pose(LAND << 16 | 1, (x, 1, 0)), None) for x in (1, 2))
    assert building_of(World(landblocks=[flat(LAND)], buildings=[first, second]), LAND << 16 | 1) == 0


def test_a_part_without_physics_is_not_compiled() -> None:
    """Its geometry only says where its object is found."""
    drawn = Obstacle(Pose(CELL), state=0x10001, parts=[Part(triangle(), has_physics=False)])
    world = World([Cell(CELL, Pose(CELL), None, [drawn])])
    assert (world.shapes, world.shape_count(0), world.has_parts(0)) == ((), 0, False)
