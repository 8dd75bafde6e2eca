"""What is near, looked up instead of walked for: a grid and a lattice for each tree of an environment cell.

To make them takes as long as hundreds of thousands of queries save by them, and longer than all the rest of a
world. So they are not part of it when it is made, but appended when it is prepared (`World.prepare`).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.compiling.cell_trees import Written
from engine.compiling.clearance import write_clearance
from engine.compiling.growing import Growing
from engine.compiling.lattice import write_lattice
from engine.memory import aligned

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.compiling.cell_trees import CellTree
    from engine.kernels.types import Array, Ints

_FEWEST: Final = 1000
"""Queries of a world for which grids and lattices are made, at least: more than a test asks of a scene, and
no more than a batch."""


def queries_expected_to_pay(trees: Sequence[CellTree]) -> float:
    """Return how many queries of a world it takes for grids and lattices to be made: one for each polygon.

    Each takes 0.06 to 0.3 microseconds less with them, and they 0.13 to 0.3 milliseconds for each polygon.
    Only 500 to 4,500 queries make up for that; but whoever asks as many as there are polygons, in a batch or
    in a second of play, is about to ask as many again and again, and is answered evenly from then on. Who
    stops there has lost what it took to make them, once.
    """
    polygons = sum(len(tree.shape.polygon_offsets) for tree in trees)
    return max(polygons, _FEWEST) if polygons else math.inf


def with_what_is_near(floats: Array, ints: Ints, trees: Sequence[CellTree]) -> tuple[Array, Ints]:
    """Return a world's arrays with a grid and a lattice for each of its cells' trees.

    Those that are given are left as they are, for whoever is walking through them meanwhile; what they say is
    at the same places in the new ones.
    """
    row: Array = aligned(int(ints[at.WORLD_ROW]), np.float64)
    row[:] = 0.0
    world, more = Written(floats, ints, row), Growing(len(floats), len(ints))
    grids = [write_clearance(more, world, tree) for tree in trees]
    gates = [write_lattice(more, world, tree) for tree in trees]
    floats, ints = more.behind([floats], [ints])
    table = int(ints[at.WORLD_CLEARANCES])
    for tree, grid, (gate, places) in zip(trees, grids, gates, strict=True):
        ints[table + np.array(tree.cells)] = grid
        node = tree.root + int(at.GATE)
        floats[at.NODE_FLOATS * node : at.NODE_FLOATS * (node + 1)] = gate
        ints[at.NODE_INTS * node : at.NODE_INTS * (node + 1)] = places
    return floats, ints
