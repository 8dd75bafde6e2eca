"""What of a CPolygon's edge tests doesn't depend on the sphere, computed once with the same roundings.

A record keeps for every vertex the edge from there to the next vertex (`engine.layout`). Retail walks
the edges beginning with the one from the last vertex to the first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.kernels.compile import entry, inlined
from engine.kernels.indexing import unsigned
from engine.kernels.rounding import f32
from engine.kernels.vector import store
from engine.layout import (
    CORNER_SIZE,
    EDGE_NORMAL,
    EDGE_NORMAL_SQUARED,
    EDGE_SIZE,
    EDGE_SQUARED,
    POLYGON_CORNERS,
    POLYGON_COUNT,
    POLYGON_SIDES,
    SIDE_FAR,
    SIDE_NORMAL,
    SIDES,
    SIDES_SIZE,
    VECTOR_SIZE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array


@inlined
def corner(p: int, k: int) -> int:
    """Return where vertex k of the polygon at `p` lies."""
    return unsigned(p + POLYGON_CORNERS + CORNER_SIZE * k)


@inlined
def edge(p: int, n: int, k: int) -> int:
    """Return where the edge lies that begins at vertex k of the polygon at `p`, which has n vertices."""
    return unsigned(p + POLYGON_CORNERS + CORNER_SIZE * n + EDGE_SIZE * k)


@inlined
def more_sides(p: int, n: int) -> int:
    """Return where the second block of sides begins of the polygon at `p`, which has n vertices."""
    return p + POLYGON_CORNERS + (CORNER_SIZE + EDGE_SIZE) * n


@inlined
def _side(p: int, n: int, k: int) -> int:
    """Return where side k has its place in its block, of the polygon at `p`, which has n vertices."""
    if k < SIDES:
        return p + POLYGON_SIDES + k
    return more_sides(p, n) + SIDES_SIZE * (k // SIDES - 1) + k % SIDES


@entry
def polygon_make_edges(wf: Array, p: int) -> None:
    """Compute and store what the edge tests need, from the vertices and the plane.

    retail: the parts of PP-2 and of the table of PH-4 that don't depend on the point
    """
    n = int(wf[p + POLYGON_COUNT])
    for k in range(n):
        at = corner(p, k)
        following = corner(p, (k + 1) % n)
        _make_edge(wf, p, at, following, edge(p, n, k))
        side = _side(p, n, k)
        _make_side(wf, p, at, following, side)
        wf[side + SIDE_FAR] = wf[edge(p, n, k) + EDGE_NORMAL_SQUARED]


@inlined
def _make_side(wf: Array, p: int, prev: int, cur: int, at: int) -> None:
    """Store a vertex, and the in-plane normal as point_in_polygon rounds it: z stays a register.

    retail: PP-2
    """
    nx, ny, nz = wf[p], wf[p + 1], wf[p + 2]
    ex, ey, ez = wf[cur] - wf[prev], wf[cur + 1] - wf[prev + 1], wf[cur + 2] - wf[prev + 2]
    for j in range(VECTOR_SIZE):
        wf[at + SIDES * j] = wf[prev + j]
    wf[at + SIDE_NORMAL] = f32(ez * ny - ey * nz)
    wf[at + SIDE_NORMAL + SIDES] = f32(ex * nz - ez * nx)
    wf[at + SIDE_NORMAL + 2 * SIDES] = ey * nx - ex * ny


@inlined
def _make_edge(wf: Array, p: int, prev: int, cur: int, at: int) -> None:
    """Store the edge and its in-plane normal as the other tests round them: the normal is a register.

    retail: the table of PH-4, FE-3
    """
    nx, ny, nz = wf[p], wf[p + 1], wf[p + 2]
    ex = f32(wf[cur] - wf[prev])
    ey = f32(wf[cur + 1] - wf[prev + 1])
    ez = wf[cur + 2] - wf[prev + 2]
    ez32 = f32(ez)
    cz = ey * nx - ex * ny
    cy = ex * nz - ez32 * nx
    cx = ez * ny - ey * nz
    store(wf, at, ex, ey, ez32)
    store(wf, at + EDGE_NORMAL, cx, cy, cz)
    wf[at + EDGE_NORMAL_SQUARED] = (cx * cx + cy * cy) + cz * cz
    wf[at + EDGE_SQUARED] = (ez32 * ez32 + ey * ey) + ex * ex
