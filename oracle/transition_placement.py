"""CTransition, placement: find room for a mover that comes from nowhere.

The functions here are methods of `oracle.transition.Transition`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import ceil, f32
from oracle.constants import (
    EPS2,
    FULL_CIRCLE,
    RING_PI,
    RING_RADIUS,
    RING_REACH,
    SMALL_RADIUS,
    SMALL_RING_REACH,
    Z_LANDING,
)
from oracle.enums import InsertType, TransitionState
from oracle.frame import Frame
from oracle.transition_insert import PLACEMENT_ATTEMPTS
from oracle.transition_path import ATTEMPTS, squared_length
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.transition import Transition


def find_placement_position(self: Transition) -> int:
    """Place the mover at the end position or near it; 1 means that the current position is to be used.

    retail: CTransition::find_placement_position 0x0050C170, 05 FP-1…6.
    """
    sp, oi = self.sphere_path, self.object_info
    # FP-1
    sp.set_check_pos(sp.curr_pos, sp.curr_cell)
    sp.insert_type = InsertType.INITIAL_PLACEMENT
    # FP-2
    cell = sp.check_cell
    ts = TransitionState.COLLIDED
    if cell is not None:
        ts = self.insert_into_cell(cell, PLACEMENT_ATTEMPTS)
        if ts == TransitionState.OK:
            ts = self.check_other_cells(cell)
    # FP-3
    if self.validate_placement(ts, 1) != TransitionState.OK:
        return 0
    # FP-4
    sp.insert_type = InsertType.PLACEMENT
    if not self.find_placement_pos():
        return 0
    # FP-5
    if oi.step_down:
        _put_on_ground(self)
    # FP-6
    return int(self.validate_placement(TransitionState.OK, 1) == TransitionState.OK)


def _put_on_ground(self: Transition) -> None:
    """Step the placed mover down, if there is ground (05 FP-5 of find_placement_position)."""
    sp, oi = self.sphere_path, self.object_info
    height = oi.step_down_height
    sp.walkable_allowance = Z_LANDING
    sp.save_check_pos()
    sp.backup = sp.insert_type
    sp.insert_type = InsertType.TRANSITION
    radius = sp.global_sphere[0].radius
    if sp.num_sphere < 2 and radius + radius < height:
        height = f32(radius * 0.5)
    if radius + radius >= height:
        found = self.step_down(height, Z_LANDING)
    else:
        height = f32(height * 0.5)
        found = self.step_down(height, Z_LANDING) or self.step_down(height, Z_LANDING)
    if not found:
        sp.restore_check_pos()
        self.collision_info.forget_contact()
    sp.insert_type = sp.backup
    sp.walkable = None


def find_placement_pos(self: Transition) -> int:
    """Try the position itself, then rings of positions around it; 1 if there was room.

    retail: CTransition::find_placement_pos 0x0050BA50, 05 PP-1…6.
    """
    sp = self.sphere_path
    # PP-1
    sp.set_check_pos(sp.curr_pos, sp.curr_cell)
    if _try_here(self) == TransitionState.OK:
        return 1
    if not sp.placement_allows_sliding:
        return 0
    # PP-2
    radius = sp.local_sphere[0].radius
    ring = RING_REACH
    small = radius < SMALL_RADIUS
    if small:
        ring = SMALL_RING_REACH
    elif radius < RING_RADIUS:
        radius = RING_RADIUS
    # PP-3
    q = RING_REACH / (1.0 * radius)
    if small:
        q = q * 0.5
    if q <= 1.0:
        return 0
    # PP-4
    num_steps = ceil(q)
    d = f32(ring / num_steps)
    da = f32((d / radius) * RING_PI)
    dist = acc = 0.0
    # PP-5
    for _ in range(num_steps):
        dist = f32(dist + d)
        angle_sum = da + acc
        acc = f32(angle_sum)
        count = 2 * ceil(angle_sum)
        angle = f32(FULL_CIRCLE / count)
        frame = Frame()
        for j in range(count):
            sp.set_check_pos(sp.curr_pos, sp.curr_cell)
            frame.set_heading(f32(j * angle))
            v = frame.get_vector_heading()
            off = Vector3(f32(dist * v.x), f32(dist * v.y), f32(dist * v.z))
            sp.global_offset.assign(self.adjust_offset(off))
            if squared_length(sp.global_offset) >= EPS2:
                sp.add_offset_to_check_pos(sp.global_offset)
                if _try_here(self) == TransitionState.OK:
                    return 1
    # PP-6
    return 0


def _try_here(self: Transition) -> TransitionState:
    """Insert at the check position, with no contact and no sliding normal (05 PP-1, PP-5)."""
    self.collision_info.sliding_normal_valid = 0
    self.collision_info.forget_contact()
    return self.validate_placement_transition(self.transitional_insert(ATTEMPTS))
