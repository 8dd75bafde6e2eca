"""CSphere::slide_sphere as the transition uses it (07, 6.B)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import ADJUSTED, COLLIDED, EPS, SLID
from engine.kernels.collision_info import set_collision_normal, sliding_reference
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.path import add_offset_to_check_pos
from engine.kernels.position import block_offset
from engine.kernels.rounding import f32
from engine.kernels.vector import load, normalize_check_small, store
from engine.layout import CHECK_POS, CURR_POS, GLOBAL_CURR_CENTER, GLOBAL_SPHERE

if TYPE_CHECKING:
    from engine.kernels.types import Array, Vector


@inlined
def moved_so_far(s: Array, sphere: int, center: int) -> Vector:
    """Return the way from the current to the check position, in the current block.

    `sphere` and `center` are where the sphere's two centres lie in the row.

    retail: 07 6.B.3
    """
    bx, by = block_offset(s[CURR_POS], s[CHECK_POS])
    gx = f32(bx + (s[sphere] - s[center]))
    gy = f32(by + (s[sphere + 1] - s[center + 1]))
    tz = f32(s[sphere + 2] - s[center + 2])
    return gx, gy, f32(0.0 + tz)


@inlined
def movement_along(s: Array, nx: float, ny: float, nz: float) -> float:
    """Return the component of that way along a normal, rounded as edges and cliffs do.

    retail: PS-5, CS-4
    """
    bx, by = block_offset(s[CURR_POS], s[CHECK_POS])
    dx = s[GLOBAL_SPHERE] - s[GLOBAL_CURR_CENTER]
    dy = s[GLOBAL_SPHERE + 1] - s[GLOBAL_CURR_CENTER + 1]
    dz = f32(s[GLOBAL_SPHERE + 2] - s[GLOBAL_CURR_CENTER + 2])
    wx = f32(bx + dx)
    return (nz * (0.0 + dz) + (by + dy) * ny) + wx * nx


@entry
def slide_sphere(s: Array, at: int) -> int:
    """Slide sphere 0 along an obstacle whose normal lies at `at` in the row, and may be overwritten.

    retail: CSphere::slide_sphere 0x00537440, 07 6.B.1-9
    """
    return slide_either_sphere(s, at, GLOBAL_SPHERE, GLOBAL_CURR_CENTER)


@kernel
def slide_either_sphere(s: Array, at: int, sphere: int, center: int) -> int:
    """Slide one of the mover's spheres, whose two centres lie at `sphere` and `center` in the row.

    The obstacle's normal lies at `at`, and may be overwritten.

    retail: CSphere::slide_sphere 0x00537440, 07 6.B.1-9
    """
    cx, cy, cz = load(s, at)
    if cx == 0.0 and cy == 0.0 and cz == 0.0:
        return _back_half_way(s, sphere, center)
    set_collision_normal(s, cx, cy, cz)
    gx, gy, gz = moved_so_far(s, sphere, center)
    nx, ny, nz = sliding_reference(s)
    dx = f32(cy * nz - cz * ny)
    dy = nx * cz - nz * cx
    dzr = ny * cx - nx * cy
    dz = f32(dzr)
    length = (dzr * dz + dy * dy) + dx * dx
    if length >= EPS:
        return _slide_along_crease(s, length, dx, dy, dz, gx, gy, gz)
    if (cz * nz + cy * ny) + nx * cx >= 0.0:
        d = f32((gx * cx + gz * cz) + gy * cy)
        add_offset_to_check_pos(s, f32((-cx) * d), f32((-cy) * d), f32((-cz) * d))
        return SLID
    small, ox, oy, oz = normalize_check_small(-gx, -gy, -gz)
    store(s, at, ox, oy, oz)
    if not small:
        set_collision_normal(s, ox, oy, oz)
    return COLLIDED


@kernel
def _back_half_way(s: Array, sphere: int, center: int) -> int:
    """Without a normal: go half of the way back.

    retail: 07 6.B.1
    """
    ox = f32((s[center] - s[sphere]) * 0.5)
    oy = f32(f32(s[center + 1] - s[sphere + 1]) * 0.5)
    oz = f32(f32(s[center + 2] - s[sphere + 2]) * 0.5)
    add_offset_to_check_pos(s, ox, oy, oz)
    return ADJUSTED


@kernel
def _slide_along_crease(
    s: Array, length: float, dx: float, dy: float, dz: float, gx: float, gy: float, gz: float
) -> int:
    """Keep of the movement what runs along the crease of obstacle and ground.

    retail: 07 6.B.7
    """
    d = (dz * gz + dy * gy) + dx * gx
    oy = f32(dy * d)
    oz = f32(dz * d)
    inv = 1.0 / f32(length)
    inv32 = f32(inv)
    ox = (dx * d) * inv
    py = f32(oy * inv32)
    pz = f32(oz * inv32)
    if (pz * pz + py * py) + ox * ox < EPS:
        return COLLIDED
    add_offset_to_check_pos(s, f32(ox - gx), f32(py - gy), f32(pz - gz))
    return SLID
