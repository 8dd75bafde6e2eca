"""Bits of CPhysicsObj.transient_state (04 1.4)."""

from __future__ import annotations

from typing import Final

CONTACT_TS: Final = 0x1
ON_WALKABLE_TS: Final = 0x2
SLIDING_TS: Final = 0x4
WATER_CONTACT_TS: Final = 0x8
STATIONARY_FALL_TS: Final = 0x10
STATIONARY_STOP_TS: Final = 0x20
STATIONARY_STUCK_TS: Final = 0x40
ACTIVE_TS: Final = 0x80
CHECK_ETHEREAL_TS: Final = 0x100

STATIONARY_TS: Final = STATIONARY_FALL_TS | STATIONARY_STOP_TS | STATIONARY_STUCK_TS
"""All that counts ticks without movement (06 HC-6)."""
