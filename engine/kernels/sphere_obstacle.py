"""CSphere as an obstacle (07, 2-9): does the mover run into it, and what happens then."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import (
    ADJUSTED,
    COLLIDED,
    CONTACT,
    EPS,
    NEEDS_STEP_UP,
    OK,
    ON_WALKABLE,
    PATH_CLIPPED,
)
from engine.kernels.compile import inlined, kernel
from engine.kernels.obstacle import (
    FIRST,
    NEITHER,
    SECOND,
    asks_for_overlap,
    displacement,
    sphere_at,
    stand_upon,
    way_back,
    within_step,
)
from engine.kernels.path import add_offset_to_check_pos
from engine.kernels.position import position_localtoglobal
from engine.kernels.rounding import f32
from engine.kernels.sphere_responses import (
    collide_with_point,
    land_on_sphere,
    slide_second_sphere,
    step_sphere_up,
)
from engine.kernels.trace import SPHERE_CALL, trace_close, trace_open
from engine.kernels.vector import load
from engine.layout import (
    CHECK_POS,
    CHECK_WALKABLE,
    COLLIDE,
    GLOBAL_SPHERE,
    NUM_SPHERE,
    OI_STATE,
    RADIUS,
    STATUS,
    STATUS_UNDETERMINED,
    STEP_DOWN,
    STEP_DOWN_AMT,
    WALK_INTERP,
    WALKABLE_ALLOWANCE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def test_sphere(
    wf: Array, wi: Ints, s: Array, position: int, scale: float, sphere: int, is_creature: bool
) -> int:
    """Test the mover against a sphere at ``wf[sphere]``, in the space of an object at `position`.

    retail: CSphere::intersects_sphere 0x00537FD0, 07 9
    """
    x, y, z = load(wf, sphere)
    vx, vy, vz = f32(scale * x), f32(scale * y), f32(scale * z)
    gx, gy, gz = position_localtoglobal(s[CHECK_POS], wf, position, vx, vy, vz)
    return _intersects_sphere(wi, s, gx, gy, gz, f32(scale * wf[sphere + RADIUS]), is_creature)


@kernel
def _intersects_sphere(wi: Ints, s: Array, x: float, y: float, z: float, r: float, is_creature: bool) -> int:
    """Test the mover against a sphere in the block of the check position.

    retail: CSphere::intersects_sphere 0x00537A80, 07 8
    """
    trace_open(wi, s, SPHERE_CALL)
    ts = _answer(s, x, y, z, r, is_creature)
    if ts != NEEDS_STEP_UP:
        trace_close(wi, s, ts)
    return ts


@inlined
def _overlaps(s: Array, number: int, x: float, y: float, z: float, radsum: float) -> bool:
    """Say whether a sphere of the mover overlaps or touches; `radsum` is that of sphere 0 for both.

    retail: CSphere::collides_with_sphere 0x005369E0, 07 2
    """
    dx, dy, dz = displacement(s, sphere_at(number), x, y, z)
    return radsum * radsum >= (dy * dy + dx * dx) + dz * dz


@inlined
def _first_overlapping(s: Array, x: float, y: float, z: float, radsum: float) -> int:
    """Return the number of the mover's first sphere that overlaps, or NEITHER."""
    if _overlaps(s, FIRST, x, y, z, radsum):
        return FIRST
    if s[NUM_SPHERE] > 1.0 and _overlaps(s, SECOND, x, y, z, radsum):
        return SECOND
    return NEITHER


@kernel
def _answer(s: Array, x: float, y: float, z: float, r: float, is_creature: bool) -> int:
    """Test in the one way that the path's state asks for; the first match wins.

    retail: 07 8.1-8
    """
    radsum = f32((r + s[GLOBAL_SPHERE + RADIUS]) - EPS)
    overlap_only = asks_for_overlap(s)
    if s[STEP_DOWN] != 0.0 and not overlap_only:
        return OK if is_creature else _step_sphere_down(s, x, y, z, r, radsum)
    hit = _first_overlapping(s, x, y, z, radsum)
    if hit == NEITHER:
        return OK
    if overlap_only or s[CHECK_WALKABLE] != 0.0:
        return COLLIDED
    if s[COLLIDE] != 0.0:
        return OK if is_creature else _rest_upon(s, x, y, z, radsum)
    return _respond(s, x, y, z, radsum, hit)


@kernel
def _respond(s: Array, x: float, y: float, z: float, radsum: float, hit: int) -> int:
    """Step up, slide, stop or begin a landing, as the mover's state asks for.

    retail: 07 8.7
    """
    state = int(s[OI_STATE])
    if state & (CONTACT | ON_WALKABLE):
        if hit == FIRST:
            return step_sphere_up(s, x, y, z, radsum)
        return slide_second_sphere(s, x, y, z)
    if state & PATH_CLIPPED:
        if hit == SECOND:
            return OK
    elif hit == FIRST:
        return land_on_sphere(s, x, y, z)
    return collide_with_point(s, x, y, z, radsum, hit)


@kernel
def _step_sphere_down(s: Array, x: float, y: float, z: float, r: float, radsum: float) -> int:
    """Put sphere 0 on top, also where only sphere 1 overlaps.

    Beside the sphere there is no top, and the root is NaN: what retail does then is not known (07, 11).

    retail: CSphere::step_sphere_down 0x00536D20, 07 4
    """
    dx, dy, dz = displacement(s, GLOBAL_SPHERE, x, y, z)
    yy, xx = f32(dy * dy), f32(dx * dx)
    if radsum * radsum < (dz * dz + xx) + yy and not (
        s[NUM_SPHERE] > 1.0 and _overlaps(s, SECOND, x, y, z, radsum)
    ):
        return OK
    sd = s[STEP_DOWN_AMT] * s[WALK_INTERP]
    sd32 = f32(sd)
    if abs(sd) < EPS:
        return COLLIDED
    rs = radsum + EPS
    rs32 = f32(rs)
    root = math.sqrt(rs * rs32 - (xx + yy))
    t = (root - dz) / sd32
    w = (1.0 - t) * s[WALK_INTERP]
    if not within_step(s, w):
        if math.isnan(root):
            s[STATUS] = STATUS_UNDETERMINED
        return COLLIDED
    rise = f32(sd32 * t)
    nz = rise + dz
    inv = 1.0 / rs32
    nz2 = nz * inv
    if nz2 <= s[WALKABLE_ALLOWANCE]:
        return OK
    ux, uy, uz = f32(inv * dx), f32(inv * dy), f32(nz2)
    px, py, pz = f32(x + f32(r * ux)), f32(y + f32(r * uy)), f32(z + f32(r * uz))
    stand_upon(s, ux, uy, uz, px, py, pz, w)
    add_offset_to_check_pos(s, 0.0, 0.0, rise)
    return ADJUSTED


@kernel
def _rest_upon(s: Array, x: float, y: float, z: float, radsum: float) -> int:
    """Move sphere 0 back along its way until it rests on top; a root that is NaN is a collision.

    The root is compared with 1 before it is divided, as in retail.

    retail: 07 8.8.3-14
    """
    dx, dy, dz = displacement(s, GLOBAL_SPHERE, x, y, z)
    mx, my, mz = way_back(s)
    rs = f32(radsum + EPS)
    a = (mz * mz + my * my) + mx * mx
    dot = (my * dy + mx * dx) + mz * dz
    b = -dot
    if abs(a) < EPS:
        return COLLIDED
    t = math.sqrt(b * b - (((dy * dy + dx * dx) + dz * dz) - rs * rs) * a) - dot
    if t > 1.0:
        t = (b + b) - t
    u = t / a
    w = (1.0 - u) * s[WALK_INTERP]
    if not within_step(s, w):
        return COLLIDED
    mx, my, mz = f32(mx * u), f32(my * u), f32(mz * u)
    inv = 1.0 / rs
    nx, ny, nz = f32(inv * f32(mx + dx)), f32(inv * f32(my + dy)), f32(inv * f32(mz + dz))
    if not nz > s[WALKABLE_ALLOWANCE]:
        return OK
    sx, sy, sz = load(s, GLOBAL_SPHERE)
    sr = s[GLOBAL_SPHERE + RADIUS]
    px, py, pz = f32(sx - f32(sr * nx)), f32(sy - f32(sr * ny)), f32(sz - f32(sr * nz))
    stand_upon(s, nx, ny, nz, px, py, pz, w)
    add_offset_to_check_pos(s, mx, my, mz)
    return ADJUSTED
