"""Who writes contact planes, walkables, sliding normals, state and cells while the engine runs.

Inside `recording`, kernels are run by Python instead of compiled (`engine.tracing_interpreter`): some
thousand times slower, with the same results bit for bit. Outside of it nothing is any different.
"""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial
from typing import TYPE_CHECKING, Any, Final, Protocol

from engine.errors import QueryError
from engine.tracing_recorder import Recorder
from engine.tracing_writes import TOPICS, WriteTrace

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator


class Runner(Protocol):
    """What runs kernels in place of compiled code."""

    def run(self, kernel: Any, *arguments: Any) -> Any:
        """Run a kernel, with the results that it has compiled."""


_RUNNER: Final[ContextVar[Runner | None]] = ContextVar("runner", default=None)


class UnknownTopicError(QueryError):
    """There is no such topic to trace; `topic` is its name."""

    def __init__(self, topic: str) -> None:
        self.topic = topic
        super().__init__("topics", f"unknown topic {topic!r}; there are: {', '.join(TOPICS)}")

    def __reduce__(self) -> tuple[type[UnknownTopicError], tuple[str]]:
        """Be pickled by the topic, of which the rest is made."""
        return type(self), (self.topic,)


@contextmanager
def recording(topics: Collection[str] = TOPICS) -> Iterator[WriteTrace]:
    """Record what transitions write that are run inside the block, in this thread.

    Parameters
    ----------
    topics : collection of str
        Which of `TOPICS` to record.

    Yields
    ------
    WriteTrace
        Grows with each query. Transitions are numbered from 1 in the order in which they begin.

    Raises
    ------
    UnknownTopicError
        A topic is none of `TOPICS`.
    """
    for topic in topics:
        if topic not in TOPICS:
            raise UnknownTopicError(topic)
    recorder = Recorder(topics)
    with run_by(recorder):
        yield recorder.trace


@contextmanager
def run_by(runner: Runner) -> Iterator[None]:
    """Let a runner run the kernels of the queries inside the block, in this thread."""
    token = _RUNNER.set(runner)
    try:
        yield
    finally:
        _RUNNER.reset(token)


def is_recording() -> bool:
    """Say whether this thread is inside `recording`, or `run_by`."""
    return _RUNNER.get() is not None


def runnable(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """Return the kernel itself or, inside `recording` or `run_by`, what runs it interpreted.

    It is asked for where Python calls a kernel that has a row of state, once a batch.
    """
    runner = _RUNNER.get()
    return kernel if runner is None else partial(runner.run, kernel)
