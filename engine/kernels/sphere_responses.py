"""CSphere as an obstacle, what is done about a hit (07, 3, 5-7): step up, slide, land, stop at a point."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import ADJUSTED, COLLIDED, EPS, NEEDS_STEP_UP, PERFECT_CLIP, SLID
from engine.kernels.collision_info import set_collision_normal, sliding_reference
from engine.kernels.compile import entry, kernel
from engine.kernels.obstacle import (
    SECOND,
    begin_landing,
    center_at,
    displacement,
    earlier_root,
    sphere_at,
)
from engine.kernels.path import add_offset_to_check_pos
from engine.kernels.rounding import f32
from engine.kernels.sphere import moved_so_far, slide_either_sphere
from engine.kernels.vector import load, normalize_check_small, store
from engine.layout import (
    GLOBAL_CURR_CENTER,
    GLOBAL_SPHERE,
    OI_STATE,
    REQUESTED_NORMAL,
    STEP_UP_HEIGHT,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array


@entry
def find_time_of_collision(
    mx: float, my: float, mz: float, dx: float, dy: float, dz: float, radsum: float
) -> float:
    """Return when a moving sphere touches one at rest, or -1 if it never does or overlaps already.

    m: the whole movement; d: from the resting centre to the moving one at its beginning; metres.

    retail: CSphere::find_time_of_collision 0x005368F0, 07 3
    """
    a = (mx * mx + my * my) + mz * mz
    dot = (dz * mz + dy * my) + mx * dx
    b = -dot
    c = ((dx * dx + dy * dy) + dz * dz) - radsum * radsum
    if c < EPS:
        return -1.0
    disc = b * b - c * a
    if a < EPS or disc < 0.0:
        return -1.0
    return earlier_root(math.sqrt(disc), dot) / a


@kernel
def step_sphere_up(s: Array, x: float, y: float, z: float, radsum: float) -> int:
    """Ask for a step onto the sphere, or slide along it if it is too high.

    retail: CSphere::step_sphere_up 0x00537900, 07 5
    """
    dx, dy, dz = displacement(s, GLOBAL_SPHERE, x, y, z)
    if s[STEP_UP_HEIGHT] < (radsum + EPS) - dz:
        return _slide_first_sphere(s, x, y, z, dx, dy, dz)
    nx, ny, nz = displacement(s, GLOBAL_CURR_CENTER, x, y, z)
    store(s, REQUESTED_NORMAL, nx, ny, nz)
    return NEEDS_STEP_UP


@kernel
def _slide_first_sphere(s: Array, x: float, y: float, z: float, dx: float, dy: float, dz: float) -> int:
    """Slide sphere 0 along a sphere that is too high to step on.

    retail: CSphere::slide_sphere 0x00536F40, 07 6.A
    """
    vx, vy, vz = displacement(s, GLOBAL_CURR_CENTER, x, y, z)
    small, cx, cy, cz = normalize_check_small(vx, vy, vz)
    if small:
        return COLLIDED
    set_collision_normal(s, cx, cy, cz)
    nx, ny, nz = sliding_reference(s)
    ex, ey, ez = f32(nz * cy - ny * cz), f32(cz * nx - nz * cx), f32(ny * cx - cy * nx)
    gx, gy, gz = moved_so_far(s, GLOBAL_SPHERE, GLOBAL_CURR_CENTER)
    length = (ez * ez + ey * ey) + ex * ex
    if length >= EPS:
        d = (gz * ez + gy * ey) + gx * ex
        inv = 1.0 / length
        ox, oy, oz = f32(f32(ex * d) * inv), f32(f32(ey * d) * inv), f32(f32(ez * d) * inv)
        if (oz * oz + oy * oy) + ox * ox < EPS:
            return COLLIDED
        add_offset_to_check_pos(s, f32(ox - gx), f32(oy - gy), f32(oz - gz))
        return SLID
    if (nz * dz + ny * dy) + nx * dx < 0.0:
        return COLLIDED
    d32 = f32((gz * cz + gy * cy) + gx * cx)
    add_offset_to_check_pos(s, f32((-cx) * d32), f32((-cy) * d32), f32((-cz) * d32))
    return SLID


@kernel
def slide_second_sphere(s: Array, x: float, y: float, z: float) -> int:
    """Slide along a sphere that only sphere 1 touches.

    retail: CSphere::slide_sphere 0x00537A10, 07 6.C
    """
    vx, vy, vz = displacement(s, center_at(SECOND), x, y, z)
    small, cx, cy, cz = normalize_check_small(vx, vy, vz)
    if small:
        return COLLIDED
    store(s, REQUESTED_NORMAL, cx, cy, cz)
    return slide_either_sphere(s, REQUESTED_NORMAL, sphere_at(SECOND), center_at(SECOND))


@kernel
def land_on_sphere(s: Array, x: float, y: float, z: float) -> int:
    """Begin a landing.

    retail: CSphere::land_on_sphere 0x005379A0, 07 7.1
    """
    vx, vy, vz = displacement(s, GLOBAL_CURR_CENTER, x, y, z)
    small, cx, cy, cz = normalize_check_small(vx, vy, vz)
    if small:
        return COLLIDED
    return begin_landing(s, cx, cy, cz)


@kernel
def collide_with_point(s: Array, x: float, y: float, z: float, radsum: float, number: int) -> int:
    """Stop the mover; a perfectly clipped one stops where it touches the sphere.

    retail: CSphere::collide_with_point 0x00537230, 07 7.2
    """
    at = sphere_at(number)
    dx, dy, dz = displacement(s, center_at(number), x, y, z)
    if not int(s[OI_STATE]) & PERFECT_CLIP:
        small, cx, cy, cz = normalize_check_small(dx, dy, dz)
        if not small:
            set_collision_normal(s, cx, cy, cz)
        return COLLIDED
    rs = f32(radsum + EPS)
    mx, my, mz = moved_so_far(s, at, center_at(number))
    t = find_time_of_collision(mx, my, mz, dx, dy, dz, rs)
    if t < EPS or t > 1.0:
        return COLLIDED
    px, py, pz = load(s, at)
    ux = mx * t - mx
    uy = f32(my * t) - my
    uz = f32(f32(mz * t) - mz)
    inv = 1.0 / rs
    ex = f32(f32(ux + px) - x)
    ey = f32((uy + py) - y)
    ez = (uz + pz) - z
    set_collision_normal(s, f32(ex * inv), f32(ey * inv), f32(ez * inv))
    add_offset_to_check_pos(s, f32(ux), f32(uy), uz)
    return ADJUSTED
