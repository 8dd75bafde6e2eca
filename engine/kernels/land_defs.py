"""LandDefs (10, 2): which landblock and land cell a point lies in."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import BLOCK_EDGE, BLOCK_STEP, EPS, FIRST_INDOOR, LAND_WIDTH
from engine.kernels.compile import inlined, kernel
from engine.kernels.rounding import f32
from engine.layout import ORIGIN

if TYPE_CHECKING:
    from engine.kernels.types import Array

LAST_LAND_CELL = 0x40
"""Largest low word of a land cell's id (10, 1)."""
LAST_INDOOR = 0xFFFD
"""Largest low word of an environment cell's id (10, 1)."""
BLOCK_ITSELF = 0xFFFF
"""Low word of a landblock's own id (10, 1)."""


@inlined
def _names_a_cell(cell_id: int) -> bool:
    """Say whether an id's low word is that of a land cell, an environment cell or a block.

    retail: 10 1
    """
    low = cell_id & 0xFFFF
    return 1 <= low <= LAST_LAND_CELL or FIRST_INDOOR <= low <= LAST_INDOOR or low == BLOCK_ITSELF


@inlined
def _land_coordinates(cell_id: int, x: float, y: float) -> tuple[int, int]:
    """Return in which land cell, counted from the land's corner, a point of a block lies.

    retail: LandDefs::get_outside_lcoord 0x005A9B00, 10 2.7
    """
    block_x, block_y = (cell_id >> 21) & 0x7F8, 8 * ((cell_id >> 16) & 0xFF)
    return block_x + math.floor(x / BLOCK_STEP), block_y + math.floor(y / BLOCK_STEP)


@kernel
def adjust_to_outside(a: Array, p: int) -> None:
    """Bring an outdoor position to the land cell under it, or to id 0 where there is none.

    x and y next to the block's origin snap to it first.

    retail: LandDefs::adjust_to_outside 0x005A9BC0, 10 2.8
    """
    cell_id, o = int(a[p]), p + ORIGIN
    a[p] = 0.0
    if not _names_a_cell(cell_id):
        return
    for i in range(2):
        if abs(a[o + i]) < EPS:
            a[o + i] = 0.0
    x, y = _land_coordinates(cell_id, a[o], a[o + 1])
    if not (0 <= x < LAND_WIDTH and 0 <= y < LAND_WIDTH):
        return
    for i in range(2):
        a[o + i] = f32(a[o + i] - math.floor(a[o + i] / BLOCK_EDGE) * BLOCK_EDGE)
    block = ((x >> 3) << 8) | (y >> 3)
    a[p] = (block << 16) | (((x & 7) << 3) + (y & 7) + 1)
