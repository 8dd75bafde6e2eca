"""CPhysicsObj, velocity (06, 5): gravity, friction and limits."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.body_layout import (
    B_ACCELERATION,
    B_CLOCK,
    B_CONTACT_PLANE,
    B_FRICTION,
    B_HAS_MOVEMENT_MANAGER,
    B_JUMPED,
    B_OMEGA,
    B_POSITION,
    B_STATE,
    B_TRANSIENT,
    B_UPDATE_TIME,
    B_VELOCITY,
)
from engine.constants import (
    ACTIVE_TS,
    CONTACT_TS,
    EPS,
    FRICTION_LIMIT,
    GRAVITY,
    GRAVITY_PS,
    LEAST_VELOCITY2,
    MAX_VELOCITY,
    MAX_VELOCITY2,
    ON_WALKABLE_TS,
    SLED_FAST2,
    SLED_FRICTION,
    SLED_SLOPE_Z,
    SLED_SLOW2,
    SLEDDING_PS,
    STATIC,
)
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.frame_motion import frame_grotate
from engine.kernels.rounding import f32
from engine.kernels.vector import load, store
from engine.layout import MATRIX, ORIGIN

if TYPE_CHECKING:
    from engine.kernels.types import Array


@inlined
def has_bit(b: Array, field: int, bit: int) -> bool:
    """Say whether one of the bits of a field is set."""
    return int(b[field]) & bit != 0


@inlined
def set_bit(b: Array, field: int, bit: int, flag: bool) -> None:
    """Set or clear bits of a field."""
    b[field] = int(b[field]) | bit if flag else int(b[field]) & ~bit


@entry
def update_physics_internal(b: Array, p: int, q: float) -> None:
    """Move the frame at `p` by the velocity, then change the velocity; `q` in seconds.

    Without velocity nothing moves, whatever the acceleration.

    retail: CPhysicsObj::UpdatePhysicsInternal 0x00510700, PH-1...PH-8
    """
    vx, vy, vz = load(b, B_VELOCITY)
    v2 = f32((vx * vx + vy * vy) + vz * vz)
    if v2 <= 0.0:
        if b[B_HAS_MOVEMENT_MANAGER] == 0.0 and has_bit(b, B_TRANSIENT, ON_WALKABLE_TS):
            set_bit(b, B_TRANSIENT, ACTIVE_TS, False)
    else:
        if v2 > MAX_VELOCITY2:
            _limit_speed(b)
            v2 = MAX_VELOCITY2
        calc_friction(b, q, v2)
        if v2 - LEAST_VELOCITY2 < EPS:
            store(b, B_VELOCITY, 0.0, 0.0, 0.0)
        _displace(b, p, q)
    ax, ay, az = load(b, B_ACCELERATION)
    vx, vy, vz = load(b, B_VELOCITY)
    store(b, B_VELOCITY, f32(q * ax + vx), f32(q * ay + vy), f32(f32(q * az) + vz))
    wx, wy, wz = load(b, B_OMEGA)
    frame_grotate(b, p, f32(q * wx), f32(q * wy), f32(q * wz))


@inlined
def _displace(b: Array, p: int, q: float) -> None:
    """Move a frame by the velocity and half the acceleration.

    retail: PH-6
    """
    ax, ay, az = load(b, B_ACCELERATION)
    vx, vy, vz = load(b, B_VELOCITY)
    x, y, z = load(b, p + ORIGIN)
    px = f32(f32((ax * 0.5) * q) * q)
    py = f32(((ay * 0.5) * q) * q)
    hz = f32(az * 0.5)
    sx = f32(q * vx + px)
    fallen = f32(q * vz)
    sz = f32(fallen + (hz * q) * q)
    store(b, p + ORIGIN, f32(sx + x), f32((q * vy + py) + y), f32(sz + z))


@inlined
def _limit_speed(b: Array) -> None:
    """Bring the velocity down to the highest speed, in two roundings.

    retail: PH-3, SV-1
    """
    x, y, z = load(b, B_VELOCITY)
    r = 1.0 / math.sqrt((x * x + y * y) + z * z)
    store(
        b,
        B_VELOCITY,
        f32(MAX_VELOCITY * f32(r * x)),
        f32(MAX_VELOCITY * f32(r * y)),
        f32(MAX_VELOCITY * f32(r * z)),
    )


@entry
def calc_friction(b: Array, q: float, v2: float) -> None:
    """Slow down along the contact plane for `q` seconds; `v2` is the squared speed as it was before.

    retail: CPhysicsObj::calc_friction 0x0050EE70, CF-1...CF-5
    """
    if not has_bit(b, B_TRANSIENT, ON_WALKABLE_TS):
        return
    x, y, z = load(b, B_VELOCITY)
    nx, ny, nz = load(b, B_CONTACT_PLANE)
    d = (z * nz + y * ny) + x * nx
    if d >= FRICTION_LIMIT:
        return
    x = f32(x - d * nx)
    y = f32(y - d * ny)
    z = f32(z - f32(d * nz))
    k = b[B_FRICTION]
    if has_bit(b, B_STATE, SLEDDING_PS):
        if v2 < SLED_SLOW2:
            k = 1.0
        elif not (v2 < SLED_FAST2 or nz >= SLED_SLOPE_Z):
            k = SLED_FRICTION
    s = math.pow(1.0 - k, q)
    store(b, B_VELOCITY, f32(s * x), f32(s * y), f32(s * z))


@entry
def calc_acceleration(b: Array) -> None:
    """Set the acceleration that the contact bits ask for; what stands also stops spinning.

    retail: CPhysicsObj::calc_acceleration 0x00510950, 06 5
    """
    standing = has_bit(b, B_TRANSIENT, CONTACT_TS) and has_bit(b, B_TRANSIENT, ON_WALKABLE_TS)
    store(b, B_ACCELERATION, 0.0, 0.0, 0.0)
    if standing and not has_bit(b, B_STATE, SLEDDING_PS):
        store(b, B_OMEGA, 0.0, 0.0, 0.0)
    elif has_bit(b, B_STATE, GRAVITY_PS):
        b[B_ACCELERATION + 2] = GRAVITY


@kernel
def activate(b: Array) -> None:
    """Let the body be simulated from now on, unless it is static.

    retail: CPhysicsObj::set_active, QT-2, SV-2
    """
    if has_bit(b, B_STATE, STATIC):
        return
    if not has_bit(b, B_TRANSIENT, ACTIVE_TS):
        b[B_UPDATE_TIME] = b[B_CLOCK]
    set_bit(b, B_TRANSIENT, ACTIVE_TS, True)


@entry
def set_velocity(b: Array, x: float, y: float, z: float) -> None:
    """Take a velocity (metres per second, global axes) unless it is the present one, and wake up.

    retail: CPhysicsObj::set_velocity 0x005113F0, SV-1, SV-2
    """
    vx, vy, vz = load(b, B_VELOCITY)
    if abs(x - vx) > EPS or abs(y - vy) > EPS or abs(z - vz) > EPS:
        store(b, B_VELOCITY, x, y, z)
        if math.sqrt((x * x + y * y) + z * z) > MAX_VELOCITY:
            _limit_speed(b)
        b[B_JUMPED] = 1.0
    activate(b)


@entry
def set_local_velocity(b: Array, x: float, y: float, z: float) -> None:
    """Take a velocity given in the body's own axes.

    retail: CPhysicsObj::set_local_velocity 0x005114D0, 06 5
    """
    m = B_POSITION + MATRIX
    set_velocity(
        b,
        f32((b[m] * x + b[m + 3] * y) + b[m + 6] * z),
        f32((b[m + 1] * x + b[m + 4] * y) + b[m + 7] * z),
        f32((b[m + 2] * x + b[m + 5] * y) + b[m + 8] * z),
    )
