"""A cell list of one: where no portal is in reach (`engine.plan`)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.kernels.broad import fences_beyond
from engine.kernels.cell_array import add_cell, cell_id, is_land
from engine.kernels.cell_list import point_in_cell
from engine.kernels.compile import kernel
from engine.kernels.plan import allows
from engine.kernels.rounding import slack
from engine.kernels.vector import load
from engine.layout import (
    ADDED_OUTSIDE,
    CHECK_POS,
    GLOBAL_SPHERE,
    HITS_INTERIOR_CELL,
    NO_CELL,
    NUM_CELLS,
    NUM_SPHERE,
    PLAN_PORTALS,
    RADIUS,
    SPHERE_SIZE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def reaches_no_portal(wf: Array, wi: Ints, s: Array, cell: int) -> bool:
    """Say whether the cell list of the check position is certain to be its own environment cell alone.

    For an environment cell that has the position's id, CObjCell::find_cell_list begins with that cell;
    others are added by CEnvCell::find_transit_cells alone, for each portal that a sphere reaches, and from
    cells that were added. Where no sphere reaches beyond a fence, none is.

    retail: CObjCell::find_cell_list 0x0052B4E0, 09 5.1
    """
    if not allows(s, PLAN_PORTALS) or cell == NO_CELL or is_land(wi, cell):
        return False
    if cell_id(wf, wi, cell) != s[CHECK_POS]:
        return False
    count = int(s[NUM_SPHERE])
    for i in range(count):
        at = GLOBAL_SPHERE + SPHERE_SIZE * i
        x, y, z = load(s, at)
        if not fences_beyond(wf, wi, cell, x, y, z, s[at + RADIUS] + slack(x, y, z)):
            return False
    return count > 0


@kernel
def list_alone(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Make an environment cell the cell list; return it if it contains sphere 0's centre, else NO_CELL.

    Leaves what CObjCell::find_cell_list leaves for a list of one: the list, no outside added, the
    interior hit (it is, for a position indoors, whatever contains it). The block offset to a cell of the
    same id is 0, so that the point is tested as it is.

    retail: CObjCell::find_cell_list 0x0052B4E0, 09 5.1
    """
    s[NUM_CELLS] = 0.0
    s[ADDED_OUTSIDE] = 0.0
    s[HITS_INTERIOR_CELL] = 1.0
    add_cell(wi, s, cell)
    x, y, z = load(s, GLOBAL_SPHERE)
    return cell if point_in_cell(wf, wi, cell, x, y, z) else NO_CELL
