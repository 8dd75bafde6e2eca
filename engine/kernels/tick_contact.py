"""CPhysicsObj, contact (06, 5 and 6): the bits that say what a body stands on.

A body's movement manager, if it has one, does nothing when it leaves or hits the ground.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.body_layout import B_CONTACT_PLANE, B_TRANSIENT, B_VELOCITY
from engine.constants import (
    ACTIVE_TS,
    CHECK_ETHEREAL_TS,
    CONTACT_TS,
    EPS,
    ON_WALKABLE_TS,
    SLIDING_TS,
    STATIONARY_TS,
    WATER_CONTACT_TS,
)
from engine.kernels.compile import entry, inlined
from engine.kernels.tick_velocity import calc_acceleration, has_bit, set_bit
from engine.kernels.vector import load

if TYPE_CHECKING:
    from engine.kernels.types import Array


@inlined
def leaves_contact(b: Array) -> bool:
    """Say whether the velocity leads away from the contact plane.

    retail: CPhysicsObj::check_contact 0x0050F5B0, 06 6
    """
    vx, vy, vz = load(b, B_VELOCITY)
    nx, ny, nz = load(b, B_CONTACT_PLANE)
    return has_bit(b, B_TRANSIENT, CONTACT_TS) and (vz * nz + vy * ny) + vx * nx > EPS


@entry
def set_on_walkable(b: Array, flag: bool) -> None:
    """Set or clear the bit that says that the body stands on a walkable.

    retail: CPhysicsObj::set_on_walkable 0x00511310, OW-1...OW-3
    """
    set_bit(b, B_TRANSIENT, ON_WALKABLE_TS, flag)
    calc_acceleration(b)


@entry
def clear_transient_states(b: Array) -> None:
    """Forget contact, sliding, stationary ticks and activity; planes and normals stay as they are.

    retail: CPhysicsObj::clear_transient_states 0x00511BF0, 06 1
    """
    set_bit(b, B_TRANSIENT, CONTACT_TS, False)
    calc_acceleration(b)
    set_bit(b, B_TRANSIENT, WATER_CONTACT_TS, False)
    set_on_walkable(b, False)
    set_bit(b, B_TRANSIENT, SLIDING_TS | STATIONARY_TS | ACTIVE_TS | CHECK_ETHEREAL_TS, False)
