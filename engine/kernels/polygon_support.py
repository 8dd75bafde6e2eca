"""Does a CPolygon support a sphere above it, and which of its edges is crossed (02, 11-13)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import EPS
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.polygon import along_normal, plane_distance
from engine.kernels.polygon_edges import HIT, disc_touches
from engine.kernels.polygon_record import corner, edge
from engine.kernels.rounding import f32
from engine.kernels.vector import load
from engine.layout import EDGE_NORMAL, POLYGON_COUNT

if TYPE_CHECKING:
    from engine.kernels.types import Array, Sphere, Vector


@inlined
def _below(t: float, x: float, y: float, z: float, up: Vector) -> Vector:
    """Move a sphere's centre by -t along up, on to the plane.

    retail: CW-3
    """
    ux, uy, uz = up
    ty = f32(t * uy)
    tz = f32(t * uz)
    return f32(x - t * ux), f32(y - ty), f32(z - tz)


@kernel
def _check_walkable(wf: Array, p: int, sphere: Sphere, rsq: float, up: Vector) -> bool:
    """Say whether a disc about a sphere's centre, projected along up, touches the polygon.

    retail: CW-1...CW-3, CW-5...CW-7
    """
    x, y, z, _ = sphere
    ux, uy, uz = up
    v = along_normal(wf, p, ux, uy, uz)
    if abs(v) < EPS:
        return False
    t = plane_distance(wf, p, x, y, z) / v
    px, py, pz = _below(t, x, y, z, up)
    return disc_touches(wf, p, px, py, pz, rsq) == HIT


@entry
def polygon_check_walkable(wf: Array, p: int, sphere: Sphere, up: Vector) -> bool:
    """Say whether the sphere, projected along up, touches the polygon.

    retail: CPolygon::check_walkable 0x00538E60, CW-1...CW-7
    """
    _, _, _, r = sphere
    return _check_walkable(wf, p, sphere, f32(r * r), up)


@entry
def polygon_check_small_walkable(wf: Array, p: int, sphere: Sphere, up: Vector) -> bool:
    """Say whether a sphere of half the radius, projected along up, touches the polygon.

    retail: CPolygon::check_small_walkable 0x005390B0, 02 12
    """
    _, _, _, r = sphere
    return _check_walkable(wf, p, sphere, f32((r * r) * 0.25), up)


@entry
def polygon_find_crossed_edge(
    wf: Array, p: int, center: Vector, up: Vector
) -> tuple[bool, float, float, float]:
    """Find the first edge that the centre, projected along up, is outside of: its inward normal.

    retail: CPolygon::find_crossed_edge 0x00539300, FE-1...FE-5
    """
    x, y, z = center
    ux, uy, uz = up
    ny, nz = wf[p + 1], wf[p + 2]
    v = along_normal(wf, p, ux, uy, uz)
    if abs(v) < EPS:
        return False, 0.0, 0.0, 0.0
    t = plane_distance(wf, p, x, y, z) / v
    px, py, pz = _below(t, x, y, z, up)
    n = int(wf[p + POLYGON_COUNT])
    at, e = corner(p, n - 1), edge(p, n, n - 1)
    for k in range(n):
        cx, cy, cz = load(wf, e + EDGE_NORMAL)
        if ((pz - wf[at + 2]) * cz + (py - wf[at + 1]) * cy) + (px - wf[at]) * cx < 0.0:
            gx, gy, gz = f32(wf[e + 2] * ny - wf[e + 1] * nz), f32(cy), f32(cz)
            inv = 1.0 / math.sqrt((gx * gx + gy * gy) + gz * gz)
            return True, f32(inv * gx), f32(inv * gy), f32(inv * gz)
        at, e = corner(p, k), edge(p, n, k)
    return False, 0.0, 0.0, 0.0
