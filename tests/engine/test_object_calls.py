"""Objects as obstacles: who is tested, with which shapes, and what is noted (08)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_obstacles import CONTACT, HERE, answer, contact, mover, normal, origin, world
from engine_scenes import CELL, at, floor_and_wall, triangle

from engine import (
    Cell,
    Move,
    ObjectCall,
    Obstacle,
    Part,
    PathState,
    Pose,
    QueryError,
    Target,
    Weenie,
    World,
    find_object_collisions,
    resolve,
)
from engine.object_call import object_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

STATIC, ETHEREAL, IGNORES, MISSILE, BSP = 0x1, 0x4, 0x10, 0x40, 0x10000
VIEWER, IMPENETRABLE, PLAYER, IGNORE_CREATURES, PK, PKLITE = 0x4, 0x80, 0x100, 0x400, 0x800, 0x1000
BALL = Obstacle(HERE, state=0, spheres=[(0.0, 0.0, 0.0, 1.0)], id=7)
OUTSIDE, INSIDE = (3.0, 0.0, 0.0), (1.0, 0.0, 0.0)


def move(who: Any, end: Sequence[float] = INSIDE, start: Sequence[float] = OUTSIDE) -> Move:
    """Return a movement in the only cell."""
    return Move(who, at(*end), CELL, start=at(*start))


def ask(thing: Obstacle, state: int = 0, *, path: dict[str, float] | None = None, **who: Any) -> Any:
    """Test a mover with ObjectInfo `state` inside an object."""
    given = PathState(**({"walk_interp": 1.0, "check_walkable": 1} if path is None else path))
    return find_object_collisions(world(thing), ObjectCall(move(mover(state=state, **who)), path=given))


def verdict(result: Any) -> tuple[str, int, int, int]:
    """Return the answer, how many objects were noted, the last one struck, and the environment's flag."""
    noted = (
        result["num_collide_object"],
        result["last_collided_object"],
        result["collided_with_environment"],
    )
    return (answer(result), *(int(n) for n in noted))


BLOCKS = ("COLLIDED", 1, 0, 0)
PASSES = ("OK", 1, -1, 0)
UNTOUCHED = ("OK", 0, -1, 0)


def weenie(**flags: bool) -> dict[str, Any]:
    """Return the field of an object that has a game object."""
    return {"weenie": Weenie(**flags)}


WHO_IS_TESTED: list[tuple[str, dict[str, Any], dict[str, Any], tuple[str, int, int, int]]] = [
    ("a dynamic object blocks and is noted", {}, {}, BLOCKS),
    ("a static one is environment", {"state": STATIC}, {}, ("COLLIDED", 0, -1, 1)),
    ("but not to who is in contact", {"state": STATIC}, {"state": 1}, ("COLLIDED", 0, -1, 0)),
    ("ethereal is noted, and does not block", {"state": ETHEREAL}, {}, PASSES),
    ("static and ethereal blocks", {"state": STATIC | ETHEREAL}, {}, ("COLLIDED", 0, -1, 1)),
    ("ignoring collisions alone changes nothing", {"state": IGNORES}, {}, BLOCKS),
    ("ethereal that ignores collisions is not there", {"state": ETHEREAL | IGNORES}, {}, UNTOUCHED),
    ("an ethereal mover passes", {}, {"ethereal": True}, PASSES),
    ("but not through what is static", {"state": STATIC}, {"ethereal": True}, ("COLLIDED", 0, -1, 1)),
    ("a creature blocks", weenie(creature=True), {}, BLOCKS),
    ("a viewer does not see it", weenie(creature=True), {"state": VIEWER}, UNTOUCHED),
    ("a viewer sees what is no creature", weenie(player=True), {"state": VIEWER}, BLOCKS),
    ("who ignores creatures notes them", weenie(creature=True), {"state": IGNORE_CREATURES}, PASSES),
    ("and is blocked by everything else", weenie(player=True), {"state": IGNORE_CREATURES}, BLOCKS),
    ("nobody meets a missile", {"state": MISSILE}, {}, UNTOUCHED),
    ("players pass each other", weenie(player=True), {"state": PLAYER}, UNTOUCHED),
    ("a mover that is no player does not", weenie(player=True), {"state": 0}, BLOCKS),
    ("a player does not pass creatures", weenie(creature=True), {"state": PLAYER}, BLOCKS),
    ("nor who is impenetrable", weenie(player=True, impenetrable=True), {"state": PLAYER}, BLOCKS),
    ("nor if he is himself", weenie(player=True), {"state": PLAYER | IMPENETRABLE}, BLOCKS),
    ("two player killers block", weenie(player=True, pk=True), {"state": PLAYER | PK}, BLOCKS),
    ("two of the lesser kind, too", weenie(player=True, pklite=True), {"state": PLAYER | PKLITE}, BLOCKS),
    ("one of each kind does not", weenie(player=True, pk=True), {"state": PLAYER | PKLITE}, UNTOUCHED),
    ("one alone does not", weenie(player=True, pk=True), {"state": PLAYER}, UNTOUCHED),
    ("a missile meets objects", {}, {"missile": True}, BLOCKS),
    ("and ethereal ones without a game object", {"state": ETHEREAL}, {"missile": True}, PASSES),
    ("but no others", {"state": ETHEREAL, **weenie()}, {"missile": True}, UNTOUCHED),
    (
        "unless it is meant for them",
        {"state": ETHEREAL, **weenie()},
        {"missile": True, "target_id": 7},
        PASSES,
    ),
    ("without a target it meets creatures", weenie(creature=True), {"missile": True}, BLOCKS),
    ("with one it meets that one", weenie(creature=True), {"missile": True, "target_id": 7}, BLOCKS),
    ("and no other", weenie(creature=True), {"missile": True, "target_id": 8}, UNTOUCHED),
    ("but what is no creature", weenie(), {"missile": True, "target_id": 8}, BLOCKS),
    ("a target is a missile's only", weenie(creature=True), {"target_id": 8}, BLOCKS),
    ("without a part array there is nothing", {"has_part_array": False}, {}, UNTOUCHED),
]


@pytest.mark.parametrize(
    ("_why", "thing", "who", "expected"), WHO_IS_TESTED, ids=[item[0] for item in WHO_IS_TESTED]
)
def test_who_is_tested(
    _why: str, thing: dict[str, Any], who: dict[str, Any], expected: tuple[str, int, int, int]
) -> None:
    """08 2 and 3."""
    result = ask(replace(BALL, **thing), **who)
    assert verdict(result) == expected
    assert result["obstruction_ethereal"] == 0


STEPPING_DOWN: list[tuple[str, dict[str, Any], dict[str, Any], bool]] = [
    ("onto an object", {}, {}, True),
    ("not onto an ethereal one", {"state": ETHEREAL}, {}, False),
    ("nor may who is ethereal", {}, {"ethereal": True}, False),
    ("except onto what is static", {"state": STATIC}, {"ethereal": True}, True),
]


@pytest.mark.parametrize(("_why", "thing", "who", "tested"), STEPPING_DOWN, ids=[i[0] for i in STEPPING_DOWN])
def test_stepping_down(_why: str, thing: dict[str, Any], who: dict[str, Any], tested: bool) -> None:
    """08 3.3 and 3.9: nothing is noted on the way down, and what is passed over leaves the row alone."""
    path = PathState(step_down=1, step_down_amt=0.5, walk_interp=1.0, obstruction_ethereal=2)
    call = ObjectCall(move(mover(**who), (0, 0, 1.25), (0, 0, 3)), path=path)
    result = find_object_collisions(world(replace(BALL, **thing)), call)
    assert verdict(result) == ("ADJUSTED" if tested else "OK", 0, -1, 0)
    assert (contact(result) is not None) == tested
    assert (result["objects_tested"], result["obstruction_ethereal"]) == ((1, 0) if tested else (0, 2))


def test_a_touch_that_does_not_block_forgets_the_normal() -> None:
    """08 3.9: what else the shape has done stays done: the landing that was begun."""
    creature = replace(BALL, weenie=Weenie(creature=True))
    result = ask(creature, IGNORE_CREATURES, path={"walk_interp": 1.0})
    assert (verdict(result), normal(result), result["collide"]) == (PASSES, None, 1)


def test_one_family_of_shapes_is_tested() -> None:
    """08 3.8: parts, or cylspheres, or spheres; the next family is not tried where one finds nothing."""
    far, near = (9.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.0)
    for fields, expected in (
        ({"cylspheres": [(*far, 2.0)], "spheres": [near]}, "OK"),
        ({"cylspheres": [(*near, 2.0)], "spheres": [far]}, "COLLIDED"),
        ({"spheres": [far, near]}, "COLLIDED"),
        ({"state": BSP, "cylspheres": [(*near, 2.0)], "spheres": [near]}, "OK"),
        ({"parts": [Part(floor_and_wall())], "spheres": [far]}, "OK"),
        ({"state": BSP, "parts": [Part(floor_and_wall())], "spheres": [far]}, "COLLIDED"),
    ):
        thing = replace(BALL, **({"spheres": ()} | fields))
        result = ask(thing, path={"walk_interp": 1.0, "insert_type": 1})
        assert (answer(result), result["objects_tested"]) == (expected, 1)


def test_parts_are_tested_in_order_each_in_its_own_space() -> None:
    """08 5 and 6: a part without geometry is passed over; pose and scale are the part's, else the object's.

    The floor is 5 metres wide; at a tenth of that it does not reach where the mover is.
    """
    floor = triangle()
    for parts, expected in (
        ([Part(None), Part(floor)], "COLLIDED"),
        ([Part(None)], "OK"),
        ([], "OK"),
        ([Part(floor, Pose(CELL, (0, 0, 8))), Part(floor)], "COLLIDED"),
        ([Part(floor, Pose(CELL, (0, 0, 8)))], "OK"),
        ([Part(floor, scale=0.1)], "OK"),
    ):
        thing = Obstacle(HERE, state=BSP, parts=parts)
        assert answer(ask(thing, path={"walk_interp": 1.0, "insert_type": 1})) == expected


def test_objects_are_tested_in_the_order_of_the_list() -> None:
    """08 3 and 09 3.2: those that do not block are noted, the first one that does ends it."""
    things = [replace(BALL, state=s, id=i) for i, s in enumerate((ETHEREAL, IGNORES, 0), start=1)]
    call = ObjectCall(move(mover()), Target.OBJECTS, path=PathState(check_walkable=1))
    for order, noted, last in (((0, 1, 2), 2, 1), ((2, 1, 0), 1, 0), ((0,), 1, -1)):
        result = find_object_collisions(world(*(things[i] for i in order)), call)
        assert (result["num_collide_object"], result["last_collided_object"]) == (noted, last)


def test_the_mover_and_what_is_attached_are_passed_over() -> None:
    """09 3.2: by the mover's id; no id is nobody's."""
    call = ObjectCall(move(mover(id=7)), Target.OBJECTS, path=PathState(check_walkable=1))
    for thing, expected in (
        (BALL, "OK"),
        (replace(BALL, id=8), "COLLIDED"),
        (replace(BALL, id=8, has_parent=True), "OK"),
    ):
        assert answer(find_object_collisions(world(thing), call)) == expected
    nobody = ObjectCall(move(mover()), Target.OBJECTS, path=PathState(check_walkable=1))
    assert answer(find_object_collisions(world(replace(BALL, id=0)), nobody)) == "COLLIDED"


def test_a_cell_s_environment_comes_first() -> None:
    """09 3.3: what collides there leaves the objects alone; an initial placement never gets to them."""
    near_floor = move(mover(), (0, 0, 0.25), (0, 0, 3))
    for environment, path, tested, expected in (
        (floor_and_wall(), PathState(insert_type=1), 0, "COLLIDED"),
        (None, PathState(insert_type=1), 1, "COLLIDED"),
        (None, PathState(insert_type=2), 0, "OK"),
    ):
        scene = World([Cell(CELL, HERE, environment, [BALL])])
        result = find_object_collisions(scene, ObjectCall(near_floor, Target.CELL, path=path))
        assert (answer(result), result["objects_tested"]) == (expected, tested)


def test_a_mover_walks_up_to_an_object_or_through_it() -> None:
    """A whole transition: a pillar stops it at its side, one that is ethereal is noted or not there."""
    pillar = Obstacle(Pose(CELL, (2, 0, 0)), state=0, cylspheres=[(0, 0, 0, 0.5, 2)], id=3)
    who = mover((0, 0, 0.5))
    for state, stopped, noted in ((0, True, 1), (ETHEREAL, False, 1), (ETHEREAL | IGNORES, False, 0)):
        result = resolve(world(replace(pillar, state=state)), Move(who, at(2, 0, 0), CELL, start=at(0, 0, 0)))
        assert result["num_collide_object"] == noted
        assert (result["curr"][5] == 2.0) != stopped
        assert not stopped or result["curr"][5] <= 1.0


def test_rows_name_what_is_called() -> None:
    """An index in the world, found by the place in the cell's list."""
    scene = world(BALL, replace(BALL, id=8))
    calls = [ObjectCall(move(mover()), Target.OBJECT, 1), ObjectCall(move(mover()), Target.CELL)]
    one, cell = object_rows(scene, calls)
    assert (one["target_kind"], one["target_object"], one["target_cell"]) == (Target.OBJECT, 1, 0)
    assert (cell["target_kind"], cell["target_object"]) == (Target.CELL, -1)


WRONG: list[tuple[ObjectCall, str]] = [
    (ObjectCall(move(mover()), object_index=1), "call 0, object: 1 does not exist (1 objects)"),
    (ObjectCall(move(mover()), object_index=-1), "call 0, object: -1 does not exist (1 objects)"),
    (ObjectCall(move(mover()), Target.FIRST_SHAPE), "call 0, object: 0 has no shape to call"),
    (ObjectCall(replace(move(mover()), start=None)), "call 0, start: a collision call comes from somewhere"),
    (ObjectCall(move(mover(id=-1))), "call 0, move, mover, id: -1 is not a 32-bit number"),
    (
        ObjectCall(move(mover(target_id=1 << 32))),
        "call 0, move, mover, target id: 4294967296 is not a 32-bit number",
    ),
    (
        ObjectCall(move(mover()), path=PathState(walk_interp=np.nan)),
        "call 0, walk_interp: nan at (0,) is not a finite float32",
    ),
]


@pytest.mark.parametrize(("call", "message"), WRONG, ids=[message for _, message in WRONG])
def test_calls_that_cannot_be_made(call: ObjectCall, message: str) -> None:
    """Each is refused with what is wrong."""
    with pytest.raises(QueryError) as error:
        find_object_collisions(world(replace(BALL, spheres=())), call)
    assert str(error.value) == message


def test_an_object_out_of_the_way_changes_nothing() -> None:
    """The mover stays where it is."""
    call = ObjectCall(move(mover(state=CONTACT), (9, 0, 0)))
    result = find_object_collisions(world(BALL), call)
    assert (verdict(result), origin(result)) == (UNTOUCHED, [9.0, 0.0, 0.0])
