"""CELLARRAY: the cells that the mover's spheres reach, in the order they are tested."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from oracle.obj_cell import ObjCell


class CellEntry(NamedTuple):
    """A cell id, and the cell if it is loaded."""

    cell_id: int
    cell: ObjCell | None


class CellArray:
    """One list of cells per transition, shared by everything nested in it (04 2.5).

    Attributes
    ----------
    added_outside : int
        1 once land cells were looked for.
    do_not_load_cells : int
        1 restricts the list to the cells visible from the first.
    cells : list of CellEntry
        In order of insertion; `num_cells` is its length.
    """

    __slots__ = ("added_outside", "cells", "do_not_load_cells")

    def __init__(self) -> None:
        self.added_outside = 0
        self.do_not_load_cells = 0
        self.cells: list[CellEntry] = []

    @property
    def num_cells(self) -> int:
        """Number of entries now; nested calls change it under a running loop."""
        return len(self.cells)

    def add_cell(self, cell_id: int, cell: ObjCell | None) -> None:
        """Append a cell unless its id is listed; a listed id without cell is not upgraded.

        retail: CELLARRAY::add_cell 0x006B4FF0, 04 7.
        """
        if any(entry.cell_id == cell_id for entry in self.cells):
            return
        self.cells.append(CellEntry(cell_id, cell))

    def remove_cell(self, index: int) -> None:
        """Remove an entry; the last one moves into its place.

        retail: CELLARRAY::remove_cell 0x006B4E80, 04 7.
        """
        if not self.cells:
            return
        last = self.cells.pop()
        if index < len(self.cells):
            self.cells[index] = last
