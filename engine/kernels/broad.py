"""The broad phase: what a ball about the mover is certain not to reach. Every answer errs towards reaching.

How much larger than exact a bound has to be. A number near X is stored as float32 with an error of at
most 2**-24 |X|. Between the pose that a bound is computed from and the comparison that retail makes there
are fewer than 512 such stores: at most one for each of the offsets that a sub-step tries (3 inserts of 3
attempts, in each a step of 5 more), and ten on the way into another space. So a centre that retail
compares is off by less than ``BOUND_ROUNDING`` = 2**-15 times the sum of the coordinates' magnitudes; both
the mover's and the bounded thing's own are counted, each where it is known. `BOUND_SLACK` is for what does
not grow with coordinates: spheres that overlap "nearly" are sqrt(EPS) = 0.0142 m apart at most (01, 3.1),
cells are reached within CELL_SLACK = 0.01 m, planes and normals are unit vectors within 1e-4. `BOUND_TILT`
is for poses, whose quaternions may be off unit length: with a squared length of 1 ± 0.001 (EPS5) the
matrix is n R + (1 - n) I for a rotation R, so that it stretches nothing by more than 0.002.

All this is said of geometry as it is meant to be. What is not finite, flat, convex, unit, positive or near
enough for it has no bounds: `engine.compiling.bounds` and `engine.compiling.balls` tell so when a world is
compiled. A comparison with NaN says that the ball reaches.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import BOUND_ROUNDING, UNBOUNDED
from engine.kernels.bsp_node import descend, in_bounds, is_leaf, leaf_polygons
from engine.kernels.compile import inlined, kernel
from engine.kernels.indexing import unsigned
from engine.kernels.polygon import plane_distance
from engine.kernels.polygon_record import corner, edge
from engine.kernels.position import block_offset
from engine.layout import (
    BALL_CELL,
    BALL_SIZE,
    BOUNDS_FENCE_COUNT,
    BOUNDS_FENCES,
    BOUNDS_SIZE,
    EDGE_NORMAL,
    EDGE_NORMAL_SQUARED,
    NODES_VISITED,
    NOT_FENCED,
    PLANE_SIZE,
    PLATE_BALL,
    PLATE_SIZE,
    POLYGON_COUNT,
    POLYGONS_TESTED,
    RADIUS,
    WORLD_CELL_BOUNDS,
    WORLD_LEAF_BOUNDS,
    WORLD_STACK,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Sphere


@inlined
def listed_ball(wi: Ints, table: int, index: int) -> int:
    """Return where the bounding ball of an object, or of a building, lies in the world's floats."""
    return unsigned(wi[table] + BALL_SIZE * index)


@inlined
def bounds_of(wi: Ints, cell: int) -> int:
    """Return where a cell's bounds lie in the world's floats."""
    return unsigned(wi[WORLD_CELL_BOUNDS] + BOUNDS_SIZE * cell)


@inlined
def ball_beyond(wf: Array, ball: int, home: float, x: float, y: float, z: float, reach: float) -> bool:
    """Say whether a ball about a point of the block of `home` is clear of the bounding ball at `ball`.

    That lies in the block of a cell of its own; its radius is negative if it bounds nothing.
    """
    r = wf[ball + RADIUS]
    if r < 0.0:
        return True
    bx, by = block_offset(home, wf[ball + BALL_CELL])
    far = r + reach + BOUND_ROUNDING * (abs(bx) + abs(by))
    dx, dy, dz = x - (wf[ball] + bx), y - (wf[ball + 1] + by), z - wf[ball + 2]
    return dx * dx + dy * dy + dz * dz > far * far


@kernel
def fences_beyond(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float, reach: float) -> bool:
    """Say whether a ball about a point of an environment cell's block reaches through none of its portals.

    A fence is a plane of the block, one for each portal, behind which a sphere must be by its radius to be
    outside of what is behind the portal:

    - of a cell in the world, one plane of its containment: CEnvCell::find_transit_cells adds the cell
      unless `sphere_intersects_cell_bsp` says OUTSIDE, which it does for a sphere that is behind any of
      the planes by its radius and CELL_SLACK;
    - of the outside or of a cell that is not in the world, the portal's own plane, its front towards what
      is behind it: those are added unless each sphere is behind it by its radius and EPS.

    retail: CEnvCell::find_transit_cells 0x0052C820, 09 4.2
    """
    bounds = bounds_of(wi, cell)
    count = int(wf[bounds + BOUNDS_FENCE_COUNT])
    if count == NOT_FENCED:
        return False
    fence = int(wf[bounds + BOUNDS_FENCES])
    for i in range(count):
        if not plane_distance(wf, fence + PLANE_SIZE * i, x, y, z) < -reach:
            return False
    return True


@kernel
def _edges_beyond(wf: Array, p: int, x: float, y: float, z: float, r: float) -> bool:
    """Say whether a ball is clear of the line of one of a polygon's edges."""
    n = int(wf[unsigned(p + POLYGON_COUNT)])
    for k in range(n):
        at, e = corner(p, k), edge(p, n, k)
        m = e + EDGE_NORMAL
        side = (x - wf[at]) * wf[m] + (y - wf[at + 1]) * wf[m + 1] + (z - wf[at + 2]) * wf[m + 2]
        if side < 0.0 and side * side > r * r * wf[e + EDGE_NORMAL_SQUARED]:
            return True
    return False


@inlined
def polygon_beyond(wf: Array, wi: Ints, i: int, x: float, y: float, z: float, r: float) -> bool:
    """Say whether no sphere inside a ball can touch the polygon that ``wi[i]``, in a leaf's list, names.

    Either the ball is clear of the plane: then every sphere in it is BEYOND (SS-1). Or the polygon is
    convex, and the ball is clear of the ball about it, or of the line of one of its edges: then the
    projected centre is outside an edge (PP-2), and farther from all of the polygon, edges and vertices,
    than the sphere's radius (PH-4...PH-6), so that the answer is MISS.
    """
    plate = wi[WORLD_LEAF_BOUNDS] + PLATE_SIZE * i
    if abs(plane_distance(wf, plate, x, y, z)) > r:
        return True
    ball = unsigned(plate + PLATE_BALL)
    far = wf[ball + RADIUS] + r
    dx, dy, dz = x - wf[ball], y - wf[ball + 1], z - wf[ball + 2]
    if dx * dx + dy * dy + dz * dz > far * far:
        return True
    return far < UNBOUNDED and _edges_beyond(wf, wi[unsigned(i)], x, y, z, r)


@inlined
def _leaf_beyond(wf: Array, wi: Ints, s: Array, leaf: int, ball: Sphere) -> bool:
    """Say whether a ball is clear of all polygons of a leaf."""
    first, count = leaf_polygons(wi, leaf)
    if count == 0 or not in_bounds(wf, leaf, ball):
        return True
    x, y, z, r = ball
    s[POLYGONS_TESTED] += count
    for i in range(first, first + count):
        if not polygon_beyond(wf, wi, i, x, y, z, r):
            return False
    return True


@kernel
def tree_beyond(wf: Array, wi: Ints, s: Array, root: int, ball: Sphere) -> bool:
    """Say whether no sphere inside a ball, in a tree's space, strikes or overlaps any of its polygons.

    The walk is that of `sphere_intersects_poly` with the ball as the sphere, so it visits every node that
    a walk with a sphere inside it visits: with centres not farther apart than the radii differ, less
    BOUND_SLACK, both of its tests, of bounding spheres and of splitting planes, let the ball pass wherever
    they let the sphere pass.

    retail: BSPNODE::sphere_intersects_poly 0x0053CA30, SP-1...SP-6
    """
    base = wi[WORLD_STACK]
    top = base
    node = root
    nodes = 0
    clear = True
    while True:
        nodes += 1
        if is_leaf(wi, node):
            clear = _leaf_beyond(wf, wi, s, node, ball)
            if not clear:
                break
        elif in_bounds(wf, node, ball):
            node, top = descend(wf, wi, s, node, ball, top)
            continue
        if top == base:
            break
        top -= 1
        node = int(s[unsigned(top)])
    s[NODES_VISITED] += nodes
    return clear
