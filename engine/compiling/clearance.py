"""Grids of clearances: where in a cell's tree nothing is, and how far around (`engine.kernels.clearance`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.compiling.cubes import cubes_about, packed
from engine.kernels.clearance import measure_clearance

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.cells import Cell
    from engine.compiling.cell_trees import CellTrees
    from engine.compiling.storage import Storage
    from engine.geometry import Shape
    from engine.kernels.types import Array

_LEAST_EDGE: Final = 0.5
"""Edge of a cube, metres, where there are cubes enough: finer ones say little more of a human's reach."""
_CUBES_PER_POLYGON: Final = 128
"""A grid's size, and the time that it takes to make, are bounded by those of its geometry,"""
_MOST_CUBES: Final = 2**20
"""by this: a byte each,"""
_MOST_TESTS: Final = 2**26
"""and by how many polygons are tested at most if one leaf that lists many is near to all cubes."""
_BYTES: Final = 8
"""Of an integer."""


def write_clearances(storage: Storage, trees: CellTrees, cells: Sequence[Cell]) -> dict[int, int]:
    """Write a grid for each tree of an environment cell; return what the header says of them.

    `trees`: those of the environment cells, `cells`.
    """
    grids: dict[int, int] = {}
    for shape in trees.shapes:
        grid = _grid_about(shape)
        levels = np.zeros(int(grid[at.CLEARANCE_COUNTS :][:3].prod()), dtype=np.uint8)
        measure_clearance(trees.floats, trees.ints, trees.row, storage.root_of(shape), grid, levels)
        grid[at.CLEARANCE_LEVELS] = _BYTES * storage.add_ints(packed(levels, int(at.CLEARANCE_BITS)))
        storage.align()
        grids[id(shape)] = storage.add_floats(grid)
    table = [grids.get(id(cell.shape), int(at.NO_CLEARANCE)) for cell in cells]
    return {int(at.WORLD_CLEARANCES): storage.add_ints(table)}


def _grid_about(shape: Shape) -> Array:
    """Divide the box about a shape into cubes: not too many, nor too small."""
    leaves = shape.node_ints[:, at.NODE_KIND] != at.KIND_NODE
    longest = int(shape.node_ints[leaves, at.LEAF_COUNT].max())
    most = min(_CUBES_PER_POLYGON * len(shape.polygon_offsets), _MOST_CUBES, _MOST_TESTS // max(longest, 1))
    cubes = next(cubes_about(shape, _LEAST_EDGE, most))
    grid = np.zeros(int(at.CLEARANCE_SIZE), dtype=np.float64)
    grid[at.CLEARANCE_CORNER : at.CLEARANCE_CORNER + at.VECTOR_SIZE] = cubes.corner
    grid[at.CLEARANCE_COUNTS : at.CLEARANCE_COUNTS + at.VECTOR_SIZE] = cubes.counts
    grid[at.CLEARANCE_EDGE] = cubes.edge
    grid[at.CLEARANCE_PER_METRE] = 1.0 / cubes.edge
    return grid
