"""Numbers of the command line and of pytest's options, with their limits."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable

MOST: Final = 1e6
"""Of what is measured: of seconds, no system waits for many times as many."""


def whole_from(least: int) -> Callable[[str], int]:
    """Return what reads a whole number of an option; a large one may be written as 1e7.

    It raises `argparse.ArgumentTypeError` for what is no whole number, or below `least`.
    """

    def read(text: str) -> int:
        number = _whole(text)
        if number is None or number < least:
            raise argparse.ArgumentTypeError(f"found {text}, expected a whole number, {least} or more")
        return number

    return read


def positive(unit: str) -> Callable[[str], float]:
    """Return what reads a number of `unit`, more than 0 and at most `MOST`; raises as `whole_from`."""

    def read(text: str) -> float:
        try:
            number = float(text)
        except ValueError:
            number = math.nan
        if not 0.0 < number <= MOST:
            limits = "more than 0" if not number > 0.0 else f"at most {MOST:g}"
            raise argparse.ArgumentTypeError(f"found {text}, expected {unit}, {limits}")
        return number

    return read


def _whole(text: str) -> int | None:
    try:
        return int(text)
    except ValueError:
        pass
    try:
        number = float(text)
    except ValueError:
        return None
    return int(number) if number.is_integer() else None
