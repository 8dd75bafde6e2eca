"""Numbers within a limit: all of them, the limit itself included."""

from __future__ import annotations

import math

import numpy as np
import pytest

from engine.kernels.within import all_within


@pytest.mark.parametrize("count", [0, 1, 7, 64, 1001])
def test_the_limit_is_within(count: int) -> None:
    """On both sides of 0; nothing is, too."""
    numbers = np.full(count, 2.5)
    assert all_within(numbers, 2.5)
    assert all_within(-numbers, 2.5)


@pytest.mark.parametrize(
    "strange", [math.nextafter(2.5, 3.0), -math.nextafter(2.5, 3.0), math.inf, -math.inf, math.nan]
)
def test_one_beyond_is_found_wherever_it_is(strange: float) -> None:
    """However many are compared at a time, and in what is left over."""
    for place in range(67):
        numbers = np.zeros(67)
        numbers[place] = strange
        assert not all_within(numbers, 2.5)
