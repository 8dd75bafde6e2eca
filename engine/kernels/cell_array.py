"""CELLARRAY (09, 1): the list of cells that a mover reaches, and how cells are found in the world's arrays.

An entry of the list is the index of a cell, or minus the id of one that is not in the world: retail's
known id without a cell.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import FIRST_INDOOR
from engine.kernels.compile import inlined, kernel
from engine.kernels.indexing import unsigned
from engine.layout import (
    CELL_FLOATS,
    CELL_ID,
    CELL_INTS,
    CELLS_LISTED,
    NUM_CELLS,
    WORLD_CELL_FLOATS,
    WORLD_CELL_INTS,
    WORLD_CELL_LIST,
    WORLD_CELLS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@inlined
def position_of(wi: Ints, cell: int) -> int:
    """Return where a cell's position lies in the world's floats."""
    return unsigned(wi[WORLD_CELL_FLOATS] + CELL_FLOATS * cell)


@inlined
def ints_of(wi: Ints, cell: int) -> int:
    """Return where a cell's integers lie."""
    return unsigned(wi[WORLD_CELL_INTS] + CELL_INTS * cell)


@inlined
def cell_id(wf: Array, wi: Ints, cell: int) -> float:
    """Return the id of a cell."""
    return wf[position_of(wi, cell) + CELL_ID]


@inlined
def is_outdoors(cell: float) -> bool:
    """Say whether an id is that of a land cell, or 0."""
    return (int(cell) & 0xFFFF) < FIRST_INDOOR


@inlined
def is_land(wi: Ints, cell: int) -> bool:
    """Say whether a cell is a land cell."""
    return cell >= wi[WORLD_CELLS]


@inlined
def listed_cell(wi: Ints, s: Array, i: int) -> int:
    """Return an entry of the cell list."""
    return int(s[wi[WORLD_CELL_LIST] + i])


@kernel
def add_cell(wi: Ints, s: Array, cell: int) -> None:
    """Append an entry to the list unless it is there.

    retail: CELLARRAY::add_cell 0x006B4FF0, 09 1.1
    """
    count = int(s[NUM_CELLS])
    for i in range(count):
        if listed_cell(wi, s, i) == cell:
            return
    s[wi[WORLD_CELL_LIST] + count] = cell
    s[NUM_CELLS] = count + 1
    s[CELLS_LISTED] += 1.0


@kernel
def remove_cell(wi: Ints, s: Array, i: int) -> None:
    """Remove an entry; the last one takes its place.

    retail: CELLARRAY::remove_cell 0x006B4E80, 09 1.2
    """
    s[NUM_CELLS] -= 1.0
    s[wi[WORLD_CELL_LIST] + i] = s[wi[WORLD_CELL_LIST] + int(s[NUM_CELLS])]
