"""CCylSphere as an obstacle (07, 10): does the mover run into it, and what happens then.

A cylinder stands upright in the block, however its object is turned, and has flat caps.
"""

from __future__ import annotations

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
from engine.kernels.cylsphere_responses import (
    collide_with_point,
    land_on_cylinder,
    normal_of_collision,
    slide_sphere,
    step_sphere_up,
)
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
from engine.kernels.trace import CYLSPHERE_CALL, trace_close, trace_open
from engine.kernels.vector import load, normalize_check_small
from engine.layout import (
    CHECK_POS,
    CHECK_WALKABLE,
    COLLIDE,
    CYLSPHERE_HEIGHT,
    GLOBAL_SPHERE,
    NUM_SPHERE,
    OI_STATE,
    RADIUS,
    STEP_DOWN,
    STEP_DOWN_AMT,
    WALK_INTERP,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def test_cylsphere(wf: Array, wi: Ints, s: Array, position: int, scale: float, cylinder: int) -> int:
    """Test the mover against a cylinder at ``wf[cylinder]``, in the space of an object at `position`.

    Retail puts the mover into that space first, of which only the rotation is read afterwards
    (`step_sphere_up`); here it is read from the object.

    retail: CCylSphere::intersects_sphere 0x0053B8F0, 07 10.9
    """
    x, y, z = load(wf, cylinder)
    vx, vy, vz = f32(scale * x), f32(scale * y), f32(scale * z)
    gx, gy, gz = position_localtoglobal(s[CHECK_POS], wf, position, vx, vy, vz)
    r, h = f32(scale * wf[cylinder + RADIUS]), f32(scale * wf[cylinder + CYLSPHERE_HEIGHT])
    return _intersects_sphere(wf, wi, s, position, gx, gy, gz, r, h)


@kernel
def _intersects_sphere(
    wf: Array, wi: Ints, s: Array, position: int, x: float, y: float, z: float, r: float, h: float
) -> int:
    """Test the mover against a cylinder in the block of the check position.

    retail: CCylSphere::intersects_sphere 0x0053B440, 07 10.8
    """
    trace_open(wi, s, CYLSPHERE_CALL)
    ts = _answer(wf, s, position, x, y, z, r, h)
    if ts != NEEDS_STEP_UP:
        trace_close(wi, s, ts)
    return ts


@inlined
def _overlaps(s: Array, number: int, x: float, y: float, z: float, h: float, radsum: float) -> bool:
    """Say whether a sphere of the mover overlaps or touches; `radsum` is that of sphere 0 for both.

    retail: CCylSphere::collides_with_sphere 0x0053A880, 07 10.1
    """
    at = sphere_at(number)
    dx, dy, dz = displacement(s, at, x, y, z)
    half = h * 0.5
    return radsum * radsum >= dx * dx + dy * dy and (s[at + RADIUS] - EPS) + half >= abs(half - dz)


@inlined
def _first_overlapping(s: Array, x: float, y: float, z: float, h: float, radsum: float) -> int:
    """Return the number of the mover's first sphere that overlaps, or NEITHER."""
    if _overlaps(s, FIRST, x, y, z, h, radsum):
        return FIRST
    if s[NUM_SPHERE] > 1.0 and _overlaps(s, SECOND, x, y, z, h, radsum):
        return SECOND
    return NEITHER


@kernel
def _answer(wf: Array, s: Array, position: int, x: float, y: float, z: float, r: float, h: float) -> int:
    """Test in the one way that the path's state asks for; the first match wins.

    retail: 07 10.8.1-6
    """
    radsum = f32((r - EPS) + s[GLOBAL_SPHERE + RADIUS])
    hit = _first_overlapping(s, x, y, z, h, radsum)
    if hit == NEITHER:
        return OK
    if asks_for_overlap(s):
        return COLLIDED
    if s[STEP_DOWN] != 0.0:
        return _step_sphere_down(s, z, h)
    if s[CHECK_WALKABLE] != 0.0:
        return COLLIDED
    if s[COLLIDE] != 0.0:
        return _rest_upon(s, x, y, z, h, radsum)
    return _respond(wf, s, position, x, y, z, h, radsum, hit)


@kernel
def _respond(
    wf: Array,
    s: Array,
    position: int,
    x: float,
    y: float,
    z: float,
    h: float,
    radsum: float,
    hit: int,
) -> int:
    """Step up, slide, stop or begin a landing, as the mover's state asks for.

    Every answer begins with the normal, and is COLLIDED if that is too short.

    retail: 07 10.8.5
    """
    state = int(s[OI_STATE])
    in_contact, clipped = state & (CONTACT | ON_WALKABLE) != 0, state & PATH_CLIPPED != 0
    if hit == SECOND and clipped and not in_contact:
        return OK
    definite, vx, vy, vz = normal_of_collision(s, x, y, z, h, radsum, hit)
    small, nx, ny, nz = normalize_check_small(vx, vy, vz)
    if small:
        return COLLIDED
    if in_contact:
        if hit == FIRST:
            return step_sphere_up(wf, s, position, z, h, nx, ny, nz)
        return slide_sphere(s, SECOND, nx, ny, nz)
    if hit == FIRST and not clipped:
        return land_on_cylinder(s, nx, ny, nz)
    return collide_with_point(s, x, y, z, h, radsum, hit, definite, nx, ny, nz)


@kernel
def _step_sphere_down(s: Array, z: float, h: float) -> int:
    """Put sphere 0 on the upper cap, also where only sphere 1 overlaps.

    retail: CCylSphere::step_sphere_down 0x0053A9B0, 07 10.2
    """
    sd = s[STEP_DOWN_AMT] * s[WALK_INTERP]
    if abs(sd) < EPS:
        return COLLIDED
    sx, sy, sz = load(s, GLOBAL_SPHERE)
    r = s[GLOBAL_SPHERE + RADIUS]
    rise = (h + r) - f32(sz - z)
    w = (1.0 - rise / sd) * s[WALK_INTERP]
    if not within_step(s, w):
        return COLLIDED
    rise32 = f32(rise)
    stand_upon(s, 0.0, 0.0, 1.0, sx, sy, f32((rise32 - r) + sz), w)
    add_offset_to_check_pos(s, 0.0, 0.0, rise32)
    return ADJUSTED


@kernel
def _rest_upon(s: Array, x: float, y: float, z: float, h: float, radsum: float) -> int:
    """Move sphere 0 back along its way until it rests on the upper cap.

    retail: 07 10.8.6
    """
    dx, dy, dz = displacement(s, GLOBAL_SPHERE, x, y, z)
    mx, my, mz = way_back(s)
    if abs(mz) < EPS:
        return COLLIDED
    r = s[GLOBAL_SPHERE + RADIUS]
    t = ((h + r) - dz) / mz
    f = f32(t)
    ox, oy, oz = f32(f * mx), f32(f * my), f32(f * mz)
    bx, by = ox + dx, oy + dy
    if radsum * radsum < by * by + bx * bx:
        return OK
    w = (1.0 - t) * s[WALK_INTERP]
    if not within_step(s, w):
        return COLLIDED
    sx, sy, sz = load(s, GLOBAL_SPHERE)
    stand_upon(s, 0.0, 0.0, 1.0, f32(sx + ox), f32(sy + oy), f32(f32(sz + oz) - r), w)
    add_offset_to_check_pos(s, ox, oy, oz)
    return ADJUSTED
