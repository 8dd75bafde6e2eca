"""CPhysicsObj, the write-back (06, 8): what a body takes over from its finished transition."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.body_layout import (
    B_CELL,
    B_CONTACT_CELL_ID,
    B_CONTACT_PLANE,
    B_POSITION,
    B_REPORTED,
    B_SLIDING_NORMAL,
    B_TRANSIENT,
)
from engine.constants import (
    ACTIVE_TS,
    CONTACT_TS,
    FIRST_INDOOR,
    FLOOR_Z,
    ON_WALKABLE_TS,
    SLIDING_TS,
    WATER_CONTACT_TS,
)
from engine.kernels.compile import entry, kernel
from engine.kernels.frame_motion import set_frame
from engine.kernels.land_defs import adjust_to_outside
from engine.kernels.tick_collisions import respond, track_touched_objects
from engine.kernels.tick_contact import set_on_walkable
from engine.kernels.tick_velocity import calc_acceleration, has_bit, set_bit
from engine.kernels.vector import copy_four, copy_position, copy_vector
from engine.layout import (
    CELL_FLOATS,
    CELL_ID,
    CONTACT_CELL_ID,
    CONTACT_IS_WATER,
    CONTACT_PLANE,
    CONTACT_VALID,
    CURR_CELL,
    CURR_POS,
    NO_CELL,
    SLIDING_NORMAL,
    SLIDING_VALID,
    WORLD_CELL_FLOATS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def set_position_internal(wf: Array, wi: Ints, s: Array, b: Array) -> None:
    """Take over position and contact, then respond to the collisions.

    retail: CPhysicsObj::SetPositionInternal 0x00515330, WB-1...WB-11
    """
    prev_on_walkable = has_bit(b, B_TRANSIENT, ON_WALKABLE_TS)
    cell = int(s[CURR_CELL])
    if cell == NO_CELL:
        become_lost(s, b)
        return
    take_over(s, b, wf[wi[WORLD_CELL_FLOATS] + CELL_FLOATS * cell + CELL_ID])
    reported = track_touched_objects(wi, s, b)
    reported |= respond(s, b, prev_on_walkable)
    b[B_REPORTED] = 1.0 if reported else 0.0


@entry
def take_over(s: Array, b: Array, cell_id: float) -> None:
    """Take over position, contact plane and sliding normal; `cell_id` is the one of the current cell.

    retail: CPhysicsObj::SetPositionInternal 0x00515330, WB-3...WB-10
    """
    b[B_POSITION] = s[CURR_POS] if b[B_CELL] == s[CURR_CELL] else cell_id
    b[B_CELL] = s[CURR_CELL]
    set_frame(b, B_POSITION, s, CURR_POS)
    b[B_CONTACT_CELL_ID] = s[CONTACT_CELL_ID]
    copy_four(b, B_CONTACT_PLANE, s, CONTACT_PLANE)
    contact = s[CONTACT_VALID] != 0.0
    set_bit(b, B_TRANSIENT, CONTACT_TS, contact)
    calc_acceleration(b)
    set_bit(b, B_TRANSIENT, WATER_CONTACT_TS, s[CONTACT_IS_WATER] != 0.0)
    set_on_walkable(b, contact and not b[B_CONTACT_PLANE + 2] < FLOOR_Z)
    copy_vector(b, B_SLIDING_NORMAL, s, SLIDING_NORMAL)
    set_bit(b, B_TRANSIENT, SLIDING_TS, s[SLIDING_VALID] != 0.0)


@entry
def become_lost(s: Array, b: Array) -> None:
    """Be in no cell any more; nothing but position and activity changes.

    retail: CPhysicsObj::SetPositionInternal 0x00515330, WB-2
    """
    b[B_CELL] = NO_CELL
    copy_position(b, B_POSITION, s, CURR_POS)
    if (int(b[B_POSITION]) & 0xFFFF) < FIRST_INDOOR:
        adjust_to_outside(b, B_POSITION)
    set_bit(b, B_TRANSIENT, ACTIVE_TS, False)
