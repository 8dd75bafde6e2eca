"""From a cell id to the cell (09, 2): a table with open addressing; the world's size does not matter.

An entry is an id and an index. The land cells of a block share one entry, under the block's id with the
low word 0, which is no cell's.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine.constants import FIRST_INDOOR, frozen
from engine.kernels.compile import entry
from engine.layout import NO_CELL, WORLD_IDS, WORLD_IDS_MASK

if TYPE_CHECKING:
    from engine.kernels.types import Ints

FREE: Final = frozen(-1)
"""Key of an entry that is not used."""
LAST_LAND_CELL: Final = frozen(0x40)
"""Largest low word of a land cell's id (10, 1)."""
_BLOCK_STRIDE: Final = frozen(7919)
"""Spreads the ids of different blocks, whose cells are numbered alike; any large odd number will do."""


@entry
def id_slot(cell_id: int, mask: int) -> int:
    """Return the entry at which the search for an id begins."""
    return ((cell_id >> 16) * _BLOCK_STRIDE + (cell_id & 0xFFFF)) & mask


@entry
def find_cell(wi: Ints, wanted: float) -> int:
    """Return the cell with an id, or NO_CELL.

    retail: CObjCell::GetVisible 0x0052AD40, 09 2
    """
    key = int(wanted)
    number = 0
    low = key & 0xFFFF
    if low < FIRST_INDOOR:
        if low == 0 or low > LAST_LAND_CELL:
            return NO_CELL
        number = low - 1
        key -= low
    mask = wi[WORLD_IDS_MASK]
    slot = id_slot(key, mask)
    while True:
        at = wi[WORLD_IDS] + 2 * slot
        if wi[at] == key:
            return wi[at + 1] + number
        if wi[at] == FREE:
            return NO_CELL
        slot = (slot + 1) & mask
