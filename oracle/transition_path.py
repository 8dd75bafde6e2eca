"""CTransition, the walk along the path: sub-steps and the offset of each.

The functions here are methods of `oracle.transition.Transition`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import ceil, divide, f32, floor, sqrt
from oracle.cell_list import find_cell_list_for_path
from oracle.constants import EPS, EPS2
from oracle.enums import FREE_ROTATE_OI, IS_VIEWER_OI, PATH_CLIPPED_OI, InsertType, TransitionState
from oracle.land_defs import get_block_offset
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.frame import Frame
    from oracle.position import Position
    from oracle.transition import Transition

ATTEMPTS = 3
"""Attempts of an ordinary insert (05 FT-12)."""


def find_transitional_position(self: Transition) -> int:
    """Move along the path in sub-steps; 1 means that the current position is to be used.

    A blocked move is a successful transition too: it ends where the mover could get to.

    retail: CTransition::find_transitional_position 0x0050BDF0, 05 FT-1…15.
    """
    sp, ci, oi = self.sphere_path, self.collision_info, self.object_info
    # FT-1; without a begin position a path is a placement, which does not come here
    begin_pos, end_pos = sp.begin_pos, sp.end_pos
    if sp.begin_cell is None or begin_pos is None or end_pos is None:
        return 0
    # FT-2
    ts = TransitionState.OK
    offset, step, num_steps = self.calc_num_steps()
    # FT-3
    if oi.state & FREE_ROTATE_OI:
        _take_rotation(sp.curr_pos.frame, end_pos)
    # FT-4
    sp.set_check_pos(sp.curr_pos, sp.curr_cell)
    # FT-5
    if num_steps == 0:
        if not oi.state & FREE_ROTATE_OI:
            _take_rotation(sp.curr_pos.frame, end_pos)
        sp.set_check_pos(sp.curr_pos, sp.curr_cell)
        sp.cell_array_valid = 1
        sp.hits_interior_cell = 0
        find_cell_list_for_path(self.world, self.cell_array, None, sp)
        return 1
    # FT-6
    for i in range(num_steps):
        # FT-7
        if oi.state & IS_VIEWER_OI and i == num_steps - 1:
            length = sqrt((offset.z * offset.z + offset.y * offset.y) + offset.x * offset.x)
            if length > EPS:
                k = (length - sp.local_sphere[0].radius * (num_steps - 1)) / length
                step = Vector3(f32(offset.x * k), f32(offset.y * k), f32(offset.z * k))
        # FT-8
        sp.global_offset.assign(self.adjust_offset(step))
        # FT-9
        if not oi.state & IS_VIEWER_OI and squared_length(sp.global_offset) < EPS2:
            return int(i != 0 and ts == TransitionState.OK)
        # FT-10
        if not oi.state & FREE_ROTATE_OI:
            t = f32((i + 1) / num_steps)
            sp.check_pos.frame.interpolate_rotation(begin_pos.frame, end_pos.frame, t)
        # FT-11
        ci.sliding_normal_valid = 0
        ci.forget_contact()
        # FT-12
        if sp.insert_type == InsertType.TRANSITION:
            sp.add_offset_to_check_pos(sp.global_offset)
            ts = self.validate_transition(self.transitional_insert(ATTEMPTS))
            if ci.frames_stationary_fall != 0:
                break
        # FT-13
        else:
            ts = self.validate_placement_transition(self.transitional_insert(ATTEMPTS))
            if ts == TransitionState.OK:
                return 1
            if not sp.placement_allows_sliding:
                return 0
            sp.add_offset_to_check_pos(sp.global_offset)
        # FT-14
        if ci.collision_normal_valid and oi.state & PATH_CLIPPED_OI:
            break
    # FT-15
    return int(ts == TransitionState.OK)


def calc_num_steps(self: Transition) -> tuple[Vector3, Vector3, int]:
    """Return the whole offset, the offset of one sub-step (metres) and the number of sub-steps.

    retail: CTransition::calc_num_steps 0x0050A0B0, 05 NS-1…5.
    """
    sp = self.sphere_path
    # NS-1
    if sp.begin_pos is None or sp.end_pos is None:
        return Vector3(), Vector3(), 1
    # NS-2
    offset = sp.begin_pos.get_offset(sp.end_pos)
    x, y, z = offset.x, offset.y, offset.z
    # NS-3
    radius = sp.local_sphere[0].radius
    length = sqrt((x * x + y * y) + z * z)
    # NS-4
    if self.object_info.state & IS_VIEWER_OI:
        if length <= EPS:
            return offset, Vector3(), 0
        q = length / radius
        return offset, _scaled(1.0 / q, offset), floor(q) + 1
    # NS-5
    q = length / (1.0 * radius)
    if q > 1.0:
        n = ceil(q)
        return offset, _scaled(1.0 / n, offset), n
    if x != 0.0 or y != 0.0 or z != 0.0:
        return offset, offset.copy(), 1
    return offset, Vector3(), 0


def adjust_offset(self: Transition, offset: Vector3) -> Vector3:
    """Return the sub-step's offset bent along the contact plane and the sliding normal, metres.

    May clear the sliding normal, and may lift the check position out of the contact plane.

    retail: CTransition::adjust_offset 0x0050A370, 05 AD-1…9.
    """
    sp, ci = self.sphere_path, self.collision_info
    o = offset.copy()
    s, n = ci.sliding_normal, ci.contact_plane.N
    # AD-1
    slide = 0
    if ci.sliding_normal_valid:
        if (o.z * s.z + o.y * s.y) + o.x * s.x < 0.0:
            slide = 1
        else:
            ci.sliding_normal_valid = 0
    # AD-2
    if ci.contact_plane_valid:
        # AD-3
        p = f32((o.z * n.z + o.y * n.y) + o.x * n.x)
        # AD-4
        if slide:
            x = Vector3(
                f32(s.z * n.y - s.y * n.z),
                f32(s.x * n.z - s.z * n.x),
                f32(s.y * n.x - s.x * n.y),
            )
            if x.normalize_check_small():
                o = Vector3()
            else:
                k = (x.z * o.z + x.y * o.y) + x.x * o.x
                o = Vector3(f32(x.x * k), f32(x.y * k), f32(x.z * k))
        # AD-5
        elif p <= 0.0:
            a = p * n.x
            b = p * n.y
            c = f32(p * n.z)
            o = Vector3(f32(o.x - a), f32(o.y - b), f32(o.z - c))
        # AD-6
        else:
            ci.contact_plane.snap_to_plane(o)
        # AD-7
        if not ci.contact_plane_is_water and ci.contact_plane_cell_id != 0:
            block = get_block_offset(sp.check_pos.objcell_id, ci.contact_plane_cell_id)
            center, radius = sp.global_sphere[0].center, sp.global_sphere[0].radius
            distance = (
                ((center.z - block.z) * n.z + (center.y - block.y) * n.y) + (center.x - block.x) * n.x
            ) + ci.contact_plane.d
            if distance < radius - EPS:
                h = divide(radius - distance, n.z)
                if radius > abs(h):
                    sp.add_offset_to_check_pos(Vector3(0.0, 0.0, f32(h)))
    # AD-8
    elif slide:
        k = (o.x * s.x + o.z * s.z) + o.y * s.y
        a = k * s.x
        b = f32(k * s.y)
        c = f32(k * s.z)
        o = Vector3(f32(o.x - a), f32(o.y - b), f32(o.z - c))
    # AD-9
    return o


def squared_length(v: Vector3) -> float:
    """Return the squared length of an offset in the order of 05 FT-9, as a register."""
    return (v.z * v.z + v.y * v.y) + v.x * v.x


def _scaled(k: float, v: Vector3) -> Vector3:
    return Vector3(f32(k * v.x), f32(k * v.y), f32(k * v.z))


def _take_rotation(frame: Frame, position: Position) -> None:
    f = position.frame
    frame.set_rotate(f.qw, f.qx, f.qy, f.qz)
