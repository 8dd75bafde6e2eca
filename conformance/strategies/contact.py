"""Aim: a place near a polygon at which a sphere touches it, nearly touches it, or overlaps it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from hypothesis import strategies as st

from conformance.strategies.numbers import NEARLY, along, anywhere, below
from conformance.strategies.scenes import face

if TYPE_CHECKING:
    from conformance.scenes.model import Geometry, Vec3


@dataclass(frozen=True, slots=True)
class Aim:
    """A sphere near a polygon, in the geometry's frame and scale.

    Attributes
    ----------
    polygon : int
        Index of the polygon aimed at.
    normal : Vec3
        Its unit normal, float64.
    center : Vec3
        Centre of the sphere, float64.
    distance : float
        Of the centre from the polygon's plane, positive in front.
    """

    polygon: int
    normal: Vec3
    center: Vec3
    distance: float


_DISTANCES: Final = st.one_of(
    st.tuples(anywhere(0.0, 1.0), st.just(0.0)),
    st.tuples(st.just(1.0), NEARLY),
    st.tuples(anywhere(0.0, 1.0), st.just(0.0)),
    st.tuples(anywhere(-1.0, 0.0), st.just(0.0)),
    st.tuples(anywhere(1.0, 2.0), st.just(0.0)),
)
"""Distances from the plane as a multiple of the radius and an offset: overlapping, touching, behind, away."""

_WEIGHTS: Final = st.tuples(st.integers(0, 8), st.integers(0, 8), st.integers(0, 8)).filter(any)
_STRETCHES: Final = st.sampled_from((1.0, 1.0, 1.0, 1.0625, 1.25))
"""How far a point is moved out from the polygon's middle: mostly not at all."""


def draw_aim(draw: st.DrawFn, geometry: Geometry, radius: float, *, floors: bool = False) -> Aim:
    """Draw where a sphere of `radius` (in the geometry's scale) is put.

    With `floors`, at a polygon that faces up, if the geometry has one.
    """
    every = range(len(geometry.polygons))
    facing_up = [i for i in every if face(geometry, i)[0][2] > 0.0] if floors else []
    targets = facing_up or every
    polygon = targets[draw(below(len(targets)))]
    normal, corners = face(geometry, polygon)
    multiple, offset = draw(_DISTANCES)
    distance = radius * multiple + offset
    return Aim(polygon, normal, along(draw_point(draw, corners), normal, distance), distance)


def draw_point(draw: st.DrawFn, corners: list[Vec3]) -> Vec3:
    """Draw a point of a polygon, sometimes a little outside it: the weighted mean of three corners."""
    second = 1 + draw(below(len(corners) - 2))
    triangle = (corners[0], corners[second], corners[second + 1])
    weights = draw(_WEIGHTS)
    stretch = draw(_STRETCHES)
    return (
        _mean(triangle, weights, stretch, 0),
        _mean(triangle, weights, stretch, 1),
        _mean(triangle, weights, stretch, 2),
    )


def _mean(corners: tuple[Vec3, Vec3, Vec3], weights: tuple[int, ...], stretch: float, axis: int) -> float:
    values = [corner[axis] for corner in corners]
    mean = sum(w * v for w, v in zip(weights, values, strict=True)) / sum(weights)
    middle = sum(values) / 3.0
    return middle + (mean - middle) * stretch
