"""Processes that work for another one, and end when nobody is left to take their results."""

from __future__ import annotations

import multiprocessing
import os
import sys
import threading
from typing import TYPE_CHECKING, Final

from conformance import exit_codes

if TYPE_CHECKING:
    from collections.abc import Callable

MOST_WORKERS: Final = 61 if sys.platform == "win32" else 1 << 10
"""Processes of a pool: Windows waits for 64 things at most, 3 of which Python needs itself."""
_CHUNK: Final = 1 << 12


def one_for_each_core() -> int:
    """Return how many processes keep this machine busy."""
    return min(os.cpu_count() or 1, MOST_WORKERS)


def end_with_parent() -> None:
    """End this process, one of a pool, as soon as who has started it is gone, however that came.

    A pool's processes wait for work on pipes that they hold open themselves, so that a killed parent leaves
    them waiting for ever. In a process that `multiprocessing` has not started, this does nothing.
    """
    parent = multiprocessing.parent_process()
    if parent is not None:
        _end_after(parent.join)


def end_with_stdin() -> None:
    """End this process at the end of its stdin, a pipe that who has started it only holds open."""

    def wait() -> None:
        while os.read(sys.stdin.fileno(), _CHUNK):
            pass

    _end_after(wait)


def _end_after(wait: Callable[[], object]) -> None:
    def watch() -> None:
        wait()
        os._exit(exit_codes.BROKEN_OFF)  # the only way out from a thread that nothing holds up

    threading.Thread(target=watch, daemon=True).start()
