"""Shapes: polygons given by their corner points, before they become a geometry."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING, TypeAlias

from conformance.scenes.algebra import cos_sin, round_point
from conformance.scenes.model import Polygon, Vec3

if TYPE_CHECKING:
    from collections.abc import Sequence

Corners: TypeAlias = tuple[Vec3, ...]
"""Corner points of one polygon in metres, counter-clockwise seen from its front."""
Shape: TypeAlias = list[Corners]
"""Polygons in one frame; shapes are put together with ``+``."""


def place(shape: Shape, at: Vec3, yaw: float) -> Shape:
    """Turn a shape about the z axis, then move it.

    Parameters
    ----------
    shape : Shape
        Metres.
    at : Vec3
        Where the shape's origin goes, metres.
    yaw : float
        Degrees, counter-clockwise seen from above; multiples of 90 are exact.

    Returns
    -------
    Shape
        The placed polygons, in float64: rounding to float32 happens once, in `merge`.
    """
    c, s = cos_sin(yaw)
    x0, y0, z0 = at

    def moved(x: float, y: float, z: float) -> Vec3:
        # The added zero turns -0 into 0, so that a turned corner still meets its unturned neighbour.
        return (c * x - s * y + x0 + 0.0, s * x + c * y + y0 + 0.0, z + z0 + 0.0)

    return [tuple(moved(*corner) for corner in corners) for corners in shape]


def flip(shape: Shape) -> Shape:
    """Turn every polygon to face the other way: a solid object becomes a hollow, and back."""
    return [corners[::-1] for corners in shape]


def round_shape(shape: Sequence[Sequence[Vec3]]) -> Shape:
    """Round every corner to float32."""
    return [tuple(round_point(corner) for corner in corners) for corners in shape]


def merge(shape: Sequence[Sequence[Vec3]]) -> tuple[tuple[Vec3, ...], tuple[Polygon, ...]]:
    """Turn corner points into shared vertices and polygons by vertex index.

    Parameters
    ----------
    shape : sequence of sequences of Vec3
        Metres; rounded to float32 here.

    Returns
    -------
    vertices : tuple of Vec3
        Each float32 bit pattern once (so -0 and 0 stay apart), in order of first use.
    polygons : tuple of Polygon
        In the order given: a polygon's id is its index.
    """
    index: dict[bytes, int] = {}
    vertices: list[Vec3] = []
    polygons: list[Polygon] = []
    for corners in round_shape(shape):
        ids = []
        for corner in corners:
            key = array("f", corner).tobytes()
            if key not in index:
                index[key] = len(vertices)
                vertices.append(corner)
            ids.append(index[key])
        polygons.append(Polygon(tuple(ids)))
    return tuple(vertices), tuple(polygons)
