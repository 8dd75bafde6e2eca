"""CTransition, validation: what becomes of the result of an insert.

The functions here are methods of `oracle.transition.Transition`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.enums import CONTACT_OI, IS_VIEWER_OI, ON_WALKABLE_OI, TransitionState
from oracle.physics_state import GRAVITY_PS
from oracle.plane import Plane
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.transition import Transition

FAILED = (TransitionState.COLLIDED, TransitionState.ADJUSTED, TransitionState.SLID)
"""The states that are failures after an insert (04 1.1)."""


def validate_transition(self: Transition, ts: TransitionState) -> TransitionState:
    """Accept the check position, or go back to the current one; update contact and sliding normal.

    A failed state becomes OK: the mover stays where it was and the transition goes on.

    retail: CTransition::validate_transition 0x0050AA70, 05 VT-1…13.
    """
    sp, ci, oi = self.sphere_path, self.collision_info, self.object_info
    # VT-1
    moved = 1
    # VT-2
    same = sp.check_pos.objcell_id == sp.curr_pos.objcell_id and sp.check_pos.frame.is_equal(
        sp.curr_pos.frame
    )
    if ts != TransitionState.OK or same:
        moved = 0
    # VT-3
    if ts == TransitionState.OK:
        _accept_check_pos(self)
        sp.set_check_pos(sp.curr_pos, sp.curr_cell)
    # VT-4
    elif ts in FAILED:
        # VT-5
        if ci.last_known_contact_plane_valid and _adopt_last_known_plane(self):
            moved = 1
        # VT-6
        if not ci.collision_normal_valid:
            ci.set_collision_normal(Vector3(0.0, 0.0, 1.0))
        # VT-7
        sp.set_check_pos(sp.curr_pos, sp.curr_cell)
        self.build_cell_array(None)
        ts = TransitionState.OK
    # VT-8: INVALID changes nothing of the above
    # VT-9
    if ci.collision_normal_valid:
        ci.set_sliding_normal(ci.collision_normal)
    # VT-10
    if not oi.state & IS_VIEWER_OI and oi.mover().state & GRAVITY_PS:
        _count_stationary_fall(self, moved)
    # VT-11
    ci.last_known_contact_plane_valid = ci.contact_plane_valid
    if ci.contact_plane_valid:
        ci.last_known_contact_plane.assign(ci.contact_plane)
        ci.last_known_contact_plane_cell_id = ci.contact_plane_cell_id
        ci.last_known_contact_plane_is_water = ci.contact_plane_is_water
    # VT-12
    if ci.contact_plane_valid:
        oi.state |= CONTACT_OI
        if oi.is_valid_walkable(ci.contact_plane.N):
            oi.state |= ON_WALKABLE_OI
        else:
            oi.state &= ~ON_WALKABLE_OI
    else:
        oi.state &= ~(CONTACT_OI | ON_WALKABLE_OI)
    # VT-13
    return ts


def _adopt_last_known_plane(self: Transition) -> bool:
    """Stop the mover and stand on the last known plane if near; True counts as moved (05 VT-5).

    The distance is taken without block offset, so across a landblock border it is meaningless.
    """
    sp, ci, oi = self.sphere_path, self.collision_info, self.object_info
    oi.kill_velocity()
    last, c = ci.last_known_contact_plane, sp.global_curr_center[0]
    distance = ((c.z * last.N.z + c.y * last.N.y) + c.x * last.N.x) + last.d
    if not sp.global_sphere[0].radius + EPS > abs(distance):
        return False
    ci.set_contact_plane(last, ci.last_known_contact_plane_is_water)
    ci.contact_plane_cell_id = ci.last_known_contact_plane_cell_id
    return bool(oi.state & ON_WALKABLE_OI)


def _count_stationary_fall(self: Transition, moved: int) -> None:
    """Count sub-steps without movement; the third makes a floor under the mover (05 VT-10)."""
    sp, ci, oi = self.sphere_path, self.collision_info, self.object_info
    if moved:
        ci.frames_stationary_fall = 0
    elif ci.frames_stationary_fall == 0:
        ci.frames_stationary_fall = 1
    elif ci.frames_stationary_fall == 1:
        ci.frames_stationary_fall = 2
    else:
        ci.frames_stationary_fall = 3
        c, radius = sp.global_sphere[0].center, sp.global_sphere[0].radius
        floor = Plane(Vector3(0.0, 0.0, 1.0), f32(radius - ((c.y + c.x) * 0.0 + c.z)))
        ci.set_contact_plane(floor, 0)
        if not oi.state & CONTACT_OI:
            ci.set_collision_normal(Vector3(0.0, 0.0, 1.0))
            ci.collided_with_environment = 1
        ci.contact_plane_cell_id = sp.check_pos.objcell_id


def validate_placement_transition(self: Transition, ts: TransitionState) -> TransitionState:
    """Accept a placement, or clear what it touched so that the next try starts afresh.

    retail: CTransition::validate_placement_transition 0x0050ADC0, 05 VP-1…4.
    """
    sp = self.sphere_path
    # VP-1
    if sp.check_cell is None:
        return TransitionState.COLLIDED
    # VP-2
    if ts == TransitionState.OK:
        _accept_check_pos(self)
    # VP-3
    elif ts in FAILED and sp.placement_allows_sliding:
        self.collision_info.init()
    # VP-4
    return ts


def validate_placement(self: Transition, ts: TransitionState, adjust: int) -> TransitionState:
    """Accept a placement; one that was moved is inserted once more, if `adjust`.

    retail: CTransition::validate_placement 0x0050B210, 05 7.
    """
    if self.sphere_path.check_cell is None:
        return TransitionState.COLLIDED
    if ts == TransitionState.OK:
        _accept_check_pos(self)
    elif ts in (TransitionState.ADJUSTED, TransitionState.SLID) and adjust:
        return self.validate_placement(self.placement_insert(), 0)
    return ts


def _accept_check_pos(self: Transition) -> None:
    """Make the check position the current one (05 VP-2)."""
    sp = self.sphere_path
    sp.curr_pos.assign(sp.check_pos)
    sp.curr_cell = sp.check_cell
    sp.cache_global_curr_center()
