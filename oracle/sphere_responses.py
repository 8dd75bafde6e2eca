"""CSphere as an obstacle, what is done about a hit: step down or up, slide, land, stop at a point.

The functions here are methods of `oracle.sphere.Sphere`. `disp` is the way from the obstacle's centre to
the mover's sphere 0, `radsum` the sum of the two radii less EPS, metres; the obstacle is in the block of
the check position. Some functions take that the current position is in the same block.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import divide, f32, is_nan, sqrt
from oracle.constants import EPS, WALK_INTERP_LOWEST, Z_LANDING
from oracle.enums import PERFECT_CLIP_OI, TransitionState
from oracle.errors import UndeterminedError
from oracle.plane import Plane
from oracle.sphere_obstacle import collides_with_sphere, find_time_of_collision
from oracle.vector import Vector3, minus, plus, scaled

if TYPE_CHECKING:
    from oracle.collision_info import CollisionInfo
    from oracle.object_info import ObjectInfo
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition


def step_sphere_down(
    self: Sphere,
    path: SpherePath,
    collisions: CollisionInfo,
    check_pos: Sphere,
    disp: Vector3,
    radsum: float,
) -> TransitionState:
    """Raise the mover until its sphere 0 rests upon this sphere, if that is flat enough there.

    The contact plane counts as water. `disp` is the caller's own vector and is overwritten.

    Raises
    ------
    UndeterminedError
        Only sphere 1 overlaps, and sphere 0 is beside this sphere: retail's root is NaN (07 11).

    Notes
    -----
    retail: CSphere::step_sphere_down 0x00536D20, 07 4.
    """
    # 07 4.1
    yy = f32(disp.y * disp.y)
    xx = f32(disp.x * disp.x)
    # 07 4.2
    if radsum * radsum < disp.z * disp.z + xx + yy:
        if path.num_sphere <= 1:
            return TransitionState.OK
        disp2 = minus(path.global_sphere[1].center, self.center)
        if not collides_with_sphere(disp2, radsum):
            return TransitionState.OK
    # 07 4.3
    sd = path.step_down_amt * path.walk_interp
    sd_stored = f32(sd)
    # 07 4.4
    if abs(sd) < EPS:
        return TransitionState.COLLIDED
    # 07 4.5
    rs = radsum + EPS
    rs_stored = f32(rs)
    # 07 4.6: sphere 0 is meant, also if only sphere 1 overlaps
    root = sqrt(rs * rs_stored - (xx + yy))
    if is_nan(root):
        raise UndeterminedError("a step down onto a sphere that sphere 0 passes beside (07 4.6, 07 11)")
    t = (root - disp.z) / sd_stored
    # 07 4.7
    w = (1.0 - t) * path.walk_interp
    # 07 4.8
    if w >= path.walk_interp or w < WALK_INTERP_LOWEST:
        return TransitionState.COLLIDED
    # 07 4.9
    dz = f32(sd_stored * t)
    # 07 4.10
    nz = dz + disp.z
    disp.z = f32(nz)
    # 07 4.11
    inv = divide(1.0, rs_stored)
    disp.x = f32(inv * disp.x)
    disp.y = f32(inv * disp.y)
    nz2 = nz * inv
    disp.z = f32(nz2)
    # 07 4.12
    if nz2 <= path.walkable_allowance:
        return TransitionState.OK
    # 07 4.13
    pt = plus(self.center, scaled(self.radius, disp))
    # 07 4.14
    collisions.set_contact_plane(Plane.from_point(disp, pt), 1)
    # 07 4.15
    collisions.contact_plane_cell_id = path.check_pos.objcell_id
    path.walk_interp = f32(w)
    # 07 4.16
    path.add_offset_to_check_pos(Vector3(0.0, 0.0, dz))
    return TransitionState.ADJUSTED


def step_sphere_up(
    self: Sphere, transition: Transition, check_pos: Sphere, disp: Vector3, radsum: float
) -> TransitionState:
    """Try to step onto this sphere, or slide along it if it is too high or that fails.

    retail: CSphere::step_sphere_up 0x00537900, 07 5.
    """
    oi, path, coll = transition.object_info, transition.sphere_path, transition.collision_info
    # 07 5.1
    r = radsum + EPS
    # 07 5.2
    if oi.step_up_height < r - disp.z:
        return self.slide_sphere_along(path, coll, disp, 0)
    # 07 5.3
    n = minus(path.global_curr_center[0], self.center)
    # 07 5.4
    if transition.step_up(n):
        return TransitionState.OK
    return path.step_up_slide(oi, coll)


def slide_sphere_along(
    self: Sphere, path: SpherePath, collisions: CollisionInfo, disp: Vector3, sphere_num: int
) -> TransitionState:
    """Slide one of the mover's spheres along this sphere, which is too high to step upon.

    retail: CSphere::slide_sphere 0x00536F40, 07 6.A.
    """
    # 07 6.A.1
    sphere, curr = path.global_sphere[sphere_num], path.global_curr_center[sphere_num]
    # 07 6.A.2
    cn = minus(curr, self.center)
    if cn.normalize_check_small():
        return TransitionState.COLLIDED
    # 07 6.A.3
    collisions.set_collision_normal(cn)
    # 07 6.A.4: the last known plane counts even if it is not valid
    plane = (
        collisions.contact_plane if collisions.contact_plane_valid else collisions.last_known_contact_plane
    )
    n = plane.N
    # 07 6.A.5
    dir_x = f32(n.z * cn.y - n.y * cn.z)
    dir_y = f32(cn.z * n.x - n.z * cn.x)
    dir_z = f32(n.y * cn.x - cn.y * n.x)
    # 07 6.A.6
    b = path.get_curr_pos_check_pos_block_offset()
    # 07 6.A.7
    gx = f32(b.x + (sphere.center.x - curr.x))
    gy = f32(b.y + (sphere.center.y - curr.y))
    tz = f32(sphere.center.z - curr.z)
    gz = f32(b.z + tz)
    # 07 6.A.8
    length = dir_z * dir_z + dir_y * dir_y + dir_x * dir_x
    # 07 6.A.9
    if length >= EPS:
        d = gz * dir_z + gy * dir_y + gx * dir_x
        skew = Vector3(f32(dir_x * d), f32(dir_y * d), f32(dir_z * d))
        inv = 1.0 / length
        off = Vector3(f32(skew.x * inv), f32(skew.y * inv), f32(skew.z * inv))
        if off.z * off.z + off.y * off.y + off.x * off.x < EPS:
            return TransitionState.COLLIDED
        path.add_offset_to_check_pos(minus(off, Vector3(gx, gy, gz)))
        return TransitionState.SLID
    # 07 6.A.10
    if n.z * disp.z + n.y * disp.y + n.x * disp.x < 0.0:
        return TransitionState.COLLIDED
    # 07 6.A.11
    d = f32(gz * cn.z + gy * cn.y + gx * cn.x)
    path.add_offset_to_check_pos(Vector3(f32(-cn.x * d), f32(-cn.y * d), f32(-cn.z * d)))
    return TransitionState.SLID


def slide_sphere_off(
    self: Sphere, path: SpherePath, collisions: CollisionInfo, check_pos: Sphere, sphere_num: int
) -> TransitionState:
    """Slide one of the mover's spheres along this sphere, which the mover's head has touched.

    retail: CSphere::slide_sphere 0x00537A10, 07 6.C.
    """
    # 07 6.C.1
    curr = path.global_curr_center[sphere_num]
    cn = minus(curr, self.center)
    # 07 6.C.2
    if cn.normalize_check_small():
        return TransitionState.COLLIDED
    return check_pos.slide_sphere(path, collisions, cn, curr)


def land_on_sphere(self: Sphere, path: SpherePath) -> TransitionState:
    """Begin a landing on this sphere.

    retail: CSphere::land_on_sphere 0x005379A0, 07 7.1.
    """
    # 07 7.1.1
    cn = minus(path.global_curr_center[0], self.center)
    # 07 7.1.2
    if cn.normalize_check_small():
        return TransitionState.COLLIDED
    # 07 7.1.3
    path.set_collide(cn)
    # 07 7.1.4
    path.walkable_allowance = Z_LANDING
    # 07 7.1.5
    return TransitionState.ADJUSTED


def collide_with_point(
    self: Sphere,
    oi: ObjectInfo,
    path: SpherePath,
    collisions: CollisionInfo,
    check_pos: Sphere,
    radsum: float,
    sphere_num: int,
) -> TransitionState:
    """Stop at this sphere; a perfectly clipped mover stops where its sphere touches it.

    retail: CSphere::collide_with_point 0x00537230, 07 7.2.
    """
    this, curr, p = self.center, path.global_curr_center[sphere_num], check_pos.center
    # 07 7.2.1
    if not oi.state & PERFECT_CLIP_OI:
        cn = minus(curr, this)
        if cn.normalize_check_small() == 0:
            collisions.set_collision_normal(cn)
        return TransitionState.COLLIDED
    # 07 7.2.2
    rs = f32(radsum + EPS)
    # 07 7.2.3
    od = minus(curr, this)
    # 07 7.2.4
    b = path.get_curr_pos_check_pos_block_offset()
    mx = f32(b.x + (p.x - curr.x))
    my = f32(b.y + (p.y - curr.y))
    tz = f32(p.z - curr.z)
    mz = f32(b.z + tz)
    # 07 7.2.5
    t = find_time_of_collision(Vector3(mx, my, mz), od, rs)
    if t < EPS or t > 1.0:
        return TransitionState.COLLIDED
    # 07 7.2.6
    qy = f32(my * t)
    qz = f32(mz * t)
    # 07 7.2.7
    ux = mx * t - mx
    uy = qy - my
    uz_stored = f32(qz - mz)
    off = Vector3(f32(ux), f32(uy), uz_stored)
    # 07 7.2.8
    ex = f32(f32(ux + p.x) - this.x)
    ey = f32((uy + p.y) - this.y)
    ez = (uz_stored + p.z) - this.z
    inv = divide(1.0, rs)
    cn = Vector3(f32(ex * inv), f32(ey * inv), f32(ez * inv))
    # 07 7.2.9
    collisions.set_collision_normal(cn)
    path.add_offset_to_check_pos(off)
    return TransitionState.ADJUSTED
