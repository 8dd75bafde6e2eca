"""Bits, decimals and distances of float32 and float64 values."""

from __future__ import annotations

import math
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from conformance.floats import (
    bits32,
    bits64,
    decimal32,
    is_float32,
    next_float32,
    shortest32,
    to_float32,
    ulps32,
    ulps64,
)

FLOAT32 = st.floats(width=32)


def from_bits(bits: int) -> float:
    """Return the float32 of a bit pattern."""
    return float(struct.unpack("<f", struct.pack("<I", bits))[0])


@pytest.mark.parametrize(
    ("value", "bits"),
    [
        (-94.0, 0xC2BC0000),
        (0.0, 0x00000000),
        (-0.0, 0x80000000),
        (0.1, 0x3DCCCCCD),
        (1.0 + 2.0**-24, 0x3F800000),  # a tie goes to the even neighbour
        (1.0 + 3 * 2.0**-24, 0x3F800002),
        (1e-46, 0x00000000),
        (1e-45, 0x00000001),
        (1e39, 0x7F800000),
        (-1e300, 0xFF800000),
        (3.4028235677973366e38, 0x7F800000),  # halfway to the next power rounds to infinity
        (math.inf, 0x7F800000),
    ],
)
def test_rounding_and_bits(value: float, bits: int) -> None:
    """Rounding to float32 is nearest-even, denormals are kept, what is too large is infinite."""
    assert bits32(to_float32(value)) == bits
    assert bits32(value) == bits


def test_bits64() -> None:
    """The bits of a float64 are all there."""
    assert bits64(-0.0) == 0x8000000000000000
    assert bits64(0.1) == 0x3FB999999999999A


@pytest.mark.parametrize(
    ("a", "b", "ulps"),
    [
        (1.0, 1.0, 0),
        (0.0, -0.0, 0),
        (1.0, 1.0000001192092896, 1),
        (1e-45, -1e-45, 2),
        (-94.0, 0.0, 0x42BC0000),
        (3.4028234663852886e38, math.inf, 1),
        (math.nan, 1.0, None),
    ],
)
def test_ulps32(a: float, b: float, ulps: int | None) -> None:
    """Steps are counted through zero and up to infinity; NaN has no distance."""
    assert ulps32(a, b) == ulps
    assert ulps32(b, a) == ulps


def test_ulps64() -> None:
    """A float64 step is one step."""
    assert ulps64(0.1, math.nextafter(0.1, 1.0)) == 1
    assert ulps64(0.1, math.nan) is None


@given(FLOAT32.filter(math.isfinite))
def test_next_float32_is_one_step(value: float) -> None:
    """The next float32 is one ULP away and larger, except that -0 and 0 are one point."""
    following = next_float32(value)
    assert following > value
    assert ulps32(value, following) == 1


@given(FLOAT32.filter(lambda value: not math.isnan(value)))
def test_shortest_decimal_reads_back(value: float) -> None:
    """The short decimal rounds to the same bits, sign of zero included."""
    assert bits32(float(decimal32(value))) == bits32(value)
    assert bits32(shortest32(value)) == bits32(value)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_shortest_decimals_of_powers_of_two(sign: float) -> None:
    """Above one float32s are twice as far apart as below: NumPy's search knows that, too."""
    for value in (sign * 2.0**exponent for exponent in range(-149, 128)):
        assert shortest32(value) == float(str(np.float32(value)))


@pytest.mark.parametrize(
    ("bits", "text"),
    [
        (0x3EF5C28F, "0.48"),
        (0xC2BC0000, "-94.0"),
        (0x3951B717, "0.0002"),
        (0x80000000, "-0.0"),
        (0x00000001, "1e-45"),
        (0x7F7FFFFF, "3.4028235e+38"),
        (0x7F800000, "inf"),
        (0x7FC00000, "nan"),
    ],
)
def test_decimal32(bits: int, text: str) -> None:
    """Decimals are as short as float32 allows and always look like a float."""
    assert decimal32(from_bits(bits)) == text


def test_is_float32() -> None:
    """A float64 that a float32 cannot hold is told apart."""
    assert is_float32(0.5)
    assert is_float32(math.nan)
    assert is_float32(math.inf)
    assert not is_float32(0.1)
