"""CTransition, the insertion of the check position into its cells.

The functions here are methods of `oracle.transition.Transition`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.constants import SMALL_STEP, Z_LANDING
from oracle.enums import CONTACT_OI, ON_WALKABLE_OI, InsertType, TransitionState
from oracle.land_defs import FIRST_INTERIOR_CELL, adjust_to_outside
from oracle.ref import Ref

if TYPE_CHECKING:
    from oracle.obj_cell import ObjCell
    from oracle.transition import Transition

PLACEMENT_ATTEMPTS = 3
"""Attempts of a placement in its cell (05, placement_insert and FP-2)."""


def insert_into_cell(self: Transition, cell: ObjCell | None, attempts: int) -> TransitionState:
    """Test one cell until it has nothing to add; the cell stays the same for all attempts.

    retail: CTransition::insert_into_cell 0x00509E70, 05 IC-1…3.
    """
    # IC-1
    if cell is None:
        return TransitionState.COLLIDED
    # IC-2
    result = TransitionState.OK
    for _ in range(attempts):
        result = cell.find_collisions(self)
        if result in (TransitionState.OK, TransitionState.COLLIDED):
            return result
        if result == TransitionState.SLID:
            self.collision_info.forget_contact()
    # IC-3
    return result


def check_other_cells(self: Transition, curr_cell: ObjCell | None) -> TransitionState:
    """Test the other cells that the spheres reach, then make the one that contains sphere 0 current.

    The list is shared with nested calls, which rebuild it under this loop; the cell found for sphere 0
    is the one from before the loop.

    retail: CTransition::check_other_cells 0x0050AE50, 05 OC-1…7.
    """
    sp = self.sphere_path
    # OC-1
    result = TransitionState.OK
    found: Ref[ObjCell | None] = Ref(None)
    self.build_cell_array(found)
    # OC-2
    index = 0
    while index < self.cell_array.num_cells:
        cell = self.cell_array.cells[index].cell
        index += 1
        if cell is None or cell is curr_cell:
            continue
        result = cell.find_collisions(self)
        if result == TransitionState.SLID:
            self.collision_info.forget_contact()
            return result
        if result in (TransitionState.COLLIDED, TransitionState.ADJUSTED):
            return result
    # OC-3
    sp.check_cell = found.value
    if found.value is not None:
        sp.adjust_check_pos(found.value.id)
        return result
    # OC-4
    if sp.step_down:
        return TransitionState.COLLIDED
    # OC-5
    p = sp.check_pos.copy()
    if (p.objcell_id & 0xFFFF) < FIRST_INTERIOR_CELL:
        _, p.objcell_id = adjust_to_outside(p.objcell_id, p.frame.origin)
    # OC-6
    if p.objcell_id != 0:
        sp.adjust_check_pos(p.objcell_id)
        sp.set_check_pos(p, None)
        sp.cell_array_valid = 1
        return result
    # OC-7
    return TransitionState.COLLIDED


def placement_insert(self: Transition) -> TransitionState:
    """Insert into the check cell, then into the others.

    retail: CTransition::placement_insert 0x0050B1D0, 05 4.
    """
    cell = self.sphere_path.check_cell
    if cell is None:
        return TransitionState.COLLIDED
    ts = self.insert_into_cell(cell, PLACEMENT_ATTEMPTS)
    if ts == TransitionState.OK:
        ts = self.check_other_cells(cell)
    return ts


def transitional_insert(self: Transition, attempts: int) -> TransitionState:
    """Insert the check position into its cells, landing, stepping and sliding as needed.

    ADJUSTED or SLID on the last attempt is a failure to the caller.

    retail: CTransition::transitional_insert 0x0050B6F0, 05 TI-1…22.
    """
    sp, ci, oi = self.sphere_path, self.collision_info, self.object_info
    # TI-1
    if sp.check_cell is None:
        return TransitionState.OK
    # TI-2
    ts = TransitionState.INVALID
    # TI-3
    for _ in range(attempts):
        # TI-4
        ts = self.insert_into_cell(sp.check_cell, attempts)
        # TI-5
        if ts == TransitionState.OK:
            ts = self.check_other_cells(sp.check_cell)
            if ts != TransitionState.OK:
                sp.neg_poly_hit = 0
        elif ts == TransitionState.SLID:
            ci.forget_contact()
            sp.neg_poly_hit = 0
        else:
            sp.neg_poly_hit = 0
        if ts == TransitionState.COLLIDED:
            return ts
        # TI-6
        if ts != TransitionState.OK:
            continue
        # TI-7
        if sp.collide:
            return _land(self, attempts)
        # TI-13
        if sp.neg_poly_hit and not sp.step_down and not sp.step_up:
            ts = _leave_negative_side(self)
            continue
        # TI-14
        if ci.contact_plane_valid:
            return TransitionState.OK
        # TI-15
        if not oi.state & CONTACT_OI or sp.step_down or sp.check_cell is None or not oi.step_down:
            return TransitionState.OK
        # TI-16
        height, z = SMALL_STEP, Z_LANDING
        if oi.state & ON_WALKABLE_OI:
            z = oi.get_walkable_z()
            height = oi.step_down_height
        # TI-17
        sp.walkable_allowance = z
        sp.save_check_pos()
        # TI-18
        radius = sp.global_sphere[0].radius
        if sp.num_sphere < 2 and radius + radius < height:
            height = f32(radius * 0.5)
        # TI-19
        if radius + radius >= height:
            found = self.step_down(height, z)
        else:
            height = f32(height * 0.5)
            found = self.step_down(height, z) or self.step_down(height, z)
        # TI-22
        if found:
            sp.walkable = None
            return TransitionState.OK
        # TI-20, TI-21
        stop, ts = self.edge_slide(height, z)
        if stop:
            return ts
    return ts


def _land(self: Transition, attempts: int) -> TransitionState:
    """Accept a landing, or go back to before the hit (05 TI-8…12 of transitional_insert)."""
    sp, ci = self.sphere_path, self.collision_info
    # 05 TI-8
    sp.collide = 0
    reset = True
    # 05 TI-9
    if ci.contact_plane_valid and self.check_walkable(Z_LANDING):
        sp.backup = sp.insert_type
        sp.insert_type = InsertType.PLACEMENT
        ts = self.transitional_insert(attempts)
        sp.insert_type = sp.backup
        reset = ts != TransitionState.OK
    # 05 TI-10
    sp.walkable = None
    # 05 TI-11
    if not reset:
        return TransitionState.OK
    # 05 TI-12
    sp.restore_check_pos()
    ci.forget_contact()
    if ci.last_known_contact_plane_valid:
        self.object_info.kill_velocity()
        ci.last_known_contact_plane_valid = 0
    else:
        ci.set_collision_normal(sp.step_up_normal)
    return TransitionState.COLLIDED


def _leave_negative_side(self: Transition) -> TransitionState:
    """Step or slide off a polygon overlapped from behind (05 TI-13 of transitional_insert)."""
    sp, ci = self.sphere_path, self.collision_info
    sp.neg_poly_hit = 0
    if sp.neg_step_up:
        if self.step_up(sp.neg_collision_normal):
            return TransitionState.OK
        return sp.step_up_slide(self.object_info, ci)
    return sp.global_sphere[0].slide_sphere(sp, ci, sp.neg_collision_normal, sp.global_curr_center[0])
