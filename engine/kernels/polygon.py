"""CPolygon (02): its plane, and tests of a sphere or point against it.

``p`` is the offset of a polygon record in the world's floats. Spheres are three numbers and a radius,
in the polygon's own space.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import EPS
from engine.kernels.compile import entry, inlined, inlined_entry
from engine.kernels.indexing import unsigned
from engine.kernels.polygon_edges import BEYOND, HIT, MISS, any_edge_near, disc_touches
from engine.kernels.polygon_record import corner, more_sides
from engine.kernels.rounding import f32, slack
from engine.kernels.sides import sides_outside
from engine.kernels.vector import dot_x
from engine.layout import POLYGON_CONVEX, POLYGON_COUNT, POLYGON_SIDES, SIDES, SIDES_SIZE

if TYPE_CHECKING:
    from engine.kernels.types import Array, Sphere, Vector


@inlined
def plane_distance(wf: Array, at: int, x: float, y: float, z: float) -> float:
    """Return the signed distance of a point from the plane at `at`, in a register.

    retail: 01 1.2
    """
    p = unsigned(at)
    return dot_x(wf[p], wf[p + 1], wf[p + 2], x, y, z) + wf[p + 3]


@inlined
def along_normal(wf: Array, at: int, x: float, y: float, z: float) -> float:
    """Return the component of a vector along the normal of the plane at `at`, in a register.

    retail: 01 1.2
    """
    p = unsigned(at)
    return dot_x(x, y, z, wf[p], wf[p + 1], wf[p + 2])


@inlined
def _contact(wf: Array, at: int, dist: float, x: float, y: float, z: float) -> Vector:
    """Project a sphere's centre on the plane.

    retail: PH-3
    """
    p = unsigned(at)
    pz = f32(dist * wf[p + 2])
    return f32(x - dist * wf[p]), f32(y - dist * wf[p + 1]), f32(z - pz)


@entry
def polygon_make_plane(wf: Array, p: int) -> None:
    """Compute and store the plane from the vertices; NaN for a polygon without area.

    retail: CPolygon::make_plane 0x005383D0, MP-1...MP-6
    """
    n = int(wf[p + POLYGON_COUNT])
    first = corner(p, 0)
    sx, sy, sz = 0.0, 0.0, 0.0
    for k in range(1, n - 1):
        a, b = corner(p, k), corner(p, k + 1)
        bx, by, bz = wf[b] - wf[first], wf[b + 1] - wf[first + 1], wf[b + 2] - wf[first + 2]
        ax, ay, az = f32(wf[a] - wf[first]), f32(wf[a + 1] - wf[first + 1]), wf[a + 2] - wf[first + 2]
        sx = sx + f32(ay * bz - az * by)
        sy = sy + f32(az * bx - bz * ax)
        sz = f32((by * ax - ay * bx) + sz)
    inv = 1.0 / math.sqrt((sz * sz + sy * sy) + sx * sx)
    inv32 = f32(inv)
    nx, ny, nz = f32(inv * sx), f32(inv32 * sy), f32(inv32 * sz)
    total = 0.0
    for k in range(n):
        v = corner(p, k)
        total = ((total + nz * wf[v + 2]) + ny * wf[v + 1]) + nx * wf[v]
    wf[p] = nx
    wf[p + 1] = ny
    wf[p + 2] = nz
    wf[p + 3] = f32(-(total / float(n)))


@entry
def polygon_point_in_poly2d(wf: Array, p: int, x: float, y: float, side: int) -> bool:
    """Say whether a point lies on the accepted side of every edge, seen along z.

    retail: CPolygon::point_in_poly2D 0x00538060, P2-1...P2-4
    """
    prev = corner(p, 0)
    for i in range(int(wf[p + POLYGON_COUNT]) - 1, -1, -1):
        cur = corner(p, i)
        a = wf[prev + 1] - wf[cur + 1]
        b = wf[cur] - wf[prev]
        s = ((-(a * wf[cur]) - b * wf[cur + 1]) + b * y) + a * x
        if side == 0:
            if s > 0.0:
                return False
        elif s < 0.0:
            return False
        prev = cur
    return True


@inlined
def _outside(wf: Array, p: int, x: float, y: float, z: float, far: float) -> int:
    """Return the bits of `sides_outside`, of all blocks of a polygon's edges together.

    retail: PP-1...PP-3
    """
    found = sides_outside(wf, p + POLYGON_SIDES, x, y, z, far)
    n = int(wf[unsigned(p + POLYGON_COUNT)])
    at = more_sides(p, n)
    for _ in range(SIDES, n, SIDES):
        found |= sides_outside(wf, at, x, y, z, far)
        at += SIDES_SIZE
    return found


@entry
def polygon_point_in_polygon(wf: Array, p: int, x: float, y: float, z: float) -> bool:
    """Say whether a point is inside every edge, whatever its distance from the plane.

    retail: CPolygon::point_in_polygon 0x00538D90, PP-1...PP-3
    """
    return _outside(wf, p, x, y, z, 0.0) == 0


@inlined
def _far_outside(x: float, y: float, z: float, r: float, rsq: float) -> float:
    """Return how far, squared, a disc's centre must be outside of an edge to be certain to MISS.

    The disc's radius is the root of `rsq`, and at most r. If the polygon is convex, within a millimetre, all
    of it is on the inner side of the edge's line; so where the disc's centre is farther from that line
    than the radius and `slack`, it is farther than the radius from every edge and every vertex. No edge and
    no vertex decides HIT then (PH-5, PH-6), and what is not HIT is a MISS (SS-6). With s the slack, the
    square of radius + s is not more than rsq + s (2 r + s). The slack, which `engine.kernels.broad`
    derives, is far more than a projected point and an edge's normal are rounded by.
    """
    s = slack(x, y, z)
    return rsq + s * (r + r + s)


@entry
def polygon_hits_sphere(wf: Array, p: int, sphere: Sphere) -> tuple[int, float, float, float]:
    """Test a sphere, fast version: HIT, MISS or BEYOND the plane, and the projected centre.

    retail: CPolygon::polygon_hits_sphere 0x005387C0, PH-1...PH-7
    """
    x, y, z, r = sphere
    dist = plane_distance(wf, p, x, y, z)
    rad = r - EPS
    if rad < abs(dist):
        return BEYOND, 0.0, 0.0, 0.0
    rsq = f32(rad * rad - dist * dist)
    qx, qy, qz = _contact(wf, p, dist, x, y, z)
    return disc_touches(wf, p, qx, qy, qz, rsq), qx, qy, qz


@inlined_entry
def polygon_hits_sphere_slow_but_sure(wf: Array, p: int, sphere: Sphere) -> tuple[int, float, float, float]:
    """Test a sphere: HIT, MISS or BEYOND the plane, and the projected centre.

    retail: CPolygon::polygon_hits_sphere_slow_but_sure 0x00538A10, SS-1...SS-6
    """
    x, y, z, r = sphere
    dist = plane_distance(wf, p, x, y, z)
    rad = r - EPS
    if rad < abs(dist):
        return BEYOND, 0.0, 0.0, 0.0
    qx, qy, qz = _contact(wf, p, dist, x, y, z)
    rsq = f32(rad * rad - dist * dist)
    outside = _outside(wf, p, qx, qy, qz, _far_outside(qx, qy, qz, r, rsq))
    if outside == 0:
        return HIT, qx, qy, qz
    if outside >> SIDES != 0 and wf[unsigned(p + POLYGON_CONVEX)] != 0.0:
        return MISS, qx, qy, qz
    return any_edge_near(wf, p, qx, qy, qz, rsq), qx, qy, qz


@inlined_entry
def polygon_moved_along(wf: Array, p: int, movement: Vector) -> bool:
    """Say whether a movement does not go against the normal.

    retail: PS-3
    """
    x, y, z = movement
    return along_normal(wf, p, x, y, z) >= 0.0


@inlined_entry
def polygon_walkable_hits_sphere(wf: Array, p: int, sphere: Sphere, up: Vector, allowance: float) -> bool:
    """Say whether the polygon is flat enough and touches the sphere.

    retail: CPolygon::walkable_hits_sphere 0x00539560, WH-1, WH-2
    """
    x, y, z = up
    if not along_normal(wf, p, x, y, z) > allowance:
        return False
    code, _, _, _ = polygon_hits_sphere_slow_but_sure(wf, p, sphere)
    return code == HIT
