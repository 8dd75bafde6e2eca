"""Lattices: which polygons are near each cube of the box about a cell's tree (`engine.kernels.lattice`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.compiling.cubes import cubes_about, packed
from engine.constants import BOUND_ROUNDING, BOUND_SLACK, LATTICE_REACH
from engine.kernels.lattice_making import note_near, note_solid, share_lists

if TYPE_CHECKING:
    from engine.compiling.cell_trees import CellTree, Written
    from engine.compiling.cubes import Cubes
    from engine.compiling.growing import Growing
    from engine.geometry import Shape
    from engine.kernels.types import Array, Ints

_LEAST_EDGE: Final = 0.35
"""Edge of a cube, metres, where there are cubes enough: in finer ones lists are hardly shorter."""
_CUBES_PER_POLYGON: Final = 1024
"""A lattice's size is bounded by that of its geometry,"""
_MOST_CUBES: Final = 2**21
"""and by this: most cubes are of blocks that are kept once."""
_TESTS_PER_POLYGON: Final = 16384
"""How many cubes a polygon may be held against on average: some 10 ns each, twice;"""
_MOST_TESTS: Final = 2**28
"""and all together."""
_LISTED_PER_POLYGON: Final = 96
"""Numbers in all lists together: of a cube that has no room for its own, nothing is known,"""
_MOST_LISTED: Final = 1 << int(at.WORD_BITS - at.WORD_LIST_SHIFT)
"""nor beyond what a word can say."""


def write_lattice(more: Growing, world: Written, tree: CellTree) -> tuple[Array, Ints]:
    """Append the lattice of a tree to a world; return the gate of the tree: its numbers and its integers."""
    shape, floats, ints = tree.shape, world.floats, world.ints
    listed = _listed(ints, tree)
    cubes, ranges = _divided(shape, _balls(floats, ints, listed))
    gate = floats[at.NODE_FLOATS * (tree.root + at.GATE) :][: int(at.NODE_FLOATS)].copy()
    gate[at.LATTICE_CORNER : at.LATTICE_CORNER + at.VECTOR_SIZE] = cubes.corner
    gate[at.LATTICE_PER_METRE] = 1.0 / cubes.edge
    gate[at.LATTICE_COUNTS : at.LATTICE_COUNTS + at.VECTOR_SIZE] = cubes.counts
    words = np.zeros(cubes.size, dtype=np.int64)
    note_solid(floats, ints, world.row, tree.root, gate, words)
    begins, ends, near = _near(floats, ints, gate, listed, ranges, cubes.size)
    room = min(_LISTED_PER_POLYGON * len(shape.polygon_offsets), _MOST_LISTED)
    lists = np.empty(room, dtype=np.int64)
    used = share_lists(gate, begins, ends, near, words, lists)
    blocks, numbers = _shared(words)
    first = more.add_ints(blocks.ravel())
    places = np.zeros(at.NODE_INTS, dtype=np.int64)
    places[at.LATTICE_TABLE] = more.add_ints(first + blocks.shape[1] * numbers)
    places[at.LATTICE_LISTS] = more.add_ints(packed(lists[:used], int(at.WORD_BITS)))
    return gate, places


def _listed(ints: Ints, tree: CellTree) -> Ints:
    """Return where in the leaves' lists each polygon of a tree is, once."""
    _, index = np.unique(ints[tree.first : tree.first + tree.count], return_index=True)
    return tree.first + index


def _balls(floats: Array, ints: Ints, listed: Ints) -> Array:
    """Return the ball about each polygon, by where it is listed."""
    plates = ints[at.WORLD_LEAF_BOUNDS] + at.PLATE_SIZE * listed
    balls: Array = floats[plates[:, None] + at.PLATE_BALL + np.arange(int(at.SPHERE_SIZE))]
    return balls


def _divided(shape: Shape, balls: Array) -> tuple[Cubes, Ints]:
    """Return the finest cubes that do not take too long to look at, and to which each polygon may be near.

    Those are given as the first of them along x, y and z, and the ones behind the last.
    """
    number = len(shape.polygon_offsets)
    most = min(_CUBES_PER_POLYGON * number, _MOST_CUBES)
    tests = min(_TESTS_PER_POLYGON * number, _MOST_TESTS)
    block = 1 << int(at.LATTICE_BLOCK)
    far = BOUND_SLACK + BOUND_ROUNDING * 2.0 * float(np.abs(shape.bounds).sum())
    for cubes in cubes_about(shape, _LEAST_EDGE, most, block):
        reach = balls[:, at.RADIUS :] + LATTICE_REACH + cubes.edge + far
        middles = balls[:, : at.VECTOR_SIZE] - cubes.corner
        begins = np.clip(np.floor((middles - reach) / cubes.edge) - 1.0, 0.0, cubes.counts)
        ends = np.clip(np.floor((middles + reach) / cubes.edge) + 2.0, 0.0, cubes.counts)
        if (ends - begins).prod(axis=1).sum() <= tests or cubes.size == block**3:
            break
    return cubes, np.hstack((begins, ends)).astype(np.int64)


def _near(
    floats: Array, ints: Ints, gate: Array, listed: Ints, ranges: Ints, size: int
) -> tuple[Ints, Ints, Ints]:
    """Return of each cube where its polygons begin and end, and the polygons of all of them.

    A cube that is near to too many has none, and ends at -1.
    """
    counts = np.zeros(size, dtype=np.int64)
    nothing = np.empty(0, dtype=np.int64)
    note_near(floats, ints, gate, listed, ranges, counts, nothing)
    crowded = counts >= at.CROWDED
    counts[crowded] = 0
    begins = np.cumsum(counts) - counts
    ends, near = np.where(crowded, -1, begins), np.empty(int(counts.sum()), dtype=np.int64)
    note_near(floats, ints, gate, listed, ranges, ends, near)
    return begins, ends, near


def _shared(words: Ints) -> tuple[Ints, Ints]:
    """Return the words of blocks, two in each integer, and for each block which of those are its own.

    Blocks whose words are all the same are kept once.
    """
    blocks = words.reshape(-1, 1 << 3 * int(at.LATTICE_BLOCK))
    uniform = (blocks == blocks[:, :1]).all(axis=1)
    values, which = np.unique(blocks[uniform, 0], return_inverse=True)
    same = np.broadcast_to(values[:, None], (len(values), blocks.shape[1]))
    numbers = np.empty(len(blocks), dtype=np.int64)
    numbers[uniform] = which
    numbers[~uniform] = len(values) + np.arange((~uniform).sum())
    kept = np.concatenate([same, blocks[~uniform]])
    return packed(kept.ravel(), int(at.WORD_BITS)).reshape(len(kept), -1), numbers
