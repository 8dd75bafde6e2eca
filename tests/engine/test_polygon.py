"""Spheres beside polygons: what is far outside of an edge is a MISS without a walk around the edges."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from engine import Leaf, Shape
from engine.kernels.polygon import polygon_hits_sphere_slow_but_sure
from engine.kernels.polygon_edges import BEYOND, HIT, MISS
from engine.layout import POLYGON_CONVEX

Floats = npt.NDArray[np.float64]

BOUNDS = (0.0, 0.0, 0.0, 9.0)
TRIANGLE = [(-1.0, -1.0, 0.25), (1.0, -1.0, 0.0), (0.0, 1.0, -0.5)]
SLIVER = [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 0.03125, 0.0)]
HEXAGON = [(2.0 * np.cos(a), 2.0 * np.sin(a), 0.5 * np.cos(a)) for a in np.arange(6) * np.pi / 3.0]
FAR_AWAY = [(x + 4096.0, y - 8192.0, z) for x, y, z in TRIANGLE]
DART = [(0.0, 0.0, 0.0), (2.0, 2.0, 0.0), (0.0, 1.0, 0.0), (-2.0, 2.0, 0.0)]
CONVEX = {"triangle": TRIANGLE, "sliver": SLIVER, "hexagon": HEXAGON, "far away": FAR_AWAY}


def record(corners: list[tuple[float, float, float]]) -> Floats:
    """Return the record of a polygon."""
    return Shape(corners, [tuple(range(len(corners)))], Leaf(BOUNDS, (0,))).polygon_floats


@pytest.mark.parametrize("name", CONVEX)
def test_convex_polygons_are_known_as_such(name: str) -> None:
    """In their record."""
    assert record(CONVEX[name])[POLYGON_CONVEX] == 1.0


@pytest.mark.parametrize("corners", [DART, TRIANGLE[:2], [TRIANGLE[0]] * 3], ids=["dart", "line", "point"])
def test_others_are_not(corners: list[tuple[float, float, float]]) -> None:
    """What is outside one edge of them may be near another; or there is no plane."""
    assert record(corners)[POLYGON_CONVEX] == 0.0


@settings(deadline=None, max_examples=400)
@given(
    st.sampled_from(sorted(CONVEX)),
    st.tuples(*[st.floats(-3.0, 3.0, width=32)] * 3),
    st.floats(0.0, 1.5, width=32),
)
@example("triangle", (0.0, -1.5, 0.0), 0.5)
@example("sliver", (-0.5, 0.0, 0.0), 0.5)
def test_the_answer_is_that_of_the_walk(name: str, place: tuple[float, float, float], radius: float) -> None:
    """The same code and the same point, whether the polygon is known to be convex or not."""
    floats = record(CONVEX[name])
    unknown = floats.copy()
    unknown[POLYGON_CONVEX] = 0.0
    center = np.float32(np.array(place) + CONVEX[name][0]).astype(np.float64).tolist()
    short = polygon_hits_sphere_slow_but_sure(floats, 0, (*center, radius))
    assert short == polygon_hits_sphere_slow_but_sure(unknown, 0, (*center, radius))
    assert short[0] in (BEYOND, MISS, HIT)


def test_the_walk_is_needed_where_a_polygon_is_not_convex() -> None:
    """Far outside the first edge of a dart, in the tip of its other arm: MISS, were it taken for convex."""
    floats = record(DART)
    center = (1.875, 1.875, 0.0)
    answers = []
    for convex in (0.0, 1.0):
        floats[POLYGON_CONVEX] = convex
        answers.append(polygon_hits_sphere_slow_but_sure(floats, 0, (*center, 0.25))[0])
    assert answers == [HIT, MISS]
