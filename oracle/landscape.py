"""LScape: the landblocks that are loaded."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.land_defs import FIRST_INTERIOR_CELL, SIDE_CELLS, inbound_valid_cellid

if TYPE_CHECKING:
    from collections.abc import Mapping

    from oracle.land_block import LandBlock
    from oracle.land_cell import LandCell


class Landscape:
    """The loaded landblocks, by the high word of their id.

    Retail has them in a square grid around the player and looks into the grid; what is outside of the
    grid and what is not in the mapping are the same thing.
    """

    def __init__(self, blocks: Mapping[int, LandBlock]) -> None:
        self.blocks = blocks

    def get_landblock(self, cell_id: int) -> LandBlock | None:
        """Return the block of a land cell, if it is loaded with full detail.

        retail: LScape::get_landblock 0x00505E40, 10 4.1.
        """
        if not inbound_valid_cellid(cell_id) or (cell_id & 0xFFFF) >= FIRST_INTERIOR_CELL:
            return None
        block = self.blocks.get(cell_id >> 16)
        return block if block is not None and block.side_cell_count == SIDE_CELLS else None

    def get_landcell(self, cell_id: int) -> LandCell | None:
        """Return a land cell, if its block is loaded.

        retail: LScape::get_landcell 0x00505F10, 10 4.2.
        """
        block = self.get_landblock(cell_id)
        return None if block is None else block.cell_at(cell_id)
