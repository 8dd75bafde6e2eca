"""CPhysicsObj, the write-back: what an object takes over from its finished transition.

The functions here are methods of `oracle.physics_object.PhysicsObj`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import is_nan
from oracle.constants import FLOOR_Z
from oracle.land_defs import FIRST_INTERIOR_CELL, adjust_to_outside
from oracle.physics_state import HAS_PHYSICS_BSP_PS
from oracle.transient_state import ACTIVE_TS, CONTACT_TS, ON_WALKABLE_TS, SLIDING_TS, WATER_CONTACT_TS

if TYPE_CHECKING:
    from oracle.frame import Frame
    from oracle.obj_cell import ObjCell
    from oracle.physics_object import PhysicsObj
    from oracle.position import Position
    from oracle.transition import Transition


def set_position_internal(self: PhysicsObj, made: Transition) -> int:
    """Take over position, contact and sliding normal, respond to the collisions, and register; always 1.

    retail: CPhysicsObj::SetPositionInternal(CTransition) 0x00515330, 06 WB-1…12.
    """
    sp, ci = made.sphere_path, made.collision_info
    # WB-1
    prev_on_walkable = self.transient_state & ON_WALKABLE_TS
    prev_contact = self.transient_state & CONTACT_TS
    # WB-2
    if sp.curr_cell is None:
        self.become_lost(sp.curr_pos)
        return 1
    # WB-3
    if self.cell is sp.curr_cell:
        self.m_position.objcell_id = sp.curr_pos.objcell_id
    else:
        self.change_cell(sp.curr_cell)
    # WB-4
    self.set_frame(sp.curr_pos.frame)
    # WB-5
    water = ci.contact_plane_is_water
    self.contact_plane_cell_id = ci.contact_plane_cell_id
    self.contact_plane.assign(ci.contact_plane)
    # WB-6
    _set_bit(self, CONTACT_TS, ci.contact_plane_valid)
    # WB-7
    self.calc_acceleration()
    # WB-8
    _set_bit(self, WATER_CONTACT_TS, water)
    # WB-9
    if self.transient_state & CONTACT_TS:
        self.set_on_walkable(int(not self.contact_plane.N.z < FLOOR_Z))
    else:
        self.leave_walkable()
    # WB-10
    self.sliding_normal.assign(ci.sliding_normal)
    _set_bit(self, SLIDING_TS, ci.sliding_normal_valid)
    # WB-11
    self.handle_all_collisions(ci, prev_contact, prev_on_walkable)
    # WB-12
    if self.cell is not None:
        if self.state & HAS_PHYSICS_BSP_PS:
            self.calc_cross_cells()
        elif made.cell_array.num_cells:
            self.remove_shadows_from_cells()
            self.add_shadows_to_cells(made.cell_array)
    return 1


def _set_bit(self: PhysicsObj, bit: int, flag: int) -> None:
    if flag:
        self.transient_state |= bit
    else:
        self.transient_state &= ~bit


def become_lost(self: PhysicsObj, position: Position) -> None:
    """Be in no cell any more; nothing but the position and activity changes (06 WB-2, SP-3)."""
    self.remove_shadows_from_cells()
    self.cell = None
    self.store_position(position)
    self.transient_state &= ~ACTIVE_TS


def store_position(self: PhysicsObj, position: Position) -> None:
    """Take a position; an outdoor one is brought to the land cell under it, or to id 0 (06 WB-2)."""
    p = position.copy()
    if (p.objcell_id & 0xFFFF) < FIRST_INTERIOR_CELL:
        _, p.objcell_id = adjust_to_outside(p.objcell_id, p.frame.origin)
    self.m_position.assign(p)


def change_cell(self: PhysicsObj, cell: ObjCell) -> None:
    """Leave the cell the object is in, and enter another (06 WB-3)."""
    self.cell = cell
    self.m_position.objcell_id = cell.id


def set_frame(self: PhysicsObj, frame: Frame) -> None:
    """Take a frame. A quaternion that is not a number becomes zero; the matrix stays (06 WB-4)."""
    f, o = self.m_position.frame, frame.origin
    f.assign(frame)
    turned = any(is_nan(q) for q in (f.qw, f.qx, f.qy, f.qz))
    if turned and not any(is_nan(c) for c in (o.x, o.y, o.z)):
        f.qw = f.qx = f.qy = f.qz = 0.0
