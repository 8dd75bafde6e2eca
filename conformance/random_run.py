"""Random queries: asked of retail and a candidate, compared bit for bit, the failing one kept."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from hypothesis import given

from conformance.candidates.base import ask_ahead
from conformance.compare import differences
from conformance.found import write_found
from conformance.profiles import scaled
from conformance.query import Result, Skipped
from conformance.report.text import quoted_spec, render_failure, summary_line
from conformance.report.ticks import ticks_around

if TYPE_CHECKING:
    from pathlib import Path

    from hypothesis.strategies import SearchStrategy

    from conformance.candidates.base import Candidate
    from conformance.compare import Difference
    from conformance.query import Query


class DisagreementError(AssertionError):
    """A candidate answered a random query in another way than retail; says where, and how to ask it again."""


@dataclass(slots=True)
class RandomRun:
    """What came of a strategy's queries.

    Attributes
    ----------
    compared : int
        Queries that both answered, those of shrinking included.
    skipped : Counter of str
        Queries that one of them does not do, by its reason.
    failing : tuple or None
        The last query that failed (after shrinking the smallest), its differences, and the error instead.
    around : tuple of str
        If that was a walk, the ticks that lead to the difference.
    """

    compared: int = 0
    skipped: Counter[str] = field(default_factory=Counter)
    failing: tuple[Query, list[Difference], str] | None = None
    around: tuple[str, ...] = ()

    def counts(self) -> dict[str, Any]:
        """Return the counts as they travel in test reports."""
        return {"random": self.compared, "skipped": dict(self.skipped)}


def ask_at_random(
    queries: SearchStrategy[Query],
    candidate: Candidate,
    oracle: Candidate,
    *,
    name: str,
    multiple: float,
    run: RandomRun,
) -> None:
    """Ask random queries of a strategy until one fails; signs of zero are distinct.

    Parameters
    ----------
    queries : SearchStrategy of Query
        What to ask.
    candidate, oracle : Candidate
        Who is tested, and who answers for retail.
    name : str
        Name of the law; queries of a derandomised profile depend on it.
    multiple : float
        How many times the loaded profile's number of examples.
    run : RandomRun
        Where to count; filled in also when a query fails.

    Raises
    ------
    DisagreementError
        For the smallest failing query that was found.
    """

    def law(query: Query) -> None:
        found, error = _ask(query, candidate, oracle, run)
        if found or error:
            run.failing = (query, found, error)
            raise DisagreementError(summary_line(found[0], candidate.name) if found else error)

    law.__name__ = law.__qualname__ = re.sub(r"\W+", "_", name).strip("_")
    scaled(multiple)(given(queries)(law))()


def explain(run: RandomRun, directory: Path, candidate: Candidate, *, name: str, profile: str) -> str:
    """Keep the failing query of a run as a case and explain it, rerun command included."""
    if run.failing is None:
        raise ValueError(f"{name} has not failed")
    query, found, error = run.failing
    path = write_found(
        directory, query, found, candidate=candidate.name, provenance=f"{name}, profile {profile}"
    )
    title = error or f"{candidate.name} and retail disagree"
    rerun = f'pytest "{path}" --candidate {quoted_spec(candidate.name)}'
    return render_failure(
        case=name,
        title=title,
        differences=found,
        candidate=candidate.name,
        query=query,
        rerun=rerun,
        around=run.around,
    )


def _ask(
    query: Query, candidate: Candidate, oracle: Candidate, run: RandomRun
) -> tuple[list[Difference], str]:
    answers = []
    ask_ahead(candidate, (query,))
    for who in (oracle, candidate):
        outcome = who.answer(query)
        if isinstance(outcome, Skipped):
            run.skipped[f"{who.name}: {outcome.reason}"] += 1
            return [], ""
        if not isinstance(outcome, Result):
            return [], f"{who.name} failed: {outcome.context}"
        answers.append(outcome.fields)
    run.compared += 1
    found = differences(*answers, op=query.op, zero_signs="distinct")
    if found:
        run.around = ticks_around(found, ("retail", answers[0]), (candidate.name, answers[1]))
    return found, ""
