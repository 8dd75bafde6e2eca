"""Answers in given memory: the same, in place; and an error before anything is written where it cannot be."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_scenes import CELL, R, at, floor_and_wall, mover, world_of

from engine import (
    CollisionCall,
    Move,
    ObjectCall,
    QueryError,
    Target,
    find_collisions_many,
    find_object_collisions_many,
    resolve_many,
    step_down_many,
    strike_many,
)
from engine import layout as of
from engine.given import room
from engine.kernels import tree_calls
from engine.object_call import object_rows
from engine.query import collision_rows, move_rows

if TYPE_CHECKING:
    from collections.abc import Callable

    from engine.query import Rows

WORLD = world_of(floor_and_wall())
COUNT = 3
MOVES = [Move(mover(), at(0.3 * i, 0.0, R), CELL, start=at(0.0, 0.0, R + 0.1)) for i in range(COUNT)]
ROWS = move_rows(WORLD, MOVES)
SPHERES = np.array([[0.0, 0.0, 0.25, R], [0.75, 0.0, 1.0, R], [-3.0, 1.0, 2.0, R]])
WAYS = np.array([[0, 0, -0.5], [0.25, 0, 0], [0, 0, -1]], dtype=np.float64)
UPS, ONES = np.tile((0.0, 0.0, 1.0), (COUNT, 1)), np.ones(COUNT)
RESULT = np.empty(COUNT, dtype=of.RESULT_DTYPE)
FROZEN = np.empty(COUNT, dtype=of.RESULT_DTYPE)
FROZEN.flags.writeable = False
ASKING: list[tuple[Callable[..., Any], Rows]] = [
    (resolve_many, ROWS),
    (find_collisions_many, collision_rows(WORLD, [CollisionCall(move) for move in MOVES])),
    (find_object_collisions_many, object_rows(WORLD, [ObjectCall(move, Target.CELL) for move in MOVES])),
]


@pytest.mark.parametrize(("ask", "rows"), ASKING)
def test_results_are_written_where_they_are_wanted(ask: Callable[..., Any], rows: Rows) -> None:
    """Into the given rows, which are returned; over what the last batch has left there."""
    out = np.full(COUNT, np.nan, dtype=of.RESULT_DTYPE)
    for some in (rows[::-1], rows):
        assert ask(WORLD, some, out=out) is out
    assert out.tobytes() == ask(WORLD, rows).tobytes()


def test_a_part_of_an_array_takes_results() -> None:
    """What is beside it is left alone."""
    room_for_more = np.zeros(COUNT + 2, dtype=of.RESULT_DTYPE)
    resolve_many(WORLD, ROWS, out=room_for_more[1:-1])
    assert room_for_more[1:-1].tobytes() == resolve_many(WORLD, ROWS).tobytes()
    assert room_for_more[[0, -1]].tobytes() == bytes(2 * of.RESULT_DTYPE.itemsize)


@pytest.mark.parametrize(
    ("out", "found"),
    [
        ([0, 1, 2], "a value of type list where an array is needed"),
        (
            RESULT[:2],
            r"shape \(2,\) of records of 4\d fields where \(3,\) of records of 4\d fields is needed",
        ),
        (np.empty(COUNT), r"of float64 where \(3,\) of records"),
        (np.empty(COUNT, dtype=of.QUERY_DTYPE), r"of records of \d+ fields where \(3,\) of records"),
        (np.empty(2 * COUNT, dtype=of.RESULT_DTYPE)[::2], "not contiguous"),
        (FROZEN, "not writable"),
        (np.empty(8 + RESULT.nbytes, dtype=np.uint8)[1:-7].view(of.RESULT_DTYPE), "not aligned"),
    ],
)
def test_what_cannot_take_results_is_refused(out: Any, found: str) -> None:
    """With what is wrong with it."""
    with pytest.raises(QueryError, match=f"^out: .*{found}"):
        resolve_many(WORLD, ROWS, out=out)


def test_results_are_not_written_over_queries() -> None:
    """Rows of both that share memory."""
    memory = np.zeros(COUNT * (ROWS.nbytes + RESULT.nbytes), dtype=np.uint8)
    rows = memory[: ROWS.nbytes].view(of.QUERY_DTYPE)
    rows[:] = ROWS
    beside = memory[ROWS.nbytes :][: RESULT.nbytes].view(of.RESULT_DTYPE)
    assert resolve_many(WORLD, rows, out=beside).tobytes() == resolve_many(WORLD, ROWS).tobytes()
    over = memory[ROWS.nbytes - 8 :][: RESULT.nbytes].view(of.RESULT_DTYPE)
    with pytest.raises(QueryError, match=r"^out: lies in the memory of what is asked"):
        resolve_many(WORLD, rows, out=over)


def test_strikes_are_written_where_they_are_wanted() -> None:
    """Both arrays, in a tuple."""
    out = np.empty(COUNT, dtype=np.int32), np.empty(COUNT, dtype=np.int32)
    struck, polygons = strike_many(WORLD, 0, SPHERES, WAYS, out=out)
    assert struck is out[0]
    assert polygons is out[1]
    for given, new in zip(out, strike_many(WORLD, 0, SPHERES, WAYS), strict=True):
        assert given.tolist() == new.tolist()


def test_a_part_of_any_array_takes_strikes() -> None:
    """Where an int32 may lie, also in the middle of eight bytes."""
    struck, polygons = np.full((2, COUNT), 7, dtype=np.int32)
    strike_many(WORLD, 0, SPHERES[1:2], WAYS[1:2], out=(struck[1:2], polygons[1:2]))
    assert (struck.tolist(), polygons.tolist()) == ([7, 1, 7], [7, 1, 7])


def test_steps_down_are_written_where_they_are_wanted() -> None:
    """All three arrays; what may be used of the movements may be ratcheted down in place."""
    centers, polygons, interps = np.empty((COUNT, 3)), np.empty(COUNT, dtype=np.int32), np.ones(COUNT)
    allowances = np.full(COUNT, 0.5)
    new = step_down_many(WORLD, 0, SPHERES, WAYS, UPS, allowances, ONES)
    out = centers, interps, polygons
    answers = step_down_many(WORLD, 0, SPHERES, WAYS, UPS, allowances, interps, out=out)
    assert all(answer is given for answer, given in zip(answers, out, strict=True))
    assert [a.tolist() for a in out] == [a.tolist() for a in new]
    assert interps[0] < 1.0


def test_every_array_is_checked() -> None:
    """A tuple of as many as there are answers, none of them twice; before anything is written."""
    one, other = np.full((2, COUNT), 7, dtype=np.int32)
    cases = [
        ([one, other], "out: a value of type list where a tuple of 2 arrays"),
        ((one,), "out: a value of type tuple where a tuple of 2 arrays"),
        ((one, other[:2]), r"out\[1\], polygons: shape \(2,\) of int32 where \(3,\) of int32"),
        ((one, one), r"out\[1\], polygons: lies in the memory"),
        ((one.astype(np.int64), other), r"out\[0\], struck: shape \(3,\) of int64"),
    ]
    for out, found in cases:
        with pytest.raises(QueryError, match=f"^{found}"):
            strike_many(WORLD, 0, SPHERES, WAYS, out=out)  # type: ignore[arg-type]
    with pytest.raises(QueryError, match=r"^out\[0\], centers: lies in the memory"):
        step_down_many(
            WORLD, 0, SPHERES, WAYS, UPS, ONES, ONES, out=(WAYS, np.ones(COUNT), np.empty(COUNT, np.int32))
        )
    assert one.tolist() == other.tolist() == [7] * COUNT


def test_without_given_memory_there_is_new() -> None:
    """Of the shape and type that are asked for."""
    made = room(None, np.int32, (2, 3), [], "out")
    assert (made.shape, made.dtype) == ((2, 3), np.int32)


def test_rows_that_can_only_be_read_are_asked_all_the_same() -> None:
    """Without compiling anything anew."""
    spheres = SPHERES.copy()
    spheres.flags.writeable = False
    assert (
        strike_many(WORLD, 0, spheres, WAYS)[0].tolist() == strike_many(WORLD, 0, SPHERES, WAYS)[0].tolist()
    )
    assert len(tree_calls.strike_many.overloads) == 1  # type: ignore[attr-defined]
