"""Stepping from float32 to float32."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

_SIGN: Final = -0x8000_0000


def rank(value: float) -> int:
    """Return the place of a float32 among all of them; both zeros have place 0.

    Parameters
    ----------
    value : float
        Rounded to float32.
    """
    bits = int(np.float32(value).view(np.int32))
    return bits if bits >= 0 else _SIGN - bits


def at_rank(place: int) -> float:
    """Return the float32 at a place; 0 for both zeros."""
    return float(np.int32(place if place >= 0 else _SIGN - place).view(np.float32))


def stepped(value: float, steps: int) -> float:
    """Return the float32 so many steps above `value`, or below it."""
    return at_rank(rank(value) + steps)


def turning_point(low: float, high: float, decide: Callable[[float], bool]) -> float:
    """Return the first float32 from `low` to `high` at which a decision is no longer that at `low`.

    Parameters
    ----------
    low, high : float
        In any order; the decisions at the two differ.
    decide : callable
        Turns once in between; if it turns more often, one of the turns is found.

    Raises
    ------
    ValueError
        If the decisions at both ends are the same.
    """
    same, other, first = rank(low), rank(high), decide(low)
    if decide(high) is first:
        raise ValueError(f"no turn between {low!r} and {high!r}: the decision is {first} at both")
    while abs(other - same) > 1:
        middle = (same + other) // 2
        if decide(at_rank(middle)) is first:
            same = middle
        else:
            other = middle
    return at_rank(other)
