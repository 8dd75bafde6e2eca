"""CCylSphere as an obstacle, what is done about a hit (07, 10.3-10.7): step up, slide, land, stop."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from engine.constants import ADJUSTED, COLLIDED, EPS, NEEDS_STEP_UP, PERFECT_CLIP
from engine.kernels.collision_info import set_collision_normal
from engine.kernels.compile import inlined, kernel
from engine.kernels.obstacle import (
    FIRST,
    begin_landing,
    center_at,
    displacement,
    earlier_root,
    sphere_at,
)
from engine.kernels.path import add_offset_to_check_pos
from engine.kernels.position import position_localtoglobalvec
from engine.kernels.rounding import f32
from engine.kernels.sphere import moved_so_far, slide_either_sphere
from engine.kernels.vector import load, store
from engine.layout import (
    GLOBAL_CURR_CENTER,
    GLOBAL_SPHERE,
    OI_STATE,
    RADIUS,
    REQUESTED_NORMAL,
    STEP_UP_HEIGHT,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Vector

Contact = tuple[float, float, float, float, float, float, float]
"""When a contact is, as a fraction of the movement; the way to it, and its normal."""

NEVER: Final = -1.0
"""Stands for the time of a contact that there is not: outside of the movement."""


@inlined
def normal_of_collision(
    s: Array, x: float, y: float, z: float, h: float, radsum: float, number: int
) -> tuple[bool, float, float, float]:
    """Return the normal of what a sphere comes from, not normalised, and whether that is definite.

    It is not where the sphere comes from beside and from above, or from below.

    retail: CCylSphere::normal_of_collision 0x0053AB50, 07 10.3
    """
    at, curr = sphere_at(number), center_at(number)
    ox, oy, oz = s[curr] - x, s[curr + 1] - y, s[curr + 2] - z
    oz32, dz = f32(oz), f32(s[at + 2] - z)
    if radsum * radsum < oy * oy + ox * ox:
        half = h * 0.5
        beside = (s[at + RADIUS] - EPS) + half >= abs(half - oz32)
        return beside or abs(oz32 - dz) <= EPS, f32(ox), f32(oy), 0.0
    return True, 0.0, 0.0, 1.0 if dz - oz32 <= 0.0 else -1.0


@kernel
def step_sphere_up(
    wf: Array, s: Array, position: int, z: float, h: float, nx: float, ny: float, nz: float
) -> int:
    """Ask for a step onto the cylinder, or slide along it if it is too high.

    The normal is one of the block, and is turned once more by the object's rotation, as in retail.

    retail: CCylSphere::step_sphere_up 0x0053B310, 07 10.6
    """
    dz = f32(s[GLOBAL_SPHERE + 2] - z)
    if s[STEP_UP_HEIGHT] < (s[GLOBAL_SPHERE + RADIUS] + h) - dz:
        return slide_sphere(s, FIRST, nx, ny, nz)
    gx, gy, gz = position_localtoglobalvec(wf, position, nx, ny, nz)
    store(s, REQUESTED_NORMAL, gx, gy, gz)
    return NEEDS_STEP_UP


@inlined
def slide_sphere(s: Array, number: int, nx: float, ny: float, nz: float) -> int:
    """Slide one of the mover's spheres along the cylinder.

    retail: CCylSphere::slide_sphere 0x0053B2A0, 07 10.5
    """
    store(s, REQUESTED_NORMAL, nx, ny, nz)
    return slide_either_sphere(s, REQUESTED_NORMAL, sphere_at(number), center_at(number))


@kernel
def land_on_cylinder(s: Array, nx: float, ny: float, nz: float) -> int:
    """Begin a landing.

    retail: CCylSphere::land_on_cylinder 0x0053B3D0, 07 10.7
    """
    return begin_landing(s, nx, ny, nz)


@kernel
def collide_with_point(
    s: Array,
    x: float,
    y: float,
    z: float,
    h: float,
    radsum: float,
    number: int,
    definite: bool,
    nx: float,
    ny: float,
    nz: float,
) -> int:
    """Stop the mover; a perfectly clipped one stops where it touches the cylinder.

    The way there starts at sphere 0's current centre, whichever sphere is meant, and no block offset is
    added, as in retail.

    retail: CCylSphere::collide_with_point 0x0053ACB0, 07 10.4
    """
    if not int(s[OI_STATE]) & PERFECT_CLIP:
        set_collision_normal(s, nx, ny, nz)
        return COLLIDED
    at = sphere_at(number)
    r, rs = s[at + RADIUS], f32(radsum + EPS)
    mx, my, mz = moved_so_far(s, at, GLOBAL_CURR_CENTER)
    if not definite:
        t, ox, oy, oz, nx, ny, nz = _meet_corner(s, x, y, z, h, r, rs, mx, my, mz)
    elif nz != 0.0:
        t, ox, oy, oz = _meet_cap(s, z, h, r, mx, my, mz)
    else:
        t, ox, oy, oz, nx, ny, nz = _meet_side(s, x, y, z, rs, mx, my, mz)
    if not (t >= 0.0 and t <= 1.0):
        return COLLIDED
    cx, cy, cz = load(s, GLOBAL_CURR_CENTER)
    px, py, pz = load(s, at)
    set_collision_normal(s, nx, ny, nz)
    add_offset_to_check_pos(s, f32(f32(cx + ox) - px), f32(f32(cy + oy) - py), f32(f32(cz + oz) - pz))
    return ADJUSTED


@inlined
def _time_to_cap(h: float, r: float, mz: float, dz: float) -> float:
    """Return when a moving sphere touches the cap that it moves to.

    retail: 07 10.4.4.2
    """
    if mz > 0.0:
        return -((dz + r) / mz)
    return ((r + h) - dz) / mz


@inlined
def _outward(s: Array, x: float, y: float, ox: float, oy: float, rs: float) -> tuple[float, float]:
    """Return the side's normal where the sphere is after the way to the contact.

    retail: 07 10.4.4.4
    """
    hx = f32(f32(s[GLOBAL_CURR_CENTER] + ox) - x)
    hy = f32(f32(s[GLOBAL_CURR_CENTER + 1] + oy) - y)
    inv = 1.0 / rs
    return f32(inv * hx), f32(inv * hy)


@inlined
def _scaled(t: float, x: float, y: float, z: float) -> Vector:
    """Multiply a vector by a register that is stored before.

    retail: 07 0.5
    """
    f = f32(t)
    return f32(f * x), f32(f * y), f32(f * z)


@kernel
def _meet_corner(
    s: Array,
    x: float,
    y: float,
    z: float,
    h: float,
    r: float,
    rs: float,
    mx: float,
    my: float,
    mz: float,
) -> Contact:
    """Find the contact of a sphere that comes from beside and from above or below: with cap or side.

    retail: 07 10.4.4
    """
    if abs(mz) < EPS:
        return NEVER, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    dx, dy, dz = displacement(s, GLOBAL_CURR_CENTER, x, y, z)
    t = _time_to_cap(h, r, mz, dz)
    nx, ny, nz = 0.0, 0.0, -1.0 if mz > 0.0 else 1.0
    ox, oy, oz = f32(mx * t), f32(my * t), f32(t * mz)
    reach2 = f32(rs * rs)
    bx, by = ox + dx, oy + dy
    if by * by + bx * bx >= reach2:
        a = my * my + mx * mx
        if abs(a) < EPS:
            return NEVER, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        dot = my * dy + mx * dx
        b = -dot
        disc = b * b - ((dy * dy + dx * dx) - reach2) * a
        if disc >= 0.0 and a > EPS:
            t = earlier_root(math.sqrt(disc), dot) / a
            ox, oy, oz = _scaled(t, mx, my, mz)
        nx, ny = _outward(s, x, y, ox, oy, rs)
        nz = 0.0
    return t, ox, oy, oz, nx, ny, nz


@kernel
def _meet_cap(
    s: Array, z: float, h: float, r: float, mx: float, my: float, mz: float
) -> tuple[float, float, float, float]:
    """Find the contact of a sphere that comes from above or below.

    retail: 07 10.4.5
    """
    if abs(mz) < EPS:
        return NEVER, 0.0, 0.0, 0.0
    t = _time_to_cap(h, r, mz, f32(s[GLOBAL_CURR_CENTER + 2] - z))
    ox, oy, oz = _scaled(t, mx, my, mz)
    return t, ox, oy, oz


@kernel
def _meet_side(
    s: Array,
    x: float,
    y: float,
    z: float,
    rs: float,
    mx: float,
    my: float,
    mz: float,
) -> Contact:
    """Find the contact of a sphere that comes from beside; rs * rs is not stored here.

    retail: 07 10.4.6
    """
    dx, dy, _ = displacement(s, GLOBAL_CURR_CENTER, x, y, z)
    a = my * my + mx * mx
    dot = my * dy + mx * dx
    b = -dot
    disc = b * b - ((dy * dy + dx * dx) - rs * rs) * a
    if not (disc >= 0.0 and a >= EPS):
        return NEVER, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    t = earlier_root(math.sqrt(disc), dot) / a
    ox, oy, oz = _scaled(t, mx, my, mz)
    nx, ny = _outward(s, x, y, ox, oy, rs)
    return t, ox, oy, oz, nx, ny, 0.0
