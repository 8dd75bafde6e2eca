"""Numbers: on a grid, so that they shrink to round ones, or anywhere."""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, Final, TypeVar

from hypothesis import strategies as st

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.model import Vec3

T = TypeVar("T")

_GRID: Final = 64
"""Steps per unit of a grid number: exact in float32, and shrinks to whole units."""
EPS: Final = 0.00019999999494757503
"""Retail's F_EPSILON, float32 of 0.0002; metres or a pure number (01, NM-8)."""
_DENORMAL: Final = 1e-42
_LEAST_DIRECTION: Final = 0.1
"""Shortest vector that is made a direction: shorter ones lose what was drawn."""

FLAGS: Final = st.sampled_from((0, 1))
NEARLY: Final = st.sampled_from((0.0, EPS, -EPS, 2 * EPS, -2 * EPS, 1e-6, -1e-6, 1e-4, -1e-4, _DENORMAL))
"""Offsets from a threshold at which retail's comparisons turn over."""


@cache
def below(count: int) -> st.SearchStrategy[int]:
    """Whole numbers from 0 to `count` - 1."""
    return st.integers(0, count - 1)


def pick(draw: st.DrawFn, items: Sequence[T]) -> T:
    """Draw one of a few items that are not known beforehand; it shrinks to the first."""
    return items[draw(below(len(items)))]


@cache
def grid(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers in steps of 1/64."""
    return st.integers(math.ceil(low * _GRID), math.floor(high * _GRID)).map(lambda i: i / _GRID)


@cache
def anywhere(low: float, high: float) -> st.SearchStrategy[float]:
    """Any float32 of a range, or a grid number."""
    return grid(low, high) | st.floats(low, high, width=32, allow_subnormal=False)


@cache
def vectors(size: float) -> st.SearchStrategy[Vec3]:
    """Vectors with components up to `size`."""
    part = anywhere(-size, size)
    return st.tuples(part, part, part)


def unit(v: Vec3) -> Vec3:
    """Return a vector at length 1, float64; zero stays zero."""
    size = math.hypot(*v)
    return v if size == 0.0 else (v[0] / size, v[1] / size, v[2] / size)


def along(point: Vec3, direction: Vec3, distance: float) -> Vec3:
    """Return the point moved along a direction."""
    return (
        point[0] + direction[0] * distance,
        point[1] + direction[1] * distance,
        point[2] + direction[2] * distance,
    )


_AXES: Final = ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0))
DIRECTIONS: Final = st.sampled_from(_AXES) | vectors(1.0).filter(
    lambda v: math.hypot(*v) > _LEAST_DIRECTION
).map(unit)
"""Unit vectors: the axes first, then any."""
