"""The edges of a CPolygon (02, 0.4): which side is a point on, does a disc about it touch.

The edge walk starts with the edge from the last vertex to the first. The in-plane normal of an edge
points to the inside; it is precomputed (`engine.kernels.polygon_record`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.kernels.compile import inlined, kernel
from engine.kernels.indexing import unsigned
from engine.kernels.polygon_record import corner, edge
from engine.kernels.rounding import f32
from engine.layout import (
    EDGE_NORMAL,
    EDGE_NORMAL_SQUARED,
    EDGE_SQUARED,
    POLYGON_COUNT,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array

BEYOND: int = -1
"""Answer of a test: farther from the plane than the sphere reaches."""
MISS: int = 0
HIT: int = 1

_UNDECIDED = -1


@inlined
def _edge_decision(wf: Array, at: int, e: int, x: float, y: float, z: float, rsq: float) -> tuple[int, bool]:
    """Decide by one edge whether a disc of squared radius `rsq` about a point touches the polygon.

    The edge's first vertex lies at `at`, the edge at `e`. Returns HIT, MISS or undecided, and whether
    the point is outside this edge.

    retail: the table of PH-4, PH-5, PH-6
    """
    qx = f32(x - wf[at])
    qy = f32(y - wf[at + 1])
    qz = z - wf[at + 2]
    qz32 = f32(qz)
    n = e + EDGE_NORMAL
    side = (qz * wf[n + 2] + qy * wf[n + 1]) + qx * wf[n]
    outside = side < 0.0
    if outside:
        if wf[e + EDGE_NORMAL_SQUARED] * rsq < side * side:
            return MISS, outside
        along = (qz32 * wf[e + 2] + qy * wf[e + 1]) + qx * wf[e]
        if along >= 0.0 and along <= wf[e + EDGE_SQUARED]:
            return HIT, outside
    if (qz32 * qz32 + qy * qy) + qx * qx <= rsq:
        return HIT, outside
    return _UNDECIDED, outside


@kernel
def disc_touches(wf: Array, p: int, x: float, y: float, z: float, rsq: float) -> int:
    """Walk the edges until one decides; else the disc touches iff its centre is inside all.

    retail: PH-4...PH-7, CW-5...CW-7
    """
    n = int(wf[unsigned(p + POLYGON_COUNT)])
    at, e = corner(p, n - 1), edge(p, n, n - 1)
    result = HIT
    for k in range(n):
        decision, outside = _edge_decision(wf, at, e, x, y, z, rsq)
        if decision != _UNDECIDED:
            return decision
        if outside:
            result = MISS
        at, e = corner(p, k), edge(p, n, k)
    return result


@kernel
def any_edge_near(wf: Array, p: int, x: float, y: float, z: float, rsq: float) -> int:
    """Walk the edges again for a point outside the polygon: the second pass.

    retail: SS-5, SS-6
    """
    n = int(wf[unsigned(p + POLYGON_COUNT)])
    at, e = corner(p, n - 1), edge(p, n, n - 1)
    for k in range(n):
        decision, _ = _edge_decision(wf, at, e, x, y, z, rsq)
        if decision != _UNDECIDED:
            return decision
        at, e = corner(p, k), edge(p, n, k)
    return MISS
