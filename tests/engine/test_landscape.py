"""Movers on the land: they stand on it, sink into it, cross its borders, enter houses, leave the world."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from engine_scenes import R, floor_and_wall, mover, triangle

from engine import (
    Building,
    BuildingPortal,
    Cell,
    ContactPlane,
    LandBlock,
    Leaf,
    Move,
    Mover,
    Obstacle,
    Portal,
    Pose,
    Seed,
    Shape,
    World,
    resolve,
)
from engine import layout as at
from engine.constants import CONTACT, DEEP_WATER, ON_WALKABLE

BLOCK, EAST, NORTH = 0xA9B4, 0xAAB4, 0xA9B5
FLAT = [0.0] * 81
SEA = [64] * 81
SHORE = [64] * 80 + [0]
"""Everything is deep but the cell in the north-east corner."""
STANDING = CONTACT | ON_WALKABLE


def land(number: int, block: int = BLOCK) -> int:
    """Return the id of a land cell, by its index in its block."""
    return block << 16 | number + 1


def ground(*blocks: int, terrain: list[int] | None = None) -> World:
    """Return a flat world."""
    return World(landblocks=[LandBlock(block, FLAT, terrain) for block in blocks])


def go(
    world: World, start: tuple[float, ...], end: tuple[float, ...], cell: int, who: Mover | None = None
) -> Any:
    """Move from one point to another, of the block of the cell that the mover is in."""
    who = mover() if who is None else who
    return resolve(world, Move(who, Pose(cell, end), cell, start=Pose(cell, start)))


def walk(world: World, start: tuple[float, ...], end: tuple[float, ...], cell: int, ids: int = 0) -> Any:
    """Move like `go`, standing on level ground at z = 0."""
    level = ContactPlane((0, 0, 1, 0), cell)
    who = Mover([(0, 0, 0, R)], state=STANDING, step_up_height=0.6, step_down_height=1.5, id=ids)
    move = Move(who, Pose(cell, end), cell, start=Pose(cell, start), seed=Seed(level, level))
    return resolve(world, move)


def test_a_fall_ends_on_the_ground() -> None:
    """With its lowest point on it; the plane is in the block of the land cell, and so is the cell id."""
    result = go(ground(BLOCK), (30.0, 6.0, 1.0), (30.0, 6.0, 0.25), land(8))
    assert result["contact_plane"].tolist() == [0.0, 0.0, 1.0, 0.0]
    assert result["contact_plane_cell_id"] == land(8)
    assert result["curr"][7] == R
    assert result["collided_with_environment"] == 1


def test_a_walk_across_the_border_of_two_land_cells() -> None:
    """23.9 is in cell 0, 24.1 in cell 8."""
    world = ground(BLOCK)
    result = walk(world, (23.9, 6.0, R), (24.1, 6.0, R), land(0))
    assert world.cell_ids[int(result["curr_cell"])] == result["curr"][0] == land(8)
    assert result["curr"][5] == np.float32(24.1)


def test_a_walk_across_the_border_of_two_blocks() -> None:
    """192.5 of the one is 0.5 of the other, in whose block the mover then is."""
    world = ground(BLOCK, EAST)
    result = walk(world, (191.75, 6.0, R), (192.5, 6.0, R), land(56))
    assert world.cell_ids[int(result["curr_cell"])] == result["curr"][0] == land(0, EAST)
    assert result["curr"][5:].tolist() == [0.5, 6.0, R]
    assert result["contact_plane_cell_id"] == land(0, EAST)


def test_a_walk_off_the_loaded_land() -> None:
    """The mover is in no cell; its position is in the block that is not there. A next move goes nowhere."""
    world = ground(BLOCK)
    result = walk(world, (191.75, 6.0, R), (192.5, 6.0, R), land(56))
    assert result["curr_cell"] == at.NO_CELL
    assert result["curr"][0] == land(0, EAST)
    assert result["curr"][5] == 0.5


def test_off_the_end_of_the_land_there_is_no_way() -> None:
    """No cell has an id there, so that the mover collides."""
    world = World(landblocks=[LandBlock(0x0000, FLAT)])
    result = walk(world, (0.25, 6.0, R), (-0.5, 6.0, R), 1)
    assert result["curr_cell"] == 0
    assert result["curr"][5] == 0.25


def test_one_sinks_into_deep_water() -> None:
    """By 0.9 metres; its plane is one of water, so that it is not lifted out."""
    world = ground(BLOCK, terrain=SHORE)
    result = go(world, (30.0, 6.0, 1.0), (30.0, 6.0, -0.5), land(8))
    assert result["contact_plane_is_water"] == 1
    assert result["curr"][7] == float(np.float32(np.float32(-0.5) - np.float32(-0.5 - R + DEEP_WATER)))


@pytest.mark.parametrize(
    ("who", "passes"), [(mover(), False), (Mover([(0, 0, 0, R)], missile=True), True), (mover(0x4), True)]
)
def test_a_block_that_is_nothing_but_sea_is_a_wall(who: Mover, passes: bool) -> None:
    """For all but missiles and the camera; there need not be any contact."""
    result = go(ground(BLOCK, terrain=SEA), (30.0, 6.0, 9.0), (30.25, 6.0, 9.0), land(8), who)
    assert (result["curr"][5] == 30.25) == passes


def house(*, shell: bool = True) -> World:
    """Return a house over land cell 0: its room, from x = 5.5 on, has a door to the south at y = 10."""
    hall = BLOCK << 16 | 0x100
    floor = [(0, 10, 0), (20, 10, 0), (20, 20, 0), (0, 20, 0)]
    planes = [(0.0, 1.0, 0.0, -10.0), (0.0, -1.0, 0.0, 20.0), (1.0, 0.0, 0.0, -5.5)]
    room = Shape(floor, [(0, 1, 2, 3)], Leaf((10, 15, 0, 20), (0,)), planes, name="room")
    door = Portal(None, [(9, 10, 0), (11, 10, 0), (11, 10, 3)])
    wall = Shape(
        [(0, 0, 0), (0, 10, 0), (0, 10, 4), (0, 0, 4)],
        [(3, 2, 1, 0)],
        Leaf((0, 5, 2, 8), (0,)),
        name="outer wall",
    )
    building = Building(Pose(land(0), (5.0, 10.0, 0.0)), wall if shell else None, [BuildingPortal(hall)])
    return World([Cell(hall, Pose(hall), room, portals=[door])], [LandBlock(BLOCK, FLAT)], [building])


@pytest.mark.parametrize("shell", [True, False])
def test_a_mover_enters_a_house_and_leaves_it(shell: bool) -> None:
    """Its cell is the room's as soon as its centre is behind the door, and the ground's before."""
    world = house(shell=shell)
    inside = walk(world, (10.0, 9.75, R), (10.0, 10.125, R), land(0))
    assert world.cell_ids[int(inside["curr_cell"])] == BLOCK << 16 | 0x100
    assert inside["curr"][5:].tolist() == [10.0, 10.125, R]
    assert inside["hits_interior_cell"] == 1
    hall = BLOCK << 16 | 0x100
    outside = walk(world, (10.0, 10.125, R), (10.0, 9.875, R), hall)
    assert world.cell_ids[int(outside["curr_cell"])] == land(0)


def test_the_outer_wall_of_a_house_is_in_the_way() -> None:
    """At x = 5 in the block, facing west; the mover stops short of it."""
    result = walk(house(), (4.0, 14.0, R), (4.75, 14.0, R), land(0))
    assert result["curr"][5] < 5.0 - R + 0.001
    assert result["collision_normal"].tolist() == [-1.0, 0.0, 0.0]


def test_a_house_without_a_shell_is_only_its_rooms() -> None:
    """09 3.7.1: what would be at its outer wall is passed; its building is asked all the same."""
    world = house(shell=False)
    result = walk(world, (4.0, 14.0, R), (4.75, 14.0, R), land(0))
    assert result["curr"][5] == 4.75
    assert result["collision_normal_valid"] == 0


def test_a_mover_is_not_in_its_own_way() -> None:
    """An obstacle of its id is itself; 0 is nobody's."""
    stone = Obstacle.solid(floor_and_wall(), Pose(land(0), (10, 10, 0)), state=0x10000)
    for own, passes in ((0, False), (7, True), (8, False)):
        solid = Obstacle(stone.pose, state=stone.state, parts=stone.parts, id=7 if own else 0)
        world = World(landblocks=[LandBlock(BLOCK, FLAT)], shadows={land(0): [solid]})
        result = walk(world, (10.25, 10.0, R), (10.75, 10.0, R), land(0), ids=own)
        assert (result["curr"][5] == 10.75) == passes


def test_a_placement_stands_on_the_ground() -> None:
    """Put down in the ground it is lifted out of it."""
    world = ground(BLOCK)
    there = Pose(land(8), (30.0, 6.0, 0.25))
    result = resolve(world, Move(mover(), there, land(8)))
    assert result["result"] == 1
    assert result["curr"][7] == pytest.approx(R, abs=1e-6)


def test_terrain_is_no_walkable_polygon() -> None:
    """Only polygons of trees are; and the ground has no edge to slip from."""
    result = walk(ground(BLOCK), (30.0, 6.0, R), (30.25, 6.0, R), land(8))
    assert result["walkable"] == -1
    assert result["curr"][5] == 30.25


def test_a_cell_without_a_block_under_it_is_as_before() -> None:
    """Land is not needed."""
    hall = BLOCK << 16 | 0x100
    world = World([Cell(hall, Pose(hall), triangle())])
    result = go(world, (0.0, 0.0, 1.0), (0.0, 0.0, 0.25), hall)
    assert result["contact_plane_cell_id"] == hall
