"""Many queries on several threads: each takes the next few, and answers them in a row of state of its own.

Each begins with its own part of them, but nothing is dealt out for good: queries differ in cost, and a
thread may lose its core for a while. They are taken inside the kernels (`engine.kernels.sharing`), so that
each thread needs the interpreter's lock once. Helpers wait for the next batch when one is done: to start
them takes as long as a small batch does.
"""

from __future__ import annotations

import os
from functools import cache
from queue import SimpleQueue
from threading import Lock, Thread
from time import perf_counter, sleep
from typing import TYPE_CHECKING, Final

import numpy as np

from engine.checks import whole
from engine.errors import QueryError
from engine.kernels.sharing import (
    LANE_END,
    LANE_INTS,
    LANE_NEXT,
    SHARE_DONE,
    SHARE_FAILED,
    SHARE_LANES,
    SHARE_REORDERED,
)
from engine.probes import note_reordered
from engine.processors import WHEREABOUTS, processor
from engine.tracing import is_recording

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from engine.kernels.types import Ints

_LANE, _NEXT, _END = int(LANE_INTS), int(LANE_NEXT), int(LANE_END)
"""As Python's own integers, with which it calculates faster."""
_CHECK_THREADS: Final = whole(1)
PATIENCE: Final = 0.0005
"""Seconds in which a helper's last turn is waited for awake: to be woken takes as long as many queries."""


def new_share(count: int, threads: int = 1) -> Ints:
    """Return what so many threads share of so many queries, before the first is taken."""
    share = np.zeros((1 + threads) * _LANE, dtype=np.int64)
    share[SHARE_LANES] = threads
    for lane in range(threads):
        first = (1 + lane) * _LANE
        share[first + _NEXT] = count * lane // threads
        share[first + _END] = count * (lane + 1) // threads
    return share


def sharing(count: int, threads: int) -> int:
    """Return how many threads share so many queries, which is how many lanes these have.

    Raises
    ------
    QueryError
        If `threads` is not a number of threads.
    """
    _CHECK_THREADS(threads, "threads", QueryError)
    return 1 if is_recording() else max(min(int(threads), count), 1)


def together(work: Callable[[Ints], None], count: int, threads: int) -> int:
    """Do work that consists of independent queries, with the interpreter's lock released inside kernels.

    Parameters
    ----------
    work
        Takes queries, and answers them, until all are taken: each thread calls it once, with the same
        share (`engine.kernels.sharing`).
    count : int
        How many queries there are.
    threads : int
        How many share them, the calling one among them; helpers that are busy with another caller's
        queries leave theirs to the others. While writes are recorded there is no helper.

    Returns
    -------
    int
        How many queries could not be answered.

    Raises
    ------
    QueryError
        If `threads` is not a number of threads.
    """
    at_work = sharing(count, threads)
    share = new_share(count, at_work)
    helping = [_Task(work, share) for _ in range(at_work - 1)]
    for task in helping:
        _helpers(os.getpid()).put(task)
    try:
        work(share)
    except BaseException:
        share[_LANE + _NEXT :: _LANE] = count
        raise
    finally:
        _await(share, count, helping)
    note_reordered(int(share[SHARE_REORDERED]))
    return int(share[SHARE_FAILED])


def _await(share: Ints, count: int, helping: Sequence[_Task]) -> None:
    """Wait until nobody is at work on a share of which nothing is left: awake for a while, then asleep.

    A helper that has not begun will find nothing to take; one whose queries are all done with needs nothing
    but to notice it.
    """
    if not helping:
        return
    end = perf_counter() + PATIENCE
    while share[SHARE_DONE] < count and perf_counter() < end:
        sleep(0)
    if share[SHARE_DONE] < count:
        for task in helping:
            task.wait()


class _Task:
    """What a helper is asked to do: work on a share.

    Parameters
    ----------
    work, share
        As those of `together`.
    """

    def __init__(self, work: Callable[[Ints], None], share: Ints) -> None:
        self._work: Final = work
        self._share: Final = share
        self._asked_on: Final = processor()
        self._has_begun = False
        self._at_work: Final = Lock()
        self._at_work.acquire()
        self._error: BaseException | None = None

    def do(self) -> None:
        """Work, elsewhere than who has asked for it; an error is kept for who waits."""
        WHEREABOUTS.leave(self._asked_on)
        self._has_begun = True
        try:
            self._work(self._share)
        except BaseException as error:  # noqa: BLE001 - raised again in the thread that waits
            self._error = error
        finally:
            self._at_work.release()

    def wait(self) -> None:
        """Wait for the end, unless it has not begun; raise what has been raised."""
        if self._has_begun:
            self._at_work.acquire()
        if self._error is not None:
            raise self._error


@cache
def _helpers(_process: int) -> SimpleQueue[_Task]:
    """Return what the helpers of a process are waiting at: one that was forked has none of its parent's."""
    tasks: SimpleQueue[_Task] = SimpleQueue()
    for number in range(os.cpu_count() or 1):
        Thread(target=_help, args=(tasks,), name=f"engine_{number}", daemon=True).start()
    return tasks


def _help(tasks: SimpleQueue[_Task]) -> None:
    while True:
        tasks.get().do()
