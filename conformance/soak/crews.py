"""Who works for a campaign: this process alone, or several."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import TYPE_CHECKING, ParamSpec, Protocol, TypeVar

from conformance.soak.workshop import open_process
from conformance.workers import without_interrupts

if TYPE_CHECKING:
    from collections.abc import Callable

P = ParamSpec("P")
T = TypeVar("T")


class Crew(Protocol):
    """Runs tasks, each a function of `workshop` with what it is given."""

    lost: tuple[type[BaseException], ...]
    """What a task ends with if who worked on it is gone; it may be given to somebody else."""
    chances: int
    """How often a task may lose who works on it; then it is the task that ends them."""

    @property
    def places(self) -> int:
        """How many tasks to have on their way, so that nobody is idle."""
        ...

    def submit(self, task: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Give somebody a task."""
        ...

    def close(self) -> None:
        """End, without waiting for what is on its way."""
        ...


class Alone:
    """Runs each task at once, in this process."""

    lost: tuple[type[BaseException], ...] = ()
    chances = 1
    places = 1

    def submit(self, task: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Run a task; Ctrl-C ends it."""
        future: Future[T] = Future()
        try:
            future.set_result(task(*args, **kwargs))
        except Exception as error:  # noqa: BLE001 - it is raised where the result is taken
            future.set_exception(error)
        return future

    def close(self) -> None:
        """Do nothing: nothing is on its way."""


class Processes:
    """Runs tasks in processes of their own; those that die are replaced.

    Parameters
    ----------
    jobs : int
        How many.
    """

    lost: tuple[type[BaseException], ...] = (BrokenProcessPool,)
    chances = 3

    def __init__(self, jobs: int) -> None:
        self.places = 2 * jobs
        self._jobs = jobs
        self._context = multiprocessing.get_context("spawn")  # the same everywhere, and safe beside threads
        self._stopped = self._context.Event()
        self._pool = self._open()

    def submit(self, task: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Give one of them a task."""
        with without_interrupts():  # it may have to be started first
            try:
                return self._pool.submit(task, *args, **kwargs)
            except BrokenProcessPool:
                self._pool.shutdown(wait=False, cancel_futures=True)
                self._pool = self._open()
                return self._pool.submit(task, *args, **kwargs)

    def close(self) -> None:
        """Tell them that nobody waits any more."""
        self._stopped.set()
        self._pool.shutdown(wait=False, cancel_futures=True)

    def _open(self) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(
            self._jobs, mp_context=self._context, initializer=open_process, initargs=(self._stopped,)
        )
