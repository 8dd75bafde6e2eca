"""Many queries on several threads: consecutive ones together, each part in a row of state of its own.

Parts are taken in turn, not dealt out: queries differ in cost, and a thread may lose its core for a while.
Helpers wait for the next batch when one is done: to start them takes as long as a small batch does.
"""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor, wait
from functools import cache
from threading import Lock
from typing import TYPE_CHECKING, Final

from engine.checks import told
from engine.errors import QueryError
from engine.tracing import is_recording

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

PARTS: Final = 4
"""Parts that a thread would do if all went at the same speed: the last one to finish is that much behind."""


def in_parts(work: Callable[[slice], None], count: int, threads: int) -> None:
    """Do work that consists of independent pieces, with the interpreter's lock released inside kernels.

    Parameters
    ----------
    work
        Does the pieces that a slice selects.
    count : int
        How many pieces there are.
    threads : int
        How many share them, the calling one among them; helpers that are busy with another caller's
        pieces leave theirs to the others. While writes are recorded there is no helper.

    Raises
    ------
    QueryError
        If `threads` is not a number of threads.
    """
    if not isinstance(threads, int) or threads < 1:
        raise QueryError("threads", f"{told(threads)} where at least 1 is needed")
    sharing = 1 if is_recording() else min(threads, count)
    if sharing <= 1:
        work(slice(0, count))
        return
    parts = _parts(count, sharing * PARTS)
    lock = Lock()

    def share() -> None:
        while True:
            with lock:
                part = next(parts, None)
            if part is None:
                return
            work(part)

    helping = [_helpers(os.getpid()).submit(share) for _ in range(sharing - 1)]
    try:
        share()
    finally:
        begun = [helper for helper in helping if not helper.cancel()]
        wait(begun)
    for helper in begun:
        helper.result()


@cache
def _helpers(_process: int) -> ThreadPoolExecutor:
    """Return the helpers of a process: one that was forked has none of its parent's."""
    return ThreadPoolExecutor(os.cpu_count(), thread_name_prefix="engine")


def _parts(count: int, number: int) -> Iterator[slice]:
    """Divide so many pieces into about so many parts; none is empty."""
    size = -(-count // number)
    for first in range(0, count, size):
        yield slice(first, min(first + size, count))
