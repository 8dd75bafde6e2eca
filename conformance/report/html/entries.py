"""What the report tells of each case: the verdict, the fields, who wrote what, the scene."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

from conformance.query import Result
from conformance.report.html.rows import differing_rows, other_rows
from conformance.report.ticks import tick_of
from conformance.trace_excerpt import excerpt
from conformance.verdict import PIN, judge

if TYPE_CHECKING:
    from collections.abc import Collection

    from conformance.candidates.base import Candidate
    from conformance.case import Case
    from conformance.query import Fields, Query
    from conformance.report.html.rows import Row
    from conformance.verdict import Failure, Verdict


class Status(Enum):
    """What came of a case, the worst first."""

    FAILED = "failed"
    SKIPPED = "skipped"
    PASSED = "passed"


@dataclass(frozen=True, slots=True)
class Entry:
    """A case and what came of it.

    Attributes
    ----------
    case : Case
        What was asked.
    verdict : Verdict
        What came of all its queries.
    details : Details or None
        Its page; None where only the verdict is wanted.
    """

    case: Case
    verdict: Verdict
    details: Details | None = None

    @property
    def status(self) -> Status:
        """A case fails with one query, and is skipped if none was compared."""
        if self.verdict.failures:
            return Status.FAILED
        return Status.PASSED if self.verdict.compared else Status.SKIPPED


@dataclass(frozen=True, slots=True)
class Details:
    """The page of a case: of its first failing query, or of the case as written.

    Attributes
    ----------
    query : Query
        Which is told of.
    who, against : str
        Whose answer is compared with whose.
    rows : tuple of Row
        Its fields, those that differ first.
    writes : tuple of str
        Who wrote what, about where it went wrong.
    retail, candidate : Fields or None
        The two answers, as far as there are any.
    tick : int or None
        Of a walk, the first that differs.
    """

    query: Query
    who: str
    against: str
    rows: tuple[Row, ...]
    writes: tuple[str, ...]
    retail: Fields | None
    candidate: Fields | None
    tick: int | None


@dataclass(frozen=True, slots=True)
class Judge:
    """Asks cases, and gathers what their pages tell.

    Attributes
    ----------
    candidate, oracle : Candidate
        Who is tested, and who answers for retail.
    topics : collection of str
        Of the writes to show.
    only_failed : bool
        Whether cases that pass have no page.
    """

    candidate: Candidate
    oracle: Candidate
    topics: Collection[str]
    only_failed: bool = False

    def entry(self, case: Case) -> Entry:
        """Ask a case."""
        return self.told(case, judge(case, self.candidate, self.oracle))

    def told(self, case: Case, verdict: Verdict) -> Entry:
        """Add to a verdict what the page of its case shows, by asking once more."""
        if not verdict.failures and self.only_failed:
            return Entry(case, verdict)
        failure = verdict.failures[0] if verdict.failures else None
        return Entry(case, verdict, self._details(failure.query if failure else case.queries[0], failure))

    def _details(self, query: Query, failure: Failure | None) -> Details:
        retail = _fields(self.oracle, query)
        candidate = _fields(self.candidate, query)
        found = failure.found if failure else ()
        if failure and failure.against == PIN:
            answer = retail if failure.who == self.oracle.name else candidate
            columns = (False, True)
        else:
            answer = candidate if retail is None else retail
            columns = (retail is not None, candidate is not None)
        others = other_rows(query.op, answer, found, columns) if answer is not None else []
        return Details(
            query,
            failure.who if failure else self.candidate.name,
            failure.against if failure else "retail",
            (*differing_rows(found), *others),
            self._writes(query, failure),
            retail,
            candidate,
            tick_of(found),
        )

    def _writes(self, query: Query, failure: Failure | None) -> tuple[str, ...]:
        if failure is not None and not failure.found:
            return ()
        of_oracle = failure is None or failure.who == self.oracle.name
        who = self.oracle if of_oracle else self.candidate
        return excerpt(query, failure.found if failure else (), self.oracle, who, self.topics)


def _fields(who: Candidate, query: Query) -> Fields | None:
    outcome = who.answer(query)
    return outcome.fields if isinstance(outcome, Result) else None
