"""How far a campaign is, and how long the rest will take."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.soak.tally import Tally

_MINUTE: Final = 60.0
_HOUR: Final = 3600.0
_DAY: Final = 24.0 * _HOUR


class Pace:
    """Measures the speed of this run; what an earlier one has asked does not count.

    Parameters
    ----------
    total : int
        Queries that are to be asked.
    before : int
        Those that were asked by earlier runs.
    clock : callable
        Seconds, from whenever.
    """

    def __init__(self, total: int, before: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._total = total
        self._before = before
        self._clock = clock
        self._began = clock()

    @property
    def seconds(self) -> float:
        """How long this run has taken so far."""
        return self._clock() - self._began

    def rate(self, tally: Tally) -> float:
        """Return queries a second."""
        return (tally.queries - self._before) / self.seconds if self.seconds else 0.0

    def line(self, tally: Tally) -> str:
        """Say how far it is."""
        rate = self.rate(tally)
        left = f", {duration((self._total - tally.queries) / rate)} left" if rate else ""
        return f"{tally.queries:,} of {self._total:,} queries ({rate:.0f} a second{left}): {counts(tally)}"


def counts(tally: Tally) -> str:
    """Say how queries have ended."""
    return (
        f"{tally.agreed:,} agreed, {tally.differed:,} differed, {tally.errored:,} without an answer, "
        f"{tally.skipped.total():,} skipped"
    )


def duration(seconds: float) -> str:
    """Write a time with the two units that matter."""
    if seconds < _MINUTE:
        return f"{seconds:.0f} s"
    if seconds < _HOUR:
        return f"{int(seconds // _MINUTE)} min {int(seconds % _MINUTE)} s"
    if seconds < _DAY:
        return f"{int(seconds // _HOUR)} h {int(seconds % _HOUR // _MINUTE)} min"
    return f"{int(seconds // _DAY)} d {int(seconds % _DAY // _HOUR)} h"
