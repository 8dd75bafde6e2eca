"""Comparisons that ball arithmetic leaves open: equal, or to be asked again with more precision."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Final

from flint import ctx

from conformance.exact.residues import vanishes

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.exact.ball import Ball

TIE_PRECISION: Final = 128
"""Least working precision, bits, at which two numbers may be found equal: the balls must agree to it too."""

SHOWN_DIGITS: Final = 12
"""Digits of numbers in messages."""


class UndecidedError(ArithmeticError):
    """A comparison that the working precision does not decide."""


class Ties:
    """How often two numbers were found equal although the balls alone did not tell."""

    def __init__(self) -> None:
        self.count = 0


_ties: ContextVar[Ties | None] = ContextVar("_ties", default=None)


@contextmanager
def counting_ties() -> Iterator[Ties]:
    """Count the ties of the block."""
    ties = Ties()
    token = _ties.set(ties)
    try:
        yield ties
    finally:
        _ties.reset(token)


def settle(a: Ball, b: Ball) -> bool:
    """Decide a comparison of overlapping balls: True if the numbers are equal, False if one is NaN.

    Raises
    ------
    UndecidedError
        The numbers are not known to be equal.
    """
    if a.is_nan() or b.is_nan():
        return False
    if ctx.prec < TIE_PRECISION or not vanishes(a, b):
        raise UndecidedError(
            f"{a.arb.str(SHOWN_DIGITS)} against {b.arb.str(SHOWN_DIGITS)}, at {ctx.prec} bits"
        )
    ties = _ties.get()
    if ties is not None:
        ties.count += 1
    return True
