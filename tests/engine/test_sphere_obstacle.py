"""CSphere as an obstacle: who overlaps, and standing on top (07, 2, 4, 8 and 9)."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from engine_obstacles import (
    CLIPPED,
    CONTACT,
    EPS,
    FLOOR_Z,
    HERE,
    RADIUS,
    above,
    answer,
    call,
    contact,
    f32,
    mover,
    origin,
    world,
)
from engine_scenes import CELL, at

from engine import (
    Move,
    ObjectCall,
    Obstacle,
    PathState,
    Pose,
    Target,
    UndeterminedError,
    Weenie,
    find_object_collisions,
    find_object_collisions_many,
)
from engine.layout import STATUS_OK, STATUS_UNDETERMINED

BALL = Obstacle(HERE, spheres=[(0.0, 0.0, 0.0, 1.0)])
CREATURE = replace(BALL, weenie=Weenie(creature=True))
RADSUM = f32((1.0 + RADIUS) - EPS)
"""07 8.2"""
RS = RADSUM + EPS
"""07 4.5, before it is stored; about 1.5"""
FAR = (3.0, 0.0, 0.0)

ASKS_FOR_OVERLAP: list[dict[str, float]] = [
    {"insert_type": 1},
    {"obstruction_ethereal": 1},
    {"obstruction_ethereal": 1, "step_down": 1, "step_down_amt": 0.5},
    {"check_walkable": 1},
]


@pytest.mark.parametrize("path", ASKS_FOR_OVERLAP)
def test_a_touch_is_an_overlap(path: dict[str, float]) -> None:
    """At exactly the sum of the radii; the next float32 is clear."""
    assert answer(call(BALL, mover(), FAR, (RADSUM, 0, 0), **path)) == "COLLIDED"
    assert answer(call(BALL, mover(), FAR, (above(RADSUM), 0, 0), **path)) == "OK"


@pytest.mark.parametrize("path", ASKS_FOR_OVERLAP)
def test_the_second_sphere_has_the_reach_of_the_first(path: dict[str, float]) -> None:
    """Its own radius is never read."""
    two = replace(mover(), spheres=[(0, 0, 0, RADIUS), (3, 0, 0, 0.125)])
    assert answer(call(BALL, two, FAR, (RADSUM - 3.0, 0, 0), **path)) == "COLLIDED"
    assert answer(call(BALL, two, FAR, (above(RADSUM) - 3.0, 0, 0), **path)) == "OK"


@pytest.mark.parametrize(
    "path", [*ASKS_FOR_OVERLAP, {"collide": 1}, {}, {"step_down": 1, "step_down_amt": 1}]
)
@pytest.mark.parametrize("state", [0, CONTACT, CLIPPED])
def test_who_is_far_away_is_not_concerned(path: dict[str, float], state: int) -> None:
    """Whatever is asked, nothing changes."""
    result = call(BALL, mover((0, 0, 0), (0, 0, 1), state=state), FAR, (2, 0, 0), **path)
    assert (answer(result), origin(result)) == ("OK", [2.0, 0.0, 0.0])


def test_an_object_places_and_scales_its_spheres() -> None:
    """Twice as large and a quarter of a turn to the left: (0.5, 0, 0) comes to (0, 1, 0), with radius 2."""
    turned = Pose(CELL, (10, 20, 30), (f32(math.sqrt(0.5)), 0, 0, f32(math.sqrt(0.5))))
    ball = Obstacle(turned, scale=2.0, spheres=[(0.5, 0, 0, 1)])
    reach = f32((2.0 + RADIUS) - EPS)
    for gap, expected in ((-1e-5, "COLLIDED"), (1e-5, "OK")):
        result = call(ball, mover(), (9, 30, 30), (10, 21 + reach + gap, 30), insert_type=1)
        assert answer(result) == expected


def test_an_object_of_the_next_block_is_192_metres_away() -> None:
    """Its sphere is taken into the block of the check position."""
    east = Obstacle(Pose(0xAAB40111), spheres=[(0, 0, 0, 1)])
    for x, expected in ((191.0, "COLLIDED"), (-1.0, "OK"), (1.0, "OK")):
        assert answer(call(east, mover(), (190, 0, 0), (x, 0, 0), insert_type=1)) == expected


def test_a_step_down_ends_on_top() -> None:
    """07 4: straight above, 1.25 metres from the centre, with half a metre to go."""
    t = (math.sqrt(RS * f32(RS)) - 1.25) / 0.5
    rise = f32(0.5 * t)
    nz = f32((rise + 1.25) * (1.0 / f32(RS)))
    result = call(BALL, mover(), (0, 0, 3), (0, 0, 1.25), step_down=1, step_down_amt=0.5)
    assert answer(result) == "ADJUSTED"
    assert origin(result) == [0.0, 0.0, f32(1.25 + rise)]
    assert contact(result) == [0.0, 0.0, nz, f32(-(nz * nz))]
    assert result["walk_interp"] == f32((1.0 - t) * 1.0)
    assert rise == pytest.approx(0.25, abs=1e-6)


def test_a_step_down_beside_the_top_keeps_x_and_y() -> None:
    """07 4.1: the squares of x and y are stored; the normal is that of where it comes to rest."""
    x, z, amt = 0.3, f32(1.25), 0.5
    x = f32(x)
    t = (math.sqrt(RS * f32(RS) - (f32(x * x) + 0.0)) - z) / amt
    rise = f32(amt * t)
    inv = 1.0 / f32(RS)
    nx, nz = f32(inv * x), f32((rise + z) * inv)
    result = call(BALL, mover(), (x, 0, 3), (x, 0, z), step_down=1, step_down_amt=amt)
    assert origin(result) == [x, 0.0, f32(z + rise)]
    assert contact(result) == [nx, 0.0, nz, f32(-(nz * nz + nx * nx))]


STEPS_DOWN: list[tuple[str, dict[str, Any], str]] = [
    ("it is not within reach", {"end": (0, 0, 1.5)}, "OK"),
    ("a touch is enough", {"end": (0, 0, RADSUM)}, "ADJUSTED"),
    ("t = (1.5 - 0.96) / 0.5 = 1.08 leaves -0.08", {"end": (0, 0, 0.96)}, "ADJUSTED"),
    ("t = (1.5 - 0.94) / 0.5 = 1.12 leaves -0.12", {"end": (0, 0, 0.94)}, "COLLIDED"),
    ("the top is above, in a step that is half done", {"end": (0, 0, 1.25), "walk_interp": 0.5}, "ADJUSTED"),
    ("a step of nothing", {"end": (0, 0, 1.25), "step_down_amt": 0.000199}, "COLLIDED"),
    ("the smallest step", {"end": (0, 0, RADSUM), "step_down_amt": EPS}, "ADJUSTED"),
    ("normal z = sqrt(1.5^2 - 1^2) / 1.5 = 0.745", {"end": (1, 0, 1)}, "ADJUSTED"),
    ("normal z = sqrt(1.5^2 - 1.2^2) / 1.5 = 0.6", {"end": (1.2, 0, 0.8)}, "OK"),
]


@pytest.mark.parametrize(("_why", "given", "expected"), STEPS_DOWN, ids=[why for why, _, _ in STEPS_DOWN])
def test_both_sides_of_each_limit_of_a_step_down(_why: str, given: dict[str, Any], expected: str) -> None:
    """07 4.2, 4.4, 4.8 and 4.12."""
    result = call(BALL, mover(), (0, 0, 3), **({"step_down": 1, "step_down_amt": 0.5} | given))
    assert answer(result) == expected
    assert (contact(result) is None) == (expected != "ADJUSTED")


def test_only_the_second_sphere_reaches_down() -> None:
    """The first is solved for all the same: it is above the top, so that no step is left."""
    two = mover((0, 0, 0), (0, 0, -0.5))
    path = {"step_down": 1.0, "step_down_amt": 0.5}
    assert answer(call(BALL, two, (0, 0, 3), (0, 0, 1.75), **path)) == "COLLIDED"
    assert answer(call(BALL, mover((0, 0, 0)), (0, 0, 3), (0, 0, 1.75), **path)) == "OK"


def test_a_landing_whose_root_is_not_a_number_is_a_collision() -> None:
    """The first sphere passes by at 2 metres, the second one overlaps (07 11)."""
    two = mover((0, 0, 0), (-2, 0, 0))
    assert answer(call(BALL, two, (2, 0, 3), (2, 0, 1), collide=1)) == "COLLIDED"


def test_a_step_down_whose_root_is_not_a_number_is_refused() -> None:
    """07 4.6 and 11: nobody knows what retail does beside the sphere; a little nearer the root is 0.17."""
    two = mover((0, 0, 0), (-2, 0, 0))
    path = {"step_down": 1.0, "step_down_amt": 0.5}
    with pytest.raises(UndeterminedError, match=r"query 0: .*not known: a step down .*07 4\.6"):
        call(BALL, two, (2, 0, 3), (2, 0, 1), **path)
    assert answer(call(BALL, two, (1.49, 0, 3), (1.49, 0, 1), **path)) == "COLLIDED"


def test_one_refused_call_leaves_the_other_answers() -> None:
    """The error holds the answers of the whole batch; a status says which is none."""
    things = world(BALL)
    two = mover((0, 0, 0), (-2, 0, 0))
    path = PathState(step_down=1, step_down_amt=0.5, walk_interp=1.0, walkable_allowance=FLOOR_Z)
    ends = [(0, 0, 1.25), (2, 0, 1), (0, 0, 1.25)]
    calls = [ObjectCall(Move(two, at(*end), CELL, start=at(0, 0, 3)), Target.OBJECT, 0, path) for end in ends]
    with pytest.raises(UndeterminedError) as caught:
        find_object_collisions_many(things, calls)
    assert caught.value.index == 1
    assert caught.value.results["status"].tolist() == [STATUS_OK, STATUS_UNDETERMINED, STATUS_OK]
    assert [answer(caught.value.results[i]) for i in (0, 2)] == ["ADJUSTED", "ADJUSTED"]


def test_nobody_stands_on_a_creature() -> None:
    """Neither stepping down nor landing; a missile counts as one."""
    for ball in (CREATURE, replace(BALL, state=0x40)):
        for path in ({"step_down": 1, "step_down_amt": 0.5}, {"collide": 1}):
            result = call(ball, mover(), (0, 0, 3), (0, 0, 1.25), **path)
            assert (answer(result), contact(result)) == ("OK", None)
    assert answer(call(CREATURE, mover(), FAR, (1, 0, 0), check_walkable=1)) == "COLLIDED"


def test_a_landing_goes_back_along_the_way() -> None:
    """07 8.8, from z = 3 to 1: a 4, dot 2, root sqrt(4 + 1.25 * 4) - 2 = 1, which is a quarter of the way.

    The plane goes through the lowest point of the sphere before it is moved: 1 - 0.5.
    """
    result = call(BALL, mover(), (0, 0, 3), (0, 0, 1), collide=1)
    assert answer(result) == "ADJUSTED"
    assert origin(result) == [0.0, 0.0, 1.5]
    assert contact(result) == [0.0, 0.0, 1.0, -0.5]
    assert result["walk_interp"] == 0.75


LANDINGS: list[tuple[str, dict[str, Any], str]] = [
    ("a root above 1 is mirrored before it is divided", {"start": (0, 0, 4), "end": (0, 0, 1)}, "COLLIDED"),
    ("no movement has no root", {"start": (0, 0, 1), "end": (0, 0, 1)}, "COLLIDED"),
    ("a^2 = 0.0001 is a movement too short", {"start": (0, 0, 1.01), "end": (0, 0, 1)}, "COLLIDED"),
    ("normal z = 1 / sqrt(2) is flat enough", {"start": (2, 0, 2), "end": (1, 0, 1)}, "ADJUSTED"),
    (
        "and too steep for a smaller slope",
        {"start": (2, 0, 2), "end": (1, 0, 1), "walkable_allowance": 0.75},
        "OK",
    ),
]


@pytest.mark.parametrize(("_why", "given", "expected"), LANDINGS, ids=[why for why, _, _ in LANDINGS])
def test_ways_out_of_a_landing(_why: str, given: dict[str, Any], expected: str) -> None:
    """07 8.8.6, 8.8.8, 8.8.10 and 8.8.12."""
    result = call(BALL, mover(), collide=1, **given)
    assert answer(result) == expected


def test_how_much_of_the_step_a_landing_may_undo() -> None:
    """Up to a tenth more than all: it goes on for 1.1 of the way back from 0.96, but not 1.12 from 0.94."""
    for start, expected in ((1.451, "ADJUSTED"), (1.441, "COLLIDED")):
        # from start down to 0.951: u = (1.5 - 0.951) / (start - 0.951) = 1.098, or 1.1204
        result = call(BALL, mover(), (0, 0, start), (0, 0, 0.951), collide=1)
        assert answer(result) == expected


def test_many_calls_are_answered_as_if_alone() -> None:
    """A row of state is cleared between two calls."""
    things = world(BALL, CREATURE)
    start, end = Pose(CELL, (0, 0, 3)), Pose(CELL, (0, 0, 1.25))
    path = PathState(step_down=1, step_down_amt=0.5, walk_interp=1.0, walkable_allowance=FLOOR_Z)
    calls = [ObjectCall(Move(mover(), end, CELL, start=start), Target.OBJECT, i, path) for i in (0, 1, 0)]
    first, creature, again = (find_object_collisions(things, c) for c in calls)
    assert (answer(first), answer(creature)) == ("ADJUSTED", "OK")
    assert first.tobytes() == again.tobytes()
