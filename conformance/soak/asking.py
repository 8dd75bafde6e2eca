"""Asking retail and a candidate one query, and what that comes to."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from conformance.compare import differences
from conformance.query import Errored, Skipped
from conformance.report.text import summary_line
from conformance.soak.kinds import kind_of_difference, kind_of_error

if TYPE_CHECKING:
    from conformance.candidates.base import Candidate
    from conformance.compare import Difference
    from conformance.query import Outcome, Query
    from conformance.soak.kinds import FailureKind


class Ending(StrEnum):
    """How a query ended."""

    AGREED = "agreed"
    DIFFERED = "differed"
    ERRORED = "errored"
    SKIPPED = "skipped"


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of a query.

    Attributes
    ----------
    ending : Ending
    truth : Outcome
        Retail's answer.
    kind : FailureKind or None
        What it is counted with, if it failed.
    said : str
        The first difference, who failed and how, or why it was skipped; empty if both agree.
    differences : tuple of Difference
    """

    ending: Ending
    truth: Outcome
    kind: FailureKind | None = None
    said: str = ""
    differences: tuple[Difference, ...] = ()


def judge(query: Query, oracle: Candidate, candidate: Candidate) -> Verdict:
    """Ask both; signs of zero are distinct. A query that one of them does not do is skipped."""
    truth = oracle.answer(query)
    given = candidate.answer(query)  # also if retail has no answer: an engine that was asked ahead has one
    if isinstance(truth, Skipped):
        return _skipped(truth, oracle, truth)
    if isinstance(truth, Errored):
        return _errored(query, truth, oracle, truth)
    if isinstance(given, Skipped):
        return _skipped(truth, candidate, given)
    if isinstance(given, Errored):
        return _errored(query, truth, candidate, given)
    found = differences(truth.fields, given.fields, op=query.op, zero_signs="distinct")
    if not found:
        return Verdict(Ending.AGREED, truth)
    said = summary_line(found[0], candidate.name)
    return Verdict(Ending.DIFFERED, truth, kind_of_difference(query.op, found[0]), said, tuple(found))


def _skipped(truth: Outcome, who: Candidate, outcome: Skipped) -> Verdict:
    return Verdict(Ending.SKIPPED, truth, said=f"{who.name}: {outcome.reason}")


def _errored(query: Query, truth: Outcome, who: Candidate, outcome: Errored) -> Verdict:
    first, _, _log = outcome.context.partition("\n")
    return Verdict(
        Ending.ERRORED, truth, kind_of_error(query.op, who.name, first), f"{who.name} failed: {first}"
    )
