"""Stepping from float32 to float32, and finding where a decision turns."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from conformance.stress.steps import at_rank, rank, stepped, turning_point

FLOATS = st.floats(width=32, allow_nan=False, allow_infinity=False)


@given(FLOATS)
def test_a_place_and_back_is_the_same_number(value: float) -> None:
    """Every float32 has one place; -0 shares that of 0."""
    assert at_rank(rank(value)) == value


@given(FLOATS)
def test_one_step_is_nextafter(value: float) -> None:
    """Up and down."""
    single = np.float32(value)
    with np.errstate(over="ignore"):
        assert stepped(value, 1) == np.nextafter(single, np.float32(math.inf))
        assert stepped(value, -1) == np.nextafter(single, np.float32(-math.inf))


@given(FLOATS, FLOATS)
def test_places_are_in_the_order_of_the_numbers(a: float, b: float) -> None:
    """A larger number has a larger place."""
    assert (a < b) == (rank(a) < rank(b))


@given(FLOATS)
def test_the_turn_of_a_threshold_is_the_threshold(limit: float) -> None:
    """Between the two ends of all float32s, from either side."""
    low, high = -3.4028234663852886e38, 3.4028234663852886e38
    if low < limit:
        assert turning_point(low, high, lambda value: value >= limit) == limit
        assert turning_point(high, low, lambda value: value >= limit) == stepped(limit, -1)


def test_no_turn_is_an_error() -> None:
    """With both ends and the decision."""
    with pytest.raises(ValueError, match=r"no turn between 1\.0 and 2\.0: the decision is True at both"):
        turning_point(1.0, 2.0, lambda _: True)
