"""The pages of a gate's cases, for the report that people look at."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.report.html.entries import Entry, Judge
from conformance.report.html.library import MissingVizError, plotly_source
from conformance.report.html.page import Report, page
from conformance.report.html.view import views_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.case import Case
    from conformance.gate.parties import Parties
    from conformance.verdict import Verdict

MOST_PAGES: Final = 50
"""Failing cases that have a page each; for a page its case is asked once more."""
_TOPICS: Final = ("cp-write",)


class Pages:
    """Gathers what came of cases while the candidate can still be asked.

    Parameters
    ----------
    parties : Parties
    """

    def __init__(self, parties: Parties) -> None:
        self._judge = Judge(parties.candidate, parties.oracle, _TOPICS, only_failed=True)
        self._candidate = parties.spec
        self._entries: list[Entry] = []
        self._told = 0

    def add(self, case: Case, verdict: Verdict) -> None:
        """Keep a case; one that was answered wrongly gets a page, one that was not answered does not."""
        if self._told < MOST_PAGES and any(failure.found for failure in verdict.failures):
            self._told += 1
            self._entries.append(self._judge.told(case, verdict))
        else:
            self._entries.append(Entry(case, verdict))

    def html(self, complaints: list[str]) -> str:
        """Write the report; empty if no case was asked."""
        if not self._entries:
            return ""
        views, library = self._scenes()
        report = Report(self._candidate, self._entries, complaints=complaints, views=views, library=library)
        return page(report)

    def _scenes(self) -> tuple[Mapping[str, dict[str, Any]] | None, str]:
        """Return the 3-D views of the pages, and the library that shows them, if it is installed."""
        if not self._told:
            return None, ""
        try:
            library = plotly_source()
        except MissingVizError:
            return None, ""
        return views_of(self._entries, self._candidate), library
