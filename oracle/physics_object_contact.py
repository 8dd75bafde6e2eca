"""CPhysicsObj, contact: the bits that say what the object stands on.

The functions here are methods of `oracle.physics_object.PhysicsObj`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.constants import EPS
from oracle.transient_state import (
    ACTIVE_TS,
    CHECK_ETHEREAL_TS,
    CONTACT_TS,
    ON_WALKABLE_TS,
    SLIDING_TS,
    STATIONARY_TS,
    WATER_CONTACT_TS,
)

if TYPE_CHECKING:
    from oracle.physics_object import PhysicsObj


def check_contact(self: PhysicsObj, contact: int) -> int:
    """Return `contact`, or 0 for an object whose velocity leaves its contact plane.

    retail: CPhysicsObj::check_contact 0x0050F5B0, 06 6.
    """
    v, n = self.m_velocity, self.contact_plane.N
    if self.transient_state & CONTACT_TS and (v.z * n.z + v.y * n.y) + v.x * n.x > EPS:
        return 0
    return contact


def set_on_walkable(self: PhysicsObj, flag: int) -> None:
    """Set or clear the bit that says that the object stands on a walkable.

    retail: CPhysicsObj::set_on_walkable 0x00511310, 06 OW-1…3.
    """
    # OW-1
    was = self.transient_state & ON_WALKABLE_TS
    if flag:
        self.transient_state |= ON_WALKABLE_TS
    else:
        self.transient_state &= ~ON_WALKABLE_TS
    # OW-2
    if self.movement_manager is not None:
        if was and not flag:
            self.movement_manager.leave_ground()
        elif flag and not was:
            self.movement_manager.hit_ground()
    # OW-3
    self.calc_acceleration()


def leave_walkable(self: PhysicsObj) -> None:
    """Stand on nothing (06 WB-9, 1); unlike `set_on_walkable` this may be so already."""
    was = self.transient_state & ON_WALKABLE_TS
    self.transient_state &= ~ON_WALKABLE_TS
    if was and self.movement_manager is not None:
        self.movement_manager.leave_ground()
    self.calc_acceleration()


def clear_transient_states(self: PhysicsObj) -> None:
    """Forget contact, sliding, stationary ticks and activity; planes and normals stay as they are.

    retail: CPhysicsObj::clear_transient_states 0x00511BF0, 06 1.
    """
    self.transient_state &= ~CONTACT_TS
    self.calc_acceleration()
    self.transient_state &= ~WATER_CONTACT_TS
    self.leave_walkable()
    self.transient_state &= ~(SLIDING_TS | STATIONARY_TS | ACTIVE_TS | CHECK_ETHEREAL_TS)
