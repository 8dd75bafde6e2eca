"""The edges of a CPolygon (02, 0.4): which side is a point on, does a disc about it touch.

The edge walk starts with the edge from the last vertex to the first. The in-plane normal of an edge
points to the inside.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.kernels.compile import inlined, kernel
from engine.kernels.rounding import f32
from engine.layout import POLYGON_COUNT, POLYGON_VERTICES

if TYPE_CHECKING:
    from engine.kernels.types import Array

BEYOND: int = -1
"""Answer of a test: farther from the plane than the sphere reaches."""
MISS: int = 0
HIT: int = 1

_UNDECIDED = -1


@inlined
def last_vertex(p: int, n: int) -> int:
    """Return where the last vertex of a polygon of n vertices lies."""
    return p + POLYGON_VERTICES + 3 * (n - 1)


@inlined
def _edge_decision(
    wf: Array, p: int, prev: int, cur: int, x: float, y: float, z: float, rsq: float
) -> tuple[int, bool]:
    """Decide by one edge whether a disc of squared radius `rsq` about a point touches the polygon.

    Returns HIT, MISS or undecided, and whether the point is outside this edge.

    retail: the table of PH-4, PH-5, PH-6
    """
    nx, ny, nz = wf[p], wf[p + 1], wf[p + 2]
    ex = f32(wf[cur] - wf[prev])
    ey = f32(wf[cur + 1] - wf[prev + 1])
    ez = wf[cur + 2] - wf[prev + 2]
    ez32 = f32(ez)
    qx = f32(x - wf[prev])
    qy = f32(y - wf[prev + 1])
    qz = z - wf[prev + 2]
    qz32 = f32(qz)
    cz = ey * nx - ex * ny
    cy = ex * nz - ez32 * nx
    cx = ez * ny - ey * nz
    side = (qz * cz + qy * cy) + qx * cx
    outside = side < 0.0
    if outside:
        if ((cx * cx + cy * cy) + cz * cz) * rsq < side * side:
            return MISS, outside
        along = (qz32 * ez32 + qy * ey) + qx * ex
        if along >= 0.0 and along <= (ez32 * ez32 + ey * ey) + ex * ex:
            return HIT, outside
    if (qz32 * qz32 + qy * qy) + qx * qx <= rsq:
        return HIT, outside
    return _UNDECIDED, outside


@kernel
def disc_touches(wf: Array, p: int, x: float, y: float, z: float, rsq: float) -> int:
    """Walk the edges until one decides; else the disc touches iff its centre is inside all.

    retail: PH-4...PH-7, CW-5...CW-7
    """
    n = int(wf[p + POLYGON_COUNT])
    prev = last_vertex(p, n)
    result = HIT
    for i in range(n):
        cur = p + POLYGON_VERTICES + 3 * i
        decision, outside = _edge_decision(wf, p, prev, cur, x, y, z, rsq)
        if decision != _UNDECIDED:
            return decision
        if outside:
            result = MISS
        prev = cur
    return result


@kernel
def any_edge_near(wf: Array, p: int, x: float, y: float, z: float, rsq: float) -> int:
    """Walk the edges again for a point outside the polygon: the second pass.

    retail: SS-5, SS-6
    """
    n = int(wf[p + POLYGON_COUNT])
    prev = last_vertex(p, n)
    for i in range(n):
        cur = p + POLYGON_VERTICES + 3 * i
        decision, _ = _edge_decision(wf, p, prev, cur, x, y, z, rsq)
        if decision != _UNDECIDED:
            return decision
        prev = cur
    return MISS
