"""Checks of polygons: what retail's polygon code takes for granted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.scenes.algebra import cross, dot, length, scale, subtract
from conformance.scenes.errors import SceneError, join_path
from conformance.scenes.planes import area_vector
from conformance.scenes.validate_numbers import number_errors, show
from oracle.constants import EPS

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from conformance.scenes.model import Vec3

PLANARITY: Final = EPS
"""How far a corner may be off its polygon's plane, metres: where retail begins to tell a point from a
plane. Game data are off by up to 6e-5."""
CONVEXITY: Final = EPS
"""How far a corner may be outside an edge of its polygon, metres; for the same reason."""
SMALLEST_AREA: Final = 1e-8
"""Square metres, a tenth of a millimetre squared: below it a float32 plane says nothing."""
MOST_CORNERS: Final = 255
"""A polygon's corners are counted in a byte (02, 0)."""


def polygon_errors(corners: Sequence[Vec3], path: str) -> Iterator[SceneError]:
    """Yield what is wrong with a polygon given by its corner points.

    Parameters
    ----------
    corners : sequence of Vec3
        Metres.
    path : str
        Of the polygon.

    Yields
    ------
    SceneError
        Fewer than 3 corners, a corner that is not finite or that occurs twice, no area, a corner off
        the plane, a polygon that is not convex. A polygon with one of the first is not looked at further.
    """
    if not 3 <= len(corners) <= MOST_CORNERS:
        yield SceneError(path, f"{len(corners)} corners", f"3 to {MOST_CORNERS} corners")
        return
    basic = [*_corner_errors(corners, path), *_repeated(corners, path)]
    if basic:
        yield from basic
    elif (area := length(area_vector(corners))) < SMALLEST_AREA:
        yield SceneError(path, f"an area of {area:.3g} square metres", f"at least {SMALLEST_AREA:g}")
    else:
        yield from _uneven(corners, path)


def shape_errors(shape: Sequence[Sequence[Vec3]], path: str) -> Iterator[SceneError]:
    """Yield what is wrong with the polygons of a shape; their paths end in ``polygons[i]``."""
    for i, corners in enumerate(shape):
        yield from polygon_errors(corners, join_path(path, f"polygons[{i}]"))


def _corner_errors(corners: Sequence[Vec3], path: str) -> Iterator[SceneError]:
    for k, corner in enumerate(corners):
        yield from number_errors(corner, f"{path}.corners[{k}]")


def _repeated(corners: Sequence[Vec3], path: str) -> Iterator[SceneError]:
    first: dict[Vec3, int] = {}
    for k, corner in enumerate(corners):
        if corner in first:
            found = f"corners {first[corner]} and {k} both at {show(corner)}"
            yield SceneError(path, found, "each corner once (the last edge closes the polygon)")
        first.setdefault(corner, k)


def _uneven(corners: Sequence[Vec3], path: str) -> Iterator[SceneError]:
    """Yield corners off the mean plane, and corners outside an edge, the worst of each."""
    vector = area_vector(corners)
    normal = scale(1.0 / length(vector), vector)
    heights = [dot(normal, corner) for corner in corners]
    mean = sum(heights) / len(heights)
    k, height = max(enumerate(heights), key=lambda item: abs(item[1] - mean))
    if abs(height - mean) > PLANARITY:
        found = f"corner {k} {abs(height - mean):.6g} m off the polygon's plane"
        yield SceneError(path, found, f"a flat polygon, within {PLANARITY:g} m")
        return
    outside, edge, k = max(_overhangs(corners, normal))
    if outside > CONVEXITY:
        start = (edge - 1) % len(corners)
        found = f"corner {k} {outside:.6g} m outside the edge from corner {start} to corner {edge}"
        yield SceneError(path, found, f"a convex polygon, within {CONVEXITY:g} m")


def _overhangs(corners: Sequence[Vec3], normal: Vec3) -> Iterator[tuple[float, int, int]]:
    """Yield how far each corner is outside each edge: metres, the edge's end, the corner."""
    for edge, end in enumerate(corners):
        start = corners[edge - 1]
        along = subtract(end, start)
        inward = scale(1.0 / length(along), cross(normal, along))
        for k, corner in enumerate(corners):
            yield -dot(inward, subtract(corner, start)), edge, k
