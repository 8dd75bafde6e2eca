"""What a candidate is: a name and an answer to each query."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, runtime_checkable

if TYPE_CHECKING:
    from collections.abc import Sequence

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


@runtime_checkable
class Remote(Protocol):
    """A candidate in a process of its own: it works while retail is computed, and must be stopped."""

    def ask_ahead(self, queries: Sequence[Query]) -> None:
        """Send queries whose answers will be wanted next, in this order."""
        ...

    def close(self) -> tuple[str, ...]:
        """Stop the process, and return what was wrong with how it stopped."""
        ...


def ask_ahead(candidate: Candidate, queries: Sequence[Query]) -> None:
    """Let a candidate that works beside the suite begin with what it will be asked."""
    if isinstance(candidate, Remote):
        candidate.ask_ahead(queries)


def close(candidate: Candidate) -> tuple[str, ...]:
    """End what a candidate has started, and return what was wrong with how it ended."""
    return candidate.close() if isinstance(candidate, Remote) else ()
