"""BSPTREE::placement_insert (03, 17): push the spheres out of solid matter."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import ADJUSTED, COLLIDED, OK, PLACEMENT_TRIES
from engine.kernels.bsp_ground import center_check_flag
from engine.kernels.bsp_poly import sphere_intersects_solid_poly
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.path import add_offset_to_check_pos, enter_second_sphere
from engine.kernels.polygon_adjust import polygon_placement_push
from engine.kernels.position import position_localtoglobalvec
from engine.kernels.rounding import f32
from engine.kernels.trace import INITIAL_PLACEMENT_CALL, trace_close, trace_open
from engine.kernels.vector import load
from engine.layout import (
    LOCALSPACE_POS,
    LOCALSPACE_SPHERE,
    NO_POLYGON,
    NOT_SOLID,
    NUM_SPHERE,
    RADIUS,
    SPHERE_SIZE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Vector


@entry
def placement_insert(wf: Array, wi: Ints, s: Array, root: int) -> int:
    """Push the row's local-space spheres out of a tree's solid matter.

    retail: BSPTREE::placement_insert 0x00539960, PI-1...PI-9
    """
    trace_open(wi, s, INITIAL_PLACEMENT_CALL)
    ts = _placement_insert(wf, wi, s, root)
    trace_close(wi, s, ts)
    return ts


@entry
def pushed(x: float, y: float, z: float, ox: float, oy: float, oz: float) -> Vector:
    """Add a push to a centre.

    retail: AQ-4
    """
    return f32(ox + x), f32(oy + y), f32(oz + z)


@kernel
def _placement_insert(wf: Array, wi: Ints, s: Array, root: int) -> int:
    """Push one sphere, then the other, at most `PLACEMENT_TRIES` times.

    retail: PI-1...PI-7
    """
    one = s[NUM_SPHERE] <= 1.0
    if not one:
        enter_second_sphere(s)
    ax, ay, az = load(s, LOCALSPACE_SPHERE)
    ar = s[LOCALSPACE_SPHERE + RADIUS]
    bx, by, bz = load(s, LOCALSPACE_SPHERE + SPHERE_SIZE)
    br = s[LOCALSPACE_SPHERE + SPHERE_SIZE + RADIUS]
    r = ar
    poly = NO_POLYGON
    flag = center_check_flag(s)
    for i in range(PLACEMENT_TRIES):
        second = False
        hit, solid, poly = sphere_intersects_solid_poly(
            wf, wi, s, root, (ax, ay, az, ar), r, NOT_SOLID, poly, flag
        )
        if hit == 0:
            if one:
                return _finish_one(s, i, ax, ay, az)
            second = True
            hit, solid, poly = sphere_intersects_solid_poly(
                wf, wi, s, root, (bx, by, bz, br), r, solid, poly, flag
            )
            if hit == 0:
                return _finish_two(s, i, ax, ay, az)
        if poly == NO_POLYGON:
            r = f32(r + r)
            continue
        if second:
            ox, oy, oz = polygon_placement_push(wf, poly, bx, by, bz, r, solid, flag)
        else:
            ox, oy, oz = polygon_placement_push(wf, poly, ax, ay, az, r, solid, flag)
        ax, ay, az = pushed(ax, ay, az, ox, oy, oz)
        bx, by, bz = pushed(bx, by, bz, ox, oy, oz)
        poly = NO_POLYGON
        r = ar
    return COLLIDED


@inlined
def _finish_one(s: Array, tries: int, x: float, y: float, z: float) -> int:
    """Move the check position as the only sphere was pushed; registers are rotated.

    retail: PI-5, PI-8
    """
    if tries == 0:
        return OK
    sx, sy, sz = load(s, LOCALSPACE_SPHERE)
    ox, oy, oz = position_localtoglobalvec(s, LOCALSPACE_POS, x - sx, y - sy, z - sz)
    add_offset_to_check_pos(s, ox, oy, oz)
    return ADJUSTED


@inlined
def _finish_two(s: Array, tries: int, x: float, y: float, z: float) -> int:
    """Move the check position as sphere 0 was pushed; the stored difference is rotated.

    retail: PI-6, PI-9
    """
    if tries == 0:
        return OK
    sx, sy, sz = load(s, LOCALSPACE_SPHERE)
    ox, oy, oz = position_localtoglobalvec(s, LOCALSPACE_POS, f32(x - sx), f32(y - sy), f32(z - sz))
    add_offset_to_check_pos(s, ox, oy, oz)
    return ADJUSTED
