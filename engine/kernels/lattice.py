"""The lattice of a tree: what is near, looked up instead of walked for.

Most walks of a mover through a tree find nothing: the ground under it is at its radius, and not nearer. When
a world is prepared, the box about a cell's tree is divided into cubes, and for each those polygons are listed
that a sphere with its centre there may touch (`engine.kernels.lattice_making`): three, as a rule, where a
walk comes to a dozen nodes and tests two dozen polygons.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine.constants import EPS, LATTICE_REACH, frozen
from engine.kernels.bsp_node import is_solid, leaf_of, leaf_polygons
from engine.kernels.compile import inlined, kernel
from engine.kernels.indexing import unsigned
from engine.kernels.plan import allows
from engine.kernels.polygon import polygon_hits_sphere_slow_but_sure, polygon_walkable_hits_sphere
from engine.kernels.polygon_edges import HIT
from engine.layout import (
    CROWDED,
    GATE,
    LATTICE_BLOCK,
    LATTICE_BLOCK_MASK,
    LATTICE_CORNER,
    LATTICE_COUNTS,
    LATTICE_LISTS,
    LATTICE_PER_METRE,
    LATTICE_TABLE,
    NODE_FLOATS,
    NODE_INTS,
    PLAN_WALKS,
    POLYGONS_TESTED,
    SKIPPED_WALKS,
    WALKABLE_ALLOWANCE,
    WORD_BITS,
    WORD_COUNT_SHIFT,
    WORD_LIST_SHIFT,
    WORD_MASK,
    WORD_SOLID,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Sphere, Vector

_UNKNOWN = CROWDED << WORD_COUNT_SHIFT
"""The word of a point that is in no cube."""
NOWHERE: Final = frozen(-1)
"""Its place in the table."""


@inlined
def half(wi: Ints, first: int, k: int) -> int:
    """Return the k-th of the numbers from `first` on of which an integer holds two."""
    return (wi[unsigned(first + (k >> 1))] >> WORD_BITS * (k & 1)) & WORD_MASK


@inlined
def block_of(a: int, b: int, c: int, ny: int, nz: int) -> int:
    """Return the number of the block that a cube is in, z changing fastest.

    `ny`, `nz`: cubes along y and z, in whole blocks.
    """
    n = LATTICE_BLOCK
    return ((a >> n) * (ny >> n) + (b >> n)) * (nz >> n) + (c >> n)


@inlined
def within(a: int, b: int, c: int) -> int:
    """Return the number of a cube in its block, z changing fastest."""
    n, m = LATTICE_BLOCK, LATTICE_BLOCK_MASK
    return ((a & m) << n | b & m) << n | c & m


@inlined
def cube_at(wf: Array, wi: Ints, root: int, x: float, y: float, z: float) -> tuple[int, int]:
    """Return where the table says where the words of a point's block begin, and its cube in that block.

    The point is in the frame of the tree. One that is in no cube, as NaN is, is `NOWHERE` in the table.
    """
    g = unsigned(NODE_FLOATS * (root + GATE))
    scale = wf[g + LATTICE_PER_METRE]
    u = scale * (x - wf[g + LATTICE_CORNER])
    v = scale * (y - wf[g + LATTICE_CORNER + 1])
    w = scale * (z - wf[g + LATTICE_CORNER + 2])
    ny, nz = wf[g + LATTICE_COUNTS + 1], wf[g + LATTICE_COUNTS + 2]
    if not (0.0 <= u < wf[g + LATTICE_COUNTS] and 0.0 <= v < ny and 0.0 <= w < nz):
        return NOWHERE, 0
    table = wi[unsigned(NODE_INTS * (root + GATE) + LATTICE_TABLE)]
    a, b, c = int(u), int(v), int(w)
    return table + block_of(a, b, c, int(ny), int(nz)), within(a, b, c)


@inlined
def _word_at(wf: Array, wi: Ints, root: int, x: float, y: float, z: float) -> int:
    """Return the word of the cube that a point of a tree's space is in."""
    entry, cube = cube_at(wf, wi, root, x, y, z)
    return _UNKNOWN if entry == NOWHERE else half(wi, wi[unsigned(entry)], cube)


@inlined
def listed(word: int) -> tuple[int, int]:
    """Return where in the lists the polygons of a word begin, and end."""
    first = word >> WORD_LIST_SHIFT
    return first, first + (word >> WORD_COUNT_SHIFT & CROWDED)


@inlined
def _what_is_near(wf: Array, wi: Ints, s: Array, root: int, sphere: Sphere) -> tuple[int, int, int]:
    """Return the word of a sphere's cube, and where in the lists its polygons begin, and end.

    All that they leave out of the tree's polygons is BEYOND the sphere, or MISSes it. The word is that of a
    point in no cube if nothing is known of such a sphere, or the plan does not ask for it.
    """
    x, y, z, r = sphere
    if not 0.0 <= r <= LATTICE_REACH or not allows(s, PLAN_WALKS):
        return _UNKNOWN, 0, 0
    word = _word_at(wf, wi, root, x, y, z)
    first, end = listed(word)
    return word, first, end


@inlined
def is_unknown(word: int) -> bool:
    """Say whether a cube lists nothing because there is too much."""
    return word >> WORD_COUNT_SHIFT & CROWDED == CROWDED


@inlined
def lists_of(wi: Ints, root: int) -> int:
    """Return where a tree's lists begin."""
    return wi[unsigned(NODE_INTS * (root + GATE) + LATTICE_LISTS)]


@inlined
def _may_count_as_solid(wf: Array, wi: Ints, root: int, word: int, sphere: Sphere, center_check: int) -> bool:
    """Say whether a walk may come to a solid leaf whose flag counts for a sphere in the cube of a word.

    A leaf's flag counts, if at all, on the side of the centre of every plane that the sphere straddles. It is
    on no other side of the planes that it doesn't, if it reaches farther than 0: so that leaf is the one that
    the centre is in. A bounding sphere may end the walk before it, which is then made for nothing.

    retail: BSPNODE::sphere_intersects_solid 0x0053CAF0, SO-3...SO-6
    """
    if not word & WORD_SOLID or center_check == 0:
        return False
    x, y, z, r = sphere
    if not r > EPS:
        return True
    leaf = leaf_of(wf, wi, root, x, y, z)
    _, count = leaf_polygons(wi, leaf)
    return count != 0 and is_solid(wi, leaf)


@kernel
def nothing_near(wf: Array, wi: Ints, s: Array, root: int, sphere: Sphere, center_check: int) -> bool:
    """Say whether a walk with a sphere is certain to find nothing: no polygon, and no solid leaf.

    `center_check`: whether a solid leaf counts that holds the centre, as of `sphere_intersects_solid`.

    The polygons that the centre's cube lists are asked as a walk asks them. If none is HIT, no leaf that a
    walk comes to has one, whichever those are; it would end with the polygon that it began with, and with no
    answer but that of a solid leaf. Whether there may be one near, the cube says, too.

    A walk may leave a point of contact, too, which a transition never reads (03, 16), and counters of work.

    retail: BSPNODE::sphere_intersects_poly 0x0053CA30, SP-4...SP-6;
    BSPNODE::sphere_intersects_solid 0x0053CAF0, SO-6...SO-8
    """
    word, first, end = _what_is_near(wf, wi, s, root, sphere)
    if is_unknown(word) or _may_count_as_solid(wf, wi, root, word, sphere, center_check):
        return False
    s[POLYGONS_TESTED] += end - first
    lists = lists_of(wi, root)
    for i in range(first, end):
        code, _, _, _ = polygon_hits_sphere_slow_but_sure(wf, half(wi, lists, i), sphere)
        if code == HIT:
            return False
    s[SKIPPED_WALKS] += 1.0
    return True


@kernel
def no_ground_near(wf: Array, wi: Ints, s: Array, root: int, sphere: Sphere, up: Vector) -> bool:
    """Say whether `find_walkable` is certain to find nothing to put a sphere on.

    It moves the sphere for the first time on to a polygon that is flat enough and HIT where the sphere is at
    first. If none of those that the cube lists is, there is no such polygon.

    retail: BSPNODE::find_walkable 0x0053CC80, FW-4, FW-5
    """
    word, first, end = _what_is_near(wf, wi, s, root, sphere)
    if is_unknown(word):
        return False
    allowance = s[WALKABLE_ALLOWANCE]
    s[POLYGONS_TESTED] += end - first
    lists = lists_of(wi, root)
    for i in range(first, end):
        if polygon_walkable_hits_sphere(wf, half(wi, lists, i), sphere, up, allowance):
            return False
    s[SKIPPED_WALKS] += 1.0
    return True
