"""Which polygons are too steep to be walked on, noted in the leaves that list them.

Most polygons of a cell are walls, ceilings and undersides. Who looks for ground asks of each how much of its
normal is along the up of what the tree belongs to, a cell or a part, and nearly always whether that is more
than FLOOR_Z. So most of what such a question rules out is known before it is asked, and need not be read.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.compiling.leaf_planes import listed_polygons
from engine.constants import FLOOR_Z, UP_SLACK

if TYPE_CHECKING:
    from collections.abc import Mapping

    from engine.geometry import Shape
    from engine.kernels.types import Array, Ints

_SLACK: Final = 2.0 * float(UP_SLACK)
"""How much more of a normal may be along another up, as a part of its largest component; half of it is for
rounding, which is far less."""


def write_slopes(floats: Array, ints: Ints, trees: Mapping[int, Shape], num_parts: int) -> None:
    """Note in each leaf that is not wide which of its polygons may be walked on; in the gate, along which up.

    A tree that several cells or parts have in common is measured along the up of the first of them.

    Parameters
    ----------
    floats, ints : ndarray
        The world's arrays, of which everything else is compiled; written to.
    trees : mapping of int to Shape
        All shapes, by the root nodes of their trees.
    num_parts : int
        How many parts there are.
    """
    for root, position in _first_places(ints, num_parts).items():
        up = floats[position + at.MATRIX : position + at.ORIGIN].reshape(3, 3)[:, 2]
        _note(floats, ints, root, trees[root], up)


def _first_places(ints: Ints, num_parts: int) -> dict[int, int]:
    """Return for each tree where the position lies of the first cell, or else the first part, that has it."""
    places: dict[int, int] = {}
    cells = np.arange(ints[at.WORLD_CELLS])
    parts = np.arange(num_parts)
    roots = (
        ints[ints[at.WORLD_CELL_INTS] + at.CELL_INTS * cells + at.CELL_TREE],
        ints[ints[at.WORLD_PART_INTS] + at.PART_INTS * parts + at.PART_TREE],
    )
    positions = (
        ints[at.WORLD_CELL_FLOATS] + at.CELL_FLOATS * cells,
        ints[at.WORLD_PART_FLOATS] + at.PART_FLOATS * parts,
    )
    for root, position in zip(
        np.concatenate(roots).tolist(), np.concatenate(positions).tolist(), strict=True
    ):
        if root != at.NO_TREE:
            places.setdefault(root, position)
    return places


def _note(floats: Array, ints: Ints, root: int, shape: Shape, up: Array) -> None:
    """Measure the slopes of a tree, and write them to its leaves, and the up to its gate."""
    nodes = shape.node_ints
    leaves = np.flatnonzero(
        (nodes[:, at.NODE_KIND] != at.KIND_NODE) & (nodes[:, at.LEAF_COUNT] < at.WIDE_LEAF)
    )
    owners, within, polygons = listed_polygons(shape, leaves)
    bits = np.where(_too_steep(shape, up), 0, 1)[polygons] << within
    masks = np.zeros(len(leaves), dtype=np.int64)
    np.add.at(masks, owners, bits)
    ints[at.NODE_INTS * (root + leaves) + at.NODE_NEXT] |= masks << at.LEAF_SLOPES_SHIFT
    gate = int(at.NODE_FLOATS * (root + at.GATE) + at.GATE_UP)
    floats[gate : gate + len(up)] = up


def _too_steep(shape: Shape, up: Array) -> Array:
    """Say of each polygon whether it is certainly too steep; of NaN and infinities nothing is certain."""
    normals = shape.polygon_floats[shape.polygon_offsets[:, None] + np.arange(len(up))]
    with np.errstate(invalid="ignore", over="ignore"):
        along = (normals * up).sum(axis=1)
        steep: Array = along + _SLACK * np.abs(normals).max(axis=1) <= FLOOR_Z
    return steep
