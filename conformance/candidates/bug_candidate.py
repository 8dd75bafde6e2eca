"""A candidate that is the oracle with one mistake."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.own_caches import own_caches
from conformance.candidates.replacements import replaced

if TYPE_CHECKING:
    from collections.abc import Collection
    from contextlib import AbstractContextManager

    from conformance.candidates.replacements import Replacement
    from conformance.query import Outcome, Query
    from oracle.writes import WriteTrace

BUG_PREFIX: Final = "bug:"
"""What the name of such a candidate begins with."""


@dataclass(frozen=True, slots=True)
class KnownBug:
    """A mistake that a port has made.

    Attributes
    ----------
    id : str
        Its name; the candidate is called ``bug:`` and this.
    mistake : str
        What it does, in one sentence.
    retail : str
        What retail does instead, with the steps of the specification that the mistake breaks.
    replacements : tuple of Replacement
        What makes the oracle do it.
    case : str
        Id of the pinned case that is named for catching it.
    output : str
        The first pinned output that it misses there, as reports call it.
    survives : str
        Why cases or random queries need not catch it; empty: both must.
    rated : bool
        Whether it is told how many random queries differ, not only the first.
    """

    id: str
    mistake: str
    retail: str
    replacements: tuple[Replacement, ...] = field(repr=False)
    case: str = ""
    output: str = ""
    survives: str = ""
    rated: bool = False


class BugCandidate:
    """The oracle with one mistake.

    It has its own polygons, trees and worlds: a mistake may concern how they are made.
    """

    def __init__(self, bug: KnownBug) -> None:
        self.bug = bug
        self._oracle = OracleCandidate()
        self._own = own_caches()

    def __repr__(self) -> str:
        return f"BugCandidate({self.bug.id!r}: {self.bug.mistake})"

    @property
    def name(self) -> str:
        """How reports call it."""
        return BUG_PREFIX + self.bug.id

    def answer(self, query: Query) -> Outcome:
        """Perform one operation, wrongly where the mistake matters."""
        with replaced((*self._own, *self.bug.replacements)):
            return self._oracle.answer(query)

    def recording(self, topics: Collection[str]) -> AbstractContextManager[WriteTrace]:
        """Record what every transition that is made in the block writes."""
        return self._oracle.recording(topics)
