"""CPhysics::UseTime and CPhysicsObj::update_object (06, 2): which time is simulated, in which ticks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from engine.body_layout import (
    B_CELL,
    B_CLOCK,
    B_HAS_PARENT,
    B_PHYSICS_TIME,
    B_POSITION,
    B_STATE,
    B_STATUS,
    B_TRANSIENT,
    B_UPDATE_TIME,
)
from engine.constants import (
    ACTIVE_DISTANCE,
    ACTIVE_TS,
    EPS,
    FROZEN_PS,
    HUGE_QUANTUM,
    MAX_QUANTUM,
    MIN_QUANTUM,
    frozen,
)
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.position import position_get_offset
from engine.kernels.rounding import f32
from engine.kernels.tick import update_object_internal
from engine.kernels.tick_velocity import activate, has_bit, set_bit
from engine.layout import NO_CELL, STATUS_OK

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints

WAIT: Final = frozen(0)
"""Too little time has passed; nothing is simulated in this frame."""
RESET: Final = frozen(1)
"""The clock went back."""
RUN: Final = frozen(2)
"""The frame is simulated."""

MAX_TICKS: Final = frozen(11)
"""Most ticks of one frame: `HUGE_QUANTUM` in ticks of `MAX_QUANTUM`, and a remainder."""


@entry
def frame_gate(last_update: float, now: float) -> tuple[int, float]:
    """Say what a rendered frame does, and up to when everything is simulated after it; seconds.

    retail: CPhysics::UseTime 0x00509950, UT-1...UT-5
    """
    q = now - last_update
    if q < 0.0:
        return RESET, now
    if q < MIN_QUANTUM:
        return WAIT, last_update
    return RUN, now


@entry
def near_player(b: Array, player: Array, maintained: bool) -> float:
    """Wake a body up, or let it rest far from the player; return the distance, metres.

    `player`: the player's position; `maintained`: whether the object maintainer is active.

    retail: CPhysicsObj::update_object 0x00515D10, QT-2
    """
    if not _can_move(b):
        return math.nan
    x, y, z = position_get_offset(player, 0, b, B_POSITION)
    distance = math.sqrt((x * x + y * y) + z * z)
    if distance > ACTIVE_DISTANCE and maintained:
        set_bit(b, B_TRANSIENT, ACTIVE_TS, False)
    else:
        activate(b)
    return f32(distance)


@inlined
def _can_move(b: Array) -> bool:
    """Say whether a body has no parent, has a cell, and is not frozen.

    retail: QT-1
    """
    return b[B_HAS_PARENT] == 0.0 and b[B_CELL] != NO_CELL and not has_bit(b, B_STATE, FROZEN_PS)


@entry
def object_gate(b: Array, quanta: Array, times: Array) -> int:
    """Divide the time since the body's last tick into ticks; return how many.

    The lengths of the ticks (float32) go to `quanta`, and the time at the end of each to `times`; both
    have room for `MAX_TICKS`. The body's times are those after the last tick.

    retail: CPhysicsObj::update_object 0x00515D10, QT-1, QT-3...QT-9
    """
    if not _can_move(b):
        set_bit(b, B_TRANSIENT, ACTIVE_TS, False)
        return 0
    q = b[B_CLOCK] - b[B_UPDATE_TIME]
    b[B_PHYSICS_TIME] = b[B_UPDATE_TIME]
    if q <= EPS or q > HUGE_QUANTUM:
        b[B_UPDATE_TIME] = b[B_CLOCK]
        return 0
    count = 0
    while q > MAX_QUANTUM:
        count = _add_tick(b, quanta, times, count, MAX_QUANTUM)
        q = q - MAX_QUANTUM
    if count == 0 or q > MIN_QUANTUM:
        count = _add_tick(b, quanta, times, count, q)
    b[B_UPDATE_TIME] = b[B_PHYSICS_TIME]
    return count


@inlined
def _add_tick(b: Array, quanta: Array, times: Array, count: int, q: float) -> int:
    """Append a tick, and return how many there are.

    retail: QT-7, QT-8
    """
    b[B_PHYSICS_TIME] += q
    quanta[count] = f32(q)
    times[count] = b[B_PHYSICS_TIME]
    return count + 1


@kernel
def update(wf: Array, wi: Ints, s: Array, b: Array, now: float, quanta: Array, times: Array) -> None:
    """Simulate a body up to `now`; it stops at the first tick that fails.

    `quanta`, `times`: room for its ticks.

    retail: CPhysicsObj::update_object 0x00515D10, without a player
    """
    b[B_STATUS] = STATUS_OK
    b[B_CLOCK] = now
    for k in range(object_gate(b, quanta, times)):
        if b[B_STATUS] == STATUS_OK:
            b[B_PHYSICS_TIME] = times[k]
            update_object_internal(wf, wi, s, b, quanta[k])
