"""What a law is, and asking a candidate whether it keeps one."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

from hypothesis import given

from conformance.compare import differences
from conformance.found import write_found
from conformance.profiles import scaled
from conformance.query import Errored, Result
from conformance.report.scene import scene_line
from conformance.report.text import quoted_spec, summary_line

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

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
    multiple : float
        How many times the profile's number of queries it takes: more where few of them can tell.
    """

    name: str
    queries: SearchStrategy[Query]
    breach: Callable[[Query, Ask], str]
    multiple: float = 1.0


class BrokenLawError(AssertionError):
    """A candidate's answers do not belong together as a law says; tells the law and the first difference."""


@dataclass(slots=True)
class LawRun:
    """What a run has asked so far.

    Attributes
    ----------
    compared : int
        Queries of the law that were answered.
    skipped : Counter of str
        Those that were not, by the reason.
    breaking : tuple of Query
        The questions whose answers broke the law, those of the smallest query; none if it was kept.
    """

    compared: int = 0
    skipped: Counter[str] = field(default_factory=Counter)
    breaking: tuple[Query, ...] = ()

    def counts(self) -> dict[str, Any]:
        """Return the counts as they travel in test reports."""
        return {"random": self.compared, "skipped": dict(self.skipped)}


class _UnansweredError(Exception):
    """A question of a law that the candidate does not answer."""


def hold(law: Law, candidate: Candidate, run: LawRun, *, multiple: float = 1.0) -> None:
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
        How many times as many queries as the law takes in the loaded profile.

    Raises
    ------
    BrokenLawError
        For the smallest query that was found; also if the candidate fails to answer one.
    """
    asked: list[Query] = []

    def ask(query: Query) -> Fields:
        asked.append(query)
        outcome = candidate.answer(query)
        if isinstance(outcome, Result):
            return outcome.fields
        if isinstance(outcome, Errored):
            raise BrokenLawError(f"{law.name}: {candidate.name} failed: {outcome.context}")
        run.skipped[f"{candidate.name}: {outcome.reason}"] += 1
        raise _UnansweredError

    def once(query: Query) -> None:
        asked.clear()
        try:
            broken = law.breach(query, ask)
        except _UnansweredError:
            return
        except BrokenLawError:
            run.breaking = tuple(asked)
            raise
        run.compared += 1
        if broken:
            run.breaking = tuple(asked)
            raise BrokenLawError(f"{law.name}: {broken}")

    once.__name__ = once.__qualname__ = re.sub(r"\W+", "_", f"law {law.name}")
    scaled(multiple * law.multiple)(given(law.queries)(once))()


def explain(run: LawRun, directory: Path, candidate: Candidate, *, broken: str, profile: str) -> str:
    """Keep the questions that broke a law as cases, and tell how to ask each of them again.

    Each of the answers may be right by itself: against retail, the cases show which of them is not.

    Parameters
    ----------
    run : LawRun
        One that has ended with a `BrokenLawError`.
    directory : Path
        Where cases are kept; made if it is not there.
    candidate : Candidate
        Who has broken the law.
    broken : str
        The law, and how it was broken.
    profile : str
        Of the queries.
    """
    lines = [broken]
    for number, query in enumerate(run.breaking, start=1):
        provenance = f"question {number} of {len(run.breaking)} of a law, profile {profile}"
        path = write_found(directory, query, (), candidate=candidate.name, provenance=provenance, said=broken)
        lines += ["", f"  question {number}: {scene_line(query)}"]
        lines += [f'  against retail: pytest "{path}" --candidate {quoted_spec(candidate.name)}']
    return "\n".join(lines)


def unlike(op: str, expected: Fields, found: Fields, who: str) -> str:
    """Say where an answer is not what a law makes of another one; the sign of a zero is left open.

    Negating a coordinate turns 0 into -0, and whether a sum of both is one or the other depends on their
    order: no decision of retail sees it.
    """
    wrong = differences(expected, found, op=op, zero_signs="equal")
    return summary_line(wrong[0], who, retail="expected") if wrong else ""
