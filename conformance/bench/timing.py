"""Two implementations at the same work, in turns: are the answers equal, and who is faster.

Machines change their speed while a benchmark runs. What does not change with them is the ratio of two
times that were measured next to each other, so every round measures both sides, in alternating order,
on queries that no other round has asked, and the rounds' ratios are summarised.
"""

from __future__ import annotations

import gc
from contextlib import contextmanager
from dataclasses import dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

import numpy as np
import numpy.typing as npt

from conformance.bench.figures import Summary, summarise

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

Answer: TypeAlias = npt.NDArray[np.float64]
"""What was answered: a row of numbers for each query."""


class DisagreementError(Exception):
    """Two implementations that must be equal are not: their times are not compared."""


@dataclass(frozen=True, slots=True)
class Job:
    """Work that is ready to be done; everything that may be prepared has been.

    Attributes
    ----------
    run : callable
        Does all of it once; nothing else is in the clock.
    answer : callable
        Turns what `run` returned into a row of numbers for each different query, outside of the clock.
    count : int
        How many queries `run` asks.
    """

    run: Callable[[], Any]
    answer: Callable[[Any], Answer]
    count: int


class Maker(Protocol):
    """An implementation: makes a job of work."""

    def __call__(self, work: Any, /) -> Job:
        """Prepare work, with fresh state."""
        ...


@dataclass(frozen=True, slots=True)
class Comparison:
    """What rounds have shown.

    Attributes
    ----------
    ratio : Summary
        Our rate over theirs: above 1, ours is faster.
    ours, theirs : Summary
        Nanoseconds a query.
    rounds : int
        How many.
    agreement : float
        Share of queries that are answered alike: 1.0 where equality is demanded.
    """

    ratio: Summary
    ours: Summary
    theirs: Summary
    rounds: int
    agreement: float = 1.0


@contextmanager
def no_collection() -> Iterator[None]:
    """Keep the garbage collector out of the clock."""
    was_on = gc.isenabled()
    gc.collect()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def clock(job: Job) -> tuple[float, Any]:
    """Do a job; return the nanoseconds it took for each query, and what it returned."""
    begin = perf_counter()
    done = job.run()
    elapsed = perf_counter() - begin
    return elapsed * 1e9 / job.count, done


def take_turns(
    makers: Sequence[Maker],
    rounds: Sequence[Any],
    *,
    warm_up: Any,
    judge: Callable[[Any, Sequence[Answer]], None],
) -> list[list[float]]:
    """Let implementations take turns.

    Parameters
    ----------
    makers : sequence of Maker
    rounds : sequence
        The work of each round, at least one. Who begins moves on from round to round.
    warm_up : work
        Done first, and not counted.
    judge : callable
        Is told the work and all answers of every round, and raises if they are not what they must be.

    Returns
    -------
    list of list of float
        For each implementation the nanoseconds a query of each round.
    """
    for maker in makers:
        maker(warm_up).run()
    times: list[list[float]] = [[] for _ in makers]
    with no_collection():
        for number, work in enumerate(rounds):
            jobs = [maker(work) for maker in makers]
            answers: dict[int, Answer] = {}
            for turn in range(len(jobs)):
                side = (turn + number) % len(jobs)
                elapsed, done = clock(jobs[side])
                times[side].append(elapsed)
                answers[side] = jobs[side].answer(done)
            judge(work, [answers[side] for side in range(len(jobs))])
    return times


def comparison(ours: Sequence[float], theirs: Sequence[float], agreement: float = 1.0) -> Comparison:
    """Summarise the times of two that took turns."""
    return Comparison(
        ratio=summarise([other / mine for mine, other in zip(ours, theirs, strict=True)]),
        ours=summarise(ours),
        theirs=summarise(theirs),
        rounds=len(ours),
        agreement=agreement,
    )


def demand_equal(_work: Any, answers: Sequence[Answer]) -> None:
    """Judge answers that must be equal in every bit.

    Raises
    ------
    DisagreementError
        Naming the first query that is answered differently.
    """
    first = answers[0]
    for other in answers[1:]:
        if first.shape != other.shape:
            raise DisagreementError(f"answers of shape {first.shape} and {other.shape}")
        for query in np.flatnonzero(~equal_rows(first, other)):
            raise DisagreementError(f"query {query}: {first[query].tolist()} and {other[query].tolist()}")


def equal_rows(a: Answer, b: Answer) -> npt.NDArray[np.bool_]:
    """Tell for each query whether both answers have the same bits; NaN equals itself."""
    left, right = (np.ascontiguousarray(x, dtype=np.float64).view(np.int64) for x in (a, b))
    same: npt.NDArray[np.bool_] = (left == right).all(axis=1)
    return same
