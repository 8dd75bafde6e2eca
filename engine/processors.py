"""Where helpers run: not on the processor of who they help.

A thread that is woken may be put on its waker's own processor while another has nothing to do. In a virtual
machine of two, Linux did so with a helper nine times in ten if the last batch was ten milliseconds ago, as it
is in a game that ticks: both threads took turns on one processor, and were no faster than one. So a helper
that finds itself on its caller's processor leaves it, and does not come back before it meets its caller
somewhere else. The caller's thread is left alone; so is everybody where the system does not tell.
"""

from __future__ import annotations

import ctypes
import os
import sys
from threading import local
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable

UNKNOWN: Final = -1
"""In place of a processor's number."""


def _find_out() -> Callable[[], int]:
    """Return the function of the C library that says on which processor the calling thread is."""
    if sys.platform == "linux":
        try:
            # It takes less time than to give the interpreter's lock back, which a `CDLL` would.
            found: Callable[[], int] = ctypes.PyDLL(None).sched_getcpu
        except (OSError, AttributeError):
            pass
        else:
            return found
    return lambda: UNKNOWN


processor: Final = _find_out()
"""Returns the number of the processor that the calling thread is on, or `UNKNOWN`."""


def _allowed() -> frozenset[int]:
    """Return the processors that the calling thread may be on; none if that is not known."""
    found: frozenset[int] = frozenset()
    if sys.platform == "linux":
        found = frozenset(os.sched_getaffinity(0))
    return found


def _allow(processors: frozenset[int]) -> None:
    """Have the calling thread be on none but these."""
    if sys.platform == "linux":
        os.sched_setaffinity(0, processors)


class Whereabouts(local):
    """Where helpers may be; each thread has its own."""

    def __init__(self) -> None:
        self._everywhere: frozenset[int] = frozenset()
        self._chosen: frozenset[int] | None = None
        self._may_move = True

    def leave(self, occupied: int) -> None:
        """Go to any other processor that is allowed, if the calling thread is on this one.

        Who is refused once, as in a sandbox, stays for good.

        Parameters
        ----------
        occupied : int
            Number of the processor that somebody else is at work on, or `UNKNOWN`.
        """
        if not self._may_move or occupied == UNKNOWN or processor() != occupied:
            return
        try:
            self._go_elsewhere(occupied)
        except OSError:
            self._may_move = False

    def _go_elsewhere(self, occupied: int) -> None:
        allowed = _allowed()
        if allowed != self._chosen:
            self._everywhere = allowed
        elsewhere = self._everywhere - {occupied}
        if elsewhere:
            _allow(elsewhere)
            self._chosen = elsewhere


WHEREABOUTS: Final = Whereabouts()
"""Those of all threads: one that had two would not know what it has chosen itself."""
