"""Float32 and float64 values as bits, decimals and distances in units of the last place."""

from __future__ import annotations

import math
import struct
from array import array
from decimal import Decimal
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

_LARGEST_FLOAT32: Final = 3.4028234663852886e38
_SIGN32: Final = 0x8000_0000
_SIGN64: Final = 0x8000_0000_0000_0000
_FLOAT32_DIGITS: Final = 9
"""Significant decimal digits that always suffice to read a float32 back (IEEE 754-2019, 5.12.2)."""


def to_float32(value: float) -> float:
    """Round to the nearest float32, ties to even; too large becomes infinity."""
    return array("f", (value,))[0]


def is_float32(value: float) -> bool:
    """Tell whether a float32 holds `value` exactly; NaN and the infinities are float32 values."""
    return math.isnan(value) or to_float32(value) == value


def bits32(value: float) -> int:
    """Return the 32 bits of `value` rounded to float32."""
    bits: int = struct.unpack("<I", struct.pack("<f", _in_range(value)))[0]
    return bits


def bits64(value: float) -> int:
    """Return the 64 bits of a float64."""
    bits: int = struct.unpack("<Q", struct.pack("<d", value))[0]
    return bits


def ulps32(a: float, b: float) -> int | None:
    """Count the float32 steps between two values; both zeros are one step's start, NaN has no distance."""
    if math.isnan(a) or math.isnan(b):
        return None
    return abs(_rank(bits32(a), _SIGN32) - _rank(bits32(b), _SIGN32))


def ulps64(a: float, b: float) -> int | None:
    """Count the float64 steps between two values; see `ulps32`."""
    if math.isnan(a) or math.isnan(b):
        return None
    return abs(_rank(bits64(a), _SIGN64) - _rank(bits64(b), _SIGN64))


def next_float32(value: float) -> float:
    """Return the float32 one step up; from the largest, infinity."""
    rank = _rank(bits32(value), _SIGN32) + 1
    bits = rank if rank >= 0 else _SIGN32 - rank
    return float(struct.unpack("<f", struct.pack("<I", bits))[0])


def decimal32(value: float) -> str:
    """Write the shortest decimal that reads back as the same float32, always with a point or exponent."""
    return repr(shortest32(value))


def shortest32(value: float) -> float:
    """Return the float64 whose shortest decimal is the shortest decimal of the float32 `value`.

    JSON and YAML writers print the shortest float64 decimal, so this is how a float32 is written short.
    """
    rounded = to_float32(value)
    if not math.isfinite(rounded):
        return rounded
    for digits in range(1, _FLOAT32_DIGITS):
        for short in _decimals(rounded, digits):
            if to_float32(short) == rounded:
                return short
    return float(f"{rounded:.{_FLOAT32_DIGITS}g}")


def _decimals(value: float, digits: int) -> Iterator[float]:
    """Yield the nearest decimal of so many digits, and the next one away from zero.

    That one may be meant where the nearest is not: above a power of two float32s are twice as far apart.
    """
    nearest = Decimal(f"{value:.{digits - 1}e}")
    yield float(nearest)
    yield float(nearest + Decimal((0, (1,), int(nearest.as_tuple().exponent))).copy_sign(nearest))


def _rank(bits: int, sign: int) -> int:
    return bits if bits < sign else sign - bits


def _in_range(value: float) -> float:
    if abs(value) <= _LARGEST_FLOAT32 or not math.isfinite(value):
        return value
    return to_float32(value)
