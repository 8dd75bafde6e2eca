"""CObjCell::find_cell_list (09, 5): which cells spheres reach, and which one contains the first.

Spheres are `count` records at ``first`` of `a`, in the block of the position that they come with.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine.constants import frozen
from engine.kernels.bsp_cell import point_inside_cell_bsp
from engine.kernels.cell_array import (
    add_cell,
    cell_id,
    ints_of,
    is_land,
    is_outdoors,
    listed_cell,
    position_of,
    remove_cell,
)
from engine.kernels.cell_ids import find_cell
from engine.kernels.compile import entry, kernel
from engine.kernels.frame import frame_globaltolocal
from engine.kernels.land_cells import find_terrain_poly
from engine.kernels.outside import add_all_outside_cells
from engine.kernels.position import block_offset
from engine.kernels.rounding import f32
from engine.kernels.transit import find_transit_cells
from engine.kernels.vector import load
from engine.layout import (
    ADDED_OUTSIDE,
    CELL_PLANE_COUNT,
    CELL_PLANES,
    CELL_PORTAL_COUNT,
    CELL_STAB,
    CELL_STAB_COUNT,
    DO_NOT_LOAD_CELLS,
    HITS_INTERIOR_CELL,
    NO_CELL,
    NO_PLANES,
    NO_POLYGON,
    NO_PORTALS,
    NUM_CELLS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


UNTOUCHED: Final = frozen(-2)
"""`find_cell_list` did not look for the cell that contains the position (09, 5.1.4)."""


@entry
def point_in_cell(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float) -> bool:
    """Say whether a cell contains a point of its block.

    retail: CEnvCell::point_in_cell 0x0052C300, 09 4.1; CLandCell::point_in_cell 0x00532D40, 10 5.1
    """
    if is_land(wi, cell):
        return find_terrain_poly(wf, wi, cell, x, y) != NO_POLYGON
    ints = ints_of(wi, cell)
    if wi[ints + CELL_PORTAL_COUNT] == NO_PORTALS:
        return False
    count = wi[ints + CELL_PLANE_COUNT]
    if count == NO_PLANES:
        return True
    lx, ly, lz = frame_globaltolocal(wf, position_of(wi, cell), x, y, z)
    return point_inside_cell_bsp(wf, wi[ints + CELL_PLANES], count, lx, ly, lz)


@kernel
def _containing_cell(wf: Array, wi: Ints, s: Array, home: float, a: Array, first: int) -> int:
    """Return the listed cell that contains the first sphere's centre, or NO_CELL.

    The first environment cell; if there is none, the last land cell.

    retail: CObjCell::find_cell_list 0x0052B4E0, 09 5.1.6
    """
    found = NO_CELL
    x, y, z = load(a, first)
    for i in range(int(s[NUM_CELLS])):
        cell = listed_cell(wi, s, i)
        if cell < 0:
            continue
        bx, by = block_offset(home, cell_id(wf, wi, cell))
        if point_in_cell(wf, wi, cell, f32(x - bx), f32(y - by), f32(z - 0.0)):
            found = cell
            if not is_land(wi, cell):
                s[HITS_INTERIOR_CELL] = 1.0
                return found
    return found


@kernel
def _keep_visible(wf: Array, wi: Ints, s: Array, start: int) -> None:
    """Drop all listed cells but an environment cell and those in its stab list.

    retail: CObjCell::find_cell_list 0x0052B4E0, 09 5.1.7
    """
    ints = ints_of(wi, start)
    stab = wi[ints + CELL_STAB]
    i = 0
    while i < int(s[NUM_CELLS]):
        cell = listed_cell(wi, s, i)
        number = -cell if cell < 0 else int(cell_id(wf, wi, cell))
        keep = cell == start
        for k in range(stab, stab + wi[ints + CELL_STAB_COUNT]):
            keep = keep or wi[k] == number
        if keep:
            i += 1
        else:
            remove_cell(wi, s, i)


@entry
def find_cell_list(
    wf: Array,
    wi: Ints,
    s: Array,
    hint: int,
    home: float,
    hx: float,
    hy: float,
    a: Array,
    first: int,
    count: int,
) -> int:
    """List the cells that the spheres reach; return the one that contains the first sphere's centre.

    NO_CELL if none does; UNTOUCHED if the position's own cell is not in the world, or without spheres.
    home, hx, hy: the position's cell id, and its origin's x and y; `hint`: the cell that probably has
    that id, or NO_CELL.

    retail: CObjCell::find_cell_list 0x0052B4E0, 09 5.1
    """
    s[NUM_CELLS] = 0.0
    s[ADDED_OUTSIDE] = 0.0
    start = hint if hint != NO_CELL and cell_id(wf, wi, hint) == home else find_cell(wi, home)
    if is_outdoors(home):
        add_all_outside_cells(wi, s, home, hx, hy, a, first, count)
    else:
        s[HITS_INTERIOR_CELL] = 1.0
        add_cell(wi, s, -int(home) if start == NO_CELL else start)
    if start == NO_CELL or count == 0:
        return UNTOUCHED
    i = 0
    while i < int(s[NUM_CELLS]):
        cell = listed_cell(wi, s, i)
        if cell >= 0:
            find_transit_cells(wf, wi, s, cell, home, hx, hy, a, first, count)
        i += 1
    found = _containing_cell(wf, wi, s, home, a, first)
    if s[DO_NOT_LOAD_CELLS] != 0.0 and not is_outdoors(home):
        _keep_visible(wf, wi, s, start)
    return found
