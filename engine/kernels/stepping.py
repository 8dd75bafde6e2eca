"""CTransition::step_up, step_down, check_walkable, and the slides along edges (04, 4; 05, 6)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import (
    COLLIDED,
    EDGE_SLIDE,
    FLOOR_Z,
    OK,
    ON_WALKABLE,
    PLACEMENT_INSERT,
    PROBE_ATTEMPTS,
    SMALL_STEP,
    STEP_ATTEMPTS,
    Z_LANDING,
)
from engine.kernels.collision_info import forget_contact
from engine.kernels.compile import inlined, kernel
from engine.kernels.frame import frame_localtoglobalvec
from engine.kernels.path import (
    add_offset_to_check_pos,
    restore_check_pos,
    save_check_pos,
    set_check_pos,
    shift_global_sphere,
)
from engine.kernels.polygon_support import polygon_check_walkable, polygon_find_crossed_edge
from engine.kernels.probing import probe
from engine.kernels.rounding import f32
from engine.kernels.sphere import movement_along, slide_sphere
from engine.kernels.vector import copy_position, load, load_four, store
from engine.layout import (
    BACKUP,
    CELL_ARRAY_VALID,
    CHECK_CELL,
    CHECK_POS,
    CHECK_WALKABLE,
    CONTACT_PLANE,
    CONTACT_VALID,
    GLOBAL_SPHERE,
    INSERT_TYPE,
    NEG_POLY_HIT,
    NO_POLYGON,
    NUM_SPHERE,
    OI_STATE,
    ORIGIN,
    RADIUS,
    REQUESTED_NORMAL,
    SAVED_POS,
    STEP_DOWN,
    STEP_DOWN_AMT,
    STEP_DOWN_HEIGHT,
    STEP_UP,
    STEP_UP_HEIGHT,
    STEP_UP_NORMAL,
    WALK_INTERP,
    WALKABLE,
    WALKABLE_ALLOWANCE,
    WALKABLE_CHECK_POS,
    WALKABLE_POS,
    WALKABLE_UP,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@inlined
def on_walkable(s: Array) -> bool:
    """Say whether the mover stands on what it can walk on."""
    return int(s[OI_STATE]) & ON_WALKABLE != 0


@inlined
def step_limits(s: Array, height_at: int) -> tuple[float, float]:
    """Return how far to step, and the smallest normal z to step on.

    `height_at` is where the mover's height for this step lies in the row.

    retail: TI-16, SU-2
    """
    if on_walkable(s):
        return s[height_at], FLOOR_Z
    return SMALL_STEP, Z_LANDING


@kernel
def _check_walkables(wf: Array, s: Array) -> bool:
    """Say whether the walkable polygon supports the stored sphere, whose radius is halved for good.

    retail: SPHEREPATH::check_walkables 0x0050C3E0, 04 CW-1...CW-3
    """
    poly = int(s[WALKABLE])
    if poly == NO_POLYGON:
        return True
    s[WALKABLE_CHECK_POS + RADIUS] = f32(s[WALKABLE_CHECK_POS + RADIUS] * 0.5)
    return polygon_check_walkable(wf, poly, load_four(s, WALKABLE_CHECK_POS), load(s, WALKABLE_UP))


@inlined
def _probe_depth(s: Array) -> float:
    """Return how far below to look for support, in a register.

    retail: WK-4, WK-5
    """
    h = s[STEP_DOWN_HEIGHT]
    r = s[GLOBAL_SPHERE + RADIUS]
    if s[NUM_SPHERE] < 2.0 and h > r + r:
        h = r * 0.5
    if h > r + r:
        h = h * 0.5
    return h


@kernel
def check_walkable(wf: Array, wi: Ints, s: Array, z: float) -> bool:
    """Say whether the mover is supported, by the polygon it found or by anything below.

    retail: CTransition::check_walkable 0x0050AFF0, WK-1...WK-8
    """
    if not on_walkable(s) or _check_walkables(wf, s):
        return True
    copy_position(s, SAVED_POS, s, CHECK_POS)
    cell = s[CHECK_CELL]
    s[WALKABLE_ALLOWANCE] = z
    s[CHECK_WALKABLE] = 1.0
    add_offset_to_check_pos(s, 0.0, 0.0, f32(-_probe_depth(s)))
    ts = probe(wf, wi, s, PROBE_ATTEMPTS)
    s[CHECK_WALKABLE] = 0.0
    set_check_pos(s, SAVED_POS, cell)
    return ts != OK


@kernel
def insert_as_placement(wf: Array, wi: Ints, s: Array, attempts: int) -> int:
    """Test whether there is room at the check position.

    retail: SD-6, TI-9
    """
    s[BACKUP] = s[INSERT_TYPE]
    s[INSERT_TYPE] = PLACEMENT_INSERT
    ts = probe(wf, wi, s, attempts)
    s[INSERT_TYPE] = s[BACKUP]
    return ts


@kernel
def step_down(wf: Array, wi: Ints, s: Array, height: float, z: float) -> bool:
    """Look for ground within a height, and go there if there is room.

    retail: CTransition::step_down 0x0050B2A0, SD-1...SD-6 of document 05
    """
    s[NEG_POLY_HIT] = 0.0
    s[STEP_DOWN] = 1.0
    s[STEP_DOWN_AMT] = height
    s[WALK_INTERP] = 1.0
    if s[STEP_UP] == 0.0:
        s[CELL_ARRAY_VALID] = 0.0
        dz = f32(-height)
        s[CHECK_POS + ORIGIN + 2] = f32(dz + s[CHECK_POS + ORIGIN + 2])
        shift_global_sphere(s, 0.0, 0.0, dz)
    ts = probe(wf, wi, s, STEP_ATTEMPTS)
    s[STEP_DOWN] = 0.0
    if ts != OK or s[CONTACT_VALID] == 0.0 or not s[CONTACT_PLANE + 2] >= z:
        return False
    needs_support = int(s[OI_STATE]) & EDGE_SLIDE != 0 and s[STEP_UP] == 0.0
    if needs_support and not check_walkable(wf, wi, s, z):
        return False
    return insert_as_placement(wf, wi, s, PROBE_ATTEMPTS) == OK


@kernel
def step_up(wf: Array, wi: Ints, s: Array, x: float, y: float, z: float) -> bool:
    """Step on what was struck, if ground is found above it.

    x, y, z: its normal, in the block.

    retail: CTransition::step_up 0x0050B610, SU-1...SU-6
    """
    forget_contact(s)
    s[STEP_UP] = 1.0
    store(s, STEP_UP_NORMAL, x, y, z)
    height, limit = step_limits(s, STEP_UP_HEIGHT)
    s[WALKABLE_ALLOWANCE] = limit
    save_check_pos(s)
    stepped = step_down(wf, wi, s, height, limit)
    s[STEP_UP] = 0.0
    s[WALKABLE] = NO_POLYGON
    if not stepped:
        restore_check_pos(s)
    return stepped


@kernel
def step_up_slide(s: Array) -> int:
    """Slide along what could not be stepped on.

    retail: SPHEREPATH::step_up_slide 0x0050C3B0, SS-1, SS-2 of document 04
    """
    forget_contact(s)
    s[STEP_UP] = 0.0
    return slide_sphere(s, STEP_UP_NORMAL)


@kernel
def step_up_or_slide(wf: Array, wi: Ints, s: Array) -> int:
    """Answer a collision that asked for a step up on `REQUESTED_NORMAL`.

    retail: BSPTREE::step_sphere_up 0x00539F20, 03 11.2-3
    """
    x, y, z = load(s, REQUESTED_NORMAL)
    if step_up(wf, wi, s, x, y, z):
        return OK
    return step_up_slide(s)


@kernel
def precipice_slide(wf: Array, s: Array) -> int:
    """Slide along the edge of the walkable polygon that the mover is beyond.

    retail: SPHEREPATH::precipice_slide 0x0050CC80, PS-1...PS-7 of document 04
    """
    center, up = load(s, WALKABLE_CHECK_POS), load(s, WALKABLE_UP)
    found, nx, ny, nz = polygon_find_crossed_edge(wf, int(s[WALKABLE]), center, up)
    s[WALKABLE] = NO_POLYGON
    if not found:
        return COLLIDED
    s[STEP_UP] = 0.0
    gx, gy, gz = frame_localtoglobalvec(s, WALKABLE_POS, nx, ny, nz)
    if movement_along(s, gx, gy, gz) > 0.0:
        gx, gy, gz = f32(gx * -1.0), f32(gy * -1.0), f32(gz * -1.0)
    store(s, REQUESTED_NORMAL, gx, gy, gz)
    return slide_sphere(s, REQUESTED_NORMAL)
