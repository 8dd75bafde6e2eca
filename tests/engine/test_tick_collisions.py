"""What a body makes of its collisions: bounces, stationary ticks, reports."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from engine_bodies import ACTIVE, GROUNDED, f32, grounded, walker
from engine_scenes import CELL, floor_and_wall, triangle, world_of

from engine import Body, CrowdedError, Obstacle, Pose, World, body_rows
from engine import layout as at
from engine.batch import check_status
from engine.body_layout import MAX_RECORDS
from engine.kernels.tick_collisions import respond, track_object_collision
from engine.memory import rows_as_numbers

MISSILE = 0x340 | 0x8
ETHEREAL = 0x4


def collided(body: Body, **collision: Any) -> tuple[Any, bool]:
    """Let a body respond to a transition; return its record, and whether something was reported."""
    rows = body_rows(world_of(floor_and_wall()), [body])
    state = np.zeros(at.STATE_SIZE, dtype=np.float64)
    made = state.view(at.STATE_DTYPE)[0]
    for name, value in collision.items():
        made[name] = value
    reported = respond(state, rows_as_numbers(rows)[0], bool(int(body.transient_state) & 2))
    return rows[0], reported


def wall(x: float) -> dict[str, Any]:
    """Return the collision with a wall that faces along x."""
    return {"collision_normal_valid": 1, "collision_normal": (x, 0, 0)}


def test_a_bounce_gives_back_part_of_the_speed() -> None:
    """The velocity into the wall is reversed and multiplied by the elasticity, in retail's roundings."""
    record, _ = collided(walker(velocity=(2, 1, 0), elasticity=f32(0.1)), **wall(-1))
    bounce = -(-2.0 * (f32(0.1) + 1.0))
    assert record["velocity"].tolist() == [f32(bounce * -1.0 + 2.0), 1.0, 0.0]


def test_who_does_not_bounce() -> None:
    """Neither what moves away, nor what stays on the ground; what is inelastic stops."""
    for body, after in (
        (walker(velocity=(2, 0, 0)), [2.0, 0.0, 0.0]),
        (grounded(velocity=(-2, 0, 0)), [-2.0, 0.0, 0.0]),
        (walker(velocity=(-2, 0, 0), state=0x20000), [0.0, 0.0, 0.0]),
    ):
        record, _ = collided(body, **wall(1))
        assert record["velocity"].tolist() == after


def test_a_sled_bounces_on_the_ground_too() -> None:
    """It is the exception to staying on the ground."""
    record, _ = collided(grounded(velocity=(-2, 0, 0), state=0x800000, elasticity=0), **wall(1))
    assert record["velocity"].tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    ("frames", "before", "after", "stops"),
    [(0, 0x30, 0, False), (1, 0, 0x10, False), (2, 0x10, 0x30, True), (3, 0x30, 0, True), (4, 0, 0x40, True)],
)
def test_ticks_without_movement_are_counted(frames: int, before: int, after: int, stops: bool) -> None:
    """Bits are added, not replaced; from the second on the velocity is lost."""
    body = walker(velocity=(0, 3, 0), transient_state=ACTIVE | before)
    record, _ = collided(body, frames_stationary_fall=frames)
    assert record["transient_state"] == ACTIVE | after
    assert record["velocity"][1] == (0.0 if stops else 3.0)


def test_the_environment_is_reported_once_until_it_is_left() -> None:
    """The report needs a game object; the latch is set without one, and a missile becomes ordinary."""
    hit = {"collided_with_environment": 1}
    for body, reported, latch in (
        (walker(weenie_bits=0), True, 1),
        (walker(), False, 1),
        (walker(weenie_bits=0, colliding_with_environment=True), False, 1),
    ):
        record, answer = collided(body, **hit)
        assert (answer, record["colliding_with_environment"]) == (reported, latch)
    record, _ = collided(walker(colliding_with_environment=True))
    assert record["colliding_with_environment"] == 0
    record, _ = collided(walker(state=MISSILE), **hit)
    assert record["state"] == 0x8


def test_a_landing_counts_as_a_hit() -> None:
    """Standing on a walkable now, and not before, is reported like a collision."""
    rows = body_rows(world_of(floor_and_wall()), [walker(weenie_bits=0, transient_state=GROUNDED)])
    assert respond(np.zeros(at.STATE_SIZE), rows_as_numbers(rows)[0], False)


def test_objects_are_remembered_for_a_second() -> None:
    """A second touch is not reported; after a second, an ethereal one at once, it is forgotten."""
    things = [Obstacle.solid(triangle(), Pose(CELL), state=state) for state in (0x10000, 0x10004)]
    world: World = world_of(floor_and_wall(), objects=things)
    rows = body_rows(world, [walker(weenie_bits=0)])
    record, row = rows[0], rows_as_numbers(rows)[0]
    assert track_object_collision(row, 0, 0x10000, False)
    assert not track_object_collision(row, 0, 0x10000, False)
    assert track_object_collision(row, 1, 0x10000 | ETHEREAL, False)
    assert record["records"][:2].tolist() == [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0]]
    state = np.zeros(at.STATE_SIZE)
    for now, known in ((0.0, [0, 1]), (1.0, [0]), (1.125, [])):
        record["physics_time"] = now
        respond(state, row, False)
        assert record["records"][: int(record["num_records"]), 0].tolist() == known


def test_a_body_remembers_a_crowd_of_256() -> None:
    """The next object is a typed error, not a memory that was overwritten; a known one is not."""
    world = world_of(floor_and_wall())
    rows = body_rows(world, [walker()])
    row = rows_as_numbers(rows)[0]
    for thing in range(MAX_RECORDS):
        track_object_collision(row, thing, 0, False)
    track_object_collision(row, 17, 0, False)
    check_status(rows["status"])
    track_object_collision(row, int(MAX_RECORDS), 0, False)
    assert rows["num_records"][0] == MAX_RECORDS
    with pytest.raises(CrowdedError, match="body 0 has touched more than 256 objects within a second"):
        check_status(rows["status"])


def test_what_a_touched_object_makes_of_it() -> None:
    """A static one is environment; one that ignores collisions is not told of, but may be told itself."""
    for state, has_weenie, reported, latch in (
        (0x1, False, True, 1),
        (0x200000, False, True, 1),
        (0x10, False, False, 0),
        (0x18, True, True, 0),
    ):
        world = world_of(floor_and_wall(), objects=[Obstacle.solid(triangle(), Pose(CELL), state=state)])
        rows = body_rows(world, [walker(weenie_bits=0)])
        assert track_object_collision(rows_as_numbers(rows)[0], 0, state, has_weenie) == reported
        assert rows[0]["colliding_with_environment"] == latch
