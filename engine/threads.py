"""Many queries on several threads: consecutive ones together, each part in a row of state of its own.

Parts are taken in turn, not dealt out: queries differ in cost, and a thread may lose its core for a while.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from threading import Lock
from typing import TYPE_CHECKING, Final

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
        How many share them, the calling one among them. While writes are recorded there is no other.

    Raises
    ------
    QueryError
        If `threads` is not a number of threads.
    """
    if threads < 1:
        raise QueryError("threads", f"{threads} where at least 1 is needed")
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

    with ThreadPoolExecutor(sharing - 1) as others:
        helping = [others.submit(share) for _ in range(sharing - 1)]
        share()
        for helper in helping:
            helper.result()


def _parts(count: int, number: int) -> Iterator[slice]:
    """Divide so many pieces into about so many parts; none is empty."""
    size = -(-count // number)
    for first in range(0, count, size):
        yield slice(first, min(first + size, count))
