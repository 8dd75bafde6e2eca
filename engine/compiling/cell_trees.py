"""The trees of environment cells, as kernels walk through them while a world is compiled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from engine import layout as at
from engine.memory import aligned

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from engine.cells import Cell
    from engine.compiling.storage import Storage
    from engine.geometry import Shape
    from engine.kernels.types import Array, Ints


@dataclass(frozen=True, slots=True)
class CellTrees:
    """What is needed to find out what is near a place in a cell.

    Attributes
    ----------
    floats, ints : ndarray
        The world's arrays, of which all is written that a walk reads, and plates of polygons.
    row : ndarray
        A row of state, with room for a traversal.
    shapes : list of Shape
        The cells' geometry: of those that have polygons, each once.
    """

    floats: Array
    ints: Ints
    row: Array
    shapes: list[Shape]

    @classmethod
    def of(cls, storage: Storage, header: Mapping[int, int], cells: Sequence[Cell]) -> CellTrees:
        """Return the trees of the environment cells, from what is written and what the header says of it."""
        floats, ints = storage.finish(header)
        row: Array = aligned(int(ints[at.WORLD_ROW]), np.float64)
        row[:] = 0.0
        shapes = {id(cell.shape): cell.shape for cell in cells if cell.shape is not None}
        return cls(floats, ints, row, [shape for shape in shapes.values() if len(shape.polygon_offsets)])
