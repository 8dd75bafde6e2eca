"""Cells that not everybody may enter (09, 3.1)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from engine_scenes import CELL, R, at, triangle

from engine import (
    Body,
    Cell,
    LandBlock,
    Move,
    Mover,
    ObjectCall,
    Pose,
    Restriction,
    Target,
    World,
    WorldError,
    find_object_collisions,
    resolve,
    step,
)
from engine.constants import ACTIVE_TS, COLLIDED, IS_PLAYER, OK

ME, FRIEND, STRANGER = 0x50000001, 0x50000002, 0x50000003
BLOCK = 0xA9B4
LOT = BLOCK << 16 | 0x0A
"""The land cell from 24 to 48 metres along both axes: column 1, row 1."""
MIDDLE = 36.0
FOR_FRIENDS = Restriction(admits=(ME, FRIEND))
PLAYER = Mover([(0, 0, 0, R)], state=IS_PLAYER, id=STRANGER, restricted=True)


def house(restriction: Restriction = FOR_FRIENDS) -> World:
    """Return a floor in a cell of a house, and its lot on level land."""
    return World(
        [Cell(CELL, Pose(CELL), triangle())],
        [LandBlock(BLOCK, [0.0] * 81)],
        restrictions={CELL: restriction, LOT: restriction},
    )


def enter(world: World, who: Mover, cell: int, start: tuple[float, ...], end: tuple[float, ...]) -> Any:
    """Test a mover in a cell, wherever it is."""
    move = Move(who, Pose(cell, end), cell, start=Pose(cell, start))
    return find_object_collisions(world, ObjectCall(move, Target.CELL))


ADMITTED: list[tuple[str, Mover]] = [
    ("who is on the list", replace(PLAYER, id=ME)),
    ("and the last one on it", replace(PLAYER, id=FRIEND)),
    ("who may bypass it, or has no game object", replace(PLAYER, restricted=False)),
    ("who is no player", replace(PLAYER, state=0)),
]


@pytest.mark.parametrize("cell", [CELL, LOT], ids=["room", "lot"])
@pytest.mark.parametrize(("_why", "who"), ADMITTED, ids=[why for why, _ in ADMITTED])
def test_who_may_enter(_why: str, who: Mover, cell: int) -> None:
    """In the air, nothing else is in the way."""
    above = (30.0, 30.0, 5.0) if cell == LOT else (0.0, 0.0, 5.0)
    assert enter(house(), who, cell, above, above)["result"] == OK


@pytest.mark.parametrize("who", [PLAYER, replace(PLAYER, id=0)], ids=["a stranger", "nobody"])
@pytest.mark.parametrize("restriction", [FOR_FRIENDS, Restriction()], ids=["for friends", "for nobody"])
def test_who_may_not_enter_a_room(restriction: Restriction, who: Mover) -> None:
    """A collision without normal, and not one with the environment: 3.4 returns before its last step."""
    result = enter(house(restriction), who, CELL, (0, 0, 5), (0, 0, 5))
    assert result["result"] == COLLIDED
    assert not result["collision_normal_valid"]
    assert not result["collided_with_environment"]
    assert result["nodes_visited"] == 0


SIDES: list[tuple[tuple[float, float], list[float]]] = [
    ((MIDDLE, 23.0), [0, -1, 0]),
    ((MIDDLE, 49.0), [0, 1, 0]),
    ((23.0, MIDDLE), [-1, 0, 0]),
    ((49.0, MIDDLE), [1, 0, 0]),
    ((23.0, 23.0), [0, -1, 0]),
    ((49.0, 49.0), [0, 1, 0]),
    ((24.0, 24.0), [1, 0, 0]),
    ((MIDDLE, MIDDLE), [1, 0, 0]),
]


@pytest.mark.parametrize(("where", "expected"), SIDES)
def test_a_lot_answers_with_its_side(where: tuple[float, float], expected: list[float]) -> None:
    """The side on which the mover is: south and north first; 12 metres from the middle are within."""
    result = enter(house(), PLAYER, LOT, (*where, 5.0), (MIDDLE, MIDDLE, 5.0))
    assert result["result"] == COLLIDED
    assert result["collision_normal"].tolist() == expected
    assert not result["collided_with_environment"]


def test_the_side_is_that_of_another_block() -> None:
    """The way from the lot's middle to the mover crosses the border: 1 metre south of it is 37 away."""
    south = Pose((BLOCK - 1) << 16 | 0x10, (MIDDLE, 191.0, 5.0))
    move = Move(PLAYER, Pose(LOT, (MIDDLE, MIDDLE, 5.0)), LOT, start=south)
    result = find_object_collisions(house(), ObjectCall(move, Target.CELL))
    assert result["collision_normal"].tolist() == [0, -1, 0]


def test_a_house_that_is_not_known_admits_nobody() -> None:
    """Not even those on its list; and its lot doesn't respond."""
    gone = house(Restriction(admits=(ME,), is_known=False))
    result = enter(gone, replace(PLAYER, id=ME), LOT, (23, MIDDLE, 5), (MIDDLE, MIDDLE, 5))
    assert (result["result"], result["collision_normal_valid"]) == (COLLIDED, 0)
    assert enter(gone, replace(PLAYER, state=0), LOT, (23, MIDDLE, 5), (MIDDLE, MIDDLE, 5))["result"] == OK


def test_a_walk_ends_at_the_border() -> None:
    """As soon as the sphere reaches over it; who is admitted walks on."""
    start, end = Pose(BLOCK << 16 | 2, (23.4, 30, 5)), Pose(BLOCK << 16 | 2, (23.8, 30, 5))
    stopped = resolve(house(), Move(PLAYER, end, start.cell, start=start))
    assert stopped["collision_normal"].tolist() == [-1, 0, 0]
    assert stopped["curr"][5] < 24.0 - R
    admitted = resolve(house(), Move(replace(PLAYER, id=ME), end, start.cell, start=start))
    assert admitted["collision_normal_valid"] == 0
    assert admitted["curr"][5] == pytest.approx(23.8)


def test_a_step_down_asks_too() -> None:
    """Probing for the ground of a room is an insertion like any other."""
    level = Move(replace(PLAYER, state=IS_PLAYER | 3, step_down_height=1.5), at(0, 0, R), CELL)
    placed = {
        who: resolve(house(), replace(level, mover=replace(level.mover, id=who))) for who in (ME, STRANGER)
    }
    assert [placed[who]["result"] for who in (ME, STRANGER)] == [1, 0]


@pytest.mark.parametrize(
    ("given", "way"),
    [
        ({}, 0.0),
        ({"bypasses_restrictions": True}, 0.1),
        ({"weenie_bits": None}, 0.1),
        ({"weenie_bits": 0}, 0.1),
        ({"id": ME}, 0.1),
    ],
)
def test_a_body_is_asked_by_its_game_object(given: dict[str, Any], way: float) -> None:
    """It is a player by its weenie's bits, and restricted by having one that does not bypass."""
    fields: dict[str, Any] = {"id": STRANGER, "weenie_bits": IS_PLAYER} | given
    pose = Pose(CELL, (0, 0, 5))
    body = Body(pose, [(0, 0, 0, R)], state=0, transient_state=int(ACTIVE_TS), velocity=(1, 0, 0), **fields)
    stepped = step(house(), body, 0.1)
    assert stepped["origin"].tolist() == pytest.approx([way, 0.0, 5.0])


def test_restrictions_name_cells_of_the_world() -> None:
    """Another cell is a mistake of who gives them."""
    with pytest.raises(WorldError, match="restrictions, 0xa9b40199: is not a cell"):
        World([Cell(CELL, Pose(CELL), triangle())], restrictions={0xA9B40199: FOR_FRIENDS})


@pytest.mark.parametrize("thing", [0, -1, 1 << 32])
def test_restrictions_admit_object_ids(thing: int) -> None:
    """0 is the id of a mover that has none."""
    with pytest.raises(WorldError, match=rf"0xa9b40111, admits\[0\]: {thing} is not between 1 and"):
        house(Restriction(admits=(thing,)))
