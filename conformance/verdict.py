"""Asking a case: the same queries to retail and to a candidate, and what came of it."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from conformance.candidates.base import ask_ahead
from conformance.compare import differences, pin_differences
from conformance.query import Errored, Result, Skipped
from conformance.report.text import render_failure, summary_line
from conformance.report.ticks import step_id, tick_of, ticks_around

if TYPE_CHECKING:
    from conformance.candidates.base import Candidate
    from conformance.compare import Difference
    from conformance.loader import Case
    from conformance.query import Outcome, Query

RETAIL = "retail"
PIN = "pinned"


@dataclass(frozen=True, slots=True)
class Failure:
    """One query on which an answer was wrong, or missing.

    Attributes
    ----------
    query : Query
        What was asked; its label names the variant.
    who : str
        Whose answer it is.
    against : str
        What it was compared with: retail, or the pins of the case.
    found : tuple of Difference
        The fields that differ; empty if there was no answer.
    error : str
        Why there was no answer.
    around : tuple of str
        Of a walk, the ticks that lead to the difference.
    """

    query: Query
    who: str
    against: str = RETAIL
    found: tuple[Difference, ...] = ()
    error: str = ""
    around: tuple[str, ...] = ()

    @property
    def summary(self) -> str:
        """The first difference, in a line."""
        if self.found:
            return summary_line(self.found[0], self.who, retail=self.against)
        first, _, _log = self.error.partition("\n")
        return f"{self.who} failed: {first}"

    def render(self, case: Case, rerun: str) -> str:
        """Explain the failure in several lines."""
        tick = tick_of(self.found)
        step = case.id if tick is None else step_id(case.id, tick)
        head = f"{step} [{self.query.label}]" if self.query.label != case.id else step
        if not self.found:
            return f"{head}: {case.title}\n\n  {self.who} failed: {self.error}\n\n  rerun: {rerun}"
        return render_failure(
            case=head,
            title=case.title,
            differences=self.found,
            candidate=self.who,
            query=self.query,
            rerun=rerun,
            retail=self.against,
            around=self.around,
        )


@dataclass(slots=True)
class Verdict:
    """What came of a case: how many queries were compared, skipped (and why), and which failed."""

    compared: int = 0
    skipped: Counter[str] = field(default_factory=Counter)
    failures: list[Failure] = field(default_factory=list)


def judge(case: Case, candidate: Candidate, oracle: Candidate) -> Verdict:
    """Ask every query of a case.

    Parameters
    ----------
    case : Case
        Its pins hold for the first query.
    candidate : Candidate
        Who is tested.
    oracle : Candidate
        Who answers for retail.
    """
    verdict = Verdict()
    ask_ahead(candidate, case.queries)
    for index, query in enumerate(case.queries):
        _judge_query(verdict, case if index == 0 else None, query, candidate, oracle)
    return verdict


def _judge_query(
    verdict: Verdict, pinned: Case | None, query: Query, candidate: Candidate, oracle: Candidate
) -> None:
    truth = _answer(verdict, query, oracle)
    if truth is None:
        return
    if pinned is not None and _misses_pins(verdict, pinned, truth, query, oracle.name):
        return
    given = _answer(verdict, query, candidate)
    if given is None:
        return
    verdict.compared += 1
    found = differences(truth.fields, given.fields, op=query.op, zero_signs="distinct")
    if found:
        around = ticks_around(found, (RETAIL, truth.fields), (candidate.name, given.fields))
        verdict.failures.append(Failure(query, candidate.name, found=tuple(found), around=around))
    elif pinned is not None:
        _misses_pins(verdict, pinned, given, query, candidate.name)


def _misses_pins(verdict: Verdict, case: Case, given: Result, query: Query, who: str) -> bool:
    found = pin_differences(case.expect, given.fields, op=query.op)
    if found:
        around = ticks_around(found, (who, given.fields))
        verdict.failures.append(Failure(query, who, PIN, tuple(found), around=around))
    return bool(found)


def _answer(verdict: Verdict, query: Query, who: Candidate) -> Result | None:
    outcome: Outcome = who.answer(query)
    match outcome:
        case Skipped(reason):
            verdict.skipped[f"{who.name}: {reason}"] += 1
        case Errored(context):
            verdict.failures.append(Failure(query, who.name, error=context))
        case Result():
            return outcome
    return None
