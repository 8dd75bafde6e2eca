"""Asking one or many: the same answers, and errors instead of silence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from engine_scenes import CELL, R, at, floor_and_wall, mover, seed_world, triangle, world_of

from engine import (
    CollisionCall,
    ContactPlane,
    Move,
    PathState,
    Pose,
    QueryError,
    RecursionBoundError,
    Seed,
    UndeterminedError,
    find_collisions,
    find_collisions_many,
    resolve,
    resolve_many,
)
from engine.batch import check_status
from engine.constants import ADJUSTED, FLOOR_Z, OK
from engine.layout import NO_CELL, RESULT_SIZE, STATUS_RECURSION, STATUS_UNDETERMINED
from engine.query import move_rows

STEP = PathState(step_down=1, step_down_amt=0.5, walk_interp=1.0, walkable_allowance=FLOOR_Z)
GROUND = ContactPlane((0, 0, 1, 0), CELL)


def call_at(height: float) -> CollisionCall:
    """Return a step down by half a metre, from a height above the turned floor."""
    pose = Pose(CELL, (100.0, 50.0, 94.0 + height))
    return CollisionCall(Move(mover(), pose, CELL, start=pose), path=STEP)


def test_the_case_this_project_starts_from() -> None:
    """Overlapping by 0.08 the sphere is lifted to rest, and the plane is the world's, not the cell's."""
    result = find_collisions(seed_world(), call_at(0.4))
    assert result["result"] == ADJUSTED
    assert chr(int(result["dispatch"])) == "D"
    assert result["contact_plane_valid"] == 1
    assert result["contact_plane"].tolist() == [0.0, 0.0, 1.0, -94.0]
    assert result["contact_plane_cell_id"] == CELL
    assert result["global_spheres"][0].tolist() == [100.0, 50.0, float(np.float32(94.48)), R]
    assert (result["walkable"], result["walkable_shape"]) == (0, 0)


def test_not_touching_it_finds_nothing() -> None:
    """Two centimetres above the floor there is no ground, although the step would reach it."""
    result = find_collisions(seed_world(), call_at(0.5))
    assert result["result"] == OK
    assert result["contact_plane_valid"] == 0
    assert result["walkable"] == -1


def test_a_batch_of_calls_equals_the_single_ones() -> None:
    """Each query is answered as if it were alone; nothing leaks from one to the next."""
    world = seed_world()
    calls = [call_at(height) for height in (0.4, 0.5, 0.1, 0.4, 5.0)]
    many = find_collisions_many(world, calls)
    assert [record.tobytes() for record in many] == [find_collisions(world, c).tobytes() for c in calls]
    assert many["result"].tolist() == [ADJUSTED, OK, ADJUSTED, ADJUSTED, OK]


def moves() -> list[Move]:
    """Return moves of every kind towards a wall: on the ground, in the air, a placement, standing still."""
    grounded = Move(mover(3), at(0.9, 0.5, R), CELL, start=at(0, 0, R), seed=Seed(GROUND, GROUND))
    return [
        grounded,
        replace(grounded, mover=mover(0x203, spheres=2), end=at(-3, 1, R)),
        replace(grounded, mover=mover(), seed=Seed(), end=at(0.2, 0, 0.1), start=at(0, 0, 2)),
        replace(grounded, start=None, end=at(0.7, 0, R)),
        replace(grounded, end=at(0, 0, R)),
    ]


def test_a_batch_of_moves_equals_the_single_ones() -> None:
    """Each move is answered as if it were alone."""
    world = world_of(floor_and_wall())
    many = resolve_many(world, moves())
    assert [record.tobytes() for record in many] == [resolve(world, m).tobytes() for m in moves()]
    assert (many["polygons_tested"] > 0).tolist() == [True, True, True, True, False]
    assert np.array_equal(resolve_many(world, move_rows(world, moves())), many)


def test_rows_may_be_read_only_or_apart() -> None:
    """They are copied then."""
    world = seed_world()
    rows = move_rows(world, moves())
    many = resolve_many(world, rows)
    apart = np.repeat(rows, 2)[::2]
    apart.flags.writeable = False
    assert np.array_equal(resolve_many(world, apart), many)


def test_a_wall_stops_a_walker_and_it_slides() -> None:
    """The blocked part of the movement is lost, the rest kept, the ground stays."""
    result = resolve(world_of(floor_and_wall()), moves()[0])
    x, y, z = result["curr"][5:]
    assert result["result"] == 1
    assert x < 1.0 - R + 0.0002
    assert y == 0.5
    assert z == R
    assert result["contact_plane"].tolist() == [0.0, 0.0, 1.0, 0.0]
    assert result["collision_normal"].tolist() == [-1.0, 0.0, 0.0]
    assert result["state"] == 3


def test_nothing_asked_nothing_answered() -> None:
    """An empty batch is an empty result."""
    assert len(resolve_many(seed_world(), [])) == 0
    assert len(find_collisions_many(seed_world(), [])) == 0


def test_rows_of_another_type_are_refused() -> None:
    """Plain numbers could be anything."""
    with pytest.raises(QueryError, match="rows: not of engine"):
        resolve_many(seed_world(), np.zeros((1, RESULT_SIZE)))  # type: ignore[arg-type]


def test_a_mover_may_leave_for_land_that_is_not_in_the_world() -> None:
    """It is in no cell then; having none, it meets nothing, and its cell id does not change any more."""
    start, end = Pose(0xA9B40001, (0, 0, R)), Pose(0xA9B40001, (30, 0, R))
    result = resolve(world_of(triangle()), Move(mover(), end, CELL, start=start))
    assert result["result"] == 1
    assert result["curr_cell"] == NO_CELL
    assert result["curr"][0] == 0xA9B40001
    assert result["curr"][5] > 24.0


def test_a_violated_bound_is_an_error() -> None:
    """A status is never ignored."""
    check_status(np.zeros(3))
    with pytest.raises(RecursionBoundError, match="query 1"):
        check_status(np.array([0.0, STATUS_RECURSION]))


def test_an_unknown_answer_does_not_hide_a_violated_bound() -> None:
    """What is wrong with the engine is told before what is not known of retail."""
    with pytest.raises(RecursionBoundError, match="query 1"):
        check_status(np.array([STATUS_UNDETERMINED, STATUS_RECURSION]))
    with pytest.raises(UndeterminedError, match="query 0"):
        check_status(np.array([STATUS_UNDETERMINED, 0.0]))
