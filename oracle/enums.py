"""Retail's enumerations and state bits, as far as the port reads or returns them."""

from __future__ import annotations

from enum import IntEnum
from typing import Final


class TransitionState(IntEnum):
    """What a collision call says about the check position (04 1.1).

    Attributes
    ----------
    INVALID
        Only from an insert with zero attempts.
    OK
        Nothing (more) is in the way.
    COLLIDED
        A hard stop: the position cannot be used.
    ADJUSTED
        The check position was moved; test again.
    SLID
        The check position was slid along an obstacle; forget the contact plane and test again.
    """

    INVALID = 0
    OK = 1
    COLLIDED = 2
    ADJUSTED = 3
    SLID = 4


class InsertType(IntEnum):
    """How a sphere path enters a cell (SPHEREPATH::InsertType, 04 1.2)."""

    TRANSITION = 0
    PLACEMENT = 1
    INITIAL_PLACEMENT = 2


class Sidedness(IntEnum):
    """On which side of a plane something is (01 6.2)."""

    POSITIVE = 0
    NEGATIVE = 1
    IN_PLANE = 2
    CROSSING = 3


class WaterType(IntEnum):
    """How much of a land cell, or of a landblock, is water (LandDefs::WaterType, 10 6.3)."""

    NOT_WATER = 0
    PARTIALLY_WATER = 1
    ENTIRELY_WATER = 2


class BoundingType(IntEnum):
    """How much of a sphere is in a cell (01 section 7)."""

    OUTSIDE = 0
    PARTIALLY_INSIDE = 1
    ENTIRELY_INSIDE = 2


# Bits of OBJECTINFO.state (ObjectInfoEnum, 04 1.3); plain integers, because an IntFlag costs an
# object for every test of a bit.
CONTACT_OI: Final = 0x0001
ON_WALKABLE_OI: Final = 0x0002
IS_VIEWER_OI: Final = 0x0004
PATH_CLIPPED_OI: Final = 0x0008
FREE_ROTATE_OI: Final = 0x0010
PERFECT_CLIP_OI: Final = 0x0040
IS_IMPENETRABLE: Final = 0x0080
IS_PLAYER: Final = 0x0100
EDGE_SLIDE: Final = 0x0200
IGNORE_CREATURES: Final = 0x0400
IS_PK: Final = 0x0800
IS_PKLITE: Final = 0x1000
