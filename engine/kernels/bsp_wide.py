"""Walks through trees with wide leaves: a real cell's tree is often one leaf that lists all of its polygons.

Most polygons of a leaf are ruled out by their planes. Of few, the branches that each takes are foreseen, and
cost little; of many they aren't. So where a walk comes to a leaf that lists `WIDE_LEAF` polygons or more, it
goes on here: of each leaf, `ABREAST` planes are computed at a time (`engine.kernels.abreast`), and only what
is not ruled out is looked at one by one, in the leaf's order. Answers and counters are those of the plain
walks.

These walks are functions of their own, called where a plain one ends: called from within its loop they would
take the registers that its numbers are in.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import EPS
from engine.kernels.abreast import above, flat_planes, lowest, near_planes
from engine.kernels.bsp_node import descend, in_bounds, is_leaf, leaf_planes, leaf_polygons
from engine.kernels.compile import inlined, kernel
from engine.kernels.indexing import unsigned
from engine.kernels.polygon import (
    polygon_hits_sphere_slow_but_sure,
    polygon_moved_along,
    polygon_walkable_hits_sphere,
)
from engine.kernels.polygon_adjust import polygon_adjust_sphere_to_plane
from engine.kernels.polygon_edges import HIT, MISS
from engine.kernels.vector import centre, store
from engine.layout import (
    ABREAST,
    CONTACT_POINT,
    NO_POLYGON,
    NODES_VISITED,
    PLANE_SIZE,
    POLYGONS_TESTED,
    WALK_INTERP,
    WALKABLE_ALLOWANCE,
    WORLD_STACK,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Sphere, Vector


@inlined
def _leaf_strikes(
    wf: Array, wi: Ints, s: Array, leaf: int, sphere: Sphere, movement: Vector, poly: int
) -> tuple[bool, int]:
    """Find the first polygon of a leaf that overlaps and faces the movement.

    Returns whether there is one, and the last polygon that overlapped (`poly` if none did).

    retail: SP-4...SP-6, CPolygon::pos_hits_sphere 0x005394F0, PS-1...PS-3
    """
    first, count = leaf_polygons(wi, leaf)
    if count == 0 or not in_bounds(wf, leaf, sphere):
        return False, poly
    x, y, z, r = sphere
    planes = leaf_planes(wf, leaf)
    for begin in range(0, count, ABREAST):
        near = near_planes(wf, planes + PLANE_SIZE * begin, count - begin, x, y, z, r - EPS)
        while near != 0:
            i = begin + lowest(near)
            near &= near - 1
            p = wi[unsigned(first + i)]
            code, qx, qy, qz = polygon_hits_sphere_slow_but_sure(wf, p, sphere)
            if code >= MISS:
                store(s, CONTACT_POINT, qx, qy, qz)
            if code == HIT:
                poly = p
                if not polygon_moved_along(wf, p, movement):
                    s[POLYGONS_TESTED] += i + 1
                    return True, poly
    s[POLYGONS_TESTED] += count
    return False, poly


@kernel
def wide_leaf_overlap(wf: Array, wi: Ints, s: Array, leaf: int, sphere: Sphere) -> int:
    """Return the first polygon of a leaf that overlaps a sphere, whatever its facing.

    retail: SO-7, SO-8, SQ-8
    """
    x, y, z, r = sphere
    first, count = leaf_polygons(wi, leaf)
    planes = leaf_planes(wf, leaf)
    for begin in range(0, count, ABREAST):
        near = near_planes(wf, planes + PLANE_SIZE * begin, count - begin, x, y, z, r - EPS)
        while near != 0:
            i = begin + lowest(near)
            near &= near - 1
            p = wi[unsigned(first + i)]
            code, _, _, _ = polygon_hits_sphere_slow_but_sure(wf, p, sphere)
            if code == HIT:
                s[POLYGONS_TESTED] += i + 1
                return p
    s[POLYGONS_TESTED] += count
    return NO_POLYGON


@inlined
def _leaf_find_walkable(
    wf: Array, wi: Ints, s: Array, leaf: int, sphere: Sphere, movement: Vector, up: Vector, poly: int
) -> tuple[int, Sphere]:
    """Put the sphere on every polygon of a leaf that takes it; the last one wins.

    Wherever one takes it, those that follow are ruled out anew.

    retail: FW-4, FW-5
    """
    first, count = leaf_polygons(wi, leaf)
    if count == 0 or not in_bounds(wf, leaf, sphere):
        return poly, sphere
    ux, uy, uz = up
    planes = leaf_planes(wf, leaf)
    allowance = s[WALKABLE_ALLOWANCE]
    for begin in range(0, count, ABREAST):
        block = planes + PLANE_SIZE * begin
        flat = flat_planes(wf, block, ux, uy, uz, allowance)
        x, y, z, r = sphere
        left = flat & near_planes(wf, block, count - begin, x, y, z, r - EPS)
        while left != 0:
            i = lowest(left)
            left &= left - 1
            p = wi[unsigned(first + begin + i)]
            if not polygon_walkable_hits_sphere(wf, p, sphere, up, allowance):
                continue
            moved, sphere, interp = polygon_adjust_sphere_to_plane(wf, p, sphere, movement, s[WALK_INTERP])
            if moved:
                s[WALK_INTERP] = interp
                poly = p
                x, y, z, _ = sphere
                left = flat & above(i) & near_planes(wf, block, count - begin, x, y, z, r - EPS)
    s[POLYGONS_TESTED] += count
    return poly, sphere


@kernel
def strike_on(
    wf: Array, wi: Ints, s: Array, node: int, top: int, sphere: Sphere, movement: Vector, poly: int
) -> tuple[bool, int]:
    """Go on with a walk of `engine.kernels.bsp_poly.sphere_intersects_poly` from a node.

    `top`: of the stack.

    retail: BSPNODE::sphere_intersects_poly 0x0053CA30, SP-1...SP-6
    """
    while True:
        s[NODES_VISITED] += 1
        if is_leaf(wi, node):
            struck, poly = _leaf_strikes(wf, wi, s, node, sphere, movement, poly)
            if struck:
                return True, poly
        elif in_bounds(wf, node, sphere):
            node, top = descend(wf, wi, s, node, sphere, top)
            continue
        if top == wi[WORLD_STACK]:
            return False, poly
        top -= 1
        node = int(s[unsigned(top)])


@kernel
def find_walkable_on(
    wf: Array,
    wi: Ints,
    s: Array,
    node: int,
    top: int,
    sphere: Sphere,
    movement: Vector,
    up: Vector,
    poly: int,
) -> tuple[int, Vector]:
    """Go on with a walk of `engine.kernels.bsp_walkable.find_walkable` from a node.

    `top`: of the stack.

    retail: BSPNODE::find_walkable 0x0053CC80, FW-1...FW-5
    """
    while True:
        s[NODES_VISITED] += 1
        if is_leaf(wi, node):
            poly, sphere = _leaf_find_walkable(wf, wi, s, node, sphere, movement, up, poly)
        elif in_bounds(wf, node, sphere):
            node, top = descend(wf, wi, s, node, sphere, top)
            continue
        if top == wi[WORLD_STACK]:
            return poly, centre(sphere)
        top -= 1
        node = int(s[unsigned(top)])
