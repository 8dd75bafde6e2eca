"""CCylSphere::collide_with_point: a path-clipped mover stops at a cylinder, and so does a flying head.

A perfectly clipped mover stops where it first touches the cylinder: at the side, at a cap, or, where it
came from beside and from above or below, at the cap's plane unless it meets that outside of the rim.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from oracle.arithmetic import f32, sqrt
from oracle.constants import EPS
from oracle.enums import PERFECT_CLIP_OI, TransitionState
from oracle.sphere_obstacle import first_root
from oracle.vector import Vector3, minus, plus, scaled

if TYPE_CHECKING:
    from oracle.collision_info import CollisionInfo
    from oracle.cyl_sphere import CylSphere
    from oracle.object_info import ObjectInfo
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath


class Approach(NamedTuple):
    """How the mover comes to a cylinder: from where its *sphere 0* was, whichever sphere has hit.

    Attributes
    ----------
    curr : Vector3
        Centre of sphere 0 at the current position, in that position's block, metres.
    radius : float
        Of the sphere that has hit, metres.
    m : Vector3
        The movement from `curr` to the sphere that has hit.
    od : Vector3
        From the cylinder's low point to `curr`.
    rs : float
        The sum of the radii of cylinder and sphere 0, metres.
    """

    curr: Vector3
    radius: float
    m: Vector3
    od: Vector3
    rs: float


class Touch(NamedTuple):
    """Where the mover touches: fraction of the movement (a register), that much of it, and normal."""

    time: float
    off: Vector3
    normal: Vector3


def collide_with_point(
    self: CylSphere,
    oi: ObjectInfo,
    path: SpherePath,
    collisions: CollisionInfo,
    check_pos: Sphere,
    disp: Vector3,
    radsum: float,
    sphere_num: int,
) -> TransitionState:
    """Stop at this cylinder; a perfectly clipped mover stops where it touches it.

    retail: CCylSphere::collide_with_point 0x0053ACB0, 07 10.4.
    """
    p = check_pos.center
    # 07 10.4.1
    cn = Vector3()
    definite = self.normal_of_collision(path, check_pos, disp, radsum, sphere_num, cn)
    if cn.normalize_check_small():
        return TransitionState.COLLIDED
    # 07 10.4.2
    if not oi.state & PERFECT_CLIP_OI:
        collisions.set_collision_normal(cn)
        return TransitionState.COLLIDED
    # 07 10.4.3
    curr, b = path.global_curr_center[0], path.get_curr_pos_check_pos_block_offset()
    mx = f32(b.x + (p.x - curr.x))
    my = f32(b.y + (p.y - curr.y))
    tz = f32(p.z - curr.z)
    mz = f32(b.z + tz)
    od = minus(curr, self.low_pt)
    way = Approach(curr, check_pos.radius, Vector3(mx, my, mz), od, f32(radsum + EPS))
    if not definite:
        touch = _touch_corner(self, way)
    elif cn.z != 0.0:
        touch = _touch_cap(self, way, cn)
    else:
        touch = _touch_side(self, way)
    # 07 10.4.7, which holds for a side too (07 10.4.6)
    if touch is None or not touch.time >= 0.0 or touch.time > 1.0:
        return TransitionState.COLLIDED
    # 07 10.4.8: across a border of landblocks this is wrong by a block
    offset = minus(plus(curr, touch.off), p)
    collisions.set_collision_normal(touch.normal)
    path.add_offset_to_check_pos(offset)
    return TransitionState.ADJUSTED


def _cap_time(cylinder: CylSphere, way: Approach) -> float | None:
    """Return when the sphere touches the plane of the cap it moves to; None if it moves level (07 10.4.4)."""
    mz = way.m.z
    # 07 10.4.4.1
    if abs(mz) < EPS:
        return None
    # 07 10.4.4.2
    if mz > 0.0:
        return -((way.od.z + way.radius) / mz)
    return (way.radius + cylinder.height - way.od.z) / mz


def _touch_corner(cylinder: CylSphere, way: Approach) -> Touch | None:
    """Touch the plane of a cap or, outside of its rim, the side if that is ever reached (07 10.4.4)."""
    m, od = way.m, way.od
    t = _cap_time(cylinder, way)
    if t is None:
        return None
    # 07 10.4.4.3
    cn = Vector3(0.0, 0.0, -1.0 if m.z > 0.0 else 1.0)
    off = Vector3(f32(m.x * t), f32(m.y * t), f32(t * m.z))
    rs2 = f32(way.rs * way.rs)
    # 07 10.4.4.4
    x, y = off.x + od.x, off.y + od.y
    if y * y + x * x >= rs2:
        a = m.y * m.y + m.x * m.x
        if abs(a) < EPS:
            return None
        dot = m.y * od.y + m.x * od.x
        b = -dot
        disc = b * b - (od.y * od.y + od.x * od.x - rs2) * a
        # the limit itself does not count here, unlike at a side
        if disc >= 0.0 and a > EPS:
            t = first_root(sqrt(disc), dot, b) / a
            off = scaled(f32(t), m)
        cn = _side_normal(cylinder, way, off)
    return Touch(t, off, cn)


def _touch_cap(cylinder: CylSphere, way: Approach, cn: Vector3) -> Touch | None:
    """Touch the plane of a cap (07 10.4.5)."""
    t = _cap_time(cylinder, way)
    return None if t is None else Touch(t, scaled(f32(t), way.m), cn)


def _touch_side(cylinder: CylSphere, way: Approach) -> Touch | None:
    """Touch the side (07 10.4.6)."""
    m, od = way.m, way.od
    a = m.y * m.y + m.x * m.x
    dot = m.y * od.y + m.x * od.x
    b = -dot
    # the squared radius sum is not rounded here, unlike at a corner
    disc = b * b - (od.y * od.y + od.x * od.x - way.rs * way.rs) * a
    if not disc >= 0.0 or a < EPS:
        return None
    t = first_root(sqrt(disc), dot, b) / a
    off = scaled(f32(t), m)
    return Touch(t, off, _side_normal(cylinder, way, off))


def _side_normal(cylinder: CylSphere, way: Approach, off: Vector3) -> Vector3:
    """Return the way from the axis to the touching sphere, level, divided by the radius sum (07 10.4.4)."""
    h = minus(plus(way.curr, off), cylinder.low_pt)
    cn = Vector3(h.x, h.y, 0.0)
    cn.divide_by(way.rs)
    return cn
