"""CPhysicsObj, the response: bounces, ticks without movement, reports."""

from __future__ import annotations

import pytest
from oracle_bodies import STANDING, walker
from oracle_worlds import at, vec, xyz

from oracle.arithmetic import f32
from oracle.collision_info import CollisionInfo
from oracle.physics_object import PhysicsObj
from oracle.physics_object_collisions import CollisionRecord
from oracle.physics_state import (
    ETHEREAL_PS,
    FLIGHT_PS,
    GRAVITY_PS,
    IGNORE_COLLISIONS_PS,
    INELASTIC_PS,
    MISSILE_PS,
    REPORT_COLLISIONS_AS_ENVIRONMENT_PS,
    REPORT_COLLISIONS_PS,
    SLEDDING_PS,
    STATIC_PS,
)
from oracle.transient_state import (
    ACTIVE_TS,
    CONTACT_TS,
    STATIONARY_FALL_TS,
    STATIONARY_STOP_TS,
    STATIONARY_STUCK_TS,
    STATIONARY_TS,
)
from oracle.weenie import Weenie

EAST_WALL = (-1.0, 0.0, 0.0)


def hit(
    normal: tuple[float, float, float] | None = EAST_WALL, *, frames: int = 0, environment: int = 0
) -> CollisionInfo:
    """Return what a transition that ran against something holds."""
    ci = CollisionInfo()
    if normal is not None:
        ci.collision_normal_valid = 1
        ci.collision_normal = vec(*normal)
    ci.frames_stationary_fall, ci.collided_with_environment = frames, environment
    return ci


def flying(state: int = GRAVITY_PS, elasticity: float = 0.0625) -> PhysicsObj:
    """Return an object in the air that flies east and down."""
    body = walker(state=state, transient=ACTIVE_TS, velocity=(4.0, 2.0, -1.0))
    body.elasticity = elasticity
    return body


def other(state: int, *, weenie: bool = False, object_id: int = 5) -> PhysicsObj:
    """Return an object that was touched."""
    return PhysicsObj(
        object_id,
        state,
        at(0.0, 0.0, 0.0),
        scale=1.0,
        part_array=None,
        weenie=Weenie() if weenie else None,
    )


class TestBounce:
    """HC-1, HC-5."""

    def test_an_elastic_object_bounces(self) -> None:
        """What went into the wall comes back, times the elasticity; the rest stays."""
        body = flying()
        body.handle_all_collisions(hit(), 0, 0)
        assert xyz(body.m_velocity) == (-0.25, 2.0, -1.0)

    def test_an_inelastic_object_stops(self) -> None:
        """Whichever way it flies."""
        for normal in (EAST_WALL, (1.0, 0.0, 0.0)):
            body = flying(INELASTIC_PS)
            body.handle_all_collisions(hit(normal), 0, 0)
            assert xyz(body.m_velocity) == (0.0, 0.0, 0.0)

    @pytest.mark.parametrize("normal", [(1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.5, -1.0, 0.0), None])
    def test_away_from_the_wall_there_is_no_bounce(self, normal: tuple[float, float, float] | None) -> None:
        """Nor along it, nor without a normal; a zero normal is none."""
        body = flying()
        body.handle_all_collisions(hit(normal), 0, 0)
        assert xyz(body.m_velocity) == (4.0, 2.0, -1.0)

    @pytest.mark.parametrize(
        ("state", "prev_on_walkable", "transient", "x"),
        [
            (0, 1, STANDING, 4.0),
            (SLEDDING_PS, 1, STANDING, -0.25),
            (0, 0, STANDING, -0.25),
            (0, 1, CONTACT_TS, -0.25),
        ],
    )
    def test_what_stays_on_the_ground_does_not_bounce(
        self, state: int, prev_on_walkable: int, transient: int, x: float
    ) -> None:
        """HC-1: on a walkable before and after, and not sledding."""
        body = flying(state)
        body.transient_state = transient
        body.handle_all_collisions(hit(), 1, prev_on_walkable)
        assert body.m_velocity.x == x

    def test_the_stores_of_a_bounce(self) -> None:
        """Of x one, of y and z two: the products are stored first."""
        body = flying(elasticity=f32(0.05))
        n = vec(-0.6, -0.48, 0.64)
        ci = hit(xyz(n))
        body.handle_all_collisions(ci, 0, 0)
        d = (-1.0 * n.z + 2.0 * n.y) + n.x * 4.0
        e = -(d * (f32(0.05) + 1.0))
        assert xyz(body.m_velocity) == (
            f32(e * n.x + 4.0),
            f32(f32(e * n.y) + 2.0),
            f32(f32(e * n.z) + -1.0),
        )


class TestStationary:
    """HC-5, HC-6."""

    @pytest.mark.parametrize(
        ("frames", "before", "after", "x"),
        [
            (0, STATIONARY_TS, 0, -0.25),
            (1, 0, STATIONARY_FALL_TS, -0.25),
            (2, STATIONARY_FALL_TS, STATIONARY_FALL_TS | STATIONARY_STOP_TS, 0.0),
            (3, STATIONARY_FALL_TS | STATIONARY_STOP_TS, 0, 0.0),
            (4, 0, STATIONARY_STUCK_TS, 0.0),
        ],
    )
    def test_ticks_without_movement(self, frames: int, before: int, after: int, x: float) -> None:
        """Bits are added; the second and third tick stop the object, the third forgets the count."""
        body = flying()
        body.transient_state = ACTIVE_TS | before
        body.handle_all_collisions(hit(frames=frames), 0, 0)
        assert (body.transient_state, body.m_velocity.x) == (ACTIVE_TS | after, x)


class TestEnvironment:
    """HC-4."""

    @pytest.mark.parametrize(
        ("prev_on_walkable", "transient", "environment", "latched"),
        [(0, ACTIVE_TS, 0, 0), (0, ACTIVE_TS, 1, 1), (0, STANDING, 0, 1), (1, STANDING, 0, 0)],
    )
    def test_what_counts_as_hitting_it(
        self, prev_on_walkable: int, transient: int, environment: int, latched: int
    ) -> None:
        """A collision with it, or landing on a walkable."""
        body = walker(state=REPORT_COLLISIONS_PS, transient=transient, weenie=Weenie())
        result = body.handle_all_collisions(hit(None, environment=environment), 0, prev_on_walkable)
        assert (result, body.colliding_with_environment) == (latched, latched)

    @pytest.mark.parametrize("environment", [0, 1])
    def test_it_is_reported_once(self, environment: int) -> None:
        """While the latch is set it only follows the collisions."""
        body = walker(state=REPORT_COLLISIONS_PS, weenie=Weenie())
        body.colliding_with_environment = 1
        assert body.handle_all_collisions(hit(None, environment=environment), 1, 0) == 0
        assert body.colliding_with_environment == environment

    @pytest.mark.parametrize(("state", "weenie"), [(REPORT_COLLISIONS_PS, False), (0, True)])
    def test_nobody_may_listen(self, state: int, weenie: bool) -> None:
        """Then nothing is reported, but the latch is set all the same."""
        body = walker(state=state, weenie=Weenie() if weenie else None)
        assert body.handle_all_collisions(hit(None, environment=1), 0, 0) == 0
        assert body.colliding_with_environment == 1

    def test_a_missile_becomes_an_ordinary_object(self) -> None:
        """06 7: at the first report only."""
        body = walker(state=FLIGHT_PS | GRAVITY_PS, transient=ACTIVE_TS)
        body.handle_all_collisions(hit(None, environment=1), 0, 0)
        assert body.state == GRAVITY_PS
        body.state = FLIGHT_PS
        body.handle_all_collisions(hit(None, environment=1), 0, 0)
        assert body.state == FLIGHT_PS


class TestObjects:
    """HC-2, HC-3 and the reports."""

    @pytest.mark.parametrize(
        ("own", "own_weenie", "state", "weenie", "reported"),
        [
            (REPORT_COLLISIONS_PS, True, 0, False, 1),
            (REPORT_COLLISIONS_PS, False, 0, False, 0),
            (REPORT_COLLISIONS_PS, True, IGNORE_COLLISIONS_PS, False, 0),
            (0, False, REPORT_COLLISIONS_PS, True, 1),
            (0, False, REPORT_COLLISIONS_PS, False, 0),
            (IGNORE_COLLISIONS_PS, False, REPORT_COLLISIONS_PS, True, 0),
            (0, False, REPORT_COLLISIONS_PS | IGNORE_COLLISIONS_PS, True, 1),
        ],
    )
    def test_who_is_told(self, own: int, own_weenie: bool, state: int, weenie: bool, reported: int) -> None:
        """Either side, if it reports, has a game object, and the opposite does not ignore."""
        body = walker(state=own, transient=ACTIVE_TS, weenie=Weenie() if own_weenie else None)
        ci = hit(None)
        ci.collide_object.append(other(state, weenie=weenie))
        assert body.handle_all_collisions(ci, 0, 0) == reported
        assert body.colliding_with_environment == 0

    def test_one_report_is_enough(self) -> None:
        """HC-2, HC-4: the other object's, although nobody hears of the environment."""
        body, ci = walker(state=0, transient=ACTIVE_TS), hit(None, environment=1)
        ci.collide_object.append(other(REPORT_COLLISIONS_PS, weenie=True))
        ci.collide_object.append(other(0, object_id=6))
        assert body.handle_all_collisions(ci, 0, 0) == 1

    @pytest.mark.parametrize("state", [STATIC_PS, REPORT_COLLISIONS_AS_ENVIRONMENT_PS])
    def test_what_is_environment(self, state: int) -> None:
        """Statics, and what says so; a static is not remembered."""
        body = walker(state=REPORT_COLLISIONS_PS, weenie=Weenie())
        assert body.track_object_collision(other(state), 0) == 1
        assert body.colliding_with_environment == 1
        assert list(body.collision_table) == ([] if state == STATIC_PS else [5])

    @pytest.mark.parametrize(("state", "left"), [(0, 0), (IGNORE_COLLISIONS_PS, MISSILE_PS)])
    def test_a_missile_that_hits_an_object(self, state: int, left: int) -> None:
        """It becomes ordinary, unless the other ignores collisions."""
        body = walker(state=MISSILE_PS, transient=ACTIVE_TS)
        body.track_object_collision(other(state), 0)
        assert body.state == left

    def test_an_object_is_reported_once(self) -> None:
        """While it is remembered; each touch is remembered anew."""
        body = walker(state=REPORT_COLLISIONS_PS, weenie=Weenie())
        assert [body.track_object_collision(other(0), 0) for _ in range(2)] == [1, 0]
        body.world.clock.curr_time = 0.5
        assert body.track_object_collision(other(ETHEREAL_PS), 0) == 0
        assert body.collision_table == {5: CollisionRecord(0.5, ETHEREAL_PS)}
        assert body.track_object_collision(other(0, object_id=6), 0) == 1

    @pytest.mark.parametrize(
        ("age", "ethereal", "kept"),
        [(1.0, 0, True), (1.0 + 2.0**-52, 0, False), (0.0, 4, True), (2.0**-52, 4, False)],
    )
    def test_memory_ends(self, age: float, ethereal: int, kept: bool) -> None:
        """HC-3: after a second, of ethereal objects with the next tick."""
        body = walker()
        body.collision_table[5] = CollisionRecord(0.0, ethereal)
        body.world.clock.curr_time = age
        body.handle_all_collisions(hit(None), 1, 1)
        assert (5 in body.collision_table) is kept
