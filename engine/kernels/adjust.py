"""CTransition::adjust_offset and cliff_slide (05, 3 and 6): bend a movement along planes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import ADJUSTED, EPS, OK
from engine.kernels.collision_info import set_collision_normal
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.path import add_offset_to_check_pos
from engine.kernels.plane import snap_to_plane
from engine.kernels.position import block_offset
from engine.kernels.rounding import f32
from engine.kernels.sphere import movement_along
from engine.kernels.vector import load, normalize_check_small
from engine.layout import (
    CHECK_POS,
    CONTACT_CELL_ID,
    CONTACT_IS_WATER,
    CONTACT_PLANE,
    CONTACT_VALID,
    GLOBAL_SPHERE,
    LAST_KNOWN_PLANE,
    RADIUS,
    SLIDING_NORMAL,
    SLIDING_VALID,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Vector


@entry
def adjust_offset(s: Array, x: float, y: float, z: float) -> Vector:
    """Bend an offset along the sliding normal and the contact plane; may lift the check position.

    retail: CTransition::adjust_offset 0x0050A370, AD-1...AD-9
    """
    slide = _still_slides(s, x, y, z)
    if s[CONTACT_VALID] == 0.0:
        if slide:
            return _along_sliding_plane(s, x, y, z)
        return x, y, z
    nx, ny, nz = load(s, CONTACT_PLANE)
    if slide:
        x, y, z = _along_crease(s, nx, ny, nz, x, y, z)
    else:
        p = f32((z * nz + y * ny) + x * nx)
        if p <= 0.0:
            c = f32(p * nz)
            x, y, z = f32(x - p * nx), f32(y - p * ny), f32(z - c)
        else:
            z = snap_to_plane(s, CONTACT_PLANE, x, y, z)
    if s[CONTACT_IS_WATER] == 0.0 and s[CONTACT_CELL_ID] != 0.0:
        _lift_out_of_plane(s)
    return x, y, z


@inlined
def _still_slides(s: Array, x: float, y: float, z: float) -> bool:
    """Say whether the offset goes against the sliding normal; otherwise forget that normal.

    retail: AD-1
    """
    if s[SLIDING_VALID] == 0.0:
        return False
    sx, sy, sz = load(s, SLIDING_NORMAL)
    if (z * sz + y * sy) + x * sx < 0.0:
        return True
    s[SLIDING_VALID] = 0.0
    return False


@kernel
def _along_crease(s: Array, nx: float, ny: float, nz: float, x: float, y: float, z: float) -> Vector:
    """Keep what runs along both the contact plane and the sliding plane.

    retail: AD-4
    """
    sx, sy, sz = load(s, SLIDING_NORMAL)
    small, cx, cy, cz = normalize_check_small(
        f32(sz * ny - sy * nz), f32(sx * nz - sz * nx), f32(sy * nx - sx * ny)
    )
    if small:
        return 0.0, 0.0, 0.0
    k = (cz * z + cy * y) + cx * x
    return f32(cx * k), f32(cy * k), f32(cz * k)


@kernel
def _along_sliding_plane(s: Array, x: float, y: float, z: float) -> Vector:
    """Take away what goes against the sliding normal.

    retail: AD-8
    """
    sx, sy, sz = load(s, SLIDING_NORMAL)
    k = (x * sx + z * sz) + y * sy
    b = f32(k * sy)
    c = f32(k * sz)
    return f32(x - k * sx), f32(y - b), f32(z - c)


@kernel
def _lift_out_of_plane(s: Array) -> None:
    """Lift the check position until sphere 0, measured along z, touches the contact plane.

    retail: AD-7
    """
    bx, by = block_offset(s[CHECK_POS], s[CONTACT_CELL_ID])
    nx, ny, nz = load(s, CONTACT_PLANE)
    x, y, z = load(s, GLOBAL_SPHERE)
    radius = s[GLOBAL_SPHERE + RADIUS]
    dist = (((z - 0.0) * nz + (y - by) * ny) + (x - bx) * nx) + s[CONTACT_PLANE + 3]
    if dist < radius - EPS:
        h = (radius - dist) / nz
        if radius > abs(h):
            add_offset_to_check_pos(s, 0.0, 0.0, f32(h))


@entry
def cliff_slide(s: Array, plane: int) -> int:
    """Slide along the line in which a plane too steep to walk on meets the last known one.

    `plane` is where that plane lies in the row. Retail's asymmetry is kept: a movement against the
    line's normal is doubled, not removed.

    retail: CTransition::cliff_slide 0x0050A6D0, CS-1...CS-7
    """
    nx, ny, nz = load(s, plane)
    lx, ly, lz = load(s, LAST_KNOWN_PLANE)
    a = ny * lz - nz * ly
    b = lx * nz - lz * nx
    c = (nx * ly - ny * lx) * 0.0
    small, cx, cy, cz = normalize_check_small(f32(c - b), f32(a - c), f32(b * 0.0 - a * 0.0))
    if small:
        return OK
    k = movement_along(s, cx, cy, cz)
    if k <= 0.0:
        add_offset_to_check_pos(s, f32(cx * k), f32(cy * k), f32(cz * k))
        set_collision_normal(s, cx, cy, cz)
    else:
        j = -k
        add_offset_to_check_pos(s, f32(cx * j), f32(cy * j), f32(cz * j))
        set_collision_normal(s, -cx, -cy, -cz)
    return ADJUSTED
