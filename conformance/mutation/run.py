"""Judging many mutants, in this process or in several."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, TypeAlias

from conformance.branches.measure import oracle_sources
from conformance.mutation.asking import questions
from conformance.mutation.journal import Journal, digest_of
from conformance.mutation.operators import plans
from conformance.mutation.reach import reaches
from conformance.mutation.trial import Trial
from conformance.workers import serve_parent, without_interrupts

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
    from pathlib import Path

    from conformance.mutation.asking import Question
    from conformance.mutation.operators import Plan
    from conformance.mutation.reach import Reach
    from conformance.mutation.trial import Finding

    Asked: TypeAlias = tuple[Sequence[Question], Mapping[str, Reach]]

DOCUMENTS: Final = tuple(f"{number:02d}" for number in range(1, 11))
"""Documents whose functions are mutated unless others are asked for: all that functions are ported from."""


class WorkerLostError(RuntimeError):
    """A worker process has ended by itself; what was found before is in the journal."""


@dataclass(frozen=True, slots=True)
class Work:
    """What is to be judged, and how.

    Attributes
    ----------
    documents : tuple of str
        Documents whose functions are mutated.
    chosen : tuple of int
        Numbers of the mutants that are judged, in the order of `all_plans`.
    jobs : int
        Processes.
    journal : Path
        Where findings are kept.
    resume : bool
        Whether to go on with what the journal holds.
    """

    documents: tuple[str, ...]
    chosen: tuple[int, ...]
    jobs: int
    journal: Path
    resume: bool


def all_plans(documents: Collection[str]) -> list[Plan]:
    """Make every mutant of certain documents, in an order that is always the same."""
    return list(plans(oracle_sources(), documents))


def judge(work: Work, plans_: Sequence[Plan], say: Callable[[str], None]) -> list[Finding]:
    """Judge the chosen mutants; findings are in the order of their numbers.

    Parameters
    ----------
    work : Work
        What to do.
    plans_ : sequence of Plan
        All mutants of its documents.
    say : callable
        Is told how far it is.

    Raises
    ------
    JournalError
        The journal to go on with is none.
    WorkerLostError
        A worker process has ended by itself.
    """
    asked = questions()
    journal = Journal(work.journal, digest_of(oracle_sources(), asked), resume=work.resume)
    known = {number: journal.finding(plans_[number].mutant) for number in work.chosen}
    found = {number: finding for number, finding in known.items() if finding is not None}
    hints = {n: journal.hint(plans_[n].mutant) for n in work.chosen if n not in found}
    with journal:
        if hints:
            for number, finding in _judged(work, plans_, (asked, reaches(asked, say)), hints):
                found[number] = finding
                journal.note(finding)
                noticed = sum(one.killed for one in found.values())
                say(f"mutants: {len(found)} of {len(work.chosen)}, {noticed} noticed")
    return [found[number] for number in work.chosen]


def _judged(
    work: Work, plans_: Sequence[Plan], asked: Asked, hints: Mapping[int, str]
) -> Iterator[tuple[int, Finding]]:
    if work.jobs == 1:
        trial = Trial(*asked)
        for number, hint in hints.items():
            yield number, trial.judge(plans_[number], hint)
        return
    context = multiprocessing.get_context("spawn")
    # What Hypothesis draws depends on the modules that a process has loaded: workers are given it.
    pool = ProcessPoolExecutor(work.jobs, context, _begin, (work.documents, asked))
    try:
        with without_interrupts():
            futures = [pool.submit(_judge_one, number, hint) for number, hint in hints.items()]
        yield from _results(futures)
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _results(futures: Sequence[Future[tuple[int, Finding]]]) -> Iterator[tuple[int, Finding]]:
    for future in as_completed(futures):
        try:
            yield future.result()
        except BrokenProcessPool as error:
            raise WorkerLostError("a worker process has ended by itself") from error


class _Worker:
    """What a worker process keeps between mutants."""

    trial: Trial
    plans: Sequence[Plan]


def _begin(documents: tuple[str, ...], asked: Asked) -> None:
    serve_parent()
    _Worker.plans = all_plans(documents)
    _Worker.trial = Trial(*asked)


def _judge_one(number: int, hint: str) -> tuple[int, Finding]:
    return number, _Worker.trial.judge(_Worker.plans[number], hint)
