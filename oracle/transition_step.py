"""CTransition, steps and edges: step up, step down, is there ground, slide off or along an edge.

The functions here are methods of `oracle.transition.Transition`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.constants import SMALL_STEP, Z_LANDING
from oracle.enums import EDGE_SLIDE, ON_WALKABLE_OI, InsertType, TransitionState
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.plane import Plane
    from oracle.transition import Transition

STEP_DOWN_ATTEMPTS = 5
"""Attempts of the insert below (05 SD-3)."""


def step_up(self: Transition, normal: Vector3) -> int:
    """Try to stand on what was hit; 1 if that worked. `normal` is in block coordinates.

    After a failure the contact plane is whatever the probe left.

    retail: CTransition::step_up 0x0050B610, 05 SU-1…6.
    """
    sp, ci, oi = self.sphere_path, self.collision_info, self.object_info
    # SU-1
    ci.forget_contact()
    sp.step_up = 1
    sp.step_up_normal.assign(normal)
    # SU-2
    height, z = SMALL_STEP, Z_LANDING
    if oi.state & ON_WALKABLE_OI:
        z = oi.get_walkable_z()
        height = oi.step_up_height
    # SU-3
    sp.walkable_allowance = z
    sp.backup_cell = sp.check_cell
    sp.backup_check_pos.assign(sp.check_pos)
    # SU-4
    r = self.step_down(height, z)
    # SU-5
    sp.step_up = 0
    sp.walkable = None
    # SU-6
    if r:
        return 1
    sp.restore_check_pos()
    return 0


def step_down(self: Transition, height: float, z: float) -> int:
    """Look for ground within `height` metres whose normal's z is at least `z`; 1 if there is some.

    After a failure the check position stays lowered, the contact plane as found.

    retail: CTransition::step_down 0x0050B2A0, 05 SD-1…6.
    """
    sp, ci, oi = self.sphere_path, self.collision_info, self.object_info
    # SD-1
    sp.neg_poly_hit = 0
    sp.step_down = 1
    sp.step_down_amt = height
    sp.walk_interp = 1.0
    # SD-2
    if not sp.step_up:
        sp.cell_array_valid = 0
        dz = f32(-height)
        origin = sp.check_pos.frame.origin
        origin.z = f32(dz + origin.z)
        sp.cache_global_sphere(Vector3(0.0, 0.0, dz))
    # SD-3
    ts = self.transitional_insert(STEP_DOWN_ATTEMPTS)
    sp.step_down = 0
    # SD-4
    accept = (
        ts == TransitionState.OK
        and ci.contact_plane_valid
        and ci.contact_plane.N.z >= z
        and (not oi.state & EDGE_SLIDE or sp.step_up or self.check_walkable(z))
    )
    # SD-5
    if not accept:
        return 0
    # SD-6
    sp.backup = sp.insert_type
    sp.insert_type = InsertType.PLACEMENT
    ts = self.transitional_insert(1)
    sp.insert_type = sp.backup
    return int(ts == TransitionState.OK)


def check_walkable(self: Transition, z: float) -> int:
    """Tell whether anything below supports the mover; touching anything does.

    `walkable_allowance` is left at `z`.

    retail: CTransition::check_walkable 0x0050AFF0, 05 WK-1…8.
    """
    sp, oi = self.sphere_path, self.object_info
    # WK-1
    if not oi.state & ON_WALKABLE_OI:
        return 1
    # WK-2
    if sp.check_walkables():
        return 1
    # WK-3
    saved_pos, saved_cell = sp.check_pos.copy(), sp.check_cell
    # WK-4
    h = oi.step_down_height
    sp.walkable_allowance = z
    sp.check_walkable = 1
    # WK-5
    radius = sp.global_sphere[0].radius
    if sp.num_sphere < 2 and h > radius + radius:
        h = radius * 0.5
    if h > radius + radius:
        h = h * 0.5
    # WK-6
    sp.add_offset_to_check_pos(Vector3(0.0, 0.0, f32(-h)))
    # WK-7
    ts = self.transitional_insert(1)
    sp.check_walkable = 0
    # WK-8
    sp.set_check_pos(saved_pos, saved_cell)
    return int(ts != TransitionState.OK)


def edge_slide(self: Transition, height: float, z: float) -> tuple[int, TransitionState]:
    """Decide what happens where stepping down found no ground.

    Returns
    -------
    stop : int
        1 to end the insert with the state, 0 to go on with the next attempt.
    ts : TransitionState
        The state.

    Notes
    -----
    retail: CTransition::edge_slide 0x0050B3D0, 05 ES-1…7.
    """
    sp, ci, oi = self.sphere_path, self.collision_info, self.object_info
    # ES-1
    if not oi.state & ON_WALKABLE_OI or not oi.state & EDGE_SLIDE:
        sp.walkable = None
        sp.restore_check_pos()
        ci.forget_contact()
        sp.cell_array_valid = 1
        return 1, TransitionState.OK
    # ES-2
    if ci.contact_plane_valid and ci.contact_plane.N.z < z:
        sp.walkable = None
        sp.restore_check_pos()
        ts = self.cliff_slide(ci.contact_plane)
        ci.forget_contact()
        return 0, ts
    # ES-3
    if sp.walkable is not None:
        sp.restore_check_pos()
        ci.forget_contact()
        ts = sp.precipice_slide(ci)
        return int(ts == TransitionState.COLLIDED), ts
    # ES-4
    if ci.contact_plane_valid:
        sp.walkable = None
        sp.restore_check_pos()
        sp.cell_array_valid = 1
        ci.forget_contact()
        return 1, TransitionState.OK
    # ES-5
    s, c = sp.global_sphere[0].center, sp.global_curr_center[0]
    sp.add_offset_to_check_pos(Vector3(f32(c.x - s.x), f32(c.y - s.y), f32(c.z - s.z)))
    self.step_down(height, z)
    ci.forget_contact()
    sp.restore_check_pos()
    # ES-6
    if _has_walkable(self):
        ci.forget_contact()
        sp.cache_localspace_sphere(sp.get_walkable_pos(), sp.walkable_scale)
        sp.set_walkable_check_pos(sp.localspace_sphere[0])
        ts = sp.precipice_slide(ci)
        return int(ts == TransitionState.COLLIDED), ts
    # ES-7
    sp.walkable = None
    sp.cell_array_valid = 1
    return 1, TransitionState.COLLIDED


def _has_walkable(self: Transition) -> bool:
    """Tell whether the probe of ES-5 has found a polygon; it changes the field behind this function."""
    return self.sphere_path.walkable is not None


def cliff_slide(self: Transition, plane: Plane) -> TransitionState:
    """Slide along the line where the last known plane meets a plane that is too steep.

    Where the displacement goes against that line's normal its component is doubled, not removed; so
    it is in retail.

    retail: CTransition::cliff_slide 0x0050A6D0, 05 CS-1…7.
    """
    sp, ci = self.sphere_path, self.collision_info
    N, L = plane.N, ci.last_known_contact_plane.N
    # CS-1
    a = N.y * L.z - N.z * L.y
    b = L.x * N.z - L.z * N.x
    c = (N.x * L.y - N.y * L.x) * 0.0
    # CS-2
    n = Vector3(f32(c - b), f32(a - c), f32(b * 0.0 - a * 0.0))
    # CS-3
    if n.normalize_check_small():
        return TransitionState.OK
    # CS-4
    block = sp.get_curr_pos_check_pos_block_offset()
    check, curr = sp.global_sphere[0].center, sp.global_curr_center[0]
    dx = check.x - curr.x
    dy = check.y - curr.y
    dz = f32(check.z - curr.z)
    x = f32(block.x + dx)
    k = ((block.z + dz) * n.z + (block.y + dy) * n.y) + x * n.x
    # CS-5
    if k <= 0.0:
        sp.add_offset_to_check_pos(Vector3(f32(n.x * k), f32(n.y * k), f32(n.z * k)))
        ci.set_collision_normal(n)
    # CS-6
    else:
        j = -k
        sp.add_offset_to_check_pos(Vector3(f32(n.x * j), f32(n.y * j), f32(n.z * j)))
        ci.set_collision_normal(Vector3(-n.x, -n.y, -n.z))
    # CS-7
    return TransitionState.ADJUSTED
