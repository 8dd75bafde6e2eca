"""CTransition::find_placement_position (05, 8): put a mover down where there is room."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import (
    EPS2,
    INITIAL_PLACEMENT_INSERT,
    OK,
    PLACEMENT_INSERT,
    RING_LENGTH,
    RING_PI,
    RING_RADIUS,
    SMALL_RADIUS,
    SMALL_RING_LENGTH,
    SPECK,
    TRANSITION_ATTEMPTS,
    TRANSITION_INSERT,
    Z_LANDING,
)
from engine.kernels.adjust import adjust_offset
from engine.kernels.collision_info import forget_contact
from engine.kernels.compile import inlined, kernel
from engine.kernels.edge_slide import step_down_in_halves
from engine.kernels.frame import frame_cache, frame_get_vector_heading, frame_set_heading
from engine.kernels.insertion import transitional_insert
from engine.kernels.path import add_offset_to_check_pos, restore_check_pos, save_check_pos, set_check_pos
from engine.kernels.rounding import f32
from engine.kernels.validation import placement_insert, validate_placement, validate_placement_transition
from engine.kernels.vector import store
from engine.layout import (
    BACKUP,
    CURR_CELL,
    CURR_POS,
    GLOBAL_OFFSET,
    INSERT_TYPE,
    LOCAL_SPHERE,
    NO_POLYGON,
    OI_STEP_DOWN,
    PLACEMENT_ALLOWS_SLIDING,
    POSITION_SIZE,
    QUATERNION,
    RADIUS,
    SCRATCH_FRAME,
    SLIDING_VALID,
    STATUS,
    STATUS_ENDLESS,
    STEP_DOWN_HEIGHT,
    WALKABLE,
    WALKABLE_ALLOWANCE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def find_placement_position(wf: Array, wi: Ints, s: Array) -> bool:
    """Put the mover at its current position, or near it, on the ground if there is any.

    retail: CTransition::find_placement_position 0x0050C170, FP-1...FP-6
    """
    set_check_pos(s, CURR_POS, s[CURR_CELL])
    s[INSERT_TYPE] = INITIAL_PLACEMENT_INSERT
    ts = placement_insert(wf, wi, s)
    if validate_placement(wf, wi, s, ts) != OK:
        return False
    s[INSERT_TYPE] = PLACEMENT_INSERT
    if not _find_placement_pos(wf, wi, s):
        return False
    if s[OI_STEP_DOWN] != 0.0:
        _settle(wf, wi, s)
    return validate_placement(wf, wi, s, OK) == OK


@kernel
def _settle(wf: Array, wi: Ints, s: Array) -> None:
    """Step down on to the ground, if it is near.

    retail: FP-5
    """
    s[WALKABLE_ALLOWANCE] = Z_LANDING
    save_check_pos(s)
    s[BACKUP] = s[INSERT_TYPE]
    s[INSERT_TYPE] = TRANSITION_INSERT
    found, _ = step_down_in_halves(wf, wi, s, s[STEP_DOWN_HEIGHT], Z_LANDING)
    if not found:
        restore_check_pos(s)
        forget_contact(s)
    s[INSERT_TYPE] = s[BACKUP]
    s[WALKABLE] = NO_POLYGON


@kernel
def _fits(wf: Array, wi: Ints, s: Array) -> bool:
    """Try the check position.

    retail: PP-1, PP-5
    """
    s[SLIDING_VALID] = 0.0
    forget_contact(s)
    return validate_placement_transition(s, transitional_insert(wf, wi, s, TRANSITION_ATTEMPTS)) == OK


@kernel
def _find_placement_pos(wf: Array, wi: Ints, s: Array) -> bool:
    """Try the current position, then rings of positions about it.

    retail: CTransition::find_placement_pos 0x0050BA50, PP-1...PP-6
    """
    set_check_pos(s, CURR_POS, s[CURR_CELL])
    if _fits(wf, wi, s):
        return True
    if s[PLACEMENT_ALLOWS_SLIDING] == 0.0:
        return False
    r = s[LOCAL_SPHERE + RADIUS]
    if 0.0 <= r < SPECK:
        s[STATUS] = STATUS_ENDLESS
        return False
    small = r < SMALL_RADIUS
    ring = SMALL_RING_LENGTH if small else RING_LENGTH
    if not small and r < RING_RADIUS:
        r = RING_RADIUS
    q = RING_LENGTH / (1.0 * r)
    if small:
        q = q * 0.5
    if q <= 1.0:
        return False
    n = math.ceil(q)
    step = f32(ring / n)
    turn = f32((step / r) * RING_PI)
    dist, angle = 0.0, 0.0
    for _ in range(n):
        dist = f32(dist + step)
        exact = turn + angle
        angle = f32(exact)
        if _fits_on_ring(wf, wi, s, dist, 2 * math.ceil(exact)):
            return True
    return False


@kernel
def _fits_on_ring(wf: Array, wi: Ints, s: Array, dist: float, count: int) -> bool:
    """Try a number of positions at a distance, clockwise from +y.

    retail: PP-5
    """
    step = f32(360.0 / count)
    _reset_frame(s)
    for j in range(count):
        set_check_pos(s, CURR_POS, s[CURR_CELL])
        frame_set_heading(s, SCRATCH_FRAME, f32(j * step))
        x, y, z = frame_get_vector_heading(s, SCRATCH_FRAME)
        x, y, z = adjust_offset(s, f32(dist * x), f32(dist * y), f32(dist * z))
        store(s, GLOBAL_OFFSET, x, y, z)
        if not (z * z + y * y) + x * x >= EPS2:
            continue
        add_offset_to_check_pos(s, x, y, z)
        if _fits(wf, wi, s):
            return True
    return False


@inlined
def _reset_frame(s: Array) -> None:
    """Make the scratch frame the identity."""
    for i in range(POSITION_SIZE):
        s[SCRATCH_FRAME + i] = 0.0
    s[SCRATCH_FRAME + QUATERNION] = 1.0
    frame_cache(s, SCRATCH_FRAME)
