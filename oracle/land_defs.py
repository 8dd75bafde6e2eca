"""LandDefs: arithmetic of landblocks."""

from __future__ import annotations

from oracle.arithmetic import f32, floor
from oracle.constants import BLOCK_EDGE, CELL_EDGE, EPS
from oracle.vector import Vector3

LAND_WIDTH = 2040
"""Cells along an edge of the land: 255 blocks of 8 (10 1)."""


def get_block_offset(cell_from: int, cell_to: int) -> Vector3:
    """Return what turns coordinates of `cell_to`'s block into coordinates of `cell_from`'s, metres.

    A zero `cell_from` is the block (0, 0). For a zero `cell_to` retail reads uninitialised locals
    (01 5.1, degenerate); here it is the block (0, 0) too.

    retail: LandDefs::get_block_offset 0x0043E630, 01 5.1.
    """
    if cell_from >> 16 == cell_to >> 16:
        return Vector3()
    fx = (cell_from >> 21) & 0x7F8
    fy = 8 * ((cell_from >> 16) & 0xFF)
    tx = (cell_to >> 21) & 0x7F8
    ty = 8 * ((cell_to >> 16) & 0xFF)
    return Vector3(f32(float(tx - fx) * CELL_EDGE), f32(float(ty - fy) * CELL_EDGE), 0.0)


def blockid_to_lcoord(cell_id: int) -> tuple[int, int, int]:
    """Return whether the block is on the land, and the coordinates of its first cell, in cells.

    For a zero id retail leaves its outputs alone; here they are 0.

    retail: LandDefs::blockid_to_lcoord 0x0043D680, 10 2.1.
    """
    if cell_id == 0:
        return 0, 0, 0
    x = (cell_id >> 21) & 0x7F8
    y = 8 * ((cell_id >> 16) & 0xFF)
    return int(x < LAND_WIDTH and y < LAND_WIDTH), x, y


def in_bounds(x: int, y: int) -> bool:
    """Tell whether a cell is on the land.

    retail: LandDefs::in_bounds 0x0043D650, 10 2.2.
    """
    return 0 <= x < LAND_WIDTH and 0 <= y < LAND_WIDTH


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
    if not _valid_low(cell_id & 0xFFFF):
        return 0, 0, 0
    _, x, y = blockid_to_lcoord(cell_id)
    x += floor(loc.x / CELL_EDGE)
    y += floor(loc.y / CELL_EDGE)
    return int(in_bounds(x, y)), x, y


def adjust_to_outside(cell_id: int, loc: Vector3) -> tuple[int, int]:
    """Return whether there is land under a point, and its cell's id; moves the point to that block.

    Without land the id is 0. `loc` is in metres; x and y next to the block's origin snap to it first.

    retail: LandDefs::adjust_to_outside 0x005A9BC0, 10 2.8.
    """
    if not _valid_low(cell_id & 0xFFFF):
        return 0, 0
    if abs(loc.x) < EPS:
        loc.x = 0.0
    if abs(loc.y) < EPS:
        loc.y = 0.0
    found, x, y = get_outside_lcoord(cell_id, loc)
    if not found:
        return 0, 0
    loc.x = f32(loc.x - floor(loc.x / BLOCK_EDGE) * BLOCK_EDGE)
    loc.y = f32(loc.y - floor(loc.y / BLOCK_EDGE) * BLOCK_EDGE)
    return 1, lcoord_to_gid(x, y)


def _valid_low(low: int) -> bool:
    """Tell whether the low word of an id names a land cell, an interior cell or a block (10 1)."""
    return 1 <= low <= 0x40 or 0x100 <= low <= 0xFFFD or low == 0xFFFF
