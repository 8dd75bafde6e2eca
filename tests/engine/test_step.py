"""Ticks: bodies that fall, walk, are stopped; one or many; errors instead of silence."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from engine_bodies import ACTIVE, GRAVITY, GROUNDED, f32, grounded, walker
from engine_scenes import CELL, R, at, floor_and_wall, triangle, world_of

from engine import (
    Body,
    Obstacle,
    Pose,
    QueryError,
    Weenie,
    body_rows,
    resolve_many,
    set_elasticity,
    set_local_velocity,
    set_velocity,
    step,
    step_many,
    update_many,
)
from engine.body_layout import OUTCOMES
from engine.layout import NO_CELL

DT = 1.0 / 30.0


def outcome(record: Any) -> str:
    """Return the name of what the last tick did."""
    return OUTCOMES[int(record["outcome"])]


def test_a_walker_walks() -> None:
    """On the ground it goes as far as its velocity says, and its contact stays."""
    record = step(world_of(floor_and_wall()), grounded(-3, velocity=(3, 0, 0)), 0.1)
    assert outcome(record) == "moved"
    assert record["origin"].tolist() == [f32(f32(f32(0.1) * 3.0) - 3.0), 0.0, R]
    assert record["transient_state"] == GROUNDED
    assert record["contact_plane"].tolist() == [0.0, 0.0, 1.0, 0.0]
    assert record["contact_plane_cell_id"] == CELL
    assert record["cached_velocity"][0] == pytest.approx(3.0, abs=1e-5)
    assert record["physics_time"] == f32(0.1)


def test_a_fall_ends_on_the_floor() -> None:
    """It falls freely, lands, and does not move any more; its plane is the floor's in every tick."""
    world = world_of(floor_and_wall())
    record = step(world, walker(z=2.0, velocity=(0, 0, -1), acceleration=(0, 0, GRAVITY)), DT)
    assert record["acceleration"].tolist() == [0.0, 0.0, GRAVITY]
    assert record["velocity"][2] == f32(f32(f32(DT) * GRAVITY) - 1.0)
    for _ in range(60):
        record = step(world, record, DT)
    assert int(record["transient_state"]) & GROUNDED == GROUNDED
    assert record["acceleration"].tolist() == [0.0, 0.0, 0.0]
    assert record["contact_plane"].tolist() == [0.0, 0.0, 1.0, 0.0]
    assert outcome(record) == "still"
    assert record["origin"].tolist() == pytest.approx([0.0, 0.0, R], abs=0.0003)


def test_a_wall_stops_a_walker() -> None:
    """It comes to rest in front of the wall, on the ground."""
    rows = body_rows(world_of(floor_and_wall()), [grounded(0.0, velocity=(3, 0, 0))])
    for _ in range(20):
        set_velocity(rows, [(3, 0, 0)])
        step_many(world_of(floor_and_wall()), rows, DT, 1)
    assert 0.9 - R < rows[0]["origin"][0] < 1.0 - R + 0.0002
    assert rows[0]["contact_plane"].tolist() == [0.0, 0.0, 1.0, 0.0]


def bodies() -> list[Body]:
    """Return bodies of every kind."""
    return [
        grounded(0.2, velocity=(3, 1, 0)),
        walker(z=3.0, velocity=(0, 2, 0), acceleration=(0, 0, GRAVITY), omega=(0, 0, 2)),
        grounded(-2, velocity=(1, 1, 0), friction=0.95, has_movement_manager=False),
        walker(state=0x20000 | 0x340, z=1.0, velocity=(5, 0, 0)),
        replace(walker(velocity=(1, 0, 0)), spheres=()),
        walker(transient_state=0, velocity=(1, 0, 0)),
    ]


def test_a_batch_equals_the_single_ones() -> None:
    """Each body moves as if it were alone, tick after tick or all ticks at once."""
    world = world_of(floor_and_wall())
    many = step_many(world, body_rows(world, bodies()), DT, 20)
    for body, row in zip(bodies(), many, strict=True):
        record = step(world, body, DT)
        for _ in range(19):
            record = step(world, record, DT)
        assert record.tobytes() == row.tobytes()
    assert {outcome(row) for row in many} >= {"moved", "nosphere", "inactive"}


def test_time_gates_and_ticks() -> None:
    """Up to a time, ticks are those of retail's gate."""
    world = world_of(floor_and_wall())
    gated = update_many(world, body_rows(world, bodies()), 0.3)
    ticked = step_many(world, step_many(world, body_rows(world, bodies()), 0.2, 1), 0.3 - 0.2, 1)
    for name in ("origin", "rotation", "velocity", "transient_state", "contact_plane"):
        assert np.array_equal(gated[name], ticked[name])
    assert (gated["update_time"] == 0.3).all()
    assert (gated["clock"] == 0.3).all()


def test_a_tick_does_not_change_what_it_was_given() -> None:
    """One body is stepped by value."""
    world = world_of(floor_and_wall())
    first = step(world, grounded(velocity=(1, 0, 0)), DT)
    before = first.tobytes()
    assert step(world, first, DT).tobytes() != before
    assert first.tobytes() == before


def test_what_stands_still_keeps_everything() -> None:
    """Without a wish to move there is no transition: contact and sliding bits stay, only rotation turns."""
    body = walker(z=1.0, transient_state=ACTIVE | 0x1D, omega=(0, 0, 1), sliding_normal=(1, 0, 0))
    record = step(world_of(floor_and_wall()), body, DT)
    assert outcome(record) == "still"
    assert record["transient_state"] == ACTIVE | 0x1D
    assert record["polygons_tested"] == 0
    assert record["rotation"][3] > 0.0


def test_a_hidden_body_does_not_move() -> None:
    """Neither does its velocity."""
    record = step(world_of(floor_and_wall()), walker(z=1.0, velocity=(3, 0, 0), state=0x4400), DT)
    assert outcome(record) == "still"
    assert record["velocity"].tolist() == [3.0, 0.0, 0.0]


def test_a_sled_looks_where_it_goes() -> None:
    """So does what aligns with its path: heading 90 degrees is a quarter of a turn clockwise."""
    for state in (0x800400, 0x100):
        record = step(world_of(floor_and_wall()), walker(z=2.0, velocity=(3, 0, 0), state=state), DT)
        assert record["wanted"][1:5].tolist() == pytest.approx([0.5**0.5, 0, 0, -(0.5**0.5)], abs=1e-6)


def test_a_touched_object_is_remembered() -> None:
    """Unless the body takes no notice."""
    box = Obstacle.solid(floor_and_wall(), Pose(CELL), state=0x10000)
    world = world_of(triangle(z=-20.0), objects=[box])
    for tracks, known in ((True, True), (False, False)):
        record = step(world, walker(0.4, z=1.5, velocity=(9, 0, 0), tracks_objects=tracks), 0.1)
        assert outcome(record) == "moved"
        assert record["num_records"] == known
        assert record["records"][0].tolist() == ([0.0, f32(0.1), 0.0] if known else [0.0, 0.0, 0.0])


def test_a_touched_game_object_may_be_the_one_that_is_told() -> None:
    """It wants to hear of collisions (8), the body does not; without a game object nobody is told."""
    for weenie, reported in ((Weenie(), 1), (None, 0)):
        ball = Obstacle(Pose(CELL, (1.5, 0, 1.5)), state=0x8, spheres=[(0, 0, 0, 1)], weenie=weenie)
        world = world_of(triangle(z=-20.0), objects=[ball])
        record = step(world, walker(0.0, z=1.5, velocity=(9, 0, 0), state=0x400), 0.1)
        assert (outcome(record), record["num_records"], record["reported"]) == ("moved", 1, reported)


def test_a_body_does_not_collide_with_itself() -> None:
    """An obstacle of its own id is the body."""
    ball = Obstacle(Pose(CELL, (1.5, 0, 1.5)), state=0, spheres=[(0, 0, 0, 1)], id=5)
    world = world_of(triangle(z=-20.0), objects=[ball])
    for own, touched in ((5, 0), (6, 1), (0, 1)):
        record = step(world, walker(0.0, z=1.5, velocity=(9, 0, 0), id=own), 0.1)
        assert record["num_records"] == touched


def test_velocities_are_given_in_either_frame() -> None:
    """A wake-up call, and a local velocity in a body that looks back."""
    world = world_of(floor_and_wall())
    back = Pose(CELL, (0, 0, R), (0.0, 0.0, 0.0, 1.0))
    rows = body_rows(world, [replace(walker(transient_state=0), pose=back)] * 2)
    set_local_velocity(rows, [(1, 2, 0), (0, 0, 60)])
    assert rows["velocity"].tolist() == [[-1.0, -2.0, 0.0], [0.0, 0.0, 50.0]]
    assert (rows["transient_state"] == ACTIVE).all()


def test_a_body_may_leave_for_land_that_is_not_in_the_world() -> None:
    """It is lost, and rests; the other bodies move on."""
    world = world_of(floor_and_wall())
    rows = body_rows(world, [grounded(velocity=(1, 0, 0)), grounded(velocity=(1, 0, 0))])
    rows["cell_id"][0] = 0xA9B40001
    step_many(world, rows, DT, 1)
    assert [OUTCOMES[int(number)] for number in rows["outcome"]] == ["lost", "moved"]
    assert rows["cell"].tolist() == [NO_CELL, 0]
    step_many(world, rows, DT, 2)
    assert [OUTCOMES[int(number)] for number in rows["outcome"]] == ["inactive", "moved"]


def test_nothing_to_do() -> None:
    """No bodies, or no ticks, change nothing."""
    world = world_of(floor_and_wall())
    assert len(step_many(world, body_rows(world, []), DT, 5)) == 0
    rows = body_rows(world, bodies())
    before = rows.tobytes()
    assert step_many(world, rows, DT, 0).tobytes() == before


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (replace(walker(), pose=Pose(0xA9B40112)), "body 0, cell: 0xa9b40112 is not in the world"),
        (replace(walker(), spheres=[(0, 0, 0, R)] * 3), "spheres: 3 spheres where at most 2"),
        (replace(walker(), spheres=[(0, 0, 0, 0)]), "the first sphere has no radius"),
        (walker(velocity=(0, 0, np.inf)), "velocity: inf at"),
        (walker(friction=np.nan), "friction: nan at"),
        (replace(walker(), pose=at(np.nan, 0, 0)), "pose|origin"),
    ],
)
def test_bodies_that_cannot_be(body: Body, message: str) -> None:
    """They are refused where they are given, by name."""
    with pytest.raises(ValueError, match=message):
        body_rows(world_of(floor_and_wall()), [body])


def test_ticks_that_cannot_be() -> None:
    """No time, rows of something else, and what the engine does not know."""
    world = world_of(floor_and_wall())
    rows = body_rows(world, [walker()])
    for dt in (0.0, -1.0, np.nan):
        with pytest.raises(QueryError, match="dt"):
            step_many(world, rows, dt, 1)
    with pytest.raises(QueryError, match="now: inf is not a time"):
        update_many(world, rows, np.inf)
    with pytest.raises(QueryError, match=r"not of engine\.body_layout"):
        step_many(world, resolve_many(world, []), DT, 1)
    with pytest.raises(QueryError, match="not contiguous"):
        step_many(world, body_rows(world, [walker()] * 4)[::2], DT, 1)
    rows["transient_state"] = 0x180
    with pytest.raises(QueryError, match="body 0: becoming solid"):
        step_many(world, rows, DT, 1)
    rows["has_parent"] = 1
    rows["state"] = 0x404
    assert step_many(world, rows, DT, 1)["state"] == 0x400
    assert rows["transient_state"] == ACTIVE


def test_elasticity_has_limits() -> None:
    """0 and 0.1; what is between is stored as float32."""
    rows = body_rows(world_of(floor_and_wall()), [walker()] * 4)
    set_elasticity(rows, [-0.5, 0.05, 0.1, 7.0])
    assert rows["elasticity"].tolist() == [0.0, f32(0.05), f32(0.1), f32(0.1)]
    with pytest.raises(QueryError, match="elasticity"):
        set_elasticity(rows, [0.0])
