"""Free flights past the transition: the same bytes, and who may not go this way."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from engine_scenes import CELL, R, at, floor_and_wall, mover, triangle, world_of
from hypothesis import given
from hypothesis import strategies as st

from engine import (
    ContactPlane,
    Leaf,
    Move,
    Plan,
    Pose,
    Seed,
    Shape,
    Stage,
    World,
    resolve,
    resolve_many,
)
from engine.constants import CONTACT, EPS, FREE_ROTATE, IS_VIEWER, ON_WALKABLE
from engine.probes import without_work

TURN = (0.8, 0.0, 0.6, 0.0)
"""A rotation about y, w x y z: it takes the second sphere to another place."""
WORLD = world_of(triangle(200.0))
FLIGHT = Move(mover(spheres=2), at(0.25, 0.0, 3.0), CELL, start=at(0.0, 0.0, 3.0))
PAST_THE_TRANSITION = 0
"""Cells that a flight lists which is answered from its query's row; a transition lists one a sub-step."""


def flown(world: World, move: Move) -> Any:
    """Return the answer with flights, which is that without."""
    short, full = resolve(world, move, plan=Plan(skip=Stage.FLIGHT)), resolve(world, move, plan=Plan.none())
    assert without_work(short) == without_work(full)
    return short


def sub_steps(answer: Any) -> int:
    """Return how many sub-steps flew freely."""
    return int(answer["skipped"][list(Stage).index(Stage.FLIGHT)])


@pytest.mark.parametrize("spheres", [1, 2])
@pytest.mark.parametrize(("length", "steps"), [(0.25, 1), (1.0, 3), (4.0, 9)])
def test_a_flight_is_answered_past_the_transition(spheres: int, length: float, steps: int) -> None:
    """In any number of sub-steps."""
    move = replace(FLIGHT, mover=mover(spheres=spheres), end=at(length, 0.0, 3.0))
    answer = flown(WORLD, move)
    assert (sub_steps(answer), answer["cells_listed"]) == (steps, PAST_THE_TRANSITION)
    assert answer["curr"][5] == pytest.approx(length)


COORDINATES = st.floats(-20.0, 20.0, width=32)
TURNS = st.tuples(*[st.floats(-1.0, 1.0, width=32)] * 4).filter(lambda q: sum(c * c for c in q) > 0.1)
WAYS = st.floats(-3.0, 3.0, width=32)


@given(
    st.tuples(COORDINATES, COORDINATES, st.floats(6.0, 9.0, width=32)),
    st.tuples(WAYS, WAYS, st.floats(-0.5, 0.5, width=32)),
    st.tuples(TURNS, TURNS),
)
def test_flights_that_turn_end_as_transitions_do(
    begin: tuple[float, ...], way: tuple[float, ...], turns: tuple[tuple[float, ...], ...]
) -> None:
    """With the same bits of place, rotation and spheres, however far they turn on their way."""
    rotations = [tuple(c / sum(x * x for x in turn) ** 0.5 for c in turn) for turn in turns]
    end = tuple(a + b for a, b in zip(begin, way, strict=True))
    start, stop = (Pose(CELL, p, q) for p, q in zip((begin, end), rotations, strict=True))
    flown(WORLD, Move(mover(spheres=2), stop, CELL, start=start))


@given(
    st.tuples(COORDINATES | st.just(0.0), COORDINATES | st.just(-0.0), st.floats(6.0, 9.0, width=32)),
    st.tuples(WAYS, WAYS, st.floats(-0.5, 0.5, width=32)),
    st.tuples(st.floats(0.0, 7.0), st.floats(0.0, 7.0)),
)
def test_upright_flights_end_as_transitions_do(
    begin: tuple[float, ...], way: tuple[float, ...], headings: tuple[float, float]
) -> None:
    """With the same bits, also where a coordinate is 0, whichever way they turn."""
    end = tuple(a + b for a, b in zip(begin, way, strict=True))
    start, stop = (
        Pose(CELL, place, (math.cos(angle), 0.0, -0.0, math.sin(angle)))
        for place, angle in zip((begin, end), headings, strict=True)
    )
    flown(WORLD, Move(mover(spheres=2), stop, CELL, start=start))


@pytest.mark.parametrize(("gap", "flies"), [(0.3, True), (0.1, True), (0.02, False)])
def test_each_sphere_alone_takes_less_room(gap: float, flies: bool) -> None:
    """Beside a wall that the ball about both reaches, a flight is one as long as neither of theirs does."""
    x = 1.0 - R - gap
    move = replace(FLIGHT, start=at(x - 0.1, 0.0, 0.9), end=at(x, 0.0, 0.9))
    assert sub_steps(flown(world_of(floor_and_wall()), move)) == flies


@pytest.mark.parametrize(
    "seed",
    [
        Seed(last_known=ContactPlane((0.0, 0.0, 1.0, 0.5), CELL, is_water=True)),
        Seed(frames_stationary_fall=2),
        Seed(sliding_normal=(1.0, 0.0, 0.0)),
        Seed(contact=ContactPlane((0.0, 0.0, 1.0, 0.5), CELL)),
    ],
    ids=["last known plane", "stationary fall", "sliding", "contact"],
)
def test_what_a_mover_brings_along_is_handed_on(seed: Seed) -> None:
    """As a transition hands it on."""
    flown(WORLD, replace(FLIGHT, seed=seed))


@pytest.mark.parametrize(
    ("change", "steps"),
    [
        ({"end": at(0.5 * EPS, 0.0, 3.0)}, 0),
        ({"end": at(0.75 * EPS, 0.75 * EPS, 3.0)}, 1),
        ({"mover": mover(IS_VIEWER)}, 1),
        ({"mover": mover(FREE_ROTATE)}, 1),
        ({"seed": Seed(frames_stationary_fall=1)}, 1),
    ],
    ids=["too short", "not far along any axis", "a camera", "one that turns first", "one that stood still"],
)
def test_others_are_left_to_the_transition(change: dict[str, Any], steps: int) -> None:
    """A mover that counts as not moved, one that is moved or turned in another way."""
    answer = flown(WORLD, replace(FLIGHT, **change))
    assert sub_steps(answer) == steps
    assert answer["cells_listed"] > PAST_THE_TRANSITION or not steps


@pytest.mark.parametrize(("gap", "past"), [(0.1, True), (0.001, False), (-0.1, False)])
def test_a_flight_past_the_transition_stays_in_its_cell(gap: float, past: bool) -> None:
    """With the whole ball about its way; otherwise each sub-step asks for the cell."""
    bounds = (0.0, 0.0, 0.0, 300.0)
    corners = [(-200, -200, 0), (200, -200, 0), (0, 200, 0)]
    wall = 0.25 + R + gap
    shape = Shape(corners, [(0, 1, 2)], Leaf(bounds, (0,)), [(-1, 0, 0, wall)])
    world = world_of(shape)
    answer = flown(world, replace(FLIGHT, mover=mover()))
    assert (answer["cells_listed"] == PAST_THE_TRANSITION) == past
    assert sub_steps(answer) == 1


@pytest.mark.parametrize(("scale", "steps"), [(1.0, 1), (1.5, 0)])
def test_no_flight_in_a_cell_whose_planes_are_not_unit(scale: float, steps: int) -> None:
    """Their distances say nothing of a ball."""
    bounds = (0.0, 0.0, 0.0, 300.0)
    shape = Shape(
        [(0, 0, -9), (1, 0, -9), (0, 1, -9)], [(0, 1, 2)], Leaf(bounds, (0,)), [(0, 0, scale, scale)]
    )
    assert sub_steps(flown(world_of(shape), FLIGHT)) == steps


def test_a_row_is_no_other_after_a_flight() -> None:
    """What a flight leaves in the row of state changes no later answer, nor does it read what was left."""
    walk = Move(mover(CONTACT | ON_WALKABLE), at(0.2, 0.0, R), CELL, start=at(0.0, 0.0, R))
    moves = [walk, FLIGHT, walk, replace(FLIGHT, mover=mover()), FLIGHT]
    together = resolve_many(WORLD, moves)
    alone = [resolve(WORLD, move) for move in moves]
    assert [answer.tobytes() for answer in together] == [answer.tobytes() for answer in alone]
