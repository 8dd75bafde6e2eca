"""CPhysicsObj, the response: bounces, stationary ticks, and the reports of what was hit.

The functions here are methods of `oracle.physics_object.PhysicsObj`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from oracle.arithmetic import f32
from oracle.constants import COLLISION_MEMORY, ETHEREAL_MEMORY
from oracle.physics_state import (
    ETHEREAL_PS,
    FLIGHT_PS,
    IGNORE_COLLISIONS_PS,
    INELASTIC_PS,
    MISSILE_PS,
    REPORT_COLLISIONS_AS_ENVIRONMENT_PS,
    REPORT_COLLISIONS_PS,
    SLEDDING_PS,
    STATIC_PS,
)
from oracle.transient_state import (
    ON_WALKABLE_TS,
    STATIONARY_FALL_TS,
    STATIONARY_STOP_TS,
    STATIONARY_STUCK_TS,
    STATIONARY_TS,
)
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.collision_info import CollisionInfo
    from oracle.physics_object import PhysicsObj


class CollisionRecord(NamedTuple):
    """When an object was touched last (simulated time, seconds), and whether it was ethereal."""

    touched_time: float
    ethereal: int


def handle_all_collisions(
    self: PhysicsObj, ci: CollisionInfo, prev_has_contact: int, prev_on_walkable: int
) -> int:
    """Report what a transition has hit and let the velocity respond; 1 if something was reported.

    retail: CPhysicsObj::handle_all_collisions 0x00514780, 06 HC-1…6.
    """
    on_walkable = self.transient_state & ON_WALKABLE_TS
    # HC-1
    bounce = not (prev_on_walkable and on_walkable and not self.state & SLEDDING_PS)
    # HC-2
    result = 0
    for touched in ci.collide_object:
        if self.track_object_collision(touched, prev_has_contact):
            result = 1
    # HC-3
    self.report_collision_end()
    # HC-4
    if self.colliding_with_environment:
        self.colliding_with_environment = int(ci.collided_with_environment != 0)
    elif ci.collided_with_environment or (not prev_on_walkable and on_walkable):
        result |= self.report_environment_collision(prev_has_contact)
    # HC-5
    frames = ci.frames_stationary_fall
    if frames <= 1:
        if bounce and ci.collision_normal_valid:
            _bounce(self, ci.collision_normal)
    else:
        self.m_velocity.assign(Vector3())
        if frames == 3:
            self.transient_state &= ~STATIONARY_TS
            return result
    # HC-6
    if frames == 0:
        self.transient_state &= ~STATIONARY_TS
    elif frames == 1:
        self.transient_state |= STATIONARY_FALL_TS
    elif frames == 2:
        self.transient_state |= STATIONARY_STOP_TS
    else:
        self.transient_state |= STATIONARY_STUCK_TS
    return result


def _bounce(self: PhysicsObj, n: Vector3) -> None:
    """Turn the velocity away from what has the collision normal `n`, or stop (06 HC-5)."""
    v = self.m_velocity
    if self.state & INELASTIC_PS:
        v.assign(Vector3())
        return
    d = (v.z * n.z + v.y * n.y) + n.x * v.x
    if d < 0.0:
        e = -(d * (self.elasticity + 1.0))
        ey = f32(e * n.y)
        ez = f32(e * n.z)
        v.x = f32(e * n.x + v.x)
        v.y = f32(ey + v.y)
        v.z = f32(ez + v.z)


def track_object_collision(self: PhysicsObj, other: PhysicsObj, prev_has_contact: int) -> int:
    """Remember a touched object; it is reported unless it is remembered already.

    retail: CPhysicsObj::track_object_collision 0x00513F10, 06 7.
    """
    if other.state & STATIC_PS:
        return self.report_environment_collision(prev_has_contact)
    known = other.id in self.collision_table
    now = self.world.clock.curr_time
    self.collision_table[other.id] = CollisionRecord(now, other.state & ETHEREAL_PS)
    return 0 if known else self.report_object_collision(other, prev_has_contact)


def report_collision_end(self: PhysicsObj) -> None:
    """Forget the objects whose last touch is too long ago (06 HC-3)."""
    now = self.world.clock.curr_time
    for touched, record in list(self.collision_table.items()):
        memory = ETHEREAL_MEMORY if record.ethereal else COLLISION_MEMORY
        if now - record.touched_time > memory:
            del self.collision_table[touched]


def report_environment_collision(self: PhysicsObj, prev_has_contact: int) -> int:
    """Hit the environment, once until it is left; 1 if the game object is told.

    retail: CPhysicsObj::report_environment_collision 0x00512FC0, 06 7.
    """
    if self.colliding_with_environment:
        return 0
    self.colliding_with_environment = 1
    reported = int(_reports(self))
    _end_flight(self)
    return reported


def report_object_collision(self: PhysicsObj, other: PhysicsObj, prev_has_contact: int) -> int:
    """Hit an object; 1 if either game object is told.

    retail: CPhysicsObj::report_object_collision 0x00513060, 06 7.
    """
    if other.state & REPORT_COLLISIONS_AS_ENVIRONMENT_PS:
        return self.report_environment_collision(prev_has_contact)
    reported = 0
    if not other.state & IGNORE_COLLISIONS_PS:
        reported = int(_reports(self))
        _end_flight(self)
    if _reports(other) and not self.state & IGNORE_COLLISIONS_PS:
        reported = 1
    return reported


def _reports(physobj: PhysicsObj) -> bool:
    """Tell whether there is a game object that wants to hear of collisions (06 7)."""
    return bool(physobj.state & REPORT_COLLISIONS_PS) and physobj.weenie_obj is not None


def _end_flight(self: PhysicsObj) -> None:
    """Make a missile that has hit something an ordinary object (06 7)."""
    if self.state & MISSILE_PS:
        self.state &= ~FLIGHT_PS
