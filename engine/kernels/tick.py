"""CPhysicsObj, the tick (06, 3 and 4): from elapsed time to a wanted position, and what comes of it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.body_layout import (
    B_CACHED_VELOCITY,
    B_CELL,
    B_COLLIDED_WITH_ENVIRONMENT,
    B_COLLISION_NORMAL,
    B_COLLISION_NORMAL_VALID,
    B_FRAMES_STATIONARY_FALL,
    B_HAS_MOVEMENT_MANAGER,
    B_JUMPED,
    B_KILL_VELOCITY,
    B_NODES_VISITED,
    B_NUM_SPHERE,
    B_ORIGIN,
    B_OUTCOME,
    B_PHYSICS_TIME,
    B_POLYGONS_TESTED,
    B_POSITION,
    B_SKIPPED,
    B_STATE,
    B_STATUS,
    B_TRANSIENT,
    B_VELOCITY,
    B_WANTED,
    FAILED,
    INACTIVE,
    LOST,
    MOVED,
    NO_SPHERE,
    REPORT,
    REPORT_SIZE,
    STILL,
)
from engine.constants import (
    ACTIVE_TS,
    ALIGNPATH_PS,
    CHECK_ETHEREAL_TS,
    EPS,
    ETHEREAL,
    HIDDEN_PS,
    ON_WALKABLE_TS,
    SLEDDING_PS,
)
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.frame import frame_set_heading, frame_set_vector_heading
from engine.kernels.frame_motion import frame_combine_identity, set_frame, vector_heading
from engine.kernels.position import position_get_offset
from engine.kernels.rounding import f32
from engine.kernels.tick_position import set_position_internal
from engine.kernels.tick_seed import seed_transition
from engine.kernels.tick_velocity import has_bit, set_bit, set_velocity, update_physics_internal
from engine.kernels.transition import find_valid_position
from engine.kernels.vector import copy, copy_vector, load, store
from engine.layout import (
    COLLIDED_WITH_ENVIRONMENT,
    COLLISION_NORMAL,
    COLLISION_NORMAL_VALID,
    CURR_POS,
    FRAMES_STATIONARY_FALL,
    KILL_VELOCITY,
    MATRIX,
    NO_CELL,
    NODES_VISITED,
    ORIGIN,
    POLYGONS_TESTED,
    POSITION_SIZE,
    QUATERNION,
    SKIPPED,
    SKIPPED_SIZE,
    STATUS,
    STATUS_OK,
    TRACE_LENGTH,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def step(wf: Array, wi: Ints, s: Array, b: Array, quantum: float, ticks: float) -> None:
    """Let ticks of `quantum` seconds pass for a body; it stops at the first that fails.

    retail: PhysicsTimer::curr_time and CPhysicsObj::UpdateObjectInternal 0x005156B0
    """
    b[B_STATUS] = STATUS_OK
    for _ in range(int(ticks)):
        if b[B_STATUS] == STATUS_OK:
            b[B_PHYSICS_TIME] += quantum
            update_object_internal(wf, wi, s, b, quantum)


@kernel
def update_object_internal(wf: Array, wi: Ints, s: Array, b: Array, quantum: float) -> None:
    """Perform one tick.

    retail: CPhysicsObj::UpdateObjectInternal 0x005156B0, UO-1...UO-11
    """
    for i in range(REPORT, REPORT + REPORT_SIZE):
        b[i] = 0.0
    s[TRACE_LENGTH] = 0.0
    b[B_OUTCOME] = INACTIVE
    if not has_bit(b, B_TRANSIENT, ACTIVE_TS) or b[B_CELL] == NO_CELL:
        return
    if has_bit(b, B_TRANSIENT, CHECK_ETHEREAL_TS):
        _become_solid(b)
    b[B_JUMPED] = 0.0
    update_position_internal(b, quantum)
    if b[B_NUM_SPHERE] == 0.0:
        if b[B_HAS_MOVEMENT_MANAGER] == 0.0 and has_bit(b, B_TRANSIENT, ON_WALKABLE_TS):
            set_bit(b, B_TRANSIENT, ACTIVE_TS, False)
        _only_turn(b)
        b[B_OUTCOME] = NO_SPHERE
    elif _wants_to_stay(b):
        _only_turn(b)
        b[B_OUTCOME] = STILL
    else:
        _face_movement(b)
        _move(wf, wi, s, b, quantum)


@entry
def update_position_internal(b: Array, quantum: float) -> None:
    """Write where the body wants to be after `quantum` seconds into its row.

    No animation moves it, and no position manager.

    retail: CPhysicsObj::UpdatePositionInternal 0x00512C30, UPI-1...UPI-5
    """
    b[B_WANTED] = b[B_POSITION]
    _become_identity(b)
    frame_combine_identity(b, B_WANTED, B_POSITION)
    if not has_bit(b, B_STATE, HIDDEN_PS):
        update_physics_internal(b, B_WANTED, quantum)


@inlined
def _become_identity(b: Array) -> None:
    """Give the wanted position an identity frame.

    retail: UO-3
    """
    for i in range(1, POSITION_SIZE):
        b[B_WANTED + i] = 0.0
    b[B_WANTED + QUATERNION] = 1.0
    m = B_WANTED + MATRIX
    b[m] = b[m + 4] = b[m + 8] = 1.0


@inlined
def _become_solid(b: Array) -> None:
    """Stop being ethereal, which a body that has a parent may do at once.

    Any other would have to look at the cells that it is registered in; `engine.step` refuses those.

    retail: UO-2
    """
    set_bit(b, B_STATE, ETHEREAL, False)
    set_bit(b, B_TRANSIENT, CHECK_ETHEREAL_TS, False)


@inlined
def _only_turn(b: Array) -> None:
    """Take the rotation of the wanted position, stay where the body is, and touch nothing else.

    retail: UO-4, UO-5, UO-8
    """
    copy_vector(b, B_WANTED + ORIGIN, b, B_ORIGIN)
    set_frame(b, B_POSITION, b, B_WANTED)
    store(b, B_CACHED_VELOCITY, 0.0, 0.0, 0.0)


@inlined
def _wants_to_stay(b: Array) -> bool:
    """Say whether the wanted origin differs by at most EPS on every axis.

    retail: UO-5
    """
    x, y, z = load(b, B_ORIGIN)
    wx, wy, wz = load(b, B_WANTED + ORIGIN)
    return abs(wx - x) <= EPS and abs(wy - y) <= EPS and abs(wz - z) <= EPS


@kernel
def _face_movement(b: Array) -> None:
    """Turn what flies along its path, or slides, the way it moves.

    retail: UO-6
    """
    if has_bit(b, B_STATE, ALIGNPATH_PS):
        ox, oy, oz = load(b, B_ORIGIN)
        wx, wy, wz = load(b, B_WANTED + ORIGIN)
        x, y, z = f32(wx - ox), f32(wy - oy), f32(wz - oz)
        r = 1.0 / math.sqrt((x * x + y * y) + z * z)
        frame_set_vector_heading(b, B_WANTED, f32(r * x), f32(r * y), f32(r * z))
    elif has_bit(b, B_STATE, SLEDDING_PS):
        x, y, z = load(b, B_VELOCITY)
        if not (abs(x) < EPS and abs(y) < EPS and abs(z) < EPS):
            frame_set_heading(b, B_WANTED, f32(vector_heading(x, y)))


@kernel
def _move(wf: Array, wi: Ints, s: Array, b: Array, quantum: float) -> None:
    """Run the transition and take over what it ends in.

    Nothing in a transition reads the velocity, so that it may be stopped afterwards.

    retail: UO-7...UO-11, OBJECTINFO::kill_velocity 0x0050CFE0
    """
    seed_transition(s, b, False)
    found = find_valid_position(wf, wi, s)
    _report(s, b)
    if s[STATUS] != STATUS_OK:
        return
    if s[KILL_VELOCITY] > 0.0:
        set_velocity(b, 0.0, 0.0, 0.0)
    if not found:
        _only_turn(b)
        b[B_OUTCOME] = FAILED
        return
    x, y, z = position_get_offset(b, B_POSITION, s, CURR_POS)
    r = 1.0 / quantum
    rounded = f32(r)
    store(b, B_CACHED_VELOCITY, f32(r * x), f32(rounded * y), f32(rounded * z))
    set_position_internal(wf, wi, s, b)
    b[B_OUTCOME] = LOST if b[B_CELL] == NO_CELL else MOVED


@inlined
def _report(s: Array, b: Array) -> None:
    """Note how the transition went."""
    b[B_STATUS] = s[STATUS]
    b[B_KILL_VELOCITY] = s[KILL_VELOCITY]
    b[B_COLLISION_NORMAL_VALID] = s[COLLISION_NORMAL_VALID]
    copy_vector(b, B_COLLISION_NORMAL, s, COLLISION_NORMAL)
    b[B_FRAMES_STATIONARY_FALL] = s[FRAMES_STATIONARY_FALL]
    b[B_COLLIDED_WITH_ENVIRONMENT] = s[COLLIDED_WITH_ENVIRONMENT]
    b[B_NODES_VISITED] = s[NODES_VISITED]
    b[B_POLYGONS_TESTED] = s[POLYGONS_TESTED]
    copy(b, B_SKIPPED, s, SKIPPED, SKIPPED_SIZE)
