"""What a candidate is: a name and an answer to each query."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from conformance.query import Outcome, Query


class Candidate(Protocol):
    """Anything that can be tested.

    An implementation never raises for a query it was given: what it cannot do is `Skipped`, what it
    fails at is `Errored`.
    """

    @property
    def name(self) -> str:
        """How reports and rerun commands call it (``engine``, ``oracle``, ``bug:cell-origin``)."""
        ...

    def answer(self, query: Query) -> Outcome:
        """Perform one operation."""
        ...
