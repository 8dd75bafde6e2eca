"""Many queries on several threads: consecutive ones together, each part in a row of state of its own."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import TYPE_CHECKING

from engine.errors import QueryError
from engine.tracing import is_recording

if TYPE_CHECKING:
    from collections.abc import Callable


def in_parts(work: Callable[[slice], None], count: int, threads: int) -> None:
    """Do work that consists of independent pieces, with the interpreter's lock released inside kernels.

    Parameters
    ----------
    work
        Does the pieces that a slice selects.
    count : int
        How many pieces there are.
    threads : int
        How many share them. While writes are recorded there is only the calling one.

    Raises
    ------
    QueryError
        If `threads` is not a number of threads.
    """
    if threads < 1:
        raise QueryError("threads", f"{threads} where at least 1 is needed")
    parts = 1 if is_recording() else min(threads, count)
    if parts <= 1:
        work(slice(0, count))
        return
    ends = [count * part // parts for part in range(parts + 1)]
    slices = [slice(first, last) for first, last in pairwise(ends)]
    with ThreadPoolExecutor(parts) as pool:
        for done in [pool.submit(work, part) for part in slices]:
            done.result()
