"""What all walks through a tree share (03, 1): bounding test, side of a sphere, the stack.

Walks are loops over an explicit stack, so a tree may be of any depth. The stack lies behind the
query's row, where the world's header says, and has a place for every level of the deepest tree.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import EPS, FLOOR_Z, UP_SLACK
from engine.kernels.compile import inlined
from engine.kernels.indexing import unsigned
from engine.kernels.polygon import plane_distance
from engine.layout import (
    GATE,
    GATE_UP,
    LEAF_COUNT_SHIFT,
    LEAF_FIRST_MASK,
    LEAF_PLANES,
    LEAF_SLOPES_SHIFT,
    NODE_FLOATS,
    NODE_INTS,
    NODE_LEAF,
    NODE_NEXT,
    NODE_SPHERE,
    SOLID_BIT,
    WIDE_LEAF,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Sphere, Vector

POSITIVE_SIDE: int = 0
NEGATIVE_SIDE: int = 1
BOTH_SIDES: int = 2


@inlined
def spheres_intersect(
    ax: float, ay: float, az: float, ar: float, bx: float, by: float, bz: float, br: float
) -> bool:
    """Say whether two spheres overlap, touch, or nearly do.

    retail: CSphere::intersects 0x005344A0, 01 3.1
    """
    dx, dy, dz = ax - bx, ay - by, az - bz
    rs = br + ar
    return ((dx * dx + dy * dy) + dz * dz) - rs * rs < EPS


@inlined
def in_bounds(wf: Array, node: int, sphere: Sphere) -> bool:
    """Test a sphere against a node's bounding sphere.

    retail: BN-1
    """
    x, y, z, r = sphere
    b = unsigned(NODE_FLOATS * node + NODE_SPHERE)
    return spheres_intersect(wf[b], wf[b + 1], wf[b + 2], wf[b + 3], x, y, z, r)


@inlined
def splitting_distance(wf: Array, node: int, x: float, y: float, z: float) -> float:
    """Return a point's distance from the splitting plane, in a register.

    retail: BN-2
    """
    return plane_distance(wf, NODE_FLOATS * node, x, y, z)


@inlined
def side_of(dist: float, reach: float) -> int:
    """Say which children a sphere of that reach touches.

    retail: BN-4
    """
    if dist >= reach:
        return POSITIVE_SIDE
    if dist <= -reach:
        return NEGATIVE_SIDE
    return BOTH_SIDES


@inlined
def is_leaf(wi: Ints, node: int) -> bool:
    """Say whether a tree ends here."""
    return wi[unsigned(NODE_INTS * node + NODE_LEAF)] != 0


@inlined
def is_solid(wi: Ints, leaf: int) -> bool:
    """Say whether a leaf is flagged as solid."""
    return wi[unsigned(NODE_INTS * leaf + NODE_LEAF)] & SOLID_BIT != 0


@inlined
def positive(node: int) -> int:
    """Return the child in front of the splitting plane: nodes lie in traversal order."""
    return node + 1


@inlined
def negative(wi: Ints, node: int) -> int:
    """Return the child behind the splitting plane."""
    return wi[unsigned(NODE_INTS * node + NODE_NEXT)]


@inlined
def leaf_of(wf: Array, wi: Ints, root: int, x: float, y: float, z: float) -> int:
    """Return the leaf that a point is in; one that is on a plane is in front of it."""
    node = root
    while not is_leaf(wi, node):
        behind = splitting_distance(wf, node, x, y, z) < 0.0
        node = negative(wi, node) if behind else positive(node)
    return node


@inlined
def leaf_polygons(wi: Ints, leaf: int) -> tuple[int, int]:
    """Return where a leaf's list of polygons begins, and its length."""
    at = unsigned(NODE_INTS * leaf)
    return wi[at + NODE_NEXT] & LEAF_FIRST_MASK, wi[at + NODE_LEAF] >> LEAF_COUNT_SHIFT


@inlined
def knows_slopes(wf: Array, root: int, up: Vector, allowance: float) -> bool:
    """Say whether leaves know which polygons are too steep for an up and an allowance.

    They know for every allowance of at least FLOOR_Z and every up near `GATE_UP`: along an up whose
    coordinates differ from it by d in all, the component of a normal n is not more than d * max(|nx|, |ny|,
    |nz|) larger, and those without a bit lack more than that (`engine.compiling.slopes`). To any other
    question, NaN among them, each polygon has to answer itself.

    retail: WH-1
    """
    ux, uy, uz = up
    measured = unsigned(NODE_FLOATS * (root + GATE) + GATE_UP)
    apart = abs(ux - wf[measured]) + abs(uy - wf[measured + 1]) + abs(uz - wf[measured + 2])
    return apart <= UP_SLACK and allowance >= FLOOR_Z


@inlined
def slopes(wi: Ints, leaf: int, count: int, known: bool) -> int:
    """Return a bit for each polygon of a leaf's list that may be flat enough; the leaf is not wide.

    `count`: how many it lists; `known`: what `knows_slopes` says.
    """
    return wi[unsigned(NODE_INTS * leaf + NODE_NEXT)] >> LEAF_SLOPES_SHIFT if known else (1 << count) - 1


@inlined
def is_wide(wi: Ints, leaf: int) -> bool:
    """Say whether a leaf lists `WIDE_LEAF` polygons or more."""
    return wi[unsigned(NODE_INTS * leaf + NODE_LEAF)] >= WIDE_LEAF << LEAF_COUNT_SHIFT


@inlined
def leaf_planes(wf: Array, leaf: int) -> int:
    """Return where the planes of a leaf's polygons begin; only in a tree that has a wide leaf."""
    return int(wf[unsigned(NODE_FLOATS * leaf + LEAF_PLANES)])


@inlined
def descend(wf: Array, wi: Ints, s: Array, node: int, sphere: Sphere, top: int) -> tuple[int, int]:
    """Go on to a child, the positive one first; leave the negative one on the stack if both are touched.

    Returns the child and the top of the stack.

    retail: BN-4
    """
    x, y, z, r = sphere
    reach = r - EPS
    dist = splitting_distance(wf, node, x, y, z)
    if dist >= reach:
        return positive(node), top
    if dist <= -reach:
        return negative(wi, node), top
    s[unsigned(top)] = negative(wi, node)
    return positive(node), top + 1
