"""Medians, growth and dominance, on numbers whose results are known."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from conformance.bench.figures import Summary, growth_exponent, pareto, summarise

POSITIVE = st.floats(1e-3, 1e3)


def test_summary_of_known_values() -> None:
    """Median and quartiles of five numbers are three of them."""
    assert summarise([5.0, 1.0, 4.0, 2.0, 3.0]) == Summary(3.0, 2.0, 4.0)


def test_summary_of_one_value() -> None:
    """A single value has no spread."""
    assert summarise([7.5]) == Summary(7.5, 7.5, 7.5)
    assert summarise([7.5]).spread == 0.0


@given(st.lists(POSITIVE, min_size=2))
def test_summary_is_ordered(values: list[float]) -> None:
    """The quartiles lie about the median, and none beyond the values."""
    found = summarise(values)
    assert min(values) <= found.low <= found.middle <= found.high <= max(values)


@given(st.floats(-2.0, 2.0), POSITIVE)
def test_exponent_of_a_power_law(exponent: float, factor: float) -> None:
    """The exponent of exact powers is found again."""
    sizes = [1.0, 10.0, 100.0, 1000.0]
    costs = [factor * size**exponent for size in sizes]
    assert growth_exponent(sizes, costs) == pytest.approx(exponent, abs=1e-9)


@pytest.mark.parametrize(
    ("sizes", "costs"), [([2.0, 2.0], [1.0, 3.0]), ([6.0] * 3, [1.0, 1.1, 1.2]), ([1.0, 2.0], [0.0, 1.0])]
)
def test_exponent_needs_growth(sizes: list[float], costs: list[float]) -> None:
    """One size does not grow, and a power law has no zero."""
    with pytest.raises(ValueError, match=r"grow|positive"):
        growth_exponent(sizes, costs)


def test_pareto_of_known_points() -> None:
    """What is worse in one and not better in the other is left out; of equals the first stays."""
    points = [(3.0, 1.0), (1.0, 3.0), (2.0, 2.0), (2.0, 2.0), (2.0, 4.0), (4.0, 1.0)]
    assert pareto(points) == [1, 2, 0]


@given(st.lists(st.tuples(POSITIVE, POSITIVE), min_size=1))
def test_pareto_beats_everything(points: list[tuple[float, float]]) -> None:
    """Every point has one on the line that is as good in both, and the line falls."""
    line = [points[i] for i in pareto(points)]
    assert all(any(x <= a and y <= b for x, y in line) for a, b in points)
    assert all(b[0] > a[0] and b[1] < a[1] for a, b in itertools.pairwise(line))
