"""The number model: the only place that knows how retail's numbers behave.

Retail runs x87 code at 53-bit precision (NM-1, NM-2). A value in a register is an IEEE double (a
plain Python float here); every store to memory rounds once to float32 (NM-3). So a port writes
ordinary arithmetic and calls `f32` at each store.

The port also runs on other number types. Such a type carries its own arithmetic, mixed with floats
too, and says with ``stored()`` and ``sqrt()`` what a store and a square root mean in its model, with
``divided_by(divisor)`` and ``dividing(float)`` what a division does whose divisor may be zero, with
``power(exponent)`` and ``raising(float)`` what a power is, and with ``is_nan()``, ``sin()``, ``atan2(x)`` …
the rest of the functions below.
"""

from __future__ import annotations

import math
from array import array
from typing import Final

from oracle.errors import UndeterminedError

_slot: Final = array("f", (0.0,))


def f32(x: float) -> float:
    """Round to float32 once, nearest-even: a store to a 4-byte memory cell (NM-3).

    Under the interpreter lock the store and the load below cannot be separated (threads switch only
    at calls and loops); the oracle is otherwise not meant to be shared between threads.
    """
    if x.__class__ is float:
        _slot[0] = x
        return _slot[0]
    return _stored(x)


def _stored(x: float) -> float:
    if isinstance(x, int):
        return f32(float(x))
    stored: float = x.stored()  # type: ignore[attr-defined]
    return stored


def sqrt(x: float) -> float:
    """Square root in a register; NaN for a negative number, as the masked x87 gives (NM-9a)."""
    if x.__class__ is float:
        return math.sqrt(x) if x >= 0.0 else math.nan
    root: float = x.sqrt()  # type: ignore[attr-defined]
    return root


def divide(a: float, b: float) -> float:
    """Divide in a register where the divisor can be zero: infinity or NaN, never an error (NM-9a)."""
    if a.__class__ is not float:
        quotient: float = a.divided_by(b)  # type: ignore[attr-defined]
        return quotient
    if b.__class__ is not float:
        inverse: float = b.dividing(a)  # type: ignore[attr-defined]
        return inverse
    if b != 0.0:
        return a / b
    if a == 0.0 or math.isnan(a):
        return math.nan
    return math.copysign(math.inf, a) * math.copysign(1.0, b)


def floor(x: float) -> int:
    """Largest whole number not above `x`; other number types answer with ``__floor__``.

    Raises
    ------
    UndeterminedError
        If there is none: what retail's conversion makes of infinity and NaN is not specified (NM-9).
    """
    if x.__class__ is float and not math.isfinite(x):
        raise UndeterminedError(f"{x} as a whole number (NM-9)")
    return math.floor(x)


def ceil(x: float) -> int:
    """Smallest whole number not below `x`; other number types answer with ``__ceil__``.

    Raises
    ------
    UndeterminedError
        If there is none, as `floor` does.
    """
    if x.__class__ is float and not math.isfinite(x):
        raise UndeterminedError(f"{x} as a whole number (NM-9)")
    return math.ceil(x)


def is_nan(x: float) -> bool:
    """Tell whether a value is not a number."""
    if x.__class__ is float:
        return math.isnan(x)
    answer: bool = x.is_nan()  # type: ignore[attr-defined]
    return answer


# The C runtime's double functions, without errors (NM-9a); the last bit is the host library's (01, U7).


def sin(x: float) -> float:
    """Sine of an angle in radians, in a register."""
    if x.__class__ is float:
        return math.nan if math.isinf(x) else math.sin(x)
    value: float = x.sin()  # type: ignore[attr-defined]
    return value


def cos(x: float) -> float:
    """Cosine of an angle in radians, in a register."""
    if x.__class__ is float:
        return math.nan if math.isinf(x) else math.cos(x)
    value: float = x.cos()  # type: ignore[attr-defined]
    return value


def asin(x: float) -> float:
    """Arc sine in radians, in a register; the argument is within [-1, 1]."""
    if x.__class__ is float:
        return math.asin(x)
    value: float = x.asin()  # type: ignore[attr-defined]
    return value


def acos(x: float) -> float:
    """Arc cosine in radians, in a register; the argument is within [-1, 1]."""
    if x.__class__ is float:
        return math.acos(x)
    value: float = x.acos()  # type: ignore[attr-defined]
    return value


def atan2(y: float, x: float) -> float:
    """Angle of the point (x, y) in radians, in a register."""
    if y.__class__ is float and x.__class__ is float:
        return math.atan2(y, x)
    value: float = y.atan2(x)  # type: ignore[attr-defined]
    return value


def fmod(a: float, b: float) -> float:
    """Remainder of a division, with the sign of `a`, in a register."""
    if a.__class__ is float:
        return math.nan if math.isinf(a) or b == 0.0 else math.fmod(a, b)
    value: float = a.fmod(b)  # type: ignore[attr-defined]
    return value


def power(x: float, y: float) -> float:
    """Return `x` to the power of `y`, a time that is not negative, in a register; NaN where C gives NaN."""
    if x.__class__ is float and y.__class__ is float:
        try:
            return math.pow(x, y)
        except ValueError:  # NM-9a
            return math.inf if x == 0.0 else math.nan
    if x.__class__ is float:
        raised: float = y.raising(x)  # type: ignore[attr-defined]
        return raised
    value: float = x.power(y)  # type: ignore[attr-defined]
    return value
