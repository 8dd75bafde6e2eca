"""CPhysicsObj, the tick: how time is split, and which ticks reach a transition."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from oracle_bodies import ORDINARY, STANDING, Ticking, walker
from oracle_worlds import CELL, WALL, at, vec, world_of, xyz

from oracle.arithmetic import f32
from oracle.constants import ACTIVE_DISTANCE, EPS, HUGE_QUANTUM, MAX_QUANTUM, MIN_QUANTUM
from oracle.errors import NotPortedError
from oracle.frame import Frame
from oracle.movement import MovementManager
from oracle.physics_part import PartArray, Setup
from oracle.physics_state import ALIGNPATH_PS, ETHEREAL_PS, FROZEN_PS, HIDDEN_PS, SLEDDING_PS, STATIC_PS
from oracle.transient_state import ACTIVE_TS, CHECK_ETHEREAL_TS, CONTACT_TS, SLIDING_TS
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.physics_object import PhysicsObj

    Step = Callable[[float, int], float]

LONGEST = f32(MAX_QUANTUM)
EIGHTH = 0.125


def updated(elapsed: float, *, state: int = 0, transient: int = ACTIVE_TS) -> Ticking:
    """Return an object after `elapsed` seconds, simulated up to 0 before."""
    world = World()
    world.clock.cur_time = elapsed
    body = Ticking(world)
    body.state, body.transient_state = state, transient
    body.update_object()
    return body


class TestGates:
    """QT-1…9."""

    def test_time_up_to_the_tolerance_is_dropped(self) -> None:
        """QT-4: EPS itself is dropped, one bit more is a tick."""
        assert (updated(EPS).quanta, updated(EPS).update_time) == ([], EPS)
        longer = math.nextafter(EPS, 1.0)
        assert updated(longer).quanta == [EPS]

    def test_a_short_time_is_one_tick(self) -> None:
        """QT-6: no lower limit; 0.2 is still one tick."""
        assert updated(0.001).quanta == [f32(0.001)]
        assert (updated(MAX_QUANTUM).quanta, updated(MAX_QUANTUM).update_time) == ([LONGEST], MAX_QUANTUM)

    def test_a_long_time_is_split(self) -> None:
        """QT-7, QT-8: ticks of 0.2, then a remainder that is long enough."""
        body = updated(0.45)
        rest = 0.45 - MAX_QUANTUM - MAX_QUANTUM
        assert body.quanta == [LONGEST, LONGEST, f32(rest)]
        assert body.update_time == MAX_QUANTUM + MAX_QUANTUM + rest

    @pytest.mark.parametrize(("steps", "ticks"), [(0, 1), (1, 2)])
    def test_a_remainder_must_exceed_the_least_quantum(self, steps: int, ticks: int) -> None:
        """QT-7: exactly MIN_QUANTUM is left for the next gate, one bit more is a tick."""
        elapsed = MAX_QUANTUM + MIN_QUANTUM
        while elapsed - MAX_QUANTUM > MIN_QUANTUM:
            elapsed = math.nextafter(elapsed, 0.0)
        for _ in range(steps):
            elapsed = math.nextafter(elapsed, 1.0)
        body = updated(elapsed)
        assert len(body.quanta) == ticks
        assert body.update_time == (MAX_QUANTUM if ticks == 1 else MAX_QUANTUM + (elapsed - MAX_QUANTUM))

    def test_just_more_than_a_tick(self) -> None:
        """QT-7, QT-9: one tick; what is left stays."""
        body = updated(math.nextafter(MAX_QUANTUM, 1.0))
        assert (body.quanta, body.update_time) == ([LONGEST], MAX_QUANTUM)

    def test_a_huge_time_is_dropped(self) -> None:
        """QT-5: 2.0 is simulated, one bit more is not."""
        assert len(updated(HUGE_QUANTUM).quanta) == 10
        dropped = updated(math.nextafter(HUGE_QUANTUM, 3.0))
        assert (dropped.quanta, dropped.update_time) == ([], math.nextafter(HUGE_QUANTUM, 3.0))

    def test_the_clock_is_at_the_end_of_each_tick(self) -> None:
        """QT-3, QT-7, QT-8: the simulated time advances before the tick."""
        body = updated(0.25)
        assert body.world.clock.curr_time == MAX_QUANTUM + (0.25 - MAX_QUANTUM)

    def test_what_is_not_simulated(self) -> None:
        """QT-1: frozen, attached or in no cell: inactive, and the time stays."""
        assert updated(1.0, state=FROZEN_PS).transient_state == 0
        body = Ticking(World())
        body.world.clock.cur_time = 1.0
        for parent, cell in ((Ticking(World()), body.cell), (None, None)):
            body.parent, body.cell, body.transient_state = parent, cell, ACTIVE_TS | CONTACT_TS
            body.update_object()
            assert (body.transient_state, body.update_time, body.quanta) == (CONTACT_TS, 0.0, [])

    @pytest.mark.parametrize(
        ("x", "maintained", "transient"),
        [(ACTIVE_DISTANCE, 1, ACTIVE_TS), (97.0, 0, ACTIVE_TS), (97.0, 1, 0), (-97.0, 1, 0)],
    )
    def test_far_from_the_player_objects_rest(self, x: float, maintained: int, transient: int) -> None:
        """QT-2: beyond 96 metres, if objects are maintained; the time is used up nevertheless."""
        world = World()
        world.player, world.maintainer_active, world.clock.cur_time = Ticking(world), maintained, 0.125
        body = Ticking(world)
        body.m_position.assign(at(x, 0.0, 0.0))
        body.transient_state = ACTIVE_TS
        body.update_object()
        assert (body.transient_state, body.player_distance) == (transient, abs(x))
        assert (xyz(body.player_vector), body.quanta) == ((x, 0.0, 0.0), [0.125])

    def test_the_distance_is_stored(self) -> None:
        """QT-2: as float32."""
        world = World()
        world.player, body = Ticking(world), Ticking(world)
        body.m_position.assign(at(1.0, 1.0, 0.0))
        body.update_object()
        assert body.player_distance == f32(math.sqrt(2.0))

    def test_near_the_player_objects_wake_up(self) -> None:
        """QT-2: an object that was not active begins now; a static one stays as it is."""
        world = World()
        world.player, world.clock.cur_time = Ticking(world), 0.125
        body, static = Ticking(world), Ticking(world)
        static.state = STATIC_PS
        body.update_object()
        static.update_object()
        assert (body.transient_state, body.update_time, body.quanta) == (ACTIVE_TS, 0.125, [])
        assert (static.transient_state, static.quanta) == (0, [0.125])

    def test_without_a_player_activity_stays(self) -> None:
        """QT-2."""
        assert updated(0.125, transient=0).transient_state == 0


class TestTick:
    """UO-1…11 on a floor."""

    def test_a_step_on_the_floor(self) -> None:
        """UO-7…11: the object moves, the plane is found again, the velocity is measured."""
        body = walker(velocity=(1.0, 0.0, 0.0))
        body.update_object_internal(EIGHTH)
        assert xyz(body.m_position.frame.origin) == (0.125, 0.0, 0.0)
        assert xyz(body.cached_velocity) == (1.0, 0.0, 0.0)
        assert (body.transient_state, xyz(body.contact_plane.N)) == (STANDING, (0.0, 0.0, 1.0))

    def test_measuring_the_velocity_rounds_the_reciprocal_for_y_and_z(self) -> None:
        """UO-10: x is multiplied by 1/quantum as it is."""
        body = walker(transient=ACTIVE_TS, velocity=(1.5, 1.5, 0.0), state=0, height=3.0)
        q = f32(0.1)
        body.update_object_internal(q)
        moved = body.m_position.frame.origin.x
        assert xyz(body.cached_velocity) == (f32(1.0 / q * moved), f32(f32(1.0 / q) * moved), 0.0)

    @pytest.mark.parametrize(("steps", "x"), [(0, 0.0), (1, f32(2.0 * EPS))])
    def test_a_step_within_the_tolerance_is_none(self, steps: int, x: float, next32: Step) -> None:
        """UO-5: EPS on an axis is standing still and changes nothing; one bit more is a step."""
        body = walker(velocity=(1.0, 0.0, 0.0))
        body.transient_state |= SLIDING_TS
        q = next32(EPS, steps)
        body.cached_velocity = vec(1.0, 2.0, 3.0)
        body.update_object_internal(q)
        assert (body.m_position.frame.origin.x == 0.0) is (x == 0.0)
        assert bool(body.transient_state & SLIDING_TS) is (x == 0.0)
        assert (body.cached_velocity.x == 0.0) is (x == 0.0)

    def test_standing_still_takes_the_rotation(self) -> None:
        """UO-5: a spinning object turns; a half turn in a second about z."""
        body = walker(transient=ACTIVE_TS, state=0)
        body.m_omega = vec(0.0, 0.0, f32(math.pi))
        body.update_object_internal(1.0)
        f = body.m_position.frame
        assert (abs(f.qw) < EPS, f.qz) == (True, 1.0)
        assert xyz(f.origin) == (0.0, 0.0, 0.0)

    def test_an_inactive_object_does_nothing(self) -> None:
        """UO-1: not even integrate its velocity; nor does one in no cell."""
        for transient, in_cell in ((0, True), (ACTIVE_TS, False)):
            body = walker(transient=transient, velocity=(1.0, 0.0, 0.0))
            body.jumped_this_frame = 1
            if not in_cell:
                body.cell = None
            body.update_object_internal(EIGHTH)
            assert (xyz(body.m_velocity), body.jumped_this_frame) == ((1.0, 0.0, 0.0), 1)

    def test_an_object_without_spheres_only_turns(self) -> None:
        """UO-4: its velocity integrates nevertheless, and on a walkable it comes to rest."""
        body = walker(velocity=(1.0, 0.0, 0.0), spheres=0)
        body.m_acceleration = vec(0.0, 8.0, 0.0)
        body.update_object_internal(EIGHTH)
        assert xyz(body.m_position.frame.origin) == (0.0, 0.0, 0.0)
        assert xyz(body.m_velocity) == (1.0, 1.0, 0.0)
        assert not body.transient_state & ACTIVE_TS
        body.part_array, body.movement_manager = None, MovementManager()
        body.transient_state = STANDING
        body.update_object_internal(EIGHTH)
        assert body.transient_state == STANDING

    def test_a_failed_transition_changes_only_the_rotation(self) -> None:
        """UO-8: pushed into a wall whose normal is seeded as sliding normal, nothing is written back."""
        body = walker(world=world_of(WALL), velocity=(4.0, 0.0, 0.0))
        body.transient_state |= SLIDING_TS
        body.sliding_normal = vec(-1.0, 0.0, 0.0)
        body.cached_velocity = vec(1.0, 2.0, 3.0)
        before = body.transient_state
        body.update_object_internal(EIGHTH)
        assert xyz(body.m_position.frame.origin) == (0.0, 0.0, 0.0)
        assert (body.transient_state, xyz(body.sliding_normal)) == (before, (-1.0, 0.0, 0.0))
        assert (xyz(body.cached_velocity), xyz(body.m_velocity)) == ((0.0, 0.0, 0.0), (4.0, 0.0, 0.0))

    @pytest.mark.parametrize("state", [ALIGNPATH_PS, SLEDDING_PS])
    def test_some_objects_look_where_they_go(self, state: int) -> None:
        """UO-6: along the path, or along the velocity; here east, a quarter turn clockwise."""
        body = walker(state=state, transient=ACTIVE_TS, velocity=(2.0, 0.0, 0.0), height=3.0)
        body.update_object_internal(EIGHTH)
        heading = body.m_position.frame.get_vector_heading()
        assert abs(heading.x - 1.0) < EPS
        assert abs(heading.y) < EPS

    def test_the_heading_of_a_sled_is_stored(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """UO-6: as float32, before the frame turns."""
        headings: list[float] = []
        monkeypatch.setattr(Frame, "set_heading", lambda _self, degrees: headings.append(degrees))
        body = walker(state=SLEDDING_PS, transient=ACTIVE_TS, velocity=(1.0, 2.0, 0.0), height=3.0)
        body.update_object_internal(EIGHTH)
        degrees = body.m_velocity.get_heading()
        assert headings == [f32(degrees)] != [degrees]

    def test_a_sled_that_falls_from_rest_keeps_its_heading(self) -> None:
        """UO-6: a velocity of zero has no heading."""
        body = walker(state=SLEDDING_PS, transient=ACTIVE_TS, height=3.0)
        body.position_manager = Nudge()
        body.update_object_internal(EIGHTH)
        assert xyz(body.m_position.frame.origin) == (0.0, 0.5, 3.0)
        assert body.m_position.frame.qw == 1.0

    def test_jumping_is_forgotten(self) -> None:
        """UO-2."""
        body = walker()
        body.jumped_this_frame = 1
        body.update_object_internal(EIGHTH)
        assert body.jumped_this_frame == 0

    def test_becoming_solid_again(self) -> None:
        """UO-2: an attached object does at once; what any other asks its cells is not specified."""
        body = walker(state=ORDINARY | ETHEREAL_PS, transient=STANDING | CHECK_ETHEREAL_TS)
        with pytest.raises(NotPortedError, match="check_collisions"):
            body.update_object_internal(EIGHTH)
        body.parent = walker()
        body.update_object_internal(EIGHTH)
        assert (body.state, body.transient_state & CHECK_ETHEREAL_TS) == (ORDINARY, 0)


class Nudge:
    """A position manager that asks for half a metre to the north."""

    def __init__(self) -> None:
        self.quanta: list[float] = []

    def adjust_offset(self, offset: Frame, quantum: float) -> None:
        """Move the offset."""
        self.quanta.append(quantum)
        offset.origin.y = 0.5


class Striding(PartArray):
    """Parts whose animation moves them forward by a quarter of a metre."""

    def update(self, quantum: float, offset: Frame) -> None:
        """Write the root motion."""
        offset.origin.y = 0.25


def striding(transient: int, *, state: int = 0) -> PhysicsObj:
    """Return an animated object of scale 2."""
    body = walker(state=state, transient=transient)
    body.part_array, body.m_scale = Striding([], Setup(), vec(1.0, 1.0, 1.0)), 2.0
    return body


class TestWantedPosition:
    """UPI-1…5."""

    @pytest.mark.parametrize(
        ("transient", "state", "y"), [(STANDING, 0, 0.5), (ACTIVE_TS, 0, 0.0), (STANDING, HIDDEN_PS, 0.0)]
    )
    def test_root_motion_is_scaled_and_needs_ground(self, transient: int, state: int, y: float) -> None:
        """UPI-2: multiplied by the scale on a walkable, by zero in the air; hidden objects have none."""
        body = striding(transient, state=state)
        frame = body.m_position.frame.copy()
        body.update_position_internal(EIGHTH, frame)
        assert xyz(frame.origin) == (0.0, y, 0.0)

    def test_the_position_manager_is_asked(self) -> None:
        """UPI-3: hidden or not, it has the last word before the combination."""
        body = walker(state=HIDDEN_PS, velocity=(1.0, 0.0, 0.0))
        nudge = Nudge()
        body.position_manager = nudge
        frame = body.m_position.frame.copy()
        body.update_position_internal(EIGHTH, frame)
        assert (xyz(frame.origin), nudge.quanta) == ((0.0, 0.5, 0.0), [EIGHTH])
        assert xyz(body.m_velocity) == (1.0, 0.0, 0.0)

    def test_the_rotation_is_normalised_again(self) -> None:
        """UPI-4: combining with the identity is not a copy."""
        body = walker(state=HIDDEN_PS)
        body.m_position.frame.qw = 1.0009765625
        frame = body.m_position.frame.copy()
        body.update_position_internal(EIGHTH, frame)
        assert (frame.qw, frame.origin.x) == (1.0, 0.0)

    def test_the_cell_of_a_wanted_position_is_the_old_one(self) -> None:
        """UO-3: the id stays although the origin may lie outside of the cell."""
        body = walker(velocity=(1.0, 0.0, 0.0))
        body.update_object_internal(EIGHTH)
        assert body.m_position.objcell_id == CELL
