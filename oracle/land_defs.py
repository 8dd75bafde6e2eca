"""LandDefs: arithmetic of landblocks and land cells, and the table of terrain heights."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from oracle.arithmetic import f32, floor
from oracle.constants import BLOCK_EDGE, CELL_EDGE, EPS
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Sequence

SIDE_CELLS: Final = 8
"""Cells along an edge of a landblock (10 1)."""
LAND_WIDTH: Final = 2040
"""Cells along an edge of the land: 255 blocks of 8 (10 1)."""
FIRST_INTERIOR_CELL: Final = 0x100
"""Low words of cell ids from here on are interior cells (09, introduction)."""
LAST_LAND_CELL: Final = 0x40
"""Low words of land cells are 1 to 64 (10 1)."""
LAST_INTERIOR_CELL: Final = 0xFFFD
"""The last low word of an interior cell (10 1)."""
WHOLE_BLOCK: Final = 0xFFFF
"""The low word that stands for a landblock (10 1)."""
HEIGHT_TABLE_SIZE: Final = 256
"""Entries of Land_Height_Table (10 1)."""
MAX_HEIGHT: Final = 800.0
"""Highest vertex that the height table may hold, metres (10 1)."""


def get_block_offset(cell_from: int, cell_to: int) -> Vector3:
    """Return what turns coordinates of `cell_to`'s block into coordinates of `cell_from`'s, metres.

    A zero `cell_from` is the block (0, 0). For a zero `cell_to` retail reads uninitialised locals
    (01 5.1, degenerate); here it is the block (0, 0) too.

    retail: LandDefs::get_block_offset 0x0043E630, 10 2.6.
    """
    # 10 2.6.1
    if cell_from >> 16 == cell_to >> 16:
        return Vector3()
    # 10 2.6.2
    fx, fy = _block_lcoord(cell_from)
    tx, ty = _block_lcoord(cell_to)
    # 10 2.6.3
    return Vector3(f32(float(tx - fx) * CELL_EDGE), f32(float(ty - fy) * CELL_EDGE), 0.0)


def _block_lcoord(cell_id: int) -> tuple[int, int]:
    """Return the coordinates of the first cell of an id's block, in cells (10 2.1.2)."""
    return (cell_id >> 21) & 0x7F8, 8 * ((cell_id >> 16) & 0xFF)


def blockid_to_lcoord(cell_id: int) -> tuple[int, int, int]:
    """Return whether the block is on the land, and the coordinates of its first cell, in cells.

    For a zero id retail leaves its outputs alone; here they are 0.

    retail: LandDefs::blockid_to_lcoord 0x0043D680, 10 2.1.
    """
    # 10 2.1.1
    if cell_id == 0:
        return 0, 0, 0
    # 10 2.1.2
    x, y = _block_lcoord(cell_id)
    # 10 2.1.3
    return int(x < LAND_WIDTH and y < LAND_WIDTH), x, y


def in_bounds(x: int, y: int) -> bool:
    """Tell whether a cell is on the land.

    retail: LandDefs::in_bounds 0x0043D650, 10 2.2.
    """
    return 0 <= x < LAND_WIDTH and 0 <= y < LAND_WIDTH


def inbound_valid_cellid(cell_id: int) -> bool:
    """Tell whether an id names a cell, or a block, of the land.

    retail: LandDefs::inbound_valid_cellid 0x004979A0, 10 2.3.
    """
    return (
        _valid_low(cell_id & 0xFFFF)
        and ((cell_id >> 21) & 0x7F8) < LAND_WIDTH
        and ((cell_id >> 13) & 0x7F8) < LAND_WIDTH
    )


def gid_to_lcoord(cell_id: int) -> tuple[int, int, int]:
    """Return whether an id names a land cell, and the cell's coordinates, in cells.

    For an id that does not, retail leaves its outputs alone; here they are 0.

    retail: LandDefs::gid_to_lcoord 0x00497A90, 10 2.4.
    """
    low = cell_id & 0xFFFF
    # 10 2.4.1
    if not inbound_valid_cellid(cell_id) or low >= FIRST_INTERIOR_CELL:
        return 0, 0, 0
    # 10 2.4.2
    x, y = _block_lcoord(cell_id)
    x += (low - 1) >> 3
    y += (low - 1) & 7
    # 10 2.4.3
    return int(in_bounds(x, y)), x, y


def lcoord_to_gid(x: int, y: int) -> int:
    """Return the id of a land cell, 0 beyond the land.

    retail: LandDefs::lcoord_to_gid 0x004A19A0, 10 2.5.
    """
    if not in_bounds(x, y):
        return 0
    block = ((x >> 3) << 8) | (y >> 3)
    cell = ((x & 7) << 3) + (y & 7) + 1
    return (block << 16) | cell


def get_outside_lcoord(cell_id: int, loc: Vector3) -> tuple[int, int, int]:
    """Return whether there is land under a point of the cell's block (metres), and which cell.

    For an id that names no cell retail leaves its outputs alone; here they are 0.

    retail: LandDefs::get_outside_lcoord 0x005A9B00, 10 2.7.
    """
    # 10 2.7.1
    if not _valid_low(cell_id & 0xFFFF):
        return 0, 0, 0
    # 10 2.7.2
    _, x, y = blockid_to_lcoord(cell_id)
    # 10 2.7.3
    x += floor(loc.x / CELL_EDGE)
    y += floor(loc.y / CELL_EDGE)
    # 10 2.7.4
    return int(in_bounds(x, y)), x, y


def adjust_to_outside(cell_id: int, loc: Vector3) -> tuple[int, int]:
    """Return whether there is land under a point, and its cell's id; moves the point to that block.

    Without land the id is 0. `loc` is in metres; x and y next to the block's origin snap to it first.

    retail: LandDefs::adjust_to_outside 0x005A9BC0, 10 2.8.
    """
    # 10 2.8.1
    if not _valid_low(cell_id & 0xFFFF):
        return 0, 0
    # 10 2.8.2
    if abs(loc.x) < EPS:
        loc.x = 0.0
    if abs(loc.y) < EPS:
        loc.y = 0.0
    # 10 2.8.3
    found, x, y = get_outside_lcoord(cell_id, loc)
    if not found:
        return 0, 0
    # 10 2.8.4
    loc.x = f32(loc.x - floor(loc.x / BLOCK_EDGE) * BLOCK_EDGE)
    loc.y = f32(loc.y - floor(loc.y / BLOCK_EDGE) * BLOCK_EDGE)
    return 1, lcoord_to_gid(x, y)


def within_block(vc: Vector3, radius: float) -> bool:
    """Tell whether a sphere (block coordinates, metres) stays clear of its block's edges.

    The southern and western edges may be touched, the others not.

    retail: LandDefs::within_block 0x0050E800, 10 2.9.
    """
    if not (vc.x >= radius and vc.y >= radius):
        return False
    lim = BLOCK_EDGE - radius
    return lim > vc.x and lim > vc.y


def set_height_table(table: list[float], values: Sequence[float]) -> int:
    """Fill the table of vertex heights (metres); 0, and no further, at the first that cannot be one.

    retail: LandDefs::set_height_table 0x005A99E0, 10 1.
    """
    for i in range(HEIGHT_TABLE_SIZE):
        if not (0.0 <= values[i] <= MAX_HEIGHT):
            return 0
        table[i] = values[i]
    return 1


def _valid_low(low: int) -> bool:
    """Tell whether the low word of an id names a land cell, an interior cell or a block (10 1)."""
    return (
        1 <= low <= LAST_LAND_CELL or FIRST_INTERIOR_CELL <= low <= LAST_INTERIOR_CELL or low == WHOLE_BLOCK
    )
