"""What several of CPolygon's functions share: projections onto its plane, and the loop over its edges."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32
from oracle.vector import Vector3, dot_x

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.plane import Plane


def foot_of(plane: Plane, center: Vector3, dist: float) -> Vector3:
    """Project a centre onto the plane, given its distance; only the z product is rounded (02 PH-3)."""
    N = plane.N
    pz = f32(dist * N.z)
    return Vector3(f32(center.x - dist * N.x), f32(center.y - dist * N.y), f32(center.z - pz))


def along_up(plane: Plane, center: Vector3, up: Vector3, v: float) -> Vector3:
    """Project a centre along `up` onto the plane; the x product is not rounded (02 CW-2…3, FE-2)."""
    t = (dot_x(plane.N, center) + plane.d) / v
    ty = f32(t * up.y)
    tz = f32(t * up.z)
    return Vector3(f32(center.x - t * up.x), f32(center.y - ty), f32(center.z - tz))


def reached_edge_by_edge(
    plane: Plane, edges: Sequence[tuple[Vector3, Vector3]], p: Vector3, rsq: float, inside: int
) -> int:
    """Tell whether a point of the plane is within sqrt(rsq) of the polygon, edge by edge.

    `inside` is the answer when no edge has the point outside.

    The loop of 02 PH-4…7, SS-5…6 and CW-5…7, which retail has four times.
    """
    N = plane.N
    result = inside
    for prev, cur in edges:
        # PH-4
        ex = f32(cur.x - prev.x)
        ey = f32(cur.y - prev.y)
        ez = cur.z - prev.z
        ez32 = f32(ez)
        qx = f32(p.x - prev.x)
        qy = f32(p.y - prev.y)
        qz = p.z - prev.z
        qz32 = f32(qz)
        cz = ey * N.x - ex * N.y
        cy = ex * N.z - ez32 * N.x
        cx = ez * N.y - ey * N.z
        side = (qz * cz + qy * cy) + qx * cx
        # PH-5, SS-5, CW-6
        if side < 0.0:
            cross2 = (cx * cx + cy * cy) + cz * cz
            if cross2 * rsq < side * side:
                return 0
            along = (qz32 * ez32 + qy * ey) + qx * ex
            if 0.0 <= along <= (ez32 * ez32 + ey * ey) + ex * ex:
                return 1
            result = 0
        # PH-6, SS-5, CW-6
        if (qz32 * qz32 + qy * qy) + qx * qx <= rsq:
            return 1
    # PH-7, SS-6, CW-7
    return result
