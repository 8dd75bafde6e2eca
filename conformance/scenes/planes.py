"""The plane of a polygon, as the builder and the checks see it.

It is Newell's plane in float64, rounded once; retail's own plane (``CPolygon::make_plane``) is
computed by each candidate and may differ in the last bits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance.floats import to_float32
from conformance.scenes.algebra import ORIGIN, add, cross, dot, length, round_point, scale, subtract

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.model import PlaneData, Vec3


def area_vector(corners: Sequence[Vec3]) -> Vec3:
    """Return the vector whose direction is a polygon's front and whose length is its area.

    Parameters
    ----------
    corners : sequence of Vec3
        Metres, counter-clockwise seen from the front.

    Returns
    -------
    Vec3
        Square metres; zero for a polygon without area. Summed about the first corner, so that a
        polygon far from the origin loses no digits.
    """
    first = corners[0]
    total = ORIGIN
    previous = subtract(corners[1], first)
    for corner in corners[2:]:
        current = subtract(corner, first)
        total = add(total, cross(previous, current))
        previous = current
    return scale(0.5, total)


def unit_normal(corners: Sequence[Vec3]) -> Vec3:
    """Return the float64 unit normal of a polygon that has an area."""
    vector = area_vector(corners)
    return scale(1.0 / length(vector), vector)


def plane_of(corners: Sequence[Vec3]) -> PlaneData:
    """Return the plane of a polygon: unit normal towards its front, and the mean offset, in float32.

    Parameters
    ----------
    corners : sequence of Vec3
        Metres; the polygon has an area.

    Returns
    -------
    PlaneData
        ``nx, ny, nz, d`` with ``n . p + d = 0``, float32, without negative zeros.
    """
    x, y, z = round_point(unit_normal(corners))
    offset = -sum(dot((x, y, z), corner) for corner in corners) / len(corners)
    return (x + 0.0, y + 0.0, z + 0.0, to_float32(offset) + 0.0)


def signed_distance(plane: PlaneData, point: Vec3) -> float:
    """Return how far a point is in front of a plane, metres."""
    return dot(plane[:3], point) + plane[3]
