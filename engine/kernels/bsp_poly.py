"""Which polygon does a moving sphere strike, and does a sphere touch solid matter (03, 2-4, 7)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import EPS
from engine.kernels.bsp_node import (
    BOTH_SIDES,
    POSITIVE_SIDE,
    descend,
    in_bounds,
    is_leaf,
    is_solid,
    is_wide,
    leaf_of,
    leaf_polygons,
    negative,
    positive,
    side_of,
    splitting_distance,
)
from engine.kernels.bsp_wide import strike_on, wide_leaf_overlap
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.gate import unbounded
from engine.kernels.indexing import unsigned
from engine.kernels.polygon import polygon_hits_sphere_slow_but_sure, polygon_moved_along
from engine.kernels.polygon_edges import HIT, MISS
from engine.kernels.vector import store
from engine.layout import CONTACT_POINT, NO_POLYGON, NODES_VISITED, POLYGONS_TESTED, WORLD_STACK

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Sphere, Vector


@inlined
def _leaf_strikes(
    wf: Array,
    wi: Ints,
    s: Array,
    leaf: int,
    sphere: Sphere,
    movement: Vector,
    poly: int,
    free: bool,
) -> tuple[bool, int]:
    """Find the first polygon of a leaf that overlaps and faces the movement.

    `free`: of the leaf's bounding sphere. Returns whether there is one, and the last polygon that overlapped
    (`poly` if none did).

    retail: SP-4...SP-6, CPolygon::pos_hits_sphere 0x005394F0, PS-1...PS-3
    """
    first, count = leaf_polygons(wi, leaf)
    if count == 0 or not (free or in_bounds(wf, leaf, sphere)):
        return False, poly
    struck = False
    tested = 0
    while tested < count and not struck:
        p = wi[unsigned(first + tested)]
        tested += 1
        code, qx, qy, qz = polygon_hits_sphere_slow_but_sure(wf, p, sphere)
        if code >= MISS:
            store(s, CONTACT_POINT, qx, qy, qz)
        if code == HIT:
            poly = p
            struck = not polygon_moved_along(wf, p, movement)
    s[POLYGONS_TESTED] += tested
    return struck, poly


@entry
def sphere_intersects_poly(
    wf: Array,
    wi: Ints,
    s: Array,
    root: int,
    sphere: Sphere,
    movement: Vector,
    poly: int,
) -> tuple[bool, int]:
    """Find the first polygon that overlaps a sphere and faces its movement.

    Returns whether there is one, and the last polygon that overlapped at all (`poly` if none did).

    retail: BSPNODE::sphere_intersects_poly 0x0053CA30, SP-1...SP-6
    """
    base = wi[WORLD_STACK]
    top = base
    node = root
    nodes = 0
    struck = False
    free = unbounded(wf, s, root, sphere)
    while True:
        nodes += 1
        if is_leaf(wi, node):
            if is_wide(wi, node):
                s[NODES_VISITED] += nodes - 1
                return strike_on(wf, wi, s, node, top, sphere, movement, poly)
            struck, poly = _leaf_strikes(wf, wi, s, node, sphere, movement, poly, free)
            if struck:
                break
        elif free or in_bounds(wf, node, sphere):
            node, top = descend(wf, wi, s, node, sphere, top)
            continue
        if top == base:
            break
        top -= 1
        node = int(s[unsigned(top)])
    s[NODES_VISITED] += nodes
    return struck, poly


@kernel
def _leaf_overlap(wf: Array, wi: Ints, s: Array, leaf: int, sphere: Sphere) -> int:
    """Return the first polygon of a leaf that overlaps a sphere, whatever its facing.

    retail: SO-7, SO-8, SQ-8
    """
    if not in_bounds(wf, leaf, sphere):
        return NO_POLYGON
    if is_wide(wi, leaf):
        return wide_leaf_overlap(wf, wi, s, leaf, sphere)
    first, count = leaf_polygons(wi, leaf)
    found = NO_POLYGON
    tested = 0
    while tested < count and found == NO_POLYGON:
        p = wi[unsigned(first + tested)]
        tested += 1
        code, _, _, _ = polygon_hits_sphere_slow_but_sure(wf, p, sphere)
        if code == HIT:
            found = p
    s[POLYGONS_TESTED] += tested
    return found


@entry
def sphere_intersects_solid(
    wf: Array, wi: Ints, s: Array, root: int, sphere: Sphere, center_check: int
) -> bool:
    """Say whether a sphere overlaps solid matter.

    `center_check` says whether a solid leaf counts by its flag alone; it follows the side that holds
    the centre.

    retail: BSPNODE::sphere_intersects_solid 0x0053CAF0, SO-1...SO-8
    """
    base = wi[WORLD_STACK]
    top = base
    node = root
    check = center_check
    x, y, z, r = sphere
    reach = r - EPS
    nodes = 0
    solid = False
    while True:
        nodes += 1
        if is_leaf(wi, node):
            _, count = leaf_polygons(wi, node)
            if count != 0:
                filled = check != 0 and is_solid(wi, node)
                solid = filled or _leaf_overlap(wf, wi, s, node, sphere) != NO_POLYGON
                if solid:
                    break
        elif in_bounds(wf, node, sphere):
            dist = splitting_distance(wf, node, x, y, z)
            side = side_of(dist, reach)
            if side == POSITIVE_SIDE:
                node = positive(node)
            elif side == BOTH_SIDES:
                in_front = not dist < 0.0
                s[unsigned(top)] = 2 * negative(wi, node) + (0 if in_front else check)
                top += 1
                node = positive(node)
                check = check if in_front else 0
            else:
                node = negative(wi, node)
            continue
        if top == base:
            break
        top -= 1
        packed = int(s[unsigned(top)])
        node = packed >> 1
        check = packed & 1
    s[NODES_VISITED] += nodes
    return solid


@entry
def sphere_intersects_solid_poly(
    wf: Array,
    wi: Ints,
    s: Array,
    root: int,
    sphere: Sphere,
    radius: float,
    center_solid: int,
    poly: int,
    center_check: int,
) -> tuple[int, int, int]:
    """Find what a placed sphere overlaps, the side of its centre first.

    `radius` prunes, the sphere's own tests. Returns the answer (retail's quirks included), center_solid and
    the polygon. Once a polygon is known, every straddled node on the way back answers center_solid.

    retail: BSPNODE::sphere_intersects_solid_poly 0x0053CD50, SQ-1...SQ-9
    """
    base = wi[WORLD_STACK]
    top = base
    node = root
    check = center_check
    x, y, z, _ = sphere
    reach = radius - EPS
    while True:
        s[NODES_VISITED] += 1
        answer = 0
        if is_leaf(wi, node):
            _, count = leaf_polygons(wi, node)
            if count != 0:
                if check != 0 and is_solid(wi, node):
                    center_solid = 1
                answer = center_solid
                found = _leaf_overlap(wf, wi, s, node, sphere)
                if found != NO_POLYGON:
                    poly = found
                    answer = 1
        elif in_bounds(wf, node, sphere):
            dist = splitting_distance(wf, node, x, y, z)
            side = side_of(dist, reach)
            behind = dist < 0.0 if side == BOTH_SIDES else side != POSITIVE_SIDE
            if side == BOTH_SIDES:
                s[unsigned(top)] = positive(node) if behind else negative(wi, node)
                top += 1
            node = negative(wi, node) if behind else positive(node)
            continue
        if top == base:
            return answer, center_solid, poly
        if poly != NO_POLYGON:
            return center_solid, center_solid, poly
        top -= 1
        node = int(s[unsigned(top)])
        check = 0


@entry
def point_intersects_solid(wf: Array, wi: Ints, root: int, x: float, y: float, z: float) -> bool:
    """Say whether a point's leaf holds polygons; a point on a plane goes to the positive child.

    retail: BSPNODE::point_intersects_solid 0x0053C310, 03 7
    """
    _, count = leaf_polygons(wi, leaf_of(wf, wi, root, x, y, z))
    return count != 0
