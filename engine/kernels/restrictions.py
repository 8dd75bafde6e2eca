"""Cells that not everybody may enter: those of a house (09, 3.1)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import COLLIDED, HALF_CELL, IS_PLAYER, OK
from engine.kernels.cell_array import ints_of, is_land, position_of
from engine.kernels.collision_info import set_collision_normal
from engine.kernels.compile import inlined, kernel
from engine.kernels.position import position_get_offset
from engine.layout import (
    CELL_RESTRICTION,
    CURR_POS,
    MOVER_ID,
    MOVER_RESTRICTED,
    NO_RESTRICTION,
    OI_STATE,
    RESTRICTION_COUNT,
    RESTRICTION_IDS,
    RESTRICTION_KNOWN,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@inlined
def is_restricted(wi: Ints, cell: int) -> bool:
    """Say whether there is anything to ask before a mover enters a cell."""
    return wi[ints_of(wi, cell) + CELL_RESTRICTION] != NO_RESTRICTION


@kernel
def check_entry_restrictions(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Refuse a player who may not enter a cell that is restricted.

    retail: CObjCell::check_entry_restrictions 0x0052B6D0, 09 3.1
    """
    if s[MOVER_RESTRICTED] == 0.0 or not int(s[OI_STATE]) & IS_PLAYER:
        return OK
    restriction = wi[ints_of(wi, cell) + CELL_RESTRICTION]
    if wi[restriction + RESTRICTION_KNOWN] == 0:
        return COLLIDED
    first = restriction + RESTRICTION_IDS
    for i in range(first, first + wi[restriction + RESTRICTION_COUNT]):
        if wi[i] == s[MOVER_ID]:
            return OK
    if is_land(wi, cell):
        _handle_move_restriction(wf, wi, s, cell)
    return COLLIDED


@kernel
def _handle_move_restriction(wf: Array, wi: Ints, s: Array, cell: int) -> None:
    """Take the side of a land cell on which the refused mover is as the collision normal.

    retail: CLandCell::handle_move_restriction 0x00533070, 09 3.1
    """
    x, y, _ = position_get_offset(wf, position_of(wi, cell), s, CURR_POS)
    if y < -HALF_CELL:
        set_collision_normal(s, 0.0, -1.0, 0.0)
    elif y > HALF_CELL:
        set_collision_normal(s, 0.0, 1.0, 0.0)
    elif x < -HALF_CELL:
        set_collision_normal(s, -1.0, 0.0, 0.0)
    else:
        set_collision_normal(s, 1.0, 0.0, 0.0)
