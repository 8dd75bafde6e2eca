"""CTransition::find_valid_position (05, 1 and 2): move in sub-steps, or place."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import (
    EPS,
    EPS2,
    FREE_ROTATE,
    IS_VIEWER,
    MAX_STEPS,
    OK,
    PATH_CLIPPED,
    TRANSITION_ATTEMPTS,
    TRANSITION_INSERT,
    WHOLE,
)
from engine.kernels.adjust import adjust_offset
from engine.kernels.cells import build_cell_array
from engine.kernels.collision_info import forget_contact
from engine.kernels.compile import entry, inlined, inlined_entry, kernel
from engine.kernels.frame import frame_interpolate_rotation, frame_set_rotate
from engine.kernels.insertion import transitional_insert
from engine.kernels.path import add_offset_to_check_pos, set_check_pos
from engine.kernels.placement import find_placement_position
from engine.kernels.plan_flight import flies_freely, fly
from engine.kernels.position import position_get_offset
from engine.kernels.rounding import f32
from engine.kernels.validation import validate_transition
from engine.kernels.vector import store
from engine.layout import (
    BEGIN_CELL,
    BEGIN_POS,
    CHECK_POS,
    COLLISION_NORMAL_VALID,
    CURR_CELL,
    CURR_POS,
    END_POS,
    FRAMES_STATIONARY_FALL,
    GLOBAL_OFFSET,
    INSERT_TYPE,
    LOCAL_SPHERE,
    LOCALSPACE_OF,
    NO_CELL,
    OI_STATE,
    QUATERNION,
    RADIUS,
    SLIDING_VALID,
    STATUS,
    STATUS_ENDLESS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Vector


@entry
def find_valid_position(wf: Array, wi: Ints, s: Array) -> bool:
    """Run a prepared transition.

    retail: CTransition::find_valid_position 0x0050C310, 05 1
    """
    if s[INSERT_TYPE] != TRANSITION_INSERT:
        return find_placement_position(wf, wi, s)
    return _find_transitional_position(wf, wi, s)


@inlined
def _length(x: float, y: float, z: float) -> float:
    """Return a vector's length in a register.

    retail: NS-3
    """
    return math.sqrt((x * x + y * y) + z * z)


@inlined
def _scaled(k: float, x: float, y: float, z: float) -> Vector:
    """Multiply a vector by a register."""
    return f32(x * k), f32(y * k), f32(z * k)


@inlined_entry
def calc_num_steps(r: float, viewer: bool, x: float, y: float, z: float) -> tuple[float, float, float, float]:
    """Divide an offset into sub-steps not longer than the first sphere's radius: a step, and how many.

    retail: CTransition::calc_num_steps 0x0050A0B0, NS-3...NS-5
    """
    length = _length(x, y, z)
    if viewer:
        if length <= EPS:
            return 0.0, 0.0, 0.0, 0.0
        q = length / r
        sx, sy, sz = _scaled(1.0 / q, x, y, z)
        return sx, sy, sz, (float(math.floor(q)) if q < WHOLE else q) + 1.0
    q = length / (1.0 * r)
    if q > 1.0:
        n = float(math.ceil(q)) if q < WHOLE else q
        sx, sy, sz = _scaled(1.0 / n, x, y, z)
        return sx, sy, sz, n
    if x != 0.0 or y != 0.0 or z != 0.0:
        return x, y, z, 1.0
    return 0.0, 0.0, 0.0, 0.0


@inlined
def _take_end_rotation(s: Array) -> None:
    """Turn the current position to the wanted rotation, normalised.

    retail: FT-3, FT-5
    """
    q = END_POS + QUATERNION
    frame_set_rotate(s, CURR_POS, s[q], s[q + 1], s[q + 2], s[q + 3])
    s[LOCALSPACE_OF] = 0.0


@kernel
def _find_transitional_position(wf: Array, wi: Ints, s: Array) -> bool:
    """Move from the begin towards the end position.

    retail: CTransition::find_transitional_position 0x0050BDF0, FT-1...FT-15
    """
    if s[BEGIN_CELL] == NO_CELL:
        return False
    state = int(s[OI_STATE])
    viewer, free = state & IS_VIEWER != 0, state & FREE_ROTATE != 0
    ox, oy, oz = position_get_offset(s, BEGIN_POS, s, END_POS)
    sx, sy, sz, steps = calc_num_steps(s[LOCAL_SPHERE + RADIUS], viewer, ox, oy, oz)
    if free:
        _take_end_rotation(s)
    set_check_pos(s, CURR_POS, s[CURR_CELL])
    if steps == 0.0:
        if not free:
            _take_end_rotation(s)
        set_check_pos(s, CURR_POS, s[CURR_CELL])
        build_cell_array(wf, wi, s)
        return True
    flies = flies_freely(wf, wi, s, ox, oy, oz, steps)
    ts = OK
    i = 0.0
    while i < steps:
        if i > MAX_STEPS:  # one more than a way has that is asked for in words: a viewer's last step
            s[STATUS] = STATUS_ENDLESS
            return False
        if viewer and i == steps - 1.0:
            sx, sy, sz = _last_viewer_step(s, ox, oy, oz, sx, sy, sz, steps)
        x, y, z = adjust_offset(s, sx, sy, sz)
        store(s, GLOBAL_OFFSET, x, y, z)
        if not viewer and (z * z + y * y) + x * x < EPS2:
            return i != 0.0 and ts == OK
        if not free:
            t = f32((i + 1.0) / steps)
            frame_interpolate_rotation(s, CHECK_POS, s, BEGIN_POS, END_POS, t)
        _begin_sub_step(s, x, y, z)
        flies = flies and fly(wf, wi, s)
        ts = OK if flies else transitional_insert(wf, wi, s, TRANSITION_ATTEMPTS)
        ts = validate_transition(wf, wi, s, ts)
        clipped = int(s[OI_STATE]) & PATH_CLIPPED != 0 and s[COLLISION_NORMAL_VALID] != 0.0
        if s[FRAMES_STATIONARY_FALL] != 0.0 or clipped:
            break
        i += 1.0
    return ts == OK


@kernel
def _last_viewer_step(
    s: Array, ox: float, oy: float, oz: float, sx: float, sy: float, sz: float, steps: float
) -> Vector:
    """Return what the viewer's last sub-step leaves to go.

    retail: FT-7
    """
    length = math.sqrt((oz * oz + oy * oy) + ox * ox)
    if not length > EPS:
        return sx, sy, sz
    k = (length - s[LOCAL_SPHERE + RADIUS] * (steps - 1.0)) / length
    return _scaled(k, ox, oy, oz)


@inlined
def _begin_sub_step(s: Array, x: float, y: float, z: float) -> None:
    """Move by one offset, to see what is in the way.

    retail: FT-11
    """
    s[SLIDING_VALID] = 0.0
    forget_contact(s)
    add_offset_to_check_pos(s, x, y, z)
