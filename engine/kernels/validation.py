"""CTransition::validate_transition and its siblings (05, 7): what a sub-step ends in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import (
    ADJUSTED,
    COLLIDED,
    CONTACT,
    EPS,
    FLOOR_Z,
    INVALID,
    IS_VIEWER,
    OK,
    ON_WALKABLE,
    SLID,
    TRANSITION_ATTEMPTS,
)
from engine.kernels.cells import build_cell_array
from engine.kernels.collision_info import (
    collision_info_init,
    copy_plane,
    set_collision_normal,
    set_contact_plane,
    set_sliding_normal,
)
from engine.kernels.compile import inlined, kernel
from engine.kernels.frame import frame_is_equal
from engine.kernels.path import cache_global_curr_center, set_check_pos
from engine.kernels.probing import probe_into_cell, probe_other_cells
from engine.kernels.rounding import f32
from engine.kernels.vector import copy_position, load
from engine.layout import (
    CHECK_CELL,
    CHECK_POS,
    COLLIDED_WITH_ENVIRONMENT,
    COLLISION_NORMAL,
    COLLISION_NORMAL_VALID,
    CONTACT_CELL_ID,
    CONTACT_IS_WATER,
    CONTACT_PLANE,
    CONTACT_VALID,
    CURR_CELL,
    CURR_POS,
    FRAMES_STATIONARY_FALL,
    GLOBAL_CURR_CENTER,
    GLOBAL_SPHERE,
    KILL_VELOCITY,
    LAST_KNOWN_CELL_ID,
    LAST_KNOWN_IS_WATER,
    LAST_KNOWN_PLANE,
    LAST_KNOWN_VALID,
    LOCALSPACE_OF,
    MOVER_GRAVITY,
    NO_CELL,
    OI_STATE,
    PLACEMENT_ALLOWS_SLIDING,
    RADIUS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def validate_transition(wf: Array, wi: Ints, s: Array, ts: int) -> int:
    """Accept the check position, or go back to the current one; then settle contact and sliding.

    retail: CTransition::validate_transition 0x0050AA70, VT-1...VT-13
    """
    same = s[CHECK_POS] == s[CURR_POS] and frame_is_equal(s, CHECK_POS, s, CURR_POS)
    moved = ts == OK and not same
    if ts == OK:
        accept_check_pos(s)
        set_check_pos(s, CURR_POS, s[CURR_CELL])
    elif ts != INVALID:
        if _readopt_last_known_plane(s):
            moved = True
        if s[COLLISION_NORMAL_VALID] == 0.0:
            set_collision_normal(s, 0.0, 0.0, 1.0)
        set_check_pos(s, CURR_POS, s[CURR_CELL])
        build_cell_array(wf, wi, s)
        ts = OK
    if s[COLLISION_NORMAL_VALID] != 0.0:
        set_sliding_normal(s, s[COLLISION_NORMAL], s[COLLISION_NORMAL + 1])
    if not int(s[OI_STATE]) & IS_VIEWER and s[MOVER_GRAVITY] != 0.0:
        _count_stationary_fall(s, moved)
    _remember_contact(s)
    return ts


@inlined
def accept_check_pos(s: Array) -> None:
    """Make the check position the current one.

    retail: VT-3, VP-2
    """
    copy_position(s, CURR_POS, s, CHECK_POS)
    s[CURR_CELL] = s[CHECK_CELL]
    s[LOCALSPACE_OF] = 0.0
    cache_global_curr_center(s)


@kernel
def _readopt_last_known_plane(s: Array) -> bool:
    """Take the last known plane as contact again if the mover still touches it.

    Returns whether the mover thereby counts as moved.

    retail: VT-5
    """
    if s[LAST_KNOWN_VALID] == 0.0:
        return False
    s[KILL_VELOCITY] += 1.0
    x, y, z = load(s, GLOBAL_CURR_CENTER)
    nx, ny, nz = load(s, LAST_KNOWN_PLANE)
    d = s[LAST_KNOWN_PLANE + 3]
    dist = ((z * nz + y * ny) + x * nx) + d
    if not s[GLOBAL_SPHERE + RADIUS] + EPS > abs(dist):
        return False
    set_contact_plane(s, nx, ny, nz, d, s[LAST_KNOWN_IS_WATER], s[LAST_KNOWN_CELL_ID])
    return int(s[OI_STATE]) & ON_WALKABLE != 0


@kernel
def _count_stationary_fall(s: Array, moved: bool) -> None:
    """Count the sub-steps in which a falling mover did not move; put it on a floor after the third.

    retail: VT-10
    """
    frames = s[FRAMES_STATIONARY_FALL]
    if moved:
        s[FRAMES_STATIONARY_FALL] = 0.0
    elif frames < 2.0:
        s[FRAMES_STATIONARY_FALL] = frames + 1.0
    else:
        s[FRAMES_STATIONARY_FALL] = 3.0
        x, y, z = load(s, GLOBAL_SPHERE)
        d = f32(s[GLOBAL_SPHERE + RADIUS] - ((y + x) * 0.0 + z))
        set_contact_plane(s, 0.0, 0.0, 1.0, d, 0.0, s[CHECK_POS])
        if not int(s[OI_STATE]) & CONTACT:
            set_collision_normal(s, 0.0, 0.0, 1.0)
            s[COLLIDED_WITH_ENVIRONMENT] = 1.0


@kernel
def _remember_contact(s: Array) -> None:
    """Note the contact plane as the last known one, and in the mover's state.

    retail: VT-11, VT-12
    """
    state = int(s[OI_STATE])
    s[LAST_KNOWN_VALID] = s[CONTACT_VALID]
    if s[CONTACT_VALID] == 0.0:
        s[OI_STATE] = state & ~(CONTACT | ON_WALKABLE)
        return
    copy_plane(s, LAST_KNOWN_PLANE, CONTACT_PLANE)
    s[LAST_KNOWN_CELL_ID] = s[CONTACT_CELL_ID]
    s[LAST_KNOWN_IS_WATER] = s[CONTACT_IS_WATER]
    state |= CONTACT
    s[OI_STATE] = state
    walkable = s[CONTACT_PLANE + 2] >= FLOOR_Z
    s[OI_STATE] = state | ON_WALKABLE if walkable else state & ~ON_WALKABLE


@kernel
def validate_placement_transition(s: Array, ts: int) -> int:
    """Accept a placement, or forget what it touched.

    retail: CTransition::validate_placement_transition 0x0050ADC0, VP-1...VP-4
    """
    if s[CHECK_CELL] == NO_CELL:
        return COLLIDED
    if ts == OK:
        accept_check_pos(s)
    elif ts != INVALID and s[PLACEMENT_ALLOWS_SLIDING] != 0.0:
        collision_info_init(s)
    return ts


@kernel
def placement_insert(wf: Array, wi: Ints, s: Array) -> int:
    """Test the mover where it is put.

    retail: CTransition::placement_insert 0x0050B1D0, 05 4
    """
    cell = int(s[CHECK_CELL])
    ts = probe_into_cell(wf, wi, s, cell, TRANSITION_ATTEMPTS)
    if ts == OK:
        ts = probe_other_cells(wf, wi, s, cell)
    return ts


@kernel
def validate_placement(wf: Array, wi: Ints, s: Array, ts: int) -> int:
    """Accept a placement; test one that was moved once more.

    retail: CTransition::validate_placement 0x0050B210, 05 7
    """
    if s[CHECK_CELL] == NO_CELL:
        return COLLIDED
    if ts in (ADJUSTED, SLID):
        ts = placement_insert(wf, wi, s)
        if s[CHECK_CELL] == NO_CELL:
            return COLLIDED
    if ts == OK:
        accept_check_pos(s)
    return ts
