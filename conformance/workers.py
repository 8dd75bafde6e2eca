"""Processes that work for another one, and end when nobody is left to take their results."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from conformance import exit_codes

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

MOST_WORKERS: Final = 61 if sys.platform == "win32" else 1 << 10
"""Processes of a pool: Windows waits for 64 things at most, 3 of which Python needs itself."""
_CHUNK: Final = 1 << 12


def one_for_each_core() -> int:
    """Return how many processes keep this machine busy."""
    return min(os.cpu_count() or 1, MOST_WORKERS)


@contextmanager
def without_interrupts() -> Iterator[None]:
    """Start processes of a pool in here: they are born deaf to Ctrl-C, which is for who has started them.

    They would not yet have called `serve_parent` while they import. Here it waits for the end of the block.
    Windows has nothing of the kind.
    """
    if sys.platform == "win32":
        yield
    else:
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            yield
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


def serve_parent() -> None:
    """Leave Ctrl-C to who has started this process, one of a pool, and end as soon as that is gone.

    A pool's processes wait for work on pipes that they hold open themselves, so that a killed parent leaves
    them waiting for ever. A process that `multiprocessing` has not started has no parent.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
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
