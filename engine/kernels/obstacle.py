"""What spheres and cylinders have in common as obstacles (07): who overlaps, landing, standing on top.

An obstacle is given in the block of the check position. A sphere of the mover is named by its number,
0 or 1; where its centres at the check and at the current position lie in the row, follows from that.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine.constants import ADJUSTED, LEAST_WALK_INTERP, PLACEMENT_INSERT, Z_LANDING, frozen
from engine.kernels.collision_info import set_contact_plane
from engine.kernels.compile import inlined, kernel
from engine.kernels.path import set_collide
from engine.kernels.position import block_offset
from engine.kernels.rounding import f32
from engine.kernels.vector import load
from engine.layout import (
    CHECK_POS,
    CURR_POS,
    GLOBAL_CURR_CENTER,
    GLOBAL_SPHERE,
    INSERT_TYPE,
    OBSTRUCTION_ETHEREAL,
    SPHERE_SIZE,
    VECTOR_SIZE,
    WALK_INTERP,
    WALKABLE_ALLOWANCE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Vector

NEITHER: Final = frozen(-1)
"""Stands for the number of a sphere: none of the mover's overlaps."""
FIRST: Final = frozen(0)
SECOND: Final = frozen(1)


@inlined
def sphere_at(number: int) -> int:
    """Return where a sphere's centre at the check position lies in the row."""
    return GLOBAL_SPHERE + SPHERE_SIZE * number


@inlined
def center_at(number: int) -> int:
    """Return where a sphere's centre at the current position lies in the row."""
    return GLOBAL_CURR_CENTER + VECTOR_SIZE * number


@inlined
def displacement(s: Array, at: int, x: float, y: float, z: float) -> Vector:
    """Return the way from an obstacle's point to a centre at `at` in the row; no block offset is added.

    retail: 07 8.1, 6.A.2
    """
    return f32(s[at] - x), f32(s[at + 1] - y), f32(s[at + 2] - z)


@inlined
def asks_for_overlap(s: Array) -> bool:
    """Say whether only an overlap is asked for: when placing, or where the touch does not block.

    retail: 07 8.4, 10.8.2
    """
    return s[OBSTRUCTION_ETHEREAL] != 0.0 or s[INSERT_TYPE] == PLACEMENT_INSERT


@inlined
def way_back(s: Array) -> Vector:
    """Return the way of sphere 0 from the check position back to the current one.

    retail: 07 8.8.3, 10.8.6.1
    """
    bx, by = block_offset(s[CURR_POS], s[CHECK_POS])
    x, y, z = load(s, GLOBAL_SPHERE)
    cx, cy, cz = load(s, GLOBAL_CURR_CENTER)
    return f32(f32(cx - x) - bx), f32(f32(cy - y) - by), f32(f32(cz - z) - 0.0)


@inlined
def earlier_root(q: float, dot: float) -> float:
    """Return the lesser root of a quadratic that is not negative, or the greater; not divided yet.

    retail: 07 3.8
    """
    b = -dot
    return q - dot if b - q < 0.0 else b - q


@inlined
def within_step(s: Array, w: float) -> bool:
    """Say whether what would remain of the step is less than now, and not too far below nothing.

    NaN is not within.

    retail: 07 4.8, 8.8.10, 11
    """
    return w < s[WALK_INTERP] and w >= LEAST_WALK_INTERP


@kernel
def stand_upon(s: Array, nx: float, ny: float, nz: float, px: float, py: float, pz: float, w: float) -> None:
    """Make the plane of a normal and a point the contact plane, as water; `w` remains of the step.

    retail: 07 4.14-15, 8.8.14, 10.2.6, 10.8.6.5
    """
    d = f32(-((pz * nz + py * ny) + px * nx))
    set_contact_plane(s, nx, ny, nz, d, 1.0, s[CHECK_POS])
    s[WALK_INTERP] = f32(w)


@inlined
def begin_landing(s: Array, x: float, y: float, z: float) -> int:
    """Note that an airborne mover struck something with a normal of unit length.

    retail: 07 7.1.3-5, 10.7.3
    """
    set_collide(s, x, y, z)
    s[WALKABLE_ALLOWANCE] = Z_LANDING
    return ADJUSTED
