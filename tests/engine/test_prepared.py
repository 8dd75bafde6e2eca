"""A query asked again and again: the same answers as asking it once."""

from __future__ import annotations

import copy
import pickle
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest
from engine_scenes import CELL, R, at, floor_and_wall, mover, world_of

from engine import CollisionCall, Move, PathState, Prepared, QueryError, find_collisions, resolve

if TYPE_CHECKING:
    from collections.abc import Callable

MOVE = Move(mover(), at(0.5, 0, R), CELL, start=at(0, 0, 2 * R))
CALL = CollisionCall(MOVE, path=PathState(step_down=1, step_down_amt=0.5, walk_interp=1.0))


def test_a_move_is_answered_each_time_anew() -> None:
    """Nothing of the last run is left in the next."""
    world = world_of(floor_and_wall())
    prepared = Prepared(world, MOVE)
    first = prepared.run().tobytes()
    assert first == resolve(world, MOVE).tobytes()
    assert prepared.run().tobytes() == first


def test_a_collision_call_is_answered_as_by_find_collisions() -> None:
    """The same record."""
    world = world_of(floor_and_wall())
    assert Prepared(world, CALL).run().tobytes() == find_collisions(world, CALL).tobytes()


def test_the_query_may_be_changed_between_runs() -> None:
    """The next answer is that of the changed query."""
    world = world_of(floor_and_wall())
    prepared = Prepared(world, MOVE)
    prepared.run()
    prepared.query["end"][5] = 0.25
    changed = replace(MOVE, end=at(0.25, 0, R))
    assert prepared.run().tobytes() == resolve(world, changed).tobytes()
    assert prepared.result["curr"][5] == 0.25


def test_what_cannot_be_asked_is_refused_at_once() -> None:
    """Before the first run."""
    for query in (MOVE, CALL):
        with pytest.raises(QueryError, match="plan"):
            Prepared(world_of(floor_and_wall()), query, plan=None)  # type: ignore[arg-type]
        with pytest.raises(QueryError, match="world"):
            Prepared(None, query)  # type: ignore[arg-type]
    with pytest.raises(QueryError, match="begin cell"):
        Prepared(world_of(floor_and_wall()), replace(MOVE, begin_cell=CELL + 1))


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, pickle.dumps])
def test_it_is_not_copied(copied: Callable[[Prepared], object]) -> None:
    """A copy's kernel would write its answer elsewhere than where it is read."""
    with pytest.raises(TypeError, match="cannot be copied or pickled"):
        copied(Prepared(world_of(floor_and_wall()), MOVE))
