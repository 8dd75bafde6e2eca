"""Ball: a number known to lie within a shrinking interval; the oracle's arithmetic without rounding.

Every operation encloses the exact result (Arb's ball arithmetic at the working precision of `flint.ctx`).
A store to memory is the identity. A comparison that the balls leave open is decided if the two sides
are found to be equal (`conformance.exact.residues`); otherwise it raises `UndecidedError`, and whoever asked
starts again with more precision.

Two things are not those of IEEE arithmetic: there is no negative zero, and nothing overflows.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

from flint import arb

from conformance.exact.ties import UndecidedError, settle
from oracle.errors import UndeterminedError

if TYPE_CHECKING:
    from conformance.exact.residues import Origin

Number: TypeAlias = "Ball | float"
"""What mixes with a `Ball`: a plain number is taken as it is, every double exactly."""


class Ball:
    """A number, and how it came about.

    Attributes
    ----------
    arb : flint.arb
        Contains the exact value.
    origin : tuple or None
        Operation and operands, from which a tie can be found; None for a number known exactly.
    """

    __slots__ = ("arb", "origin")

    arb: arb
    origin: Origin | None

    def __init__(self, x: Number) -> None:
        if isinstance(x, Ball):
            self.arb, self.origin = x.arb, x.origin
        else:
            self.arb, self.origin = arb(x), None

    def __repr__(self) -> str:
        return f"Ball({self.arb})"

    def __float__(self) -> float:
        return float(self.arb)

    def stored(self) -> Ball:
        """Store to memory: nothing is rounded."""
        return self

    def is_nan(self) -> bool:
        """Tell whether this is not a number."""
        return bool(self.arb.is_nan())

    def sqrt(self) -> Ball:
        """Return the square root; NaN for a negative number."""
        if self < 0.0 or self.is_nan():
            return Ball(math.nan)
        if self.arb.contains(0):  # then it is zero: anything else was undecided
            return Ball(0.0)
        return _made(self.arb.sqrt(), ("sqrt", self))

    def divided_by(self, other: Number) -> Ball:
        """Divide by a number that may be zero: infinity or NaN, as retail's unit gives (01 NM-9a)."""
        divisor = Ball(other)
        if divisor != 0.0 or divisor.is_nan():
            return _made(self.arb / divisor.arb, ("/", self, divisor))
        if self.is_nan() or self == 0.0:
            return Ball(math.nan)
        return Ball(math.inf if self > 0.0 else -math.inf)

    def dividing(self, other: float) -> Ball:
        """Divide a number by this, which may be zero."""
        return Ball(other).divided_by(self)

    def sin(self) -> Ball:
        """Return the sine of an angle in radians."""
        return _made(self.arb.sin(), ("sin", self))

    def cos(self) -> Ball:
        """Return the cosine of an angle in radians."""
        return _made(self.arb.cos(), ("cos", self))

    def asin(self) -> Ball:
        """Return the arc sine in radians; NaN outside [-1, 1]."""
        x = self._within_one()
        return x if x.is_nan() else _made(x.arb.asin(), ("asin", x))

    def acos(self) -> Ball:
        """Return the arc cosine in radians; NaN outside [-1, 1]."""
        x = self._within_one()
        return x if x.is_nan() else _made(x.arb.acos(), ("acos", x))

    def atan2(self, x: Number) -> Ball:
        """Return the angle of the point (x, self) in radians."""
        abscissa = Ball(x)
        ordinate = Ball(0.0) if self == 0.0 else self  # on the cut of the function a ball would be all angles
        return _made(arb.atan2(ordinate.arb, abscissa.arb), ("atan2", ordinate, abscissa))

    def fmod(self, b: Number) -> Ball:
        """Return the remainder of a division, with the sign of this."""
        quotient = self / b
        if not quotient.arb.is_finite():
            return Ball(math.nan)
        whole = math.floor(quotient) if quotient >= 0.0 else math.ceil(quotient)
        return self - Ball(b) * whole

    def power(self, y: Number) -> Ball:
        """Return this to the power of a time that is not negative."""
        exponent = Ball(y)
        if exponent == 0.0:
            return Ball(1.0)
        if self == 0.0:
            return Ball(0.0)
        return _made(self.arb**exponent.arb, ("power", self, exponent))

    def raising(self, x: float) -> Ball:
        """Return a number to the power of this, a time that is not negative."""
        return Ball(x).power(self)

    def __add__(self, other: Number) -> Ball:
        b = _ball(other)
        return _made(self.arb + b.arb, ("+", self, b))

    __radd__ = __add__

    def __sub__(self, other: Number) -> Ball:
        b = _ball(other)
        return _made(self.arb - b.arb, ("-", self, b))

    def __rsub__(self, other: float) -> Ball:
        return Ball(other) - self

    def __mul__(self, other: Number) -> Ball:
        b = _ball(other)
        return _made(self.arb * b.arb, ("*", self, b))

    __rmul__ = __mul__

    def __truediv__(self, other: Number) -> Ball:
        b = _ball(other)
        if b.arb.contains(0) and b == 0.0:
            raise ZeroDivisionError("division by zero")
        return _made(self.arb / b.arb, ("/", self, b))

    def __rtruediv__(self, other: float) -> Ball:
        return Ball(other) / self

    def __neg__(self) -> Ball:
        return _made(-self.arb, ("neg", self))

    def __abs__(self) -> Ball:
        if self.arb >= 0:
            return self
        return -self if self.arb < 0 else _made(abs(self.arb), ("abs", self))

    def __floor__(self) -> int:
        whole = self.arb.floor().unique_fmpz()
        return self._integer() if whole is None else int(whole)

    def __ceil__(self) -> int:
        whole = self.arb.ceil().unique_fmpz()
        return self._integer() if whole is None else int(whole)

    def __bool__(self) -> bool:
        return self != 0.0

    def __lt__(self, other: Number) -> bool:
        b = _ball(other)
        if self.arb < b.arb:
            return True
        if not self.arb >= b.arb:
            settle(self, b)
        return False

    def __le__(self, other: Number) -> bool:
        b = _ball(other)
        if self.arb <= b.arb:
            return True
        return False if self.arb > b.arb else settle(self, b)

    def __gt__(self, other: Number) -> bool:
        b = _ball(other)
        if self.arb > b.arb:
            return True
        if not self.arb <= b.arb:
            settle(self, b)
        return False

    def __ge__(self, other: Number) -> bool:
        b = _ball(other)
        if self.arb >= b.arb:
            return True
        return False if self.arb < b.arb else settle(self, b)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Ball | float | int):
            return False
        b = _ball(other)
        if self.arb == b.arb:
            return True
        return False if self.arb != b.arb else settle(self, b)

    __hash__ = None  # type: ignore[assignment]

    def _integer(self) -> int:
        """Return the integer that this is; nothing else is left when balls do not tell two integers apart."""
        if not self.arb.is_finite():
            raise UndeterminedError(f"{self.arb} as a whole number (NM-9)")
        nearest = (self.arb.mid() + arb(0.5)).floor().unique_fmpz()
        if nearest is None or not settle(self, Ball(int(nearest))):
            raise UndecidedError(f"floor of {self.arb}")
        return int(nearest)

    def _within_one(self) -> Ball:
        """Return this, or exactly 1 or -1 where it is equal to that, or NaN outside."""
        for end in (1.0, -1.0):
            if self.arb.contains(arb(end)) and self == end:
                return Ball(end)
        return self if abs(self) <= 1.0 else Ball(math.nan)


def _ball(x: Number) -> Ball:
    return x if isinstance(x, Ball) else Ball(x)


def _made(value: arb, origin: Origin) -> Ball:
    """Return a result; one that is known exactly needs no origin."""
    made = Ball.__new__(Ball)
    made.arb = value
    made.origin = None if value.is_exact() else origin
    return made
