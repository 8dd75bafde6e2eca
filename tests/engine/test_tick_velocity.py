"""Gravity, friction and limits of the velocity: every number as the specification rounds it."""

from __future__ import annotations

import math

import pytest
from engine_bodies import ACTIVE, GRAVITY, GROUNDED, f32, grounded, row_of, walker
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.body_layout import B_WANTED
from engine.kernels.frame_motion import frame_grotate
from engine.kernels.tick import update_position_internal
from engine.kernels.tick_contact import clear_transient_states, set_on_walkable
from engine.kernels.tick_velocity import calc_acceleration, calc_friction, set_local_velocity, set_velocity

SLED = 0x400000 | 0x800000 | 0x400
QUARTER = 0.25

speeds = st.floats(-50.0, 50.0, width=32)
quanta = st.floats(1.0 / 32.0, 0.1875, width=32)


def test_a_fall_starts_a_tick_after_its_velocity() -> None:
    """Without velocity nothing moves, whatever the acceleration; the velocity grows all the same."""
    record, row = row_of(walker(z=2.0, acceleration=(0, 0, GRAVITY)))
    update_position_internal(row, QUARTER)
    assert record["wanted"][14:].tolist() == [0.0, 0.0, 2.0]
    assert record["velocity"].tolist() == [0.0, 0.0, f32(QUARTER * GRAVITY)]
    update_position_internal(row, QUARTER)
    fallen = f32(f32(QUARTER * record["velocity"][2] / 2.0) + f32(GRAVITY * 0.5) * QUARTER * QUARTER)
    assert record["wanted"][16] == f32(fallen + 2.0)


def test_what_is_slower_than_a_quarter_of_a_metre_per_second_stops() -> None:
    """The limit is tested before gravity is added, with a tolerance of EPS on its square."""
    for speed, after in ((0.25, 0.0), (0.2503, 0.0), (0.2505, f32(0.2505))):
        record, row = row_of(walker(velocity=(speed, 0, 0)))
        update_position_internal(row, QUARTER)
        assert record["velocity"][0] == after


def test_speed_is_limited_in_two_roundings() -> None:
    """50 metres per second, from components that are rounded in between."""
    record, row = row_of(walker(velocity=(60, 70, 0)))
    update_position_internal(row, QUARTER)
    length = math.sqrt(60.0 * 60.0 + 70.0 * 70.0)
    expected = [f32(50.0 * f32(1.0 / length * 60.0)), f32(50.0 * f32(1.0 / length * 70.0)), 0.0]
    assert record["velocity"].tolist() == expected


def test_an_unsteered_body_that_stands_goes_to_sleep() -> None:
    """Without velocity on a walkable it is not simulated any more, unless something steers it."""
    for steered, after in ((False, GROUNDED & ~ACTIVE), (True, GROUNDED)):
        record, row = row_of(grounded(has_movement_manager=steered))
        update_position_internal(row, QUARTER)
        assert record["transient_state"] == after


@settings(deadline=None)
@given(x=speeds, y=speeds, q=quanta, friction=st.floats(0.0, 1.0, width=32))
def test_friction_is_the_mathematical_power(x: float, y: float, q: float, friction: float) -> None:
    """The compiled power has the bits of the C library's, which is what the oracle uses."""
    record, row = row_of(grounded(velocity=(x, y, 0), friction=friction))
    calc_friction(row, q, x * x + y * y)
    kept = math.pow(1.0 - record["friction"], q)
    assert record["velocity"].tolist() == [f32(kept * x), f32(kept * y), 0.0]


def test_friction_needs_ground_and_a_velocity_that_does_not_leave_it() -> None:
    """In the air, or upwards faster than 0.25, nothing is lost; into the ground all of that part is."""
    for body, after in (
        (walker(velocity=(1, 0, 0), friction=1.0), [1.0, 0.0, 0.0]),
        (grounded(velocity=(1, 0, 0.25), friction=1.0), [1.0, 0.0, 0.25]),
        (grounded(velocity=(1, 0, -3), friction=0.0), [1.0, 0.0, 0.0]),
        (grounded(velocity=(1, 0, 0.125), friction=1.0), [0.0, 0.0, 0.0]),
    ):
        record, row = row_of(body)
        calc_friction(row, QUARTER, 1.0)
        assert record["velocity"].tolist() == after


@pytest.mark.parametrize(
    ("v2", "normal_z", "friction"),
    [(1.5, 1.0, 1.0), (1.5625, 0.5, 0.5), (6.25, 0.5, f32(0.2)), (6.25, 0.99, 0.5), (100.0, 0.98, f32(0.2))],
)
def test_a_sled_brakes_by_speed_and_slope(v2: float, normal_z: float, friction: float) -> None:
    """Slow it stops, fast and on a slope steeper than ten degrees it glides."""
    body = grounded(state=SLED, friction=0.5, velocity=(0, 2, 0), contact_plane=(0.1, 0, normal_z, 0))
    record, row = row_of(body)
    calc_friction(row, QUARTER, v2)
    assert record["velocity"][1] == f32(math.pow(1.0 - friction, QUARTER) * 2.0)


def test_standing_still_means_no_acceleration_and_no_spin() -> None:
    """On the ground both are zero; in the air gravity pulls, if there is any; a sled is never at rest."""
    for body, pull, spin in (
        (grounded(omega=(0, 0, 1)), 0.0, 0.0),
        (grounded(omega=(0, 0, 1), state=SLED), GRAVITY, 1.0),
        (walker(omega=(0, 0, 1)), GRAVITY, 1.0),
        (walker(omega=(0, 0, 1), state=0), 0.0, 1.0),
    ):
        record, row = row_of(body)
        calc_acceleration(row)
        assert record["acceleration"].tolist() == [0.0, 0.0, pull]
        assert record["omega"].tolist() == [0.0, 0.0, spin]


def test_a_velocity_within_eps_is_not_taken_but_wakes_up() -> None:
    """The difference has to be larger than EPS on some axis; a sleeper starts at the present time."""
    record, row = row_of(walker(velocity=(1, 0, 0), transient_state=0))
    record["clock"] = 7.5
    set_velocity(row, 1.0001, 0.0001, 0.0)
    assert record["velocity"].tolist() == [1.0, 0.0, 0.0]
    assert (record["jumped_this_frame"], record["transient_state"]) == (0, ACTIVE)
    assert record["update_time"] == 7.5
    set_velocity(row, 1.0, 0.0, f32(0.00021))
    assert record["velocity"].tolist() == [1.0, 0.0, f32(0.00021)]
    assert record["jumped_this_frame"] == 1


def test_a_static_body_does_not_wake_up() -> None:
    """It takes the velocity, and stays where it is."""
    record, row = row_of(walker(state=1, transient_state=0))
    set_velocity(row, 30.0, 40.0, 0.0)
    assert record["transient_state"] == 0
    assert record["velocity"].tolist() == [30.0, 40.0, 0.0]


def test_a_local_velocity_is_turned_with_the_body() -> None:
    """Half a turn about z reverses x and y."""
    record, row = row_of(walker())
    record["matrix"] = [-1, 0, 0, 0, -1, 0, 0, 0, 1]
    set_local_velocity(row, 3.0, 4.0, 5.0)
    assert record["velocity"].tolist() == [-3.0, -4.0, 5.0]


@settings(deadline=None)
@given(angle=st.floats(0.015625, 3.0, width=32))
def test_a_turn_about_the_vertical(angle: float) -> None:
    """Sine and cosine have the bits of the C library's; the result is of unit length once more."""
    record, row = row_of(walker())
    record["wanted"][1:5] = 1.0, 0.0, 0.0, 0.0
    frame_grotate(row, B_WANTED, 0.0, 0.0, angle)
    half = math.sqrt(angle * angle) * 0.5
    inverse = f32(1.0 / math.sqrt(angle * angle))
    w, z = f32(math.cos(half)), f32((math.sin(half) * inverse) * angle)
    scale = 1.0 / math.sqrt(w * w + z * z)
    assert record["wanted"][1:5].tolist() == [f32(w * scale), 0.0, 0.0, f32(z * scale)]


def test_leaving_the_ground_brings_gravity_back() -> None:
    """The walkable bit decides; clearing everything leaves planes and normals as they are."""
    record, row = row_of(grounded(sliding_normal=(1, 0, 0)))
    set_on_walkable(row, False)
    assert record["transient_state"] == GROUNDED & ~0x2
    assert record["acceleration"][2] == GRAVITY
    record["transient_state"] = 0x1FF
    clear_transient_states(row)
    assert record["transient_state"] == 0
    assert record["contact_plane"].tolist() == [0.0, 0.0, 1.0, 0.0]
    assert record["sliding_normal"].tolist() == [1.0, 0.0, 0.0]
