"""CTransition, validation: acceptance, the last known plane, stationary falls."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_worlds import CELL, RADIUS, ScriptedCell, ScriptedWorld, at, mover, transition, vec, xyz

from oracle.arithmetic import f32
from oracle.constants import EPS, FLOOR_Z
from oracle.enums import CONTACT_OI, IS_VIEWER_OI, ON_WALKABLE_OI, TransitionState
from oracle.plane import Plane

if TYPE_CHECKING:
    from oracle.transition import Transition

OK, COLLIDED, ADJUSTED, SLID, INVALID = (
    TransitionState.OK,
    TransitionState.COLLIDED,
    TransitionState.ADJUSTED,
    TransitionState.SLID,
    TransitionState.INVALID,
)
WALKING = CONTACT_OI | ON_WALKABLE_OI


def moved(x: float = 0.25, *answers: TransitionState, state: int = 0, z: float = RADIUS) -> Transition:
    """Return a transition whose check position is `x` beyond its current position."""
    world = ScriptedWorld(ScriptedCell(answers))
    made = transition(world, at(0.0, 0.0, z), at(1.0, 0.0, z), state=state, moving=mover())
    made.sphere_path.add_offset_to_check_pos(vec(x, 0.0, 0.0))
    return made


def last_known(made: Transition, d: float) -> None:
    """Seed a level last known plane."""
    ci = made.collision_info
    ci.last_known_contact_plane.assign(Plane(vec(0.0, 0.0, 1.0), d))
    ci.last_known_contact_plane_valid = 1
    ci.last_known_contact_plane_cell_id = CELL


def test_a_free_position_is_accepted() -> None:
    """VT-3: current position, cell and centres follow the check position."""
    made = moved()
    assert made.validate_transition(OK) == OK
    assert xyz(made.sphere_path.curr_pos.frame.origin) == (0.25, 0.0, RADIUS)
    assert made.sphere_path.global_curr_center[0].x == 0.25
    assert made.collision_info.frames_stationary_fall == 0


@pytest.mark.parametrize("ts", [COLLIDED, ADJUSTED, SLID])
def test_a_failed_position_goes_back_and_counts_as_ok(ts: TransitionState) -> None:
    """VT-4, VT-6, VT-7: without a normal the collision is upright; the result is OK."""
    made = moved()
    assert made.validate_transition(ts) == OK
    assert xyz(made.sphere_path.check_pos.frame.origin) == (0.0, 0.0, RADIUS)
    assert xyz(made.collision_info.collision_normal) == (0.0, 0.0, 1.0)
    assert (made.collision_info.sliding_normal_valid, made.collision_info.frames_stationary_fall) == (1, 1)


def test_an_invalid_state_moves_nothing() -> None:
    """VT-8: neither accepted nor put back."""
    made = moved()
    assert made.validate_transition(INVALID) == INVALID
    assert xyz(made.sphere_path.check_pos.frame.origin) == (0.25, 0.0, RADIUS)
    assert made.collision_info.collision_normal_valid == 0


def test_a_failure_near_the_last_known_plane_stands_on_it() -> None:
    """VT-5: the velocity is killed and the plane becomes the contact plane again."""
    made = moved(state=WALKING)
    last_known(made, 0.0)
    made.validate_transition(COLLIDED)
    ci = made.collision_info
    assert (ci.contact_plane_valid, ci.contact_plane_cell_id) == (1, CELL)
    assert made.object_info.mover().kill_velocity_calls == 1
    assert (made.object_info.state, ci.frames_stationary_fall) == (WALKING, 0)


def test_off_walkable_ground_the_last_known_plane_is_no_movement() -> None:
    """VT-5: `moved` is decided by the bit from before this sub-step."""
    made = moved(state=CONTACT_OI)
    last_known(made, 0.0)
    made.validate_transition(COLLIDED)
    assert (made.object_info.state, made.collision_info.frames_stationary_fall) == (WALKING, 1)


@pytest.mark.parametrize(("gap", "valid"), [(EPS * 0.9, 1), (EPS * 1.1, 0)])
def test_the_last_known_plane_must_be_in_reach(gap: float, valid: int) -> None:
    """VT-5: radius + EPS must exceed the distance of the last accepted centre."""
    made = moved(z=1.0)
    last_known(made, f32(-1.0 + RADIUS + gap))
    made.validate_transition(COLLIDED)
    assert made.collision_info.contact_plane_valid == valid


def test_a_plane_exactly_at_radius_and_eps_is_out_of_reach() -> None:
    """VT-5: the comparison is strict."""
    world = ScriptedWorld(ScriptedCell([]))
    made = transition(world, at(0.0, 0.0, 0.5), at(1.0, 0.0, 0.5), spheres=((0.0, 0.5),), moving=mover())
    last_known(made, EPS)
    made.validate_transition(COLLIDED)
    assert made.collision_info.contact_plane_valid == 0


def test_a_collision_of_an_earlier_sub_step_still_slides() -> None:
    """VT-9: the collision normal outlives the sub-step, also after a free one."""
    made = moved()
    made.collision_info.set_collision_normal(vec(-1.0, 0.0, 0.0))
    made.validate_transition(OK)
    assert xyz(made.collision_info.sliding_normal) == (-1.0, 0.0, 0.0)


def test_a_move_within_tolerance_is_no_movement_but_is_accepted() -> None:
    """VT-2, VT-3: EPS per axis counts as the same place."""
    made = moved(f32(EPS))
    made.validate_transition(OK)
    assert made.sphere_path.curr_pos.frame.origin.x == f32(EPS)
    assert made.collision_info.frames_stationary_fall == 1


def test_the_third_stationary_step_makes_a_floor() -> None:
    """VT-10: a level plane that touches the sphere, in the check position's cell."""
    made = moved()
    made.collision_info.frames_stationary_fall = 2
    made.validate_transition(COLLIDED)
    ci = made.collision_info
    assert (ci.frames_stationary_fall, ci.contact_plane_valid, ci.contact_plane.d) == (3, 1, 0.0)
    assert (ci.contact_plane_cell_id, ci.collided_with_environment) == (CELL, 1)
    assert made.object_info.state == WALKING


@pytest.mark.parametrize(("state", "gravity"), [(IS_VIEWER_OI, 0x400), (0, 0)])
def test_cameras_and_weightless_movers_do_not_count(state: int, gravity: int) -> None:
    """VT-10: needs gravity, and no viewer."""
    made = moved(state=state)
    made.object_info.mover().state = gravity
    made.validate_transition(COLLIDED)
    assert made.collision_info.frames_stationary_fall == 0


@pytest.mark.parametrize(("z", "bits"), [(1.0, WALKING), (FLOOR_Z, WALKING), (0.5, CONTACT_OI)])
def test_the_state_follows_the_contact_plane(z: float, bits: int) -> None:
    """VT-11, VT-12: the plane becomes the last known one; its slope decides about walking."""
    made = moved()
    made.collision_info.set_contact_plane(Plane(vec(0.0, 0.0, z), 5.0), 1)
    made.collision_info.contact_plane_cell_id = 77
    made.validate_transition(OK)
    ci = made.collision_info
    assert made.object_info.state == bits
    assert (ci.last_known_contact_plane.d, ci.last_known_contact_plane_cell_id) == (5.0, 77)
    assert ci.last_known_contact_plane_is_water == 1


def test_without_contact_the_last_known_plane_becomes_invalid() -> None:
    """VT-11, VT-12: validity is copied; the plane itself stays."""
    made = moved(state=WALKING)
    last_known(made, -9.0)
    made.validate_transition(OK)
    ci = made.collision_info
    assert (ci.last_known_contact_plane_valid, ci.last_known_contact_plane.d) == (0, -9.0)
    assert made.object_info.state == 0


def test_a_placement_is_accepted_or_starts_afresh() -> None:
    """VP-2, VP-3: a failure clears what was touched, if sliding is allowed; the state is passed on."""
    made = moved()
    assert made.validate_placement_transition(OK) == OK
    assert made.sphere_path.curr_pos.frame.origin.x == 0.25
    for allows, valid in ((1, 0), (0, 1)):
        made.sphere_path.placement_allows_sliding = allows
        made.collision_info.set_collision_normal(vec(1.0, 0.0, 0.0))
        assert made.validate_placement_transition(SLID) == SLID
        assert made.collision_info.collision_normal_valid == valid


def test_a_placement_outside_every_cell_collides() -> None:
    """VP-1, and the same in validate_placement."""
    made = moved()
    made.sphere_path.check_cell = None
    assert made.validate_placement_transition(OK) == COLLIDED
    assert made.validate_placement(OK, 1) == COLLIDED


def test_an_adjusted_placement_is_inserted_once_more() -> None:
    """validate_placement: ADJUSTED is tried again, but only once, and only if asked to."""
    made = moved(0.25, OK)
    assert made.validate_placement(ADJUSTED, 1) == OK
    assert made.sphere_path.curr_pos.frame.origin.x == 0.25
    assert moved().validate_placement(ADJUSTED, 0) == ADJUSTED
    assert moved(0.25, ADJUSTED, ADJUSTED, ADJUSTED).validate_placement(SLID, 1) == ADJUSTED
