"""OBJECTINFO::validate_walkable (04, 6): a mover against the plane of the ground."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import (
    ADJUSTED,
    COLLIDED,
    CONTACT,
    EPS,
    FIRST_INDOOR,
    FLOOR_Z,
    IS_VIEWER,
    LEAST_WALK_INTERP,
    OK,
    ON_WALKABLE,
)
from engine.kernels.collision_info import set_collision_normal, set_contact_plane
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.path import add_offset_to_check_pos
from engine.kernels.rounding import f32
from engine.kernels.vector import load
from engine.layout import (
    BEGIN_POS,
    CHECK_WALKABLE,
    COLLIDED_WITH_ENVIRONMENT,
    GLOBAL_CURR_CENTER,
    HAS_BEGIN_POS,
    OI_STATE,
    STEP_DOWN,
    STEP_DOWN_AMT,
    WALK_INTERP,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array


@entry
def validate_walkable(
    s: Array,
    x: float,
    y: float,
    z: float,
    r: float,
    wf: Array,
    plane: int,
    is_water: float,
    depth: float,
    land_cell: float,
) -> int:
    """Test a sphere against the plane of the ground; stand on it, or be lifted out of it.

    x, y, z, r: the sphere, in the block of the ground; `plane`: where the plane lies in `wf`, in the same
    block; `depth`: of the water, metres; `land_cell`: id of the land cell.

    retail: OBJECTINFO::validate_walkable 0x0050D010, VW-1...VW-25
    """
    nx, ny, nz = load(wf, plane)
    d = wf[plane + 3]
    if int(s[OI_STATE]) & IS_VIEWER:
        return _validate_viewer(s, x, y, z, r, nx, ny, nz, d)
    dist = (((y * ny + (z - r) * nz) + x * nx) + d) + depth
    if dist > EPS:
        return OK
    accepted = _accepts(s, nz)
    if dist >= -EPS:
        if accepted:
            set_contact_plane(s, nx, ny, nz, d, is_water, land_cell)
        _note_landing(s, nx, ny, nz)
        return OK
    if s[CHECK_WALKABLE] != 0.0:
        return COLLIDED
    up = f32(dist / nz)
    if accepted:
        set_contact_plane(s, nx, ny, nz, d, is_water, land_cell)
        if s[STEP_DOWN] != 0.0 and not _shorten_step(s, up):
            return COLLIDED
        add_offset_to_check_pos(s, 0.0, 0.0, f32(-up))
    _note_landing(s, nx, ny, nz)
    return ADJUSTED if accepted else OK


@inlined
def _accepts(s: Array, nz: float) -> bool:
    """Say whether ground of this slope becomes the contact plane.

    retail: VW-13, VW-23
    """
    return s[STEP_DOWN] != 0.0 or int(s[OI_STATE]) & ON_WALKABLE == 0 or nz >= FLOOR_Z


@inlined
def _note_landing(s: Array, nx: float, ny: float, nz: float) -> None:
    """Note that what was in the air has hit the ground.

    retail: VW-14, VW-24
    """
    if not int(s[OI_STATE]) & CONTACT and s[STEP_DOWN] == 0.0:
        set_collision_normal(s, nx, ny, nz)
        s[COLLIDED_WITH_ENVIRONMENT] = 1.0


@inlined
def _shorten_step(s: Array, up: float) -> bool:
    """Note how much of the step is left; say whether the ground is within it.

    retail: VW-23
    """
    interp = s[WALK_INTERP]
    w = (1.0 - (-1.0 / (s[STEP_DOWN_AMT] * interp)) * up) * interp
    if w >= interp or w < LEAST_WALK_INTERP:
        return False
    s[WALK_INTERP] = f32(w)
    return True


@kernel
def _validate_viewer(
    s: Array, x: float, y: float, z: float, r: float, nx: float, ny: float, nz: float, d: float
) -> int:
    """Keep the camera above the ground, unless it began indoors and is only passing under.

    retail: VW-1...VW-5
    """
    dist = (((nx * x + ny * y) + z * nz) + d) - r
    if dist > -EPS:
        return OK
    cx, cy, cz = load(s, GLOBAL_CURR_CENTER)
    ox, oy, oz = f32(x - cx), f32(y - cy), z - cz
    t = f32(dist) / ((oz * nz + ox * nx) + oy * ny)
    began_indoors = s[HAS_BEGIN_POS] != 0.0 and (int(s[BEGIN_POS]) & 0xFFFF) >= FIRST_INDOOR
    if (t <= 0.0 or t > 1.0) and began_indoors:
        return OK
    k = -t
    add_offset_to_check_pos(s, f32(ox * k), f32(oy * k), f32(oz * k))
    set_collision_normal(s, nx, ny, nz)
    s[COLLIDED_WITH_ENVIRONMENT] = 1.0
    return ADJUSTED
