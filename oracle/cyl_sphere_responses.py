"""CCylSphere, what is done about a hit: step down or up, slide, land.

The functions here are methods of `oracle.cyl_sphere.CylSphere`. `disp` is the way from the cylinder's low
point to the centre of the sphere that is asked about, `radsum` the sum of the radii of cylinder and
sphere 0 less EPS, metres; the cylinder is in the block of the check position.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.constants import EPS, WALK_INTERP_LOWEST, Z_LANDING
from oracle.enums import TransitionState
from oracle.plane import Plane
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.collision_info import CollisionInfo
    from oracle.cyl_sphere import CylSphere
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition


def step_sphere_down(
    self: CylSphere,
    path: SpherePath,
    collisions: CollisionInfo,
    check_pos: Sphere,
    disp: Vector3,
    radsum: float,
) -> TransitionState:
    """Raise the mover until its sphere 0 rests upon the upper cap, wherever above it is.

    The contact plane counts as water. Creatures are stood upon too, unlike those shaped as spheres.

    retail: CCylSphere::step_sphere_down 0x0053A9B0, 07 10.2.
    """
    # 07 10.2.1
    if not self.overlaps(path, disp, radsum):
        return TransitionState.OK
    # 07 10.2.2
    sd = path.step_down_amt * path.walk_interp
    if abs(sd) < EPS:
        return TransitionState.COLLIDED
    # 07 10.2.3
    dz = self.height + check_pos.radius - disp.z
    # 07 10.2.4
    w = (1.0 - dz / sd) * path.walk_interp
    if w >= path.walk_interp or w < WALK_INTERP_LOWEST:
        return TransitionState.COLLIDED
    # 07 10.2.5
    s0 = path.global_sphere[0]
    dz_stored = f32(dz)
    pt = Vector3(s0.center.x, s0.center.y, f32((dz_stored - s0.radius) + s0.center.z))
    # 07 10.2.6
    collisions.set_contact_plane(Plane.from_point(Vector3(0.0, 0.0, 1.0), pt), 1)
    collisions.contact_plane_cell_id = path.check_pos.objcell_id
    path.walk_interp = f32(w)
    # 07 10.2.7
    path.add_offset_to_check_pos(Vector3(0.0, 0.0, dz_stored))
    return TransitionState.ADJUSTED


def normal_of_collision(
    self: CylSphere,
    path: SpherePath,
    check_pos: Sphere,
    disp: Vector3,
    radsum: float,
    sphere_num: int,
    normal: Vector3,
) -> int:
    """Find from where one of the mover's spheres came: from beside, from above or from below.

    Parameters
    ----------
    path : SpherePath
        Its current centres are taken to be in the cylinder's block.
    check_pos : Sphere
        The sphere where it is now.
    disp : Vector3
        From the low point to it.
    radsum : float
        The sum of the radii, metres.
    sphere_num : int
        Which of the mover's spheres it is.
    normal : Vector3
        Takes the normal; a side's is as long as the way to the axis.

    Returns
    -------
    int
        0 if it came from beside and from above or below, so that what it hit first is not known.

    Notes
    -----
    retail: CCylSphere::normal_of_collision 0x0053AB50, 07 10.3.
    """
    curr, low = path.global_curr_center[sphere_num], self.low_pt
    # 07 10.3.1
    ox = curr.x - low.x
    oy = curr.y - low.y
    oz = curr.z - low.z
    oz_stored = f32(oz)
    # 07 10.3.2
    if radsum * radsum < oy * oy + ox * ox:
        normal.assign(Vector3(f32(ox), f32(oy), 0.0))
        half = self.height * 0.5
        beside = (check_pos.radius - EPS) + half >= abs(half - oz_stored)
        return int(beside or abs(oz_stored - disp.z) <= EPS)
    # 07 10.3.3
    normal.assign(Vector3(0.0, 0.0, 1.0 if disp.z - oz_stored <= 0.0 else -1.0))
    return 1


def slide_sphere(
    self: CylSphere,
    path: SpherePath,
    collisions: CollisionInfo,
    check_pos: Sphere,
    disp: Vector3,
    radsum: float,
    sphere_num: int,
) -> TransitionState:
    """Slide one of the mover's spheres along the cylinder.

    retail: CCylSphere::slide_sphere 0x0053B2A0, 07 10.5.
    """
    # 07 10.5.1
    cn = Vector3()
    self.normal_of_collision(path, check_pos, disp, radsum, sphere_num, cn)
    # 07 10.5.2
    if cn.normalize_check_small():
        return TransitionState.COLLIDED
    # 07 10.5.3
    return check_pos.slide_sphere(path, collisions, cn, path.global_curr_center[sphere_num])


def step_sphere_up(
    self: CylSphere, transition: Transition, check_pos: Sphere, disp: Vector3, radsum: float
) -> TransitionState:
    """Try to step onto the cylinder, or slide along it if it is too high or that fails.

    retail: CCylSphere::step_sphere_up 0x0053B310, 07 10.6.
    """
    oi, path, coll = transition.object_info, transition.sphere_path, transition.collision_info
    # 07 10.6.1
    if oi.step_up_height < check_pos.radius + self.height - disp.z:
        return self.slide_sphere(path, coll, check_pos, disp, radsum, 0)
    # 07 10.6.2
    cn = Vector3()
    self.normal_of_collision(path, check_pos, disp, radsum, 0, cn)
    if cn.normalize_check_small():
        return TransitionState.COLLIDED
    # 07 10.6.3: the normal is a world normal already; retail turns it by the object's rotation all the same
    g = path.localspace_pos.localtoglobalvec(cn)
    # 07 10.6.4
    if transition.step_up(g):
        return TransitionState.OK
    return path.step_up_slide(oi, coll)


def land_on_cylinder(
    self: CylSphere, path: SpherePath, check_pos: Sphere, disp: Vector3, radsum: float
) -> TransitionState:
    """Begin a landing on the cylinder.

    retail: CCylSphere::land_on_cylinder 0x0053B3D0, 07 10.7.
    """
    # 07 10.7.1
    cn = Vector3()
    self.normal_of_collision(path, check_pos, disp, radsum, 0, cn)
    # 07 10.7.2
    if cn.normalize_check_small():
        return TransitionState.COLLIDED
    # 07 10.7.3
    path.set_collide(cn)
    path.walkable_allowance = Z_LANDING
    return TransitionState.ADJUSTED
