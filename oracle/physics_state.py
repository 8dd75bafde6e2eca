"""Bits of CPhysicsObj.state (PhysicsState) that the port reads or clears (04 1.5, 08 1)."""

from __future__ import annotations

from typing import Final

STATIC_PS: Final = 0x1
ETHEREAL_PS: Final = 0x4
REPORT_COLLISIONS_PS: Final = 0x8
IGNORE_COLLISIONS_PS: Final = 0x10
MISSILE_PS: Final = 0x40
ALIGNPATH_PS: Final = 0x100
PATHCLIPPED_PS: Final = 0x200
GRAVITY_PS: Final = 0x400
PARTICLE_EMITTER_PS: Final = 0x1000
HIDDEN_PS: Final = 0x4000
HAS_PHYSICS_BSP_PS: Final = 0x10000
INELASTIC_PS: Final = 0x20000
REPORT_COLLISIONS_AS_ENVIRONMENT_PS: Final = 0x200000
EDGE_SLIDE_PS: Final = 0x400000
SLEDDING_PS: Final = 0x800000
FROZEN_PS: Final = 0x1000000

FLIGHT_PS: Final = MISSILE_PS | ALIGNPATH_PS | PATHCLIPPED_PS
"""What a missile loses when it hits something (06 7)."""
