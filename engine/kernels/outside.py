"""The land cells that spheres reach (09, 6).

Spheres are `count` records at ``first`` of `a`, in the block of the position that they come with.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import BLOCK_STEP
from engine.kernels.cell_array import add_cell
from engine.kernels.cell_ids import find_cell
from engine.kernels.compile import entry, kernel
from engine.kernels.land_defs import gid_to_lcoord, in_bounds, lcoord_to_gid, outside_cell
from engine.kernels.rounding import f32
from engine.layout import ADDED_OUTSIDE, NO_CELL, RADIUS, SPHERE_SIZE

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def add_outside_cell(wi: Ints, s: Array, x: int, y: int) -> None:
    """Append a land cell, in the world or not, by its land coordinates.

    retail: CLandCell::add_outside_cell 0x00532EC0, 09 6.1
    """
    if in_bounds(x, y):
        number = lcoord_to_gid(x, y)
        cell = find_cell(wi, float(number))
        add_cell(wi, s, -number if cell == NO_CELL else cell)


@kernel
def _add_across_borders(
    wi: Ints, s: Array, px: float, py: float, x: int, y: int, hi: float, lo: float
) -> None:
    """Append the neighbours of a land cell that a square about a point of it reaches.

    retail: CLandCell::check_add_cell_boundary 0x00533260, 09 6.2
    """
    for side in (1, -1):
        if (px > hi) if side == 1 else (px < lo):
            add_outside_cell(wi, s, x + side, y)
            if py > hi:
                add_outside_cell(wi, s, x + side, y + 1)
            if py < lo:
                add_outside_cell(wi, s, x + side, y - 1)
    if py > hi:
        add_outside_cell(wi, s, x, y + 1)
    if py < lo:
        add_outside_cell(wi, s, x, y - 1)


@entry
def add_all_outside_cells(
    wi: Ints, s: Array, home: float, hx: float, hy: float, a: Array, first: int, count: int
) -> None:
    """Append the land cells that the spheres reach; without spheres the one that the position is in.

    home, hx, hy: the position's cell id, and its origin's x and y.

    retail: CLandCell::add_all_outside_cells 0x00533630, 09 6.4
    """
    if s[ADDED_OUTSIDE] != 0.0:
        return
    s[ADDED_OUTSIDE] = 1.0
    if count == 0:
        number, _, _ = outside_cell(int(home), hx, hy)
        found, x, y = gid_to_lcoord(number)
        if found:
            add_outside_cell(wi, s, x, y)
    for i in range(count):
        ball = first + SPHERE_SIZE * i
        number, px, py = outside_cell(int(home), a[ball], a[ball + 1])
        if number == 0:
            return
        found, x, y = gid_to_lcoord(number)
        if found:
            add_outside_cell(wi, s, x, y)
            px = f32(px - math.floor(px / BLOCK_STEP) * BLOCK_STEP)
            py = f32(py - math.floor(py / BLOCK_STEP) * BLOCK_STEP)
            lo = a[ball + RADIUS]
            _add_across_borders(wi, s, px, py, x, y, f32(BLOCK_STEP - lo), lo)
