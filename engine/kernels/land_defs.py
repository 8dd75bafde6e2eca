"""LandDefs (10, 2): which landblock and land cell a point lies in.

Land coordinates count the land cells from the land's south-west corner.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import BLOCK_EDGE, BLOCK_STEP, EPS, FIRST_INDOOR, LAND_WIDTH, frozen
from engine.kernels.cell_ids import LAST_LAND_CELL
from engine.kernels.compile import entry, inlined
from engine.kernels.rounding import f32
from engine.layout import ORIGIN

if TYPE_CHECKING:
    from engine.kernels.types import Array

LAST_INDOOR = frozen(0xFFFD)
"""Largest low word of an environment cell's id (10, 1)."""
BLOCK_ITSELF = frozen(0xFFFF)
"""Low word of a landblock's own id (10, 1)."""


@inlined
def _names_a_cell(cell_id: int) -> bool:
    """Say whether an id's low word is that of a land cell, an environment cell or a block.

    retail: 10 1
    """
    low = cell_id & 0xFFFF
    return 1 <= low <= LAST_LAND_CELL or FIRST_INDOOR <= low <= LAST_INDOOR or low == BLOCK_ITSELF


@entry
def in_bounds(x: int, y: int) -> bool:
    """Say whether land coordinates are on the land.

    retail: LandDefs::in_bounds 0x0043D650, 10 2.2
    """
    return 0 <= x < LAND_WIDTH and 0 <= y < LAND_WIDTH


@entry
def block_coordinates(cell_id: int) -> tuple[int, int]:
    """Return the land coordinates of the south-west cell of an id's block, on the land or not.

    retail: LandDefs::blockid_to_lcoord 0x0043D680, 10 2.1 step 2
    """
    return (cell_id >> 21) & 0x7F8, (cell_id >> 13) & 0x7F8


@entry
def inbound_valid_cellid(cell_id: int) -> bool:
    """Say whether an id names a cell, or a block, of the land.

    retail: LandDefs::inbound_valid_cellid 0x004979A0, 10 2.3
    """
    x, y = block_coordinates(cell_id)
    return _names_a_cell(cell_id) and x < LAND_WIDTH and y < LAND_WIDTH


@entry
def gid_to_lcoord(cell_id: int) -> tuple[bool, int, int]:
    """Return whether an id is that of a land cell, and its land coordinates.

    retail: LandDefs::gid_to_lcoord 0x00497A90, 10 2.4
    """
    low = cell_id & 0xFFFF
    if not inbound_valid_cellid(cell_id) or low >= FIRST_INDOOR:
        return False, 0, 0
    x, y = block_coordinates(cell_id)
    x, y = x + ((low - 1) >> 3), y + ((low - 1) & 7)
    return in_bounds(x, y), x, y


@entry
def lcoord_to_gid(x: int, y: int) -> int:
    """Return the id of the land cell at land coordinates, or 0.

    retail: LandDefs::lcoord_to_gid 0x004A19A0, 10 2.5
    """
    if not in_bounds(x, y):
        return 0
    return ((((x >> 3) << 8) | (y >> 3)) << 16) | (((x & 7) << 3) + (y & 7) + 1)


@entry
def get_outside_lcoord(cell_id: int, px: float, py: float) -> tuple[bool, int, int]:
    """Return whether a point of a block is on the land, and the coordinates of the cell that it is in.

    retail: LandDefs::get_outside_lcoord 0x005A9B00, 10 2.7
    """
    if not _names_a_cell(cell_id):
        return False, 0, 0
    x, y = block_coordinates(cell_id)
    x, y = x + math.floor(px / BLOCK_STEP), y + math.floor(py / BLOCK_STEP)
    return in_bounds(x, y), x, y


@inlined
def _snapped(x: float) -> float:
    """Take what is next to the block's origin to it.

    retail: 10 2.8 step 2
    """
    return 0.0 if abs(x) < EPS else x


@inlined
def _within_block(x: float) -> float:
    """Take a coordinate to the block that it is in.

    retail: 10 2.8 step 4
    """
    return f32(x - math.floor(x / BLOCK_EDGE) * BLOCK_EDGE)


@entry
def outside_cell(cell_id: int, px: float, py: float) -> tuple[int, float, float]:
    """Return the land cell that a point of a block is in, and the point in that cell's block.

    Where there is none the id is 0, and the point is only snapped, if the id names a cell at all.

    retail: LandDefs::adjust_to_outside 0x005A9BC0, 10 2.8
    """
    if not _names_a_cell(cell_id):
        return 0, px, py
    px, py = _snapped(px), _snapped(py)
    found, x, y = get_outside_lcoord(cell_id, px, py)
    if not found:
        return 0, px, py
    return lcoord_to_gid(x, y), _within_block(px), _within_block(py)


@entry
def adjust_to_outside(a: Array, p: int) -> None:
    """Bring a position to the land cell under it, or to id 0 where there is none.

    retail: LandDefs::adjust_to_outside 0x005A9BC0, 10 2.8
    """
    cell_id, x, y = outside_cell(int(a[p]), a[p + ORIGIN], a[p + ORIGIN + 1])
    a[p] = cell_id
    a[p + ORIGIN] = x
    a[p + ORIGIN + 1] = y
