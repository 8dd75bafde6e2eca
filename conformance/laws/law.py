"""What a law is, and asking a candidate whether it keeps one."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

from hypothesis import given

from conformance.compare import differences
from conformance.profiles import scaled
from conformance.query import Errored, Result
from conformance.report.text import summary_line

if TYPE_CHECKING:
    from collections.abc import Callable

    from hypothesis.strategies import SearchStrategy

    from conformance.candidates.base import Candidate
    from conformance.query import Fields, Query

    Ask: TypeAlias = Callable[[Query], Fields]


@dataclass(frozen=True, slots=True)
class Law:
    """A law.

    Attributes
    ----------
    name : str
        As messages call it.
    queries : SearchStrategy of Query
        What it speaks of: its condition, as far as it is one on queries.
    breach : callable
        Given a query and a function that answers queries, says how the law is broken; empty if it holds.
    """

    name: str
    queries: SearchStrategy[Query]
    breach: Callable[[Query, Ask], str]


class BrokenLawError(AssertionError):
    """A candidate's answers do not belong together as a law says; tells the law and the first difference."""


@dataclass(slots=True)
class LawRun:
    """What a run has asked so far: queries that were answered, and why others were skipped."""

    compared: int = 0
    skipped: Counter[str] = field(default_factory=Counter)

    def counts(self) -> dict[str, Any]:
        """Return the counts as they travel in test reports."""
        return {"random": self.compared, "skipped": dict(self.skipped)}


class _UnansweredError(Exception):
    """A question of a law that the candidate does not answer."""


def hold(law: Law, candidate: Candidate, run: LawRun, *, multiple: float) -> None:
    """Ask a candidate random queries of a law until one breaks it.

    Parameters
    ----------
    law : Law
        The law.
    candidate : Candidate
        Who is asked.
    run : LawRun
        Where to count.
    multiple : float
        How many times the loaded profile's number of examples.

    Raises
    ------
    BrokenLawError
        For the smallest query that was found; also if the candidate fails to answer one.
    """

    def ask(query: Query) -> Fields:
        outcome = candidate.answer(query)
        if isinstance(outcome, Result):
            return outcome.fields
        if isinstance(outcome, Errored):
            raise BrokenLawError(f"{law.name}: {candidate.name} failed: {outcome.context}")
        run.skipped[f"{candidate.name}: {outcome.reason}"] += 1
        raise _UnansweredError

    def once(query: Query) -> None:
        try:
            broken = law.breach(query, ask)
        except _UnansweredError:
            return
        run.compared += 1
        if broken:
            raise BrokenLawError(f"{law.name}: {broken}")

    once.__name__ = once.__qualname__ = re.sub(r"\W+", "_", f"law {law.name}")
    scaled(multiple)(given(law.queries)(once))()


def unlike(op: str, expected: Fields, found: Fields, who: str) -> str:
    """Say where an answer is not what a law makes of another one; the sign of a zero is left open.

    Negating a coordinate turns 0 into -0, and whether a sum of both is one or the other depends on their
    order: no decision of retail sees it.
    """
    wrong = differences(expected, found, op=op, zero_signs="equal")
    return summary_line(wrong[0], who, retail="expected") if wrong else ""
