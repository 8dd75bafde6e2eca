"""CPhysicsObj, the response (06, 7): bounces, stationary ticks, and reports of what was hit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.body_layout import (
    B_COLLIDING,
    B_ELASTICITY,
    B_HAS_WEENIE,
    B_NUM_RECORDS,
    B_PHYSICS_TIME,
    B_RECORDS,
    B_STATE,
    B_STATUS,
    B_TRACKS_OBJECTS,
    B_TRANSIENT,
    B_VELOCITY,
    MAX_RECORDS,
    RECORD_ETHEREAL,
    RECORD_SIZE,
    RECORD_TIME,
    STATUS_CROWDED,
)
from engine.constants import (
    COLLIDES_AS_ENVIRONMENT_PS,
    COLLISION_MEMORY,
    ETHEREAL,
    ETHEREAL_MEMORY,
    FLIGHT_PS,
    IGNORE_COLLISIONS,
    INELASTIC_PS,
    MISSILE,
    ON_WALKABLE_TS,
    REPORT_COLLISIONS_PS,
    SLEDDING_PS,
    STATIC,
    STATIONARY_FALL_TS,
    STATIONARY_STOP_TS,
    STATIONARY_STUCK_TS,
    STATIONARY_TS,
)
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.rounding import f32
from engine.kernels.tick_velocity import has_bit, set_bit
from engine.kernels.vector import copy, load, store
from engine.layout import (
    COLLIDED_WITH_ENVIRONMENT,
    COLLISION_NORMAL,
    COLLISION_NORMAL_VALID,
    FRAMES_STATIONARY_FALL,
    NUM_COLLIDE_OBJECT,
    OBJECT_INTS,
    OBJECT_STATE,
    OBJECT_WEENIE,
    WORLD_OBJECT_INTS,
    WORLD_TOUCHED,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def track_touched_objects(wi: Ints, s: Array, b: Array) -> bool:
    """Take notice of what the transition touched; say whether something was reported.

    retail: CPhysicsObj::handle_all_collisions 0x00514780, HC-2
    """
    reported = False
    if b[B_TRACKS_OBJECTS] != 0.0:
        first = wi[WORLD_TOUCHED]
        for i in range(first, first + int(s[NUM_COLLIDE_OBJECT])):
            thing = int(s[i])
            record = wi[WORLD_OBJECT_INTS] + OBJECT_INTS * thing
            has_weenie = wi[record + OBJECT_WEENIE] != 0
            reported |= track_object_collision(b, thing, wi[record + OBJECT_STATE], has_weenie)
    return reported


@entry
def track_object_collision(b: Array, thing: int, state: int, has_weenie: bool) -> bool:
    """Remember a touched object, and report it unless it is remembered already.

    `thing`: its index in the world; `state`: its PhysicsState.

    retail: CPhysicsObj::track_object_collision 0x00513F10, 06 7
    """
    if state & STATIC:
        return _report_environment_collision(b)
    if _remember(b, thing, state):
        return False
    return _report_object_collision(b, state, has_weenie)


@kernel
def _remember(b: Array, thing: int, state: int) -> bool:
    """Note when an object was touched; say whether it was remembered already.

    retail: 06 7
    """
    count = int(b[B_NUM_RECORDS])
    place = 0
    while place < count and b[B_RECORDS + RECORD_SIZE * place] != thing:
        place += 1
    if place == MAX_RECORDS:
        b[B_STATUS] = STATUS_CROWDED
        return True
    record = B_RECORDS + RECORD_SIZE * place
    b[record] = thing
    b[record + RECORD_TIME] = b[B_PHYSICS_TIME]
    b[record + RECORD_ETHEREAL] = 1.0 if state & ETHEREAL else 0.0
    b[B_NUM_RECORDS] = max(count, place + 1)
    return place < count


@kernel
def _report_environment_collision(b: Array) -> bool:
    """Hit the environment, once until it is left; say whether the game object is told.

    retail: CPhysicsObj::report_environment_collision 0x00512FC0, 06 7
    """
    if b[B_COLLIDING] != 0.0:
        return False
    b[B_COLLIDING] = 1.0
    reported = _reports(b)
    _end_flight(b)
    return reported


@kernel
def _report_object_collision(b: Array, state: int, has_weenie: bool) -> bool:
    """Hit an object; say whether either game object is told.

    retail: CPhysicsObj::report_object_collision 0x00513060, 06 7
    """
    if state & COLLIDES_AS_ENVIRONMENT_PS:
        return _report_environment_collision(b)
    reported = False
    if not state & IGNORE_COLLISIONS:
        reported = _reports(b)
        _end_flight(b)
    if has_weenie and state & REPORT_COLLISIONS_PS and not has_bit(b, B_STATE, IGNORE_COLLISIONS):
        reported = True
    return reported


@inlined
def _reports(b: Array) -> bool:
    """Say whether there is a game object that wants to hear of collisions.

    retail: 06 7
    """
    return has_bit(b, B_STATE, REPORT_COLLISIONS_PS) and b[B_HAS_WEENIE] != 0.0


@inlined
def _end_flight(b: Array) -> None:
    """Make a missile that has hit something an ordinary object.

    retail: 06 7
    """
    if has_bit(b, B_STATE, MISSILE):
        set_bit(b, B_STATE, FLIGHT_PS, False)


@kernel
def _report_collision_end(b: Array) -> None:
    """Forget the objects whose last touch is too long ago.

    retail: HC-3
    """
    kept = 0
    for place in range(int(b[B_NUM_RECORDS])):
        record = B_RECORDS + RECORD_SIZE * place
        memory = ETHEREAL_MEMORY if b[record + RECORD_ETHEREAL] != 0.0 else COLLISION_MEMORY
        if not b[B_PHYSICS_TIME] - b[record + RECORD_TIME] > memory:
            copy(b, B_RECORDS + RECORD_SIZE * kept, b, record, RECORD_SIZE)
            kept += 1
    b[B_NUM_RECORDS] = kept


@entry
def respond(s: Array, b: Array, prev_on_walkable: bool) -> bool:
    """Let state and velocity respond to a transition; say whether its hit was reported.

    `prev_on_walkable`: whether the body stood on a walkable before the transition.

    retail: CPhysicsObj::handle_all_collisions 0x00514780, HC-1, HC-3...HC-6
    """
    on_walkable = has_bit(b, B_TRANSIENT, ON_WALKABLE_TS)
    bounce = not (prev_on_walkable and on_walkable and not has_bit(b, B_STATE, SLEDDING_PS))
    reported = False
    _report_collision_end(b)
    hit = s[COLLIDED_WITH_ENVIRONMENT] != 0.0
    if b[B_COLLIDING] != 0.0:
        b[B_COLLIDING] = 1.0 if hit else 0.0
    elif hit or (not prev_on_walkable and on_walkable):
        reported = _report_environment_collision(b)
    frames = int(s[FRAMES_STATIONARY_FALL])
    if frames > 1:
        store(b, B_VELOCITY, 0.0, 0.0, 0.0)
    elif bounce and s[COLLISION_NORMAL_VALID] != 0.0:
        _bounce(s, b)
    _count_stationary_ticks(b, frames)
    return reported


@inlined
def _count_stationary_ticks(b: Array, frames: int) -> None:
    """Write the counter's bits; the lower ones stay when it rises.

    retail: HC-5, HC-6
    """
    if frames in (0, 3):
        set_bit(b, B_TRANSIENT, STATIONARY_TS, False)
    elif frames == 1:
        set_bit(b, B_TRANSIENT, STATIONARY_FALL_TS, True)
    elif frames == 2:
        set_bit(b, B_TRANSIENT, STATIONARY_STOP_TS, True)
    else:
        set_bit(b, B_TRANSIENT, STATIONARY_STUCK_TS, True)


@inlined
def _bounce(s: Array, b: Array) -> None:
    """Turn the velocity away from what was hit, or stop.

    retail: HC-5
    """
    if has_bit(b, B_STATE, INELASTIC_PS):
        store(b, B_VELOCITY, 0.0, 0.0, 0.0)
        return
    x, y, z = load(b, B_VELOCITY)
    nx, ny, nz = load(s, COLLISION_NORMAL)
    d = (z * nz + y * ny) + nx * x
    if d < 0.0:
        e = -(d * (b[B_ELASTICITY] + 1.0))
        ey = f32(e * ny)
        ez = f32(e * nz)
        store(b, B_VELOCITY, f32(e * nx + x), f32(ey + y), f32(ez + z))
