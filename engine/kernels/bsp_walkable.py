"""Which polygon can a sphere rest on (03, 5-6)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import GATE_WAY
from engine.kernels.abreast import lowest
from engine.kernels.bsp_node import descend, in_bounds, is_leaf, is_wide, knows_slopes, leaf_polygons, slopes
from engine.kernels.bsp_wide import find_walkable_on
from engine.kernels.compile import entry, inlined
from engine.kernels.gate import unbounded
from engine.kernels.indexing import unsigned
from engine.kernels.polygon import polygon_walkable_hits_sphere
from engine.kernels.polygon_adjust import polygon_adjust_sphere_to_plane
from engine.kernels.polygon_support import polygon_check_small_walkable
from engine.kernels.vector import centre
from engine.layout import (
    NO_POLYGON,
    NODES_VISITED,
    POLYGONS_TESTED,
    WALK_INTERP,
    WALKABLE_ALLOWANCE,
    WORLD_STACK,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Sphere, Vector


@inlined
def _leaf_find_walkable(
    wf: Array,
    wi: Ints,
    s: Array,
    leaf: int,
    sphere: Sphere,
    movement: Vector,
    up: Vector,
    poly: int,
    free: bool,
    known: bool,
) -> tuple[int, Sphere]:
    """Put the sphere on every polygon of a leaf that takes it; the last one wins.

    `free`: of the leaf's bounding sphere; `known`: what slopes are (`engine.kernels.bsp_node.knows_slopes`).

    retail: FW-4, FW-5
    """
    first, count = leaf_polygons(wi, leaf)
    if count == 0 or not (free or in_bounds(wf, leaf, sphere)):
        return poly, sphere
    allowance = s[WALKABLE_ALLOWANCE]
    left = slopes(wi, leaf, count, known)
    while left != 0:
        p = wi[unsigned(first + lowest(left))]
        left &= left - 1
        if polygon_walkable_hits_sphere(wf, p, sphere, up, allowance):
            moved, sphere, interp = polygon_adjust_sphere_to_plane(wf, p, sphere, movement, s[WALK_INTERP])
            if moved:
                s[WALK_INTERP] = interp
                poly = p
    s[POLYGONS_TESTED] += count
    return poly, sphere


@entry
def find_walkable(
    wf: Array, wi: Ints, s: Array, root: int, sphere: Sphere, movement: Vector, up: Vector
) -> tuple[int, Vector]:
    """Move a sphere back along its movement on to the polygons that can be walked on.

    Returns the last polygon that moved it (`NO_POLYGON`: none did) and the centre; walk_interp in the
    row is ratcheted down.

    retail: BSPNODE::find_walkable 0x0053CC80, FW-1...FW-5
    """
    base = wi[WORLD_STACK]
    top = base
    node = root
    poly = NO_POLYGON
    nodes = 0
    mx, my, mz = movement
    free = abs(mx) + abs(my) + abs(mz) < GATE_WAY and unbounded(wf, s, root, sphere)
    known = knows_slopes(wf, root, up, s[WALKABLE_ALLOWANCE])
    while True:
        nodes += 1
        if is_leaf(wi, node):
            if is_wide(wi, node):
                s[NODES_VISITED] += nodes - 1
                return find_walkable_on(wf, wi, s, node, top, sphere, movement, up, poly)
            poly, sphere = _leaf_find_walkable(wf, wi, s, node, sphere, movement, up, poly, free, known)
        elif free or in_bounds(wf, node, sphere):
            node, top = descend(wf, wi, s, node, sphere, top)
            continue
        if top == base:
            break
        top -= 1
        node = int(s[unsigned(top)])
    s[NODES_VISITED] += nodes
    return poly, centre(sphere)


@inlined
def _leaf_hits_walkable(
    wf: Array, wi: Ints, s: Array, leaf: int, sphere: Sphere, up: Vector, free: bool
) -> bool:
    """Say whether a leaf has a polygon that supports the sphere.

    `free`: of the leaf's bounding sphere.

    retail: BSPLEAF::hits_walkable 0x0053D670, 03 6
    """
    first, count = leaf_polygons(wi, leaf)
    if count == 0 or not (free or in_bounds(wf, leaf, sphere)):
        return False
    allowance = s[WALKABLE_ALLOWANCE]
    supported = False
    tested = 0
    while tested < count and not supported:
        p = wi[unsigned(first + tested)]
        tested += 1
        if polygon_walkable_hits_sphere(wf, p, sphere, up, allowance):
            supported = polygon_check_small_walkable(wf, p, sphere, up)
    s[POLYGONS_TESTED] += tested
    return supported


@entry
def hits_walkable(wf: Array, wi: Ints, s: Array, root: int, sphere: Sphere, up: Vector) -> bool:
    """Say whether any polygon supports the sphere; nothing is moved.

    retail: BSPNODE::hits_walkable 0x0053CBD0, 03 6
    """
    base = wi[WORLD_STACK]
    top = base
    node = root
    free = unbounded(wf, s, root, sphere)
    nodes = 0
    supported = False
    while True:
        nodes += 1
        if is_leaf(wi, node):
            supported = _leaf_hits_walkable(wf, wi, s, node, sphere, up, free)
            if supported:
                break
        elif free or in_bounds(wf, node, sphere):
            node, top = descend(wf, wi, s, node, sphere, top)
            continue
        if top == base:
            break
        top -= 1
        node = int(s[unsigned(top)])
    s[NODES_VISITED] += nodes
    return supported
