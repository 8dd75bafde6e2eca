"""CPhysicsObj, velocity: gravity, friction and limits.

The functions here are methods of `oracle.physics_object.PhysicsObj`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import cos, f32, power
from oracle.constants import (
    EPS,
    FRICTION_LIMIT,
    GRAVITY,
    LEAST_VELOCITY2,
    MAX_ELASTICITY,
    MAX_VELOCITY,
    MAX_VELOCITY2,
    SLED_FAST2,
    SLED_FRICTION,
    SLED_SLOPE,
    SLED_SLOW2,
)
from oracle.physics_state import GRAVITY_PS, SLEDDING_PS
from oracle.transient_state import ACTIVE_TS, CONTACT_TS, ON_WALKABLE_TS
from oracle.vector import Vector3, dot_z

if TYPE_CHECKING:
    from oracle.frame import Frame
    from oracle.physics_object import PhysicsObj


def update_physics_internal(self: PhysicsObj, quantum: float, frame: Frame) -> None:
    """Move `frame` by the velocity, then change the velocity by the acceleration.

    `quantum` is in seconds. Without velocity nothing moves, whatever the acceleration.

    retail: CPhysicsObj::UpdatePhysicsInternal 0x00510700, 06 PH-1…8.
    """
    q, v, a, w = quantum, self.m_velocity, self.m_acceleration, self.m_omega
    # PH-1
    v2 = f32(dot_z(v, v))
    # PH-2
    if v2 <= 0.0:
        if self.movement_manager is None and self.transient_state & ON_WALKABLE_TS:
            self.transient_state &= ~ACTIVE_TS
    else:
        # PH-3
        if v2 > MAX_VELOCITY2:
            _limit_speed(v)
            v2 = MAX_VELOCITY2
        # PH-4
        self.calc_friction(q, v2)
        # PH-5
        if v2 - LEAST_VELOCITY2 < EPS:
            v.assign(Vector3())
        # PH-6
        px = f32(f32((a.x * 0.5) * q) * q)
        py = f32(((a.y * 0.5) * q) * q)
        hz = f32(a.z * 0.5)
        sx = f32(q * v.x + px)
        vz = f32(q * v.z)
        sz = f32(vz + (hz * q) * q)
        o = frame.origin
        o.x = f32(sx + o.x)
        o.y = f32((q * v.y + py) + o.y)
        o.z = f32(sz + o.z)
    # PH-7
    v.x = f32(q * a.x + v.x)
    v.y = f32(q * a.y + v.y)
    v.z = f32(f32(q * a.z) + v.z)
    # PH-8
    frame.grotate(Vector3(f32(q * w.x), f32(q * w.y), f32(q * w.z)))


def _limit_speed(v: Vector3) -> None:
    """Bring a velocity down to the highest speed, in two roundings (06 PH-3, SV-1)."""
    v.normalize()
    v.assign(Vector3(f32(MAX_VELOCITY * v.x), f32(MAX_VELOCITY * v.y), f32(MAX_VELOCITY * v.z)))


def calc_friction(self: PhysicsObj, q: float, v2: float) -> None:
    """Slow the object down along its contact plane for `q` seconds.

    `v2` is the squared speed, as it was before.

    retail: CPhysicsObj::calc_friction 0x0050EE70, 06 CF-1…5.
    """
    v, n = self.m_velocity, self.contact_plane.N
    # CF-1
    if not self.transient_state & ON_WALKABLE_TS:
        return
    # CF-2
    d = (v.z * n.z + v.y * n.y) + v.x * n.x
    if d >= FRICTION_LIMIT:
        return
    # CF-3
    v.x = f32(v.x - d * n.x)
    v.y = f32(v.y - d * n.y)
    v.z = f32(v.z - f32(d * n.z))
    # CF-4
    k = self.friction
    if self.state & SLEDDING_PS:
        if v2 < SLED_SLOW2:
            k = 1.0
        elif not (v2 < SLED_FAST2 or cos(SLED_SLOPE) <= n.z):
            k = SLED_FRICTION
    # CF-5
    s = power(1.0 - k, q)
    v.x = f32(s * v.x)
    v.y = f32(s * v.y)
    v.z = f32(s * v.z)


def calc_acceleration(self: PhysicsObj) -> None:
    """Set the acceleration that the contact bits ask for; what stands also stops spinning.

    retail: CPhysicsObj::calc_acceleration 0x00510950, 06 5.
    """
    standing = self.transient_state & CONTACT_TS and self.transient_state & ON_WALKABLE_TS
    if standing and not self.state & SLEDDING_PS:
        self.m_acceleration.assign(Vector3())
        self.m_omega.assign(Vector3())
    elif self.state & GRAVITY_PS:
        self.m_acceleration.assign(Vector3(0.0, 0.0, GRAVITY))
    else:
        self.m_acceleration.assign(Vector3())


def set_velocity(self: PhysicsObj, velocity: Vector3, _send: int) -> None:
    """Take a velocity (metres per second, global axes) unless it is the present one, and wake up.

    retail: CPhysicsObj::set_velocity 0x005113F0, 06 SV-1…2.
    """
    # SV-1
    if velocity.differs(self.m_velocity):
        self.m_velocity.assign(velocity)
        if self.m_velocity.magnitude() > MAX_VELOCITY:
            _limit_speed(self.m_velocity)
        self.jumped_this_frame = 1
    # SV-2
    self.activate()


def set_local_velocity(self: PhysicsObj, velocity: Vector3, send: int) -> None:
    """Take a velocity given in the object's own axes.

    retail: CPhysicsObj::set_local_velocity 0x005114D0, 06 5.
    """
    m, l = self.m_position.frame, velocity
    x = f32((m.m0 * l.x + m.m3 * l.y) + m.m6 * l.z)
    y = f32((m.m1 * l.x + m.m4 * l.y) + m.m7 * l.z)
    z = f32((m.m2 * l.x + m.m5 * l.y) + m.m8 * l.z)
    self.set_velocity(Vector3(x, y, z), send)


def set_elasticity(self: PhysicsObj, elasticity: float) -> None:
    """Take the fraction of the speed that a bounce gives back, within its limits (06 1)."""
    if elasticity < 0.0:
        self.elasticity = 0.0
    elif elasticity > MAX_ELASTICITY:
        self.elasticity = MAX_ELASTICITY
    else:
        self.elasticity = f32(elasticity)
