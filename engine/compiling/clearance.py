"""Grids of clearances: where in a cell's tree nothing is, and how far around (`engine.kernels.clearance`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.compiling.cubes import cubes_about, packed
from engine.kernels.clearance import measure_clearance

if TYPE_CHECKING:
    from engine.compiling.cell_trees import CellTree, Written
    from engine.compiling.growing import Growing
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


def write_clearance(more: Growing, world: Written, tree: CellTree) -> int:
    """Append the grid of a tree to a world; return where it begins."""
    grid = _grid_about(tree.shape)
    levels = np.zeros(int(grid[at.CLEARANCE_COUNTS :][:3].prod()), dtype=np.uint8)
    measure_clearance(world.floats, world.ints, world.row, tree.root, grid, levels)
    grid[at.CLEARANCE_LEVELS] = _BYTES * more.add_ints(packed(levels, int(at.CLEARANCE_BITS)))
    more.align()
    return more.add_floats(grid)


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
