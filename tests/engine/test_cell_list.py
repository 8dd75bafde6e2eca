"""Which cells spheres reach, in which order, and which one contains them: document 09, worked by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from engine import Building, BuildingPortal, Cell, LandBlock, Leaf, Portal, Pose, Shape, World
from engine import layout as at
from engine.constants import EPS
from engine.kernels.cell_list import UNTOUCHED, find_cell_list, point_in_cell
from engine.kernels.outside import add_all_outside_cells
from engine.kernels.transit import check_building_transit, find_transit_cells

if TYPE_CHECKING:
    from collections.abc import Sequence

BLOCK = 0xA9B4
HALL, ROOM, LOFT = (BLOCK << 16 | 0x100 + i for i in range(3))
AWAY = BLOCK << 16 | 0x1FF
"""Id of a cell that is in no world here."""
REACH = 0.5 + EPS
"""How far a sphere of 0.5 metres reaches for a portal, in a register."""
STORED_REACH = float(np.float32(REACH))
"""The same, stored."""
DOOR = [(0.0, -1.0, 0.0), (0.0, 1.0, 0.0), (0.0, 1.0, 2.0)]
"""In the plane x = 0, its normal along x."""


def box(low: float, high: float) -> Shape:
    """Return a geometry whose cell contains low < x < high, without end in y and z."""
    floor = [(low, -5, 0), (high, -5, 0), (high, 5, 0), (low, 5, 0)]
    planes = [(1.0, 0.0, 0.0, -low), (-1.0, 0.0, 0.0, high)]
    return Shape(floor, [(0, 1, 2, 3)], Leaf((0, 0, 0, 20), (0,)), planes, name="box")


def cell(number: int, low: float, high: float, portals: Sequence[Portal | int] | None = ()) -> Cell:
    """Return a cell at the block's origin."""
    return Cell(number, Pose(number), box(low, high), portals=portals)


def land(number: int) -> int:
    """Return the id of a land cell of the block, by its index."""
    return BLOCK << 16 | number + 1


class Lists:
    """Cell lists of one world."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.row = world.new_row()
        self.row[:] = 0.0

    def find(self, home: int, *spheres: Sequence[float]) -> int:
        """List what the spheres reach; return the answer."""
        balls = np.array(spheres, dtype=np.float64).ravel()
        world = self.world
        return find_cell_list(
            world.floats, world.ints, self.row, -1, float(home), 0.0, 0.0, balls, 0, len(spheres)
        )

    def transit(self, start: int, *spheres: Sequence[float]) -> list[int]:
        """Append what the spheres reach from one cell; return the list."""
        balls = np.array(spheres, dtype=np.float64).ravel()
        world, index = self.world, self.world.cell_index(start)
        count = len(spheres)
        find_transit_cells(world.floats, world.ints, self.row, index, float(start), 0.0, 0.0, balls, 0, count)
        return self.ids()

    def ids(self) -> list[int]:
        """Return the ids on the list, in order; minus the id for a cell that is not in the world."""
        first = int(self.world.ints[at.WORLD_CELL_LIST])
        entries = self.row[first : first + int(self.row[at.NUM_CELLS])]
        return [self.world.cell_ids[int(e)] if e >= 0 else int(e) for e in entries]


def test_the_cells_behind_portals_are_listed_in_portal_order() -> None:
    """And those behind theirs after them, each once."""
    world = World([cell(HALL, 0, 5, [LOFT, ROOM]), cell(ROOM, 5, 10, [HALL]), cell(LOFT, 4, 9, [ROOM])])
    lists = Lists(world)
    assert lists.find(HALL, (4.9, 0, 0, 0.5)) == world.cell_index(HALL)
    assert lists.ids() == [HALL, LOFT, ROOM]
    assert lists.row[at.HITS_INTERIOR_CELL] == 1.0


def test_a_cell_that_no_sphere_reaches_is_not_listed() -> None:
    """0.6 metres away is too far for a radius of 0.5; the second sphere may be the one that reaches."""
    lists = Lists(World([cell(HALL, 0, 5, [ROOM]), cell(ROOM, 5, 10)]))
    lists.find(HALL, (4.4, 0, 0, 0.5))
    assert lists.ids() == [HALL]
    lists.find(HALL, (4.4, 0, 0, 0.5), (4.4, 0, 1, 0.7))
    assert lists.ids() == [HALL, ROOM]


def test_the_first_listed_environment_cell_that_contains_sphere_0_is_the_new_one() -> None:
    """In a place that two cells contain, the one that is listed first; in none, none."""
    world = World([cell(HALL, 0, 5, [LOFT, ROOM]), cell(ROOM, 5, 10), cell(LOFT, 4, 9)])
    lists = Lists(world)
    assert lists.find(HALL, (4.5, 0, 0, 0.5)) == world.cell_index(HALL)
    assert lists.find(HALL, (5.2, 0, 0, 0.5)) == world.cell_index(LOFT)
    assert lists.find(HALL, (-0.3, 0, 0, 0.5)) == at.NO_CELL


def test_a_position_in_no_loaded_cell_lists_only_that() -> None:
    """And says nothing of a new cell; nor does a position without spheres."""
    lists = Lists(World([cell(HALL, 0, 5)]))
    assert lists.find(AWAY, (1, 0, 0, 0.5)) == UNTOUCHED
    assert lists.ids() == [-AWAY]
    assert lists.find(HALL) == UNTOUCHED
    assert lists.ids() == [HALL]


def test_a_cell_without_portals_array_contains_nothing() -> None:
    """Unlike one whose array is empty."""
    world = World([cell(HALL, 0, 5, None), cell(ROOM, 0, 5, ())])
    assert not point_in_cell(world.floats, world.ints, 0, 1.0, 0.0, 0.0)
    assert point_in_cell(world.floats, world.ints, 1, 1.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("x", "touched"),
    [
        (STORED_REACH, False),
        (float(np.nextafter(np.float32(STORED_REACH), np.float32(0))), True),
        (-STORED_REACH, False),
        (-0.4, True),
    ],
)
def test_a_door_is_touched_within_the_stored_reach_on_either_side(x: float, touched: bool) -> None:
    """The reach is rounded to float32, and not included."""
    lists = Lists(World([cell(HALL, -5, 5, [Portal(None, DOOR)])], [LandBlock(BLOCK, [0.0] * 81)]))
    found = lists.transit(HALL, (x, 10.0, 0, 0.5))
    assert bool(found) == touched
    assert bool(lists.row[at.ADDED_OUTSIDE]) == touched


def test_land_cells_follow_the_neighbours_of_the_cell_with_the_door() -> None:
    """Also when the door is the first portal."""
    world = World(
        [cell(HALL, -5, 5, [Portal(None, DOOR), ROOM]), cell(ROOM, -5, 5)], [LandBlock(BLOCK, [0.0] * 81)]
    )
    assert Lists(world).transit(HALL, (0.125, 10.0, 0, 0.125)) == [ROOM, land(0)]


@pytest.mark.parametrize(
    ("side", "x", "added"),
    [
        (0, STORED_REACH, STORED_REACH < REACH),
        (0, float(np.nextafter(np.float32(STORED_REACH), np.float32(1))), False),
        (0, float(np.nextafter(np.float32(STORED_REACH), np.float32(0))), True),
        (0, -3.0, True),
        (1, -STORED_REACH, STORED_REACH < REACH),
        (1, float(np.nextafter(np.float32(-STORED_REACH), np.float32(-1))), False),
        (1, 3.0, True),
    ],
)
def test_a_cell_that_is_not_loaded_is_listed_by_its_id(side: int, x: float, added: bool) -> None:
    """When a sphere reaches beyond the portal's plane, by a reach that is not rounded to float32."""
    lists = Lists(World([cell(HALL, -5, 5, [Portal(AWAY, DOOR, side)])]))
    assert lists.transit(HALL, (x, 0.0, 0, 0.5)) == ([-AWAY] if added else [])


@pytest.mark.parametrize(
    ("x", "y", "expected"),
    [
        (30.0, 30.0, [9]),
        (47.6, 30.0, [9, 17]),
        (47.6, 47.6, [9, 17, 18, 10]),
        (47.6, 24.4, [9, 17, 16, 8]),
        (24.4, 47.6, [9, 1, 2, 10]),
        (24.4, 24.4, [9, 1, 0, 8]),
        (30.0, 47.6, [9, 10]),
        (30.0, 24.4, [9, 8]),
        (47.5, 30.0, [9]),
        (24.5, 30.0, [9]),
    ],
)
def test_the_land_about_a_sphere(x: float, y: float, expected: list[int]) -> None:
    """East, north-east, south-east; west, north-west, south-west; north; south. Touching is not reaching."""
    lists = Lists(World(landblocks=[LandBlock(BLOCK, [0.0] * 81)]))
    lists.find(land(9), (x, y, 0, 0.5))
    assert lists.ids() == [land(k) for k in expected]


def test_a_sphere_wider_than_half_a_cell_reaches_to_both_sides() -> None:
    """East first: its north-east and south-east belong to it; then west; then north and south."""
    lists = Lists(World(landblocks=[LandBlock(BLOCK, [0.0] * 81)]))
    lists.find(land(9), (36.0, 36.0, 0, 13.0))
    assert lists.ids() == [land(k) for k in (9, 17, 18, 16, 1, 2, 0, 10, 8)]


def test_the_land_of_a_block_that_is_not_loaded_is_listed_by_its_id() -> None:
    """East of the block 0xA9B4 lies 0xAAB4."""
    lists = Lists(World(landblocks=[LandBlock(BLOCK, [0.0] * 81)]))
    lists.find(land(56), (191.8, 12.0, 0, 0.5))
    assert lists.ids() == [land(56), -0xAAB4_0001]


def test_on_a_border_the_last_listed_land_cell_is_the_new_one() -> None:
    """X = 24 is in cell 8 by its coordinates, but also on the edge of cell 0, which is listed later."""
    lists = Lists(World(landblocks=[LandBlock(BLOCK, [0.0] * 81)]))
    assert lists.find(land(8), (24.0, 6.0, 0, 0.5)) == 0
    assert lists.ids() == [land(8), land(0)]


def test_without_spheres_only_the_positions_cell_is_listed() -> None:
    """Nothing at all off the land."""
    world = World(landblocks=[LandBlock(0x0000, [0.0] * 81)])
    lists, none = Lists(world), np.empty(0)
    add_all_outside_cells(world.ints, lists.row, float(0x0001), 25.0, 1.0, none, 0, 0)
    assert lists.ids() == [9]
    lists = Lists(world)
    add_all_outside_cells(world.ints, lists.row, float(0x0001), -1.0, 1.0, none, 0, 0)
    assert lists.ids() == []


def test_a_sphere_off_the_land_ends_the_listing() -> None:
    """Those after it are not looked at."""
    lists = Lists(World(landblocks=[LandBlock(0x0000, [0.0] * 81)]))
    lists.find(0x0001, (-1.0, 1.0, 0, 0.5), (1.0, 1.0, 0, 0.5))
    assert lists.ids() == []


def house(other_portal: int = 0) -> World:
    """Return a hall with a door in the plane x = 0, in a building that stands in land cell 0."""
    hall = cell(HALL, 0, 5, [Portal(None, DOOR)])
    building = Building(
        Pose(land(0), (3, 3, 0)), None, [BuildingPortal(AWAY), BuildingPortal(HALL, other_portal)]
    )
    return World([hall], [LandBlock(BLOCK, [0.0] * 81)], [building])


def test_a_building_is_entered_from_its_land_cell() -> None:
    """By a sphere that reaches into the room, wherever its door is; what is not loaded is passed over."""
    world = house()
    lists = Lists(world)
    assert lists.find(land(0), (3.0, 3.0, 0, 0.5)) == world.cell_index(HALL)
    assert lists.ids() == [land(0), HALL]
    assert lists.row[at.HITS_INTERIOR_CELL] == 1.0


def test_a_building_is_not_entered_from_another_land_cell() -> None:
    """Its own has to be listed."""
    lists = Lists(house())
    lists.find(land(1), (3.0, 26.0, 0, 0.5))
    assert lists.ids() == [land(1)]


def test_a_portal_without_a_number_leads_nowhere() -> None:
    """Retail's id of no portal is negative."""
    lists = Lists(house(other_portal=-1))
    lists.find(land(0), (3.0, 3.0, 0, 0.5))
    assert lists.ids() == [land(0)]
    world = house()
    ball = np.array([3.0, 3.0, 0.0, 0.5])
    for portal, listed in ((-1, 0), (0, 1)):
        row = world.new_row()
        check_building_transit(world.floats, world.ints, row, 0, portal, ball, 0, 1)
        assert row[at.NUM_CELLS] == listed


def test_only_what_is_visible_is_kept_where_nothing_may_be_loaded() -> None:
    """The last entry takes the place of one that is dropped, and is looked at there."""
    third, fourth = LOFT, LOFT + 1
    cells = [
        Cell(HALL, Pose(HALL), box(0, 5), portals=[ROOM, third, fourth], stab=[AWAY, fourth]),
        *(cell(number, 0, 5) for number in (ROOM, third, fourth)),
    ]
    lists = Lists(World(cells))
    lists.row[at.DO_NOT_LOAD_CELLS] = 1.0
    assert lists.find(HALL, (1.0, 0, 0, 0.5)) == 0
    assert lists.ids() == [HALL, fourth]
