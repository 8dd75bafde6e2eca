"""The store to float32: bit for bit NumPy's, over the whole range."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.kernels.rounding import f32


def bits(x: float) -> int:
    """Return the float64 bits of a number."""
    return int(struct.unpack("<Q", struct.pack("<d", x))[0])


@pytest.mark.parametrize(
    ("exact", "stored"),
    [
        (0.0, 0.0),
        (-0.0, -0.0),
        (0.1, 0.10000000149011612),
        (0.0002, 0.00019999999494757503),
        (1.0 + 2.0**-24, 1.0),
        (1.0 + 3.0 * 2.0**-24, 1.0 + 2.0**-22),
        (1.0 + 2.0**-24 + 2.0**-52, 1.0 + 2.0**-23),
        (2.0**-149, 2.0**-149),
        (2.0**-150, 0.0),
        (-(2.0**-150), -0.0),
        (2.0**-150 + 2.0**-180, 2.0**-149),
        (3.0 * 2.0**-150, 2.0**-148),
        (float(np.finfo(np.float32).max), float(np.finfo(np.float32).max)),
        (float(np.finfo(np.float32).max) + 2.0**102, float(np.finfo(np.float32).max)),
        (float(np.finfo(np.float32).max) + 2.0**103, np.inf),
        (-1e300, -np.inf),
        (np.inf, np.inf),
    ],
)
def test_ties_denormals_and_overflow(exact: float, stored: float) -> None:
    """Nearest-even everywhere, gradual underflow, infinity beyond the largest float32."""
    assert bits(f32(exact)) == bits(stored)


def test_nan_stays_nan() -> None:
    """A NaN is stored as one."""
    assert np.isnan(f32(np.nan))


@settings(deadline=None)  # the first call compiles
@given(st.floats(allow_nan=False))
def test_equals_numpy(x: float) -> None:
    """The compiled conversion is NumPy's."""
    with np.errstate(over="ignore"):
        assert bits(f32(x)) == bits(float(np.float32(x)))


@settings(deadline=None)  # the first call compiles
@given(st.floats(allow_nan=False, width=32))
def test_a_float32_is_stored_exactly(x: float) -> None:
    """Storing what was loaded changes nothing."""
    assert bits(f32(x)) == bits(x)
