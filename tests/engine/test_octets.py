"""Integers read by the byte: compiled and interpreted."""

from __future__ import annotations

import numpy as np
import pytest

from engine.kernels.octets import octet
from engine.tracing_interpreter import Interpreter

NUMBERS = np.array([0x0807060504030201, -1, 0x10], dtype=np.int64)
BYTES = [1, 2, 3, 4, 5, 6, 7, 8, *[255] * 8, 16, *[0] * 7]


@pytest.mark.parametrize("place", range(len(BYTES)))
def test_the_lowest_byte_comes_first(place: int) -> None:
    """And none has a sign."""
    assert octet(NUMBERS, place) == Interpreter({}).function(octet)(NUMBERS, place) == BYTES[place]
