"""Making a lattice: which polygons are near each of its cubes, and where a centre may be in solid matter.

A cube stands for all spheres with their centre in it and a radius of at most `LATTICE_REACH`. Each of them is
inside the ball about the cube's middle that reaches half of a diagonal farther than that, and what it touches
is so near (`engine.kernels.broad.polygon_beyond`). All of the tree's polygons are held against the cubes, not
only those that some walk comes to: whether a polygon is near does not depend on the tree.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import LATTICE_REACH
from engine.kernels.broad import polygon_beyond
from engine.kernels.bsp_node import is_leaf, is_solid, leaf_polygons, negative, positive, splitting_distance
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.lattice import block_of, within
from engine.kernels.rounding import slack
from engine.layout import (
    CROWDED,
    LATTICE_BLOCK,
    LATTICE_BLOCK_MASK,
    LATTICE_CORNER,
    LATTICE_COUNTS,
    LATTICE_PER_METRE,
    NODE_FLOATS,
    WORD_COUNT_SHIFT,
    WORD_LIST_SHIFT,
    WORLD_STACK,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Vector

_HALF_DIAGONAL = 0.5 * math.sqrt(3.0)
"""From a cube's middle to its corner, as a part of its edge."""


@inlined
def _counts(gate: Array) -> tuple[int, int, int]:
    """Return the number of cubes along x, y and z."""
    return int(gate[LATTICE_COUNTS]), int(gate[LATTICE_COUNTS + 1]), int(gate[LATTICE_COUNTS + 2])


@inlined
def _number(a: int, b: int, c: int, ny: int, nz: int) -> int:
    """Return the number of a cube, block by block."""
    return block_of(a, b, c, ny, nz) << 3 * LATTICE_BLOCK | within(a, b, c)


@inlined
def _coordinates(gate: Array, cube: int) -> tuple[int, int, int]:
    """Return where along x, y and z the cube is that has a number."""
    n, m = LATTICE_BLOCK, LATTICE_BLOCK_MASK
    _, ny, nz = _counts(gate)
    columns, rows = nz >> n, ny >> n
    block = cube >> 3 * n
    return (
        block // (rows * columns) << n | cube >> 2 * n & m,
        block // columns % rows << n | cube >> n & m,
        block % columns << n | cube & m,
    )


@inlined
def _middle(gate: Array, a: int, b: int, c: int) -> Vector:
    """Return the middle of a cube."""
    edge = 1.0 / gate[LATTICE_PER_METRE]
    return (
        gate[LATTICE_CORNER] + edge * (a + 0.5),
        gate[LATTICE_CORNER + 1] + edge * (b + 0.5),
        gate[LATTICE_CORNER + 2] + edge * (c + 0.5),
    )


@inlined
def _around(gate: Array, x: float, y: float, z: float) -> float:
    """Return the radius of a ball about a cube's middle that holds the cube, and what roundings may add."""
    return _HALF_DIAGONAL / gate[LATTICE_PER_METRE] + slack(x, y, z)


@entry
def note_near(wf: Array, wi: Ints, gate: Array, listed: Ints, ranges: Ints, ends: Ints, near: Ints) -> None:
    """Count for each cube the polygons that are near it; or, if there is room for them, note them.

    Parameters
    ----------
    wf, wi : ndarray
        The world's arrays, plates included.
    gate : ndarray of float
        A gate's floats, which say where the cubes are.
    listed : ndarray of int
        Where in the leaves' lists each of the tree's polygons is, once.
    ranges : ndarray of int, shape (n, 6)
        Of each the first cubes along x, y and z that it may be near, and the cubes behind the last.
    ends : ndarray of int
        Of each cube, where the next of its polygons is to be noted; grows by their number. Less than 0 if
        none is.
    near : ndarray of int
        Gets the polygons' records, if it is not empty.
    """
    _, ny, nz = _counts(gate)
    for k in range(len(listed)):
        for a in range(ranges[k, 0], ranges[k, 3]):
            for b in range(ranges[k, 1], ranges[k, 4]):
                for c in range(ranges[k, 2], ranges[k, 5]):
                    cube = _number(a, b, c, ny, nz)
                    if ends[cube] < 0:
                        continue
                    x, y, z = _middle(gate, a, b, c)
                    reach = LATTICE_REACH + _around(gate, x, y, z)
                    if polygon_beyond(wf, wi, listed[k], x, y, z, reach):
                        continue
                    if len(near) > 0:
                        near[ends[cube]] = wi[listed[k]]
                    ends[cube] += 1


@kernel
def _may_be_solid(wf: Array, wi: Ints, s: Array, root: int, x: float, y: float, z: float, r: float) -> bool:
    """Say whether a point in a ball may be in a solid leaf that lists polygons.

    Bounding spheres may keep a walk from there; it goes to the side of a plane that the centre is on.

    retail: SO-3...SO-6
    """
    base = wi[WORLD_STACK]
    top = base
    node = root
    while True:
        if not is_leaf(wi, node):
            p = NODE_FLOATS * node
            far = r * math.sqrt(wf[p] * wf[p] + wf[p + 1] * wf[p + 1] + wf[p + 2] * wf[p + 2])
            dist = splitting_distance(wf, node, x, y, z)
            if dist > far:
                node = positive(node)
            else:
                if not dist < -far:
                    s[top] = positive(node)
                    top += 1
                node = negative(wi, node)
            continue
        _, count = leaf_polygons(wi, node)
        if count != 0 and is_solid(wi, node):
            return True
        if top == base:
            return False
        top -= 1
        node = int(s[top])


@entry
def note_solid(wf: Array, wi: Ints, s: Array, root: int, gate: Array, words: Ints) -> None:
    """Set the word of each cube to whether a centre in it may be in a solid leaf that lists polygons."""
    for cube in range(len(words)):
        a, b, c = _coordinates(gate, cube)
        x, y, z = _middle(gate, a, b, c)
        words[cube] = int(_may_be_solid(wf, wi, s, root, x, y, z, _around(gate, x, y, z)))


@inlined
def _are_alike(near: Ints, a: int, b: int, count: int) -> bool:
    """Say whether two lists of polygons are the same."""
    for k in range(count):
        if near[a + k] != near[b + k]:
            return False
    return True


@inlined
def _shared(begins: Ints, ends: Ints, near: Ints, words: Ints, cube: int, other: int) -> int:
    """Return where the list of another cube is, if it is that of this one, too, and -1 if not."""
    first, count = begins[cube], ends[cube] - begins[cube]
    word = words[other]
    if (word >> WORD_COUNT_SHIFT & CROWDED) != count:
        return -1
    return word >> WORD_LIST_SHIFT if _are_alike(near, begins[other], first, count) else -1


@kernel
def _place(gate: Array, begins: Ints, ends: Ints, near: Ints, words: Ints, cube: int) -> int:
    """Return where the list of a cube is if a neighbour has it already, and -1 if none has.

    Those before it along x, y and z have lower numbers, too.
    """
    _, ny, nz = _counts(gate)
    a, b, c = _coordinates(gate, cube)
    place = -1
    if c > 0:
        place = _shared(begins, ends, near, words, cube, _number(a, b, c - 1, ny, nz))
    if place < 0 and b > 0:
        place = _shared(begins, ends, near, words, cube, _number(a, b - 1, c, ny, nz))
    if place < 0 and a > 0:
        place = _shared(begins, ends, near, words, cube, _number(a - 1, b, c, ny, nz))
    return place


@entry
def share_lists(gate: Array, begins: Ints, ends: Ints, near: Ints, words: Ints, lists: Ints) -> int:
    """Add to each cube's word where its list is; return how much of `lists` is used.

    A cube shares the list of a neighbour that has the same one. One without a list, or whose list has no room
    any more, is CROWDED.

    Parameters
    ----------
    begins, ends : ndarray of int
        Of each cube, where in `near` its polygons are; the end is less than 0 if they are too many.
    near : ndarray of int
    words : ndarray of int
    lists : ndarray of int
        Gets the lists.
    """
    used = 0
    for cube in range(len(words)):
        first, count = begins[cube], ends[cube] - begins[cube]
        if count == 0:
            continue
        place = -1 if count < 0 else _place(gate, begins, ends, near, words, cube)
        if place < 0 < count and used + count <= len(lists):
            place = used
            for k in range(count):
                lists[used + k] = near[first + k]
            used += count
        if place < 0:
            place, count = 0, CROWDED
        words[cube] |= place << WORD_LIST_SHIFT | count << WORD_COUNT_SHIFT
    return used
