"""From a failing query to the smallest one that fails in the same way, as a case."""

from __future__ import annotations

import time
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, cast

from hypothesis import HealthCheck, Phase, given, settings
from hypothesis.database import InMemoryExampleDatabase
from hypothesis.errors import Flaky

from conformance.candidates.base import close
from conformance.case import Vary
from conformance.found import found_document, found_yaml
from conformance.lint import style_problems
from conformance.loader import load_document
from conformance.soak.asking import judge
from conformance.soak.families import STRATEGIES
from conformance.yaml_source import parse

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.candidates.base import Candidate
    from conformance.query import Query
    from conformance.soak.asking import Verdict
    from conformance.soak.drawing import Drawn
    from conformance.soak.kinds import FailureKind

SHRINK_SECONDS: Final = 60.0
"""How long a failure is shrunk at most; the smallest that was found by then is kept."""


class UnusableCaseError(RuntimeError):
    """A failure, written as a case, is not one that can be read: a mistake of the suite."""


@dataclass(frozen=True, slots=True)
class FoundCase:
    """A failure as a case.

    Attributes
    ----------
    name : str
        Of its file.
    text : str
        What the file holds.
    alone : bool
        Whether the failure shows when the case is asked by itself, of a candidate that was asked nothing
        before.
    """

    name: str
    text: str
    alone: bool


class _TimeIsUpError(BaseException):
    """Ends shrinking; not an `Exception`, so that Hypothesis does not take it for a failure."""


class _SameFailureError(Exception):
    """Tells Hypothesis that a query fails as the one it began with."""


def shrink(
    drawn: Drawn,
    kind: FailureKind,
    oracle: Candidate,
    candidate: Candidate,
    *,
    seconds: float = SHRINK_SECONDS,
) -> tuple[Query, Verdict] | None:
    """Return the smallest query found that fails in the same way, and how; None if it does not fail again.

    Parameters
    ----------
    drawn : Drawn
        The query that failed.
    kind : FailureKind
        In what way.
    oracle, candidate : Candidate
    seconds : float
        After which the search ends.
    """
    deadline = time.monotonic() + seconds
    smallest: list[tuple[Query, Verdict]] = []

    @settings(
        database=InMemoryExampleDatabase(),
        deadline=None,
        derandomize=False,  # as it is on a CI machine otherwise, where no examples are kept
        phases=[Phase.reuse, Phase.shrink],
        print_blob=False,
        report_multiple_bugs=False,
        suppress_health_check=list(HealthCheck),
    )
    @given(STRATEGIES[drawn.family])
    def fails_alike(query: Query) -> None:
        if smallest and time.monotonic() > deadline:
            raise _TimeIsUpError
        verdict = judge(query, oracle, candidate)
        if verdict.kind == kind:
            smallest[:] = [(query, verdict)]
            raise _SameFailureError

    # The first failure goes into the database; Hypothesis then finds it there, and shrinks it. Who answers
    # in another way each time is `Flaky`.
    with suppress(_SameFailureError):
        cast("Any", fails_alike).hypothesis.fuzz_one_input(drawn.raw)
    if smallest:
        with suppress(_SameFailureError, _TimeIsUpError, Flaky):
            fails_alike()
    return smallest[0] if smallest else None


def found_case(
    drawn: Drawn,
    kind: FailureKind,
    oracle: Candidate,
    make: Callable[[], Candidate],
    *,
    provenance: str,
) -> FoundCase:
    """Shrink a failure and write it as a case, which is read and asked once more.

    Parameters
    ----------
    drawn : Drawn
        The query that failed.
    kind : FailureKind
        In what way.
    oracle : Candidate
    make : callable
        Makes a candidate that was asked nothing.
    provenance : str
        What found the failure.

    Raises
    ------
    UnusableCaseError
        The case cannot be read, or `conformance lint` would complain.
    """
    candidate = make()
    try:
        smallest = shrink(drawn, kind, oracle, candidate)
    finally:
        close(candidate)
    query, verdict = smallest or (drawn.query, None)
    document = found_document(
        query,
        verdict.differences if verdict is not None else (),
        candidate=candidate.name,
        provenance=provenance,
        said=verdict.said if verdict is not None else f"{kind}, but not when asked by itself",
    )
    text = found_yaml(document)
    again = _read_back(text, document["id"])
    return FoundCase(f"{document['id']}.yaml", text, _fails(again, kind, oracle, make()))


def _read_back(text: str, name: str) -> Query:
    """Return the query of a case as a run of it would ask it."""
    loaded = load_document(parse(text.encode("utf-8"), f"{name}.yaml"), Vary(poses=0))
    style = [problem for case in loaded.cases for problem in style_problems(case)]
    if loaded.problems or style or len(loaded.cases) != 1:
        raise UnusableCaseError("\n".join(str(problem) for problem in (*loaded.problems, *style)))
    return loaded.cases[0].queries[0]


def _fails(query: Query, kind: FailureKind, oracle: Candidate, candidate: Candidate) -> bool:
    try:
        return judge(query, oracle, candidate).kind == kind
    finally:
        close(candidate)
