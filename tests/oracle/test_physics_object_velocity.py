"""CPhysicsObj, velocity: both sides of every threshold of friction, limits and stopping."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from oracle_bodies import ORDINARY, STANDING, walker
from oracle_worlds import vec, xyz

from oracle.arithmetic import f32
from oracle.constants import DEFAULT_FRICTION, EPS, GRAVITY, MAX_ELASTICITY, SLED_FRICTION, SLED_SLOPE
from oracle.frame import Frame
from oracle.movement import MovementManager
from oracle.physics_state import GRAVITY_PS, SLEDDING_PS, STATIC_PS
from oracle.plane import Plane
from oracle.transient_state import ACTIVE_TS, CONTACT_TS, ON_WALKABLE_TS

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.physics_object import PhysicsObj

    Step = Callable[[float, int], float]

HALF = 0.5


def moved(body: PhysicsObj, quantum: float = HALF) -> tuple[float, float, float]:
    """Return how far the velocity carries an object."""
    frame = Frame()
    body.update_physics_internal(quantum, frame)
    return xyz(frame.origin)


class TestIntegration:
    """PH-1…8."""

    def test_half_the_acceleration_moves_and_all_of_it_accelerates(self) -> None:
        """PH-6, PH-7: x = v t + a t t / 2, then v + a t."""
        body = walker(transient=ACTIVE_TS, velocity=(1.0, 2.0, 4.0))
        body.m_acceleration = vec(8.0, -8.0, -16.0)
        assert moved(body) == (0.5 + 1.0, 1.0 - 1.0, 2.0 - 2.0)
        assert xyz(body.m_velocity) == (5.0, -2.0, -4.0)

    def test_without_velocity_nothing_moves(self) -> None:
        """PH-2, PH-7: gravity gives speed in the first tick and movement in the second."""
        body = walker(transient=ACTIVE_TS)
        body.m_acceleration = vec(0.0, 0.0, GRAVITY)
        assert moved(body) == (0.0, 0.0, 0.0)
        assert xyz(body.m_velocity) == (0.0, 0.0, GRAVITY / 2.0)
        assert moved(body)[2] < 0.0

    @pytest.mark.parametrize(
        ("transient", "manager", "left"),
        [(STANDING, False, STANDING & ~ACTIVE_TS), (STANDING, True, STANDING), (ACTIVE_TS, False, ACTIVE_TS)],
    )
    def test_what_stands_still_comes_to_rest(self, transient: int, manager: bool, left: int) -> None:
        """PH-2: on a walkable, unless it is steered."""
        body = walker(transient=transient)
        body.movement_manager = MovementManager() if manager else None
        moved(body)
        assert body.transient_state == left

    def test_the_highest_speed(self, next32: Step) -> None:
        """PH-3: 50 metres per second are allowed, one bit more is brought back to 50."""
        for speed in (50.0, next32(50.0, 1), 400.0):
            body = walker(transient=ACTIVE_TS, velocity=(0.0, speed, 0.0))
            assert moved(body) == (0.0, 25.0, 0.0)
            assert xyz(body.m_velocity) == (0.0, 50.0, 0.0)

    def test_the_limit_rounds_the_direction_first(self) -> None:
        """PH-3: 50 times the float32 nearest to 0.6 and 0.8."""
        body = walker(transient=ACTIVE_TS, velocity=(60.0, 80.0, 0.0))
        moved(body)
        assert xyz(body.m_velocity) == (f32(50.0 * f32(0.6)), f32(50.0 * f32(0.8)), 0.0)
        assert body.m_velocity.x == 30.000001907348633

    @pytest.mark.parametrize("speed", [0.0625, 0.25])
    def test_the_slow_stop(self, speed: float) -> None:
        """PH-5: up to 0.25 metres per second."""
        body = walker(velocity=(speed, 0.0, 0.0))
        assert moved(body) == (0.0, 0.0, 0.0)
        assert xyz(body.m_velocity) == (0.0, 0.0, 0.0)

    def test_the_exact_speed_below_which_things_stop(self, next32: Step) -> None:
        """PH-5: squared speed less than 0.0625 + EPS, compared unrounded."""
        speed = 0.2503
        speed = f32(speed)
        while f32(speed * speed) - 0.0625 < EPS:
            speed = next32(speed, 1)
        going, stopping = (walker(velocity=(v, 0.0, 0.0)) for v in (speed, next32(speed, -1)))
        moved(going)
        moved(stopping)
        assert (going.m_velocity.x, stopping.m_velocity.x) == (speed, 0.0)
        assert 0.2503 < speed < 0.2505

    def test_stopping_looks_at_the_speed_before_friction(self) -> None:
        """PH-4, PH-5: what friction slows below the limit goes on for this tick."""
        body = walker(velocity=(0.5, 0.0, 0.0))
        body.friction = 0.9375
        moved(body)
        assert xyz(body.m_velocity) == (0.125, 0.0, 0.0)

    def test_stopping_comes_before_gravity(self) -> None:
        """PH-5, PH-7: a slow object in the air stops and then falls."""
        body = walker(transient=ACTIVE_TS, velocity=(0.125, 0.0, 0.0))
        body.m_acceleration = vec(0.0, 0.0, -8.0)
        assert moved(body) == (0.0, 0.0, -1.0)
        assert xyz(body.m_velocity) == (0.0, 0.0, -4.0)

    def test_spinning(self) -> None:
        """PH-8: a quarter turn about z."""
        body, frame = walker(transient=ACTIVE_TS), Frame()
        body.m_omega = vec(0.0, 0.0, f32(math.pi))
        body.update_physics_internal(HALF, frame)
        assert (frame.qw, frame.qz) == (0.7071067690849304, 0.7071067690849304)


def slowed(body: PhysicsObj, v2: float = 9.0) -> tuple[float, float, float]:
    """Return the velocity after half a second of friction."""
    body.calc_friction(HALF, v2)
    return xyz(body.m_velocity)


class TestFriction:
    """CF-1…5."""

    def test_there_is_none_in_the_air(self) -> None:
        """CF-1: contact alone is not enough."""
        body = walker(transient=ACTIVE_TS | CONTACT_TS, velocity=(1.0, 0.0, -1.0))
        assert slowed(body) == (1.0, 0.0, -1.0)

    def test_it_takes_away_a_fraction_in_a_second(self) -> None:
        """CF-3, CF-5: of 15/16 a second, half a second leaves a quarter; what goes into the plane is lost."""
        body = walker(velocity=(4.0, -8.0, -2.0))
        body.friction = 0.9375
        assert slowed(body) == (1.0, -2.0, 0.0)

    def test_the_speed_from_which_an_object_leaves_the_plane(self, next32: Step) -> None:
        """CF-2: 0.25 metres per second away from the plane is free, one bit less is not."""
        free = walker(velocity=(4.0, 0.0, 0.25))
        held = walker(velocity=(4.0, 0.0, next32(0.25, -1)))
        free.friction = held.friction = 0.75
        assert slowed(free) == (4.0, 0.0, 0.25)
        assert slowed(held) == (2.0, 0.0, 0.0)

    def test_the_plane_takes_its_part_of_each_axis(self) -> None:
        """CF-3: all three with the speed that the object had into the plane."""
        body = walker(velocity=(-1.0, 2.0, 0.0))
        body.contact_plane = Plane(vec(0.5, 0.0, 0.5), 0.0)
        assert slowed(body) == (-0.75, 2.0, 0.25)

    @pytest.mark.parametrize(
        ("v2", "steps", "kept"),
        [
            (1.5625, -1, 0.0),
            (1.5625, 0, 1.0),
            (6.25, -1, 1.0),
            (6.25, 0, f32(4.0 * math.sqrt(1.0 - SLED_FRICTION)) / 4.0),
        ],
    )
    def test_a_sled_on_a_slope(self, v2: float, steps: int, kept: float, next32: Step) -> None:
        """CF-4: a slow one stops, a fast one glides, in between its own friction counts, here none."""
        body = walker(state=ORDINARY | SLEDDING_PS, velocity=(4.0, 0.0, 0.0))
        body.contact_plane = Plane(vec(0.0, 0.5, 0.5), 0.0)
        assert slowed(body, next32(v2, steps))[0] == 4.0 * kept

    def test_the_slope_from_which_a_sled_glides(self, next32: Step) -> None:
        """CF-4: ten degrees, compared unrounded; on flatter ground its own friction counts."""
        limit = math.cos(SLED_SLOPE)
        flat = f32(limit) if f32(limit) >= limit else next32(f32(limit), 1)
        kept = []
        for z in (flat, next32(flat, -1)):
            body = walker(state=ORDINARY | SLEDDING_PS, velocity=(4.0, 0.0, 0.0))
            body.contact_plane = Plane(vec(0.0, 0.0, z), 0.0)
            kept.append(slowed(body)[0])
        assert kept == [4.0, f32(4.0 * math.sqrt(1.0 - SLED_FRICTION))]

    def test_full_friction_stops_at_once(self) -> None:
        """CF-5: zero to the power of any time is zero."""
        body = walker(velocity=(4.0, 0.0, 0.0))
        body.friction = 1.0
        assert slowed(body) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("transient", "state", "z", "spin"),
    [
        (CONTACT_TS | ON_WALKABLE_TS, GRAVITY_PS, 0.0, 0.0),
        (CONTACT_TS | ON_WALKABLE_TS, GRAVITY_PS | SLEDDING_PS, GRAVITY, 3.0),
        (CONTACT_TS, GRAVITY_PS, GRAVITY, 3.0),
        (ON_WALKABLE_TS, GRAVITY_PS, GRAVITY, 3.0),
        (0, 0, 0.0, 3.0),
    ],
)
def test_acceleration(transient: int, state: int, z: float, spin: float) -> None:
    """06 5: gravity unless the object stands; what stands also stops spinning."""
    body = walker(transient=transient, state=state)
    body.m_acceleration, body.m_omega = vec(1.0, 1.0, 1.0), vec(0.0, 0.0, 3.0)
    body.calc_acceleration()
    assert (xyz(body.m_acceleration), body.m_omega.z) == ((0.0, 0.0, z), spin)


class TestSetting:
    """SV-1, SV-2."""

    def test_a_velocity_within_the_tolerance_is_not_taken(self, next32: Step) -> None:
        """SV-1: EPS on each axis is the same velocity, one bit more on one axis is another."""
        body = walker()
        body.set_velocity(vec(EPS, -EPS, EPS), 0)
        assert (xyz(body.m_velocity), body.jumped_this_frame) == ((0.0, 0.0, 0.0), 0)
        more = next32(EPS, 1)
        body.set_velocity(vec(0.0, 0.0, more), 0)
        assert (xyz(body.m_velocity), body.jumped_this_frame) == ((0.0, 0.0, more), 1)

    def test_the_highest_speed(self) -> None:
        """SV-1: 50 is allowed; more is brought down, direction rounded first."""
        body = walker()
        body.set_velocity(vec(30.0, -40.0, 0.0), 0)
        assert xyz(body.m_velocity) == (30.0, -40.0, 0.0)
        body.set_velocity(vec(60.0, -80.0, 0.0), 0)
        assert xyz(body.m_velocity) == (30.000001907348633, f32(-50.0 * f32(0.8)), 0.0)

    @pytest.mark.parametrize(
        ("state", "transient", "after", "time"),
        [
            (0, 0, ACTIVE_TS, 7.0),
            (0, CONTACT_TS, CONTACT_TS | ACTIVE_TS, 7.0),
            (0, ACTIVE_TS, ACTIVE_TS, 5.0),
            (STATIC_PS, 0, 0, 5.0),
        ],
    )
    def test_a_velocity_wakes_up(self, state: int, transient: int, after: int, time: float) -> None:
        """SV-2: even the velocity it has; the time begins now unless it was awake; statics sleep on."""
        body = walker(state=state, transient=transient)
        body.update_time, body.world.clock.cur_time = 5.0, 7.0
        body.set_velocity(vec(0.0, 0.0, 0.0), 0)
        assert (body.transient_state, body.update_time) == (after, time)

    def test_a_local_velocity_is_turned(self) -> None:
        """06 5: of an object that looks south, forward is south and right is west."""
        body = walker()
        body.m_position.frame.set_rotate(0.0, 0.0, 0.0, 1.0)
        body.set_local_velocity(vec(2.0, 4.0, 1.0), 0)
        assert xyz(body.m_velocity) == (-2.0, -4.0, 1.0)


@pytest.mark.parametrize(
    ("asked", "kept"),
    [(-0.5, 0.0), (0.07, f32(0.07)), (MAX_ELASTICITY, MAX_ELASTICITY), (0.5, MAX_ELASTICITY)],
)
def test_elasticity_has_limits(asked: float, kept: float) -> None:
    """06 1: from nothing to a tenth."""
    body = walker()
    body.set_elasticity(asked)
    assert (body.elasticity, DEFAULT_FRICTION) == (kept, f32(0.95))
