"""Helpers shared by the oracle's tests."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable


def _next32(x: float, steps: int = 1) -> float:
    bits = struct.unpack("<i", struct.pack("<f", x))[0]
    ordered = bits if bits >= 0 else -(bits & 0x7FFFFFFF)
    ordered += steps
    bits = ordered if ordered >= 0 else (-ordered) | -0x80000000
    value: float = struct.unpack("<f", struct.pack("<i", bits))[0]
    return value


@pytest.fixture(scope="session")
def next32() -> Callable[[float, int], float]:
    """Return the function that steps along the float32 numbers (towards plus infinity)."""
    return _next32


@pytest.fixture(scope="session")
def bits() -> Callable[[float], int]:
    """Return the function that gives the 32 bits of a float32 number."""

    def float_bits(x: float) -> int:
        value: int = struct.unpack("<I", struct.pack("<f", x))[0]
        return value

    return float_bits
