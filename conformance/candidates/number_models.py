"""Number types that the oracle also runs on, and that are not retail's.

A type carries its own arithmetic, as `oracle.arithmetic` describes.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

from oracle import arithmetic
from oracle.arithmetic import f32

if TYPE_CHECKING:
    from conformance.query import Fields

Number: TypeAlias = "Single | float"
"""What mixes with a `Single`: a plain number is rounded first, as a literal is."""


class Single:
    """A number that is float32 also in registers: every operation rounds.

    A sum, product, quotient or root of two float32s that is rounded to double first and then to float32
    is the float32 result, so nothing here is rounded differently than by float32 hardware.
    """

    __slots__ = ("value",)

    def __init__(self, x: Number) -> None:
        self.value = f32(_raw(x))

    def __repr__(self) -> str:
        return f"Single({self.value!r})"

    def stored(self) -> Single:
        """Store to memory: nothing is left to round."""
        return self

    def sqrt(self) -> Single:
        """Return the square root."""
        return Single(arithmetic.sqrt(self.value))

    def divided_by(self, other: Number) -> Single:
        """Divide by a number that may be zero."""
        return Single(arithmetic.divide(self.value, f32(_raw(other))))

    def dividing(self, other: float) -> Single:
        """Divide a number by this, which may be zero."""
        return Single(arithmetic.divide(f32(other), self.value))

    def is_nan(self) -> bool:
        """Tell whether this is not a number."""
        return math.isnan(self.value)

    def sin(self) -> Single:
        """Return the sine of an angle in radians."""
        return Single(math.sin(self.value))

    def cos(self) -> Single:
        """Return the cosine of an angle in radians."""
        return Single(math.cos(self.value))

    def asin(self) -> Single:
        """Return the arc sine in radians."""
        return Single(math.asin(self.value))

    def acos(self) -> Single:
        """Return the arc cosine in radians."""
        return Single(math.acos(self.value))

    def atan2(self, x: Number) -> Single:
        """Return the angle of the point (x, self) in radians."""
        return Single(math.atan2(self.value, f32(_raw(x))))

    def fmod(self, b: Number) -> Single:
        """Return the remainder of a division, with the sign of this."""
        return Single(math.fmod(self.value, f32(_raw(b))))

    def power(self, y: Number) -> Single:
        """Return this to the power of a time that is not negative."""
        return Single(arithmetic.power(self.value, f32(_raw(y))))

    def __add__(self, other: Number) -> Single:
        return Single(self.value + f32(_raw(other)))

    __radd__ = __add__

    def __sub__(self, other: Number) -> Single:
        return Single(self.value - f32(_raw(other)))

    def __rsub__(self, other: float) -> Single:
        return Single(f32(other) - self.value)

    def __mul__(self, other: Number) -> Single:
        return Single(self.value * f32(_raw(other)))

    __rmul__ = __mul__

    def __truediv__(self, other: Number) -> Single:
        return Single(self.value / f32(_raw(other)))

    def __rtruediv__(self, other: float) -> Single:
        return Single(f32(other) / self.value)

    def __neg__(self) -> Single:
        return Single(-self.value)

    def __abs__(self) -> Single:
        return Single(abs(self.value))

    def __floor__(self) -> int:
        return math.floor(self.value)

    def __ceil__(self) -> int:
        return math.ceil(self.value)

    def __lt__(self, other: Number) -> bool:
        return self.value < f32(_raw(other))

    def __le__(self, other: Number) -> bool:
        return self.value <= f32(_raw(other))

    def __gt__(self, other: Number) -> bool:
        return self.value > f32(_raw(other))

    def __ge__(self, other: Number) -> bool:
        return self.value >= f32(_raw(other))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Single | float | int) and self.value == f32(_raw(other))

    def __hash__(self) -> int:
        return hash(self.value)


def plain(fields: Fields) -> Fields:
    """Return an answer with every `Single` as a Python float."""
    return {name: _plain(value) for name, value in fields.items()}


def _plain(value: Any) -> Any:
    if isinstance(value, Single):
        return value.value
    if isinstance(value, dict):
        return plain(value)
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return value


def _raw(x: Number) -> float:
    return x.value if isinstance(x, Single) else x
