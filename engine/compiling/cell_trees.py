"""The trees of environment cells, of which grids and lattices are made when enough is asked of a world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.cells import Cell
    from engine.compiling.storage import Storage
    from engine.geometry import Shape
    from engine.kernels.types import Array, Ints


@dataclass(frozen=True, slots=True)
class CellTree:
    """A tree that has polygons, and where what is written of it lies in the world's arrays.

    Attributes
    ----------
    shape : Shape
    root : int
        Its root node.
    first, count : int
        Where the leaves' lists begin in the integers, and how long they are together.
    cells : tuple of int
        The cells that have it, by their indices.
    """

    shape: Shape
    root: int
    first: int
    count: int
    cells: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Written:
    """A world's arrays, of which all is written that walks read, and a row of state for them."""

    floats: Array
    ints: Ints
    row: Array


def cell_trees(storage: Storage, cells: Sequence[Cell]) -> list[CellTree]:
    """Return the trees of environment cells, each once, in order of first use."""
    shapes = {id(cell.shape): cell.shape for cell in cells if cell.shape is not None}
    users: dict[int, list[int]] = {key: [] for key in shapes}
    for index, cell in enumerate(cells):
        if cell.shape is not None:
            users[id(cell.shape)].append(index)
    return [
        CellTree(shape, storage.root_of(shape), *storage.leaf_lists[key], tuple(users[key]))
        for key, shape in shapes.items()
        if len(shape.polygon_offsets)
    ]
