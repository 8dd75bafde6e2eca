"""CLandBlock: a landblock, its terrain and its buildings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.land_block_struct import LandBlockStruct
from oracle.land_defs import SIDE_CELLS, adjust_to_outside, gid_to_lcoord

if TYPE_CHECKING:
    from collections.abc import Iterable

    from oracle.building import BuildingObj
    from oracle.land_cell import LandCell


class LandBlock(LandBlockStruct):
    """A loaded landblock."""

    def __repr__(self) -> str:
        return f"LandBlock({self.block_id:#010x})"

    def cell_at(self, cell_id: int) -> LandCell | None:
        """Return the land cell at the place that an id says, in whatever block (10 4.2)."""
        found, x, y = gid_to_lcoord(cell_id)
        return self.cells[y % SIDE_CELLS + x % SIDE_CELLS * SIDE_CELLS] if found else None

    def get_landcell(self, cell_id: int) -> LandCell | None:
        """Return the block's own land cell with this id.

        retail: CLandBlock::get_landcell 0x0052FD20, 10 4.3.
        """
        cell = self.cell_at(cell_id)
        return cell if cell is not None and cell.id == cell_id else None

    def init_buildings(self, buildings: Iterable[BuildingObj]) -> None:
        """Give each building to the land cell under its origin; without one it is dropped.

        retail: CLandBlock::init_buildings 0x0052FD80, 09 3.7.
        """
        for building in buildings:
            p = building.m_position.copy()
            _, cell_id = adjust_to_outside(p.objcell_id, p.frame.origin)
            cell = self.get_landcell(cell_id)
            if cell is not None:
                cell.add_building(building)
