"""The objects of each cell while they come, move and go (08, 9.4 and 9.5)."""

from __future__ import annotations

from dataclasses import replace

from engine import Cell, Leaf, Obstacle, Pose, Shape, World
from engine.shadows import ShadowLists

HALL, ROOM = 0xA9B40100, 0xA9B40101
EMITTER = 0x1000


def house() -> World:
    """Return two rooms of 10 metres, the second east of the first, from x = 5 on."""
    corners = [(x, y, z) for x in (-5, 5) for y in (-5, 5) for z in (-5, 5)]
    walls = [(1, 0, 0, 5), (-1, 0, 0, 5), (0, 1, 0, 5), (0, -1, 0, 5), (0, 0, 1, 5), (0, 0, -1, 5)]
    shape = Shape(corners, [(0, 1, 3)], Leaf((0.0, 0.0, 0.0, 10.0), (0,)), walls)
    hall = Cell(HALL, Pose(HALL), shape, portals=[ROOM])
    return World([hall, Cell(ROOM, Pose(ROOM, (10, 0, 0)), shape, portals=[HALL])])


def barrel(x: float, state: int = 0) -> Obstacle:
    """Return a cylinder of half a metre."""
    return Obstacle(Pose(HALL if x < 5 else ROOM, (x, 0, 0)), state=state, cylspheres=[(0, 0, 0, 0.5, 1)])


THINGS = [barrel(0), barrel(1), barrel(2), barrel(4.75)]


def order(lists: ShadowLists, things: list[Obstacle]) -> dict[int, list[int]]:
    """Return the numbers of the objects in each cell."""
    number = {id(thing): index for index, thing in enumerate(things)}
    return {cell: [number[id(thing)] for thing in found] for cell, found in lists.by_cell().items()}


def after(
    *calls: int, things: list[Obstacle] = THINGS, attached: dict[int, list[int]] | None = None
) -> object:
    """Return who is where after objects have entered (their number) or left (minus 1 less their number)."""
    lists = ShadowLists(house(), things, attached)
    for call in calls:
        if call < 0:
            lists.leave(-1 - call)
        else:
            lists.enter(call)
    return order(lists, things)


def test_who_comes_last_is_tested_last() -> None:
    """In each cell that it reaches."""
    assert after(0, 3, 1) == {HALL: [0, 3, 1], ROOM: [3]}


def test_the_last_takes_the_place_of_who_leaves() -> None:
    """The list is not closed up; where the last one leaves, the others stay."""
    assert after(0, 1, 2, -1 - 0) == {HALL: [2, 1]}
    assert after(0, 1, 2, -1 - 2) == {HALL: [0, 1]}


def test_each_list_is_shortened_on_its_own() -> None:
    """Who stands in the door is in both cells; one that is empty is not told."""
    assert after(3, 0, 1, -1 - 3) == {HALL: [1, 0]}


def test_who_moves_goes_behind_all_others() -> None:
    """Registering begins with leaving."""
    assert after(0, 1, 2, 0) == {HALL: [2, 1, 0]}


def test_who_is_not_there_cannot_leave() -> None:
    """Nothing happens."""
    assert after(0, -1 - 1) == {HALL: [0]}


def test_what_hangs_on_an_object_goes_with_it() -> None:
    """It is registered where the object is, behind it, wherever it is itself; an emitter in its own cell."""
    assert after(3, attached={3: [0], 0: [1]}) == {HALL: [3, 0, 1], ROOM: [3, 0, 1]}
    assert after(2, 3, -1 - 3, attached={3: [0], 0: [1]}) == {HALL: [2]}
    things = [replace(barrel(9), state=EMITTER), *THINGS[1:]]
    assert after(3, things=things, attached={3: [0]}) == {HALL: [3], ROOM: [3, 0]}
