"""Number types that the oracle also runs on, and that are not retail's.

A type carries its own arithmetic, as `oracle.arithmetic` describes.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Self, TypeAlias

from oracle import arithmetic
from oracle.arithmetic import f32

if TYPE_CHECKING:
    from conformance.query import Fields

Number: TypeAlias = "Register | float"
"""What mixes with a `Register`: a plain number is rounded first, as a literal is."""


class Register:
    """A number with one precision, in registers and in memory alike; `rounded` is its subclasses'."""

    __slots__ = ("value",)

    def __init__(self, x: Number) -> None:
        self.value = self.rounded(_raw(x))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.value!r})"

    @staticmethod
    def rounded(x: float) -> float:
        """Round the result of an operation."""
        raise NotImplementedError

    def stored(self) -> Self:
        """Store to memory: nothing is left to round."""
        return self

    def sqrt(self) -> Self:
        """Return the square root."""
        return type(self)(arithmetic.sqrt(self.value))

    def divided_by(self, other: Number) -> Self:
        """Divide by a number that may be zero."""
        return type(self)(arithmetic.divide(self.value, self._other(other)))

    def dividing(self, other: float) -> Self:
        """Divide a number by this, which may be zero."""
        return type(self)(arithmetic.divide(self.rounded(other), self.value))

    def is_nan(self) -> bool:
        """Tell whether this is not a number."""
        return math.isnan(self.value)

    def sin(self) -> Self:
        """Return the sine of an angle in radians."""
        return type(self)(arithmetic.sin(self.value))

    def cos(self) -> Self:
        """Return the cosine of an angle in radians."""
        return type(self)(arithmetic.cos(self.value))

    def asin(self) -> Self:
        """Return the arc sine in radians."""
        return type(self)(arithmetic.asin(self.value))

    def acos(self) -> Self:
        """Return the arc cosine in radians."""
        return type(self)(arithmetic.acos(self.value))

    def atan2(self, x: Number) -> Self:
        """Return the angle of the point (x, self) in radians."""
        return type(self)(math.atan2(self.value, self._other(x)))

    def fmod(self, b: Number) -> Self:
        """Return the remainder of a division, with the sign of this."""
        return type(self)(arithmetic.fmod(self.value, self._other(b)))

    def power(self, y: Number) -> Self:
        """Return this to the power of a time that is not negative."""
        return type(self)(arithmetic.power(self.value, self._other(y)))

    def raising(self, x: float) -> Self:
        """Return a number to the power of this, a time that is not negative."""
        return type(self)(x).power(self)

    def __add__(self, other: Number) -> Self:
        return type(self)(self.value + self._other(other))

    __radd__ = __add__

    def __sub__(self, other: Number) -> Self:
        return type(self)(self.value - self._other(other))

    def __rsub__(self, other: float) -> Self:
        return type(self)(self.rounded(other) - self.value)

    def __mul__(self, other: Number) -> Self:
        return type(self)(self.value * self._other(other))

    __rmul__ = __mul__

    def __truediv__(self, other: Number) -> Self:
        return type(self)(self.value / self._other(other))

    def __rtruediv__(self, other: float) -> Self:
        return type(self)(self.rounded(other) / self.value)

    def __neg__(self) -> Self:
        return type(self)(-self.value)

    def __abs__(self) -> Self:
        return type(self)(abs(self.value))

    def __floor__(self) -> int:
        return arithmetic.floor(self.value)

    def __ceil__(self) -> int:
        return arithmetic.ceil(self.value)

    def __lt__(self, other: Number) -> bool:
        return self.value < self._other(other)

    def __le__(self, other: Number) -> bool:
        return self.value <= self._other(other)

    def __gt__(self, other: Number) -> bool:
        return self.value > self._other(other)

    def __ge__(self, other: Number) -> bool:
        return self.value >= self._other(other)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Register | float | int) and self.value == self._other(other)

    def __hash__(self) -> int:
        return hash(self.value)

    def _other(self, other: Number) -> float:
        return other.value if other.__class__ is self.__class__ else self.rounded(_raw(other))


class Single(Register):
    """A number that is float32 also in registers: every operation rounds.

    A sum, product, quotient or root of two float32s that is rounded to double first and then to float32
    is the float32 result, so nothing here is rounded differently than by float32 hardware.
    """

    __slots__ = ()

    @staticmethod
    def rounded(x: float) -> float:
        """Round to float32."""
        return f32(x)


class Double(Register):
    """A number that is a double also in memory: no store rounds to float32."""

    __slots__ = ()

    @staticmethod
    def rounded(x: float) -> float:
        """Keep the double that it is."""
        return float(x)


def plain(fields: Fields) -> Fields:
    """Return an answer with every `Register` as a Python float."""
    return {name: _plain(value) for name, value in fields.items()}


def _plain(value: Any) -> Any:
    if isinstance(value, Register):
        return value.value
    if isinstance(value, dict):
        return plain(value)
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return value


def _raw(x: Number) -> float:
    return x.value if isinstance(x, Register) else x
