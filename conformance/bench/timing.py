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
from engine.collector import without_collector

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from conformance.bench.work import Work

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
        Turns what `run` returned into a row of numbers for each query, outside of the clock.
    queries : int
        How many `run` asks.
    repeats : int
        How often it asks each, one after the other: the ticks of a body. The time told is that of one.
    """

    run: Callable[[], Any]
    answer: Callable[[Any], Answer]
    queries: int
    repeats: int = 1


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


def sample_of(maker: Maker, count: int, of: int) -> Maker:
    """Return an implementation that is asked the first `count` of `of` queries, where others answer all.

    Queries are drawn in random order: the first ones are as random a sample as any. Of work of another
    length it is asked as large a share, rounded up.
    """

    def job_of_sample(work: Work) -> Job:
        return maker(work.part(0, -(-len(work) * count // of)))

    return job_of_sample


def quarter(work: Work) -> Work:
    """Return the first quarter of some work: enough for caches and predictions to be those of a long run."""
    return work.part(0, -(-len(work) // 4))


def whole(work: Any) -> Any:
    """Return all of some work."""
    return work


@contextmanager
def no_collection() -> Iterator[None]:
    """Keep the garbage collector out of the clock."""
    gc.collect()
    with without_collector():
        yield


def clock(job: Job) -> tuple[float, Any]:
    """Do a job; return the nanoseconds it took for each query, and what it returned."""
    begin = perf_counter()
    done = job.run()
    elapsed = perf_counter() - begin
    return elapsed * 1e9 / (job.queries * job.repeats), done


def take_turns(
    makers: Sequence[Maker],
    rounds: Iterable[Any],
    *,
    warm_up: Any,
    judge: Callable[[Any, Sequence[Answer]], None],
    lead_in: Callable[[Any], Any] = whole,
) -> list[list[float]]:
    """Let implementations take turns.

    Before its clock starts each does work of the round before once more: what the turns of others have driven
    out of the caches is back, and the time told is that of a long run.

    Parameters
    ----------
    makers : sequence of Maker
    rounds : iterable
        The work of each round, at least one; drawn when its round comes, before the clock starts. Who begins
        moves on from round to round.
    warm_up : work
        Done first, and not counted; the round before the first one.
    judge : callable
        Is told the work and all answers of every round, and raises if they are not what they must be.
    lead_in : callable
        Returns how much of the round before is done once more.

    Returns
    -------
    list of list of float
        For each implementation the nanoseconds a query of each round.

    Raises
    ------
    DisagreementError
        If one has not answered every query that it was asked.
    """
    for maker in makers:
        maker(warm_up).run()
    times: list[list[float]] = [[] for _ in makers]
    before = warm_up
    with no_collection():
        for number, work in enumerate(rounds):
            answers: dict[int, Answer] = {}
            for turn in range(len(makers)):
                side = (turn + number) % len(makers)
                makers[side](lead_in(before)).run()
                job = makers[side](work)  # not before: both use the same memory for what they answer
                elapsed, done = clock(job)
                times[side].append(elapsed)
                answers[side] = _all_answers(job, done)
            judge(work, [answers[side] for side in range(len(makers))])
            before = work
    return times


def _all_answers(job: Job, done: Any) -> Answer:
    """Return a job's answers, one for each of its queries."""
    answers = job.answer(done)
    if len(answers) != job.queries:
        raise DisagreementError(f"{len(answers)} answers to {job.queries} queries")
    return answers


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
    """Judge answers that must be equal in every bit, as far as they go.

    Who is asked less than others is asked the first queries (`sample_of`).

    Raises
    ------
    DisagreementError
        Naming the first query that is answered differently.
    """
    all_of_them = max(answers, key=len)
    for some in answers:
        if not len(some) or some.shape[1:] != all_of_them.shape[1:]:
            raise DisagreementError(f"answers of shape {all_of_them.shape} and {some.shape}")
        for query in np.flatnonzero(~equal_rows(all_of_them[: len(some)], some)):
            both = all_of_them[query].tolist(), some[query].tolist()
            raise DisagreementError(f"query {query}: {both[0]} and {both[1]}")


def accept(_work: Any, _answers: Sequence[Answer]) -> None:
    """Judge answers to different questions: they need not be equal."""


def equal_rows(a: Answer, b: Answer) -> npt.NDArray[np.bool_]:
    """Tell for each query whether both answers have the same bits; NaN equals itself."""
    left, right = (np.ascontiguousarray(x, dtype=np.float64).view(np.int64) for x in (a, b))
    same: npt.NDArray[np.bool_] = (left == right).all(axis=1)
    return same
