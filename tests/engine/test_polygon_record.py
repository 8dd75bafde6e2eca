"""Precomputed edges: the same bits as computing them for each sphere, and the same answers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine import Leaf, Shape
from engine.kernels.polygon import polygon_hits_sphere, polygon_point_in_polygon
from engine.kernels.polygon_edges import BEYOND, HIT, MISS
from engine.kernels.polygon_support import polygon_find_crossed_edge
from engine.layout import CORNER_SIZE, POLYGON_CORNERS, POLYGON_SIDES, SIDES, SIDES_SIZE

if TYPE_CHECKING:
    from engine.kernels.types import Array

coordinates = st.floats(-4.0, 4.0, width=32)
points = st.tuples(coordinates, coordinates, coordinates)
corners = st.lists(points, min_size=0, max_size=6)


def f32(x: float) -> float:
    """Round to float32."""
    return float(np.float32(x))


def record(vertices: list[tuple[float, float, float]]) -> Array:
    """Return the record of a polygon of these vertices."""
    count = len(vertices)
    shape = Shape(vertices, [range(count)], Leaf((0.0, 0.0, 0.0, 99.0), (0,)))
    return shape.polygon_floats


def edges(vertices: list[Any]) -> list[tuple[tuple[float, ...], tuple[float, ...]]]:
    """Return the ends of all edges in the order of the walk."""
    return list(zip([*vertices[-1:], *vertices[:-1]], vertices, strict=True))


def inside(wf: Array, vertices: list[Any], x: float, y: float, z: float) -> bool:
    """Say whether a point is inside, as PP-1...PP-3 are written."""
    nx, ny, nz = wf[:3].tolist()
    for prev, cur in edges(vertices):
        ex, ey, ez = (b - a for a, b in zip(prev, cur, strict=True))
        cx, cy = f32(ez * ny - ey * nz), f32(ex * nz - ez * nx)
        cz = ey * nx - ex * ny
        if ((z - prev[2]) * cz + (y - prev[1]) * cy) + (x - prev[0]) * cx < 0.0:
            return False
    return True


def disc(wf: Array, vertices: list[Any], x: float, y: float, z: float, rsq: float) -> int:
    """Say whether a disc touches, as PH-4...PH-7 are written."""
    nx, ny, nz = wf[:3].tolist()
    result = HIT
    for prev, cur in edges(vertices):
        ex, ey, ez = f32(cur[0] - prev[0]), f32(cur[1] - prev[1]), cur[2] - prev[2]
        qx, qy, qz = f32(x - prev[0]), f32(y - prev[1]), z - prev[2]
        cz = ey * nx - ex * ny
        cy = ex * nz - f32(ez) * nx
        cx = ez * ny - ey * nz
        side = (qz * cz + qy * cy) + qx * cx
        if side < 0.0:
            if ((cx * cx + cy * cy) + cz * cz) * rsq < side * side:
                return MISS
            along = (f32(qz) * f32(ez) + qy * ey) + qx * ex
            if 0.0 <= along <= (f32(ez) * f32(ez) + ey * ey) + ex * ex:
                return HIT
            result = MISS
        if (f32(qz) * f32(qz) + qy * qy) + qx * qx <= rsq:
            return HIT
    return result


def crossed(wf: Array, vertices: list[Any], x: float, y: float, z: float) -> tuple[float, ...] | None:
    """Return the in-plane normal of the first edge that a point is outside of, as FE-3...FE-5 are written."""
    nx, ny, nz = wf[:3].tolist()
    for prev, cur in edges(vertices):
        ex, ey, ez = f32(cur[0] - prev[0]), f32(cur[1] - prev[1]), cur[2] - prev[2]
        cz = ey * nx - ex * ny
        cy = ex * nz - f32(ez) * nx
        cx = ez * ny - ey * nz
        if ((z - prev[2]) * cz + (y - prev[1]) * cy) + (x - prev[0]) * cx < 0.0:
            gx, gy, gz = f32(f32(ez) * ny - ey * nz), f32(cy), f32(cz)
            inv = 1.0 / math.sqrt((gx * gx + gy * gy) + gz * gz)
            return f32(inv * gx), f32(inv * gy), f32(inv * gz)
    return None


@settings(deadline=None)
@given(corners, points)
def test_a_point_is_inside_as_if_nothing_were_precomputed(vertices: list[Any], point: Any) -> None:
    """Of polygons of any kind, degenerate ones too."""
    wf = record(vertices)
    assert polygon_point_in_polygon(wf, 0, *point) == inside(wf, vertices, *point)


@settings(max_examples=300, deadline=None)
@given(corners, points, st.floats(0.125, 4.0, width=32))
def test_a_sphere_hits_as_if_nothing_were_precomputed(vertices: list[Any], center: Any, r: float) -> None:
    """The precomputed normals and squared lengths decide each comparison as the formulas do."""
    wf = record(vertices)
    code, qx, qy, qz = polygon_hits_sphere(wf, 0, (*center, r))
    if code == BEYOND:
        return
    nx, ny, nz, d = wf[:4].tolist()
    dist = ((ny * center[1] + nz * center[2]) + nx * center[0]) + d
    reach = r - 0.00019999999494757503
    assert code == disc(wf, vertices, qx, qy, qz, f32(reach * reach - dist * dist))


@settings(deadline=None)
@given(st.lists(st.tuples(coordinates, coordinates), min_size=3, max_size=5), points)
def test_the_crossed_edge_is_the_same_as_if_nothing_were_precomputed(flat: list[Any], point: Any) -> None:
    """On a floor, where the point is projected straight down: the edge's normal bit for bit."""
    vertices = [(x, y, 0.0) for x, y in flat]
    wf = record(vertices)
    if abs(wf[2]) != 1.0:
        return
    found, *normal = polygon_find_crossed_edge(wf, 0, point, (0.0, 0.0, 1.0))
    expected = crossed(wf, vertices, point[0], point[1], 0.0)
    assert (tuple(normal) if found else None) == expected


def test_corners_are_the_vertices_in_order() -> None:
    """Behind the numbers that every record begins with."""
    wf = record([(0, 0, 0), (2, 0, 0), (0, 3, 0)])
    places = wf[POLYGON_CORNERS:][: 3 * CORNER_SIZE].reshape(3, CORNER_SIZE)
    assert places.tolist() == [[0, 0, 0], [2, 0, 0], [0, 3, 0]]


def test_sides_are_the_vertices_and_normals_of_the_edges_side_by_side() -> None:
    """With the normals' squared lengths; the last block of a triangle ends with an edge that is nowhere."""
    wf = record([(0, 0, 0), (2, 0, 0), (0, 3, 0)])
    block = wf[POLYGON_SIDES:][:SIDES_SIZE].reshape(-1, SIDES)
    assert block[:3].T.tolist() == [[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 0]]
    assert block[3:6].T.tolist() == [[0, 2, 0], [-3, -2, 0], [3, 0, 0], [0, 0, 0]]
    assert block[6].tolist() == [4, 13, 9, 0]


def test_a_polygon_of_five_has_two_blocks_of_sides() -> None:
    """A point outside of its last edge only is outside."""
    wf = record([(0, 0, 0), (2, 0, 0), (3, 1, 0), (2, 2, 0), (0, 2, 0)])
    assert polygon_point_in_polygon(wf, 0, 0.25, 1.0, 0.0)
    assert not polygon_point_in_polygon(wf, 0, -0.25, 1.0, 0.0)
