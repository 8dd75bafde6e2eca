"""Which of a cell and those around it a point is in (09, 7)."""

from __future__ import annotations

import pytest

from engine import Cell, LandBlock, Leaf, Portal, Pose, QueryError, Shape, World, find_visible_child_cell

LAND = 0xA9B40000
HALL, ROOM, ATTIC, UNLOADED = LAND | 0x100, LAND | 0x101, LAND | 0x102, LAND | 0x1FF
OUTDOORS = LAND | 1


def cube() -> Shape:
    """Return a cube of 2 metres about the origin, whose walls contain what is between them."""
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    walls = [(1, 0, 0, 1), (-1, 0, 0, 1), (0, 1, 0, 1), (0, -1, 0, 1), (0, 0, 1, 1), (0, 0, -1, 1)]
    return Shape(corners, [(0, 1, 3)], Leaf((0.0, 0.0, 0.0, 2.0), (0,)), walls)


def house() -> World:
    """Return a hall at x = 0, a room behind its door at x = 2, an attic at x = 4 that is only visible.

    The room and the attic also overlap: both contain what is from 3 to 3.5.
    """
    shape = cube()
    door = [(1, 0, 0), (1, 0, 1), (1, 1, 1)]
    hall = Cell(
        HALL,
        Pose(HALL),
        shape,
        portals=[Portal(None, door), Portal(UNLOADED, door), Portal(ROOM)],
        stab=[UNLOADED, OUTDOORS, ATTIC, ROOM],
    )
    room = Cell(ROOM, Pose(ROOM, (2.5, 0, 0)), shape)
    attic = Cell(ATTIC, Pose(ATTIC, (4.0, 0, 0)), shape, portals=None)
    loft = Cell(ATTIC + 1, Pose(ATTIC, (4.0, 0, 0)), shape)
    return World([hall, room, attic, loft], [LandBlock(0xA9B4, [0.0] * 81)])


@pytest.mark.parametrize(
    ("x", "stabs", "expected"),
    [
        (0.5, True, HALL),
        (0.5, False, HALL),
        (2.5, True, ROOM),
        (2.5, False, ROOM),
        (4.5, True, None),
        (4.5, False, None),
        (9.0, True, None),
    ],
)
def test_the_cell_itself_comes_first(x: float, stabs: bool, expected: int | None) -> None:
    """Then what is visible, or behind a door; a cell without portals contains nothing (09 4.1.1)."""
    assert find_visible_child_cell(house(), HALL, (x, 0, 0), search_stabs=stabs) == expected


def test_only_what_is_listed_is_looked_at() -> None:
    """The loft contains the point, but is neither visible from the hall nor behind its doors."""
    assert find_visible_child_cell(house(), ATTIC + 1, (4.5, 0, 0), search_stabs=True) == ATTIC + 1
    assert find_visible_child_cell(house(), ROOM, (0.5, 0, 0), search_stabs=True) is None


def test_land_is_no_room() -> None:
    """It is found in another table (09, 2), though it contains the point and is on the list."""
    assert find_visible_child_cell(house(), HALL, (0.5, 9, 0), search_stabs=True) is None


@pytest.mark.parametrize("cell", [OUTDOORS, UNLOADED])
def test_a_search_begins_in_an_environment_cell(cell: int) -> None:
    """Of the world."""
    with pytest.raises(QueryError, match="is not an environment cell"):
        find_visible_child_cell(house(), cell, (0, 0, 0), search_stabs=True)


def test_a_point_is_finite() -> None:
    """Nothing is in no place."""
    with pytest.raises(QueryError, match="point"):
        find_visible_child_cell(house(), HALL, (0, float("nan"), 0), search_stabs=True)
