"""Asking a candidate that can be traced, and what it writes meanwhile."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from oracle.writes import TOPICS

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from contextlib import AbstractContextManager

    from conformance.query import Outcome, Query
    from conformance.trace_text import Entry


class Trace(Protocol):
    """What a recording yields, as `oracle.writes` and `engine.tracing_writes` define it."""

    @property
    def entries(self) -> Sequence[Entry]:
        """Writes and calls of trees, in the order in which they began."""
        ...


@runtime_checkable
class Traceable(Protocol):
    """A candidate that tells who writes contact planes, walkables, sliding normals, state and cells."""

    @property
    def name(self) -> str:
        """How reports call it."""
        ...

    def answer(self, query: Query) -> Outcome:
        """Perform one operation."""
        ...

    def recording(self, topics: Collection[str]) -> AbstractContextManager[Trace]:
        """Record the writes of the operations that are performed in the block."""
        ...


def answer_traced(
    candidate: Traceable, query: Query, topics: Collection[str]
) -> tuple[Outcome, Sequence[Entry]]:
    """Ask a candidate, and return its answer and what it wrote."""
    with candidate.recording(topics) as trace:
        outcome = candidate.answer(query)
    return outcome, trace.entries


class TopicsError(ValueError):
    """A list of topics names one that there is not."""

    def __init__(self, topic: str) -> None:
        nearest = get_close_matches(topic, TOPICS, n=1)
        hint = f" Did you mean {nearest[0]!r}?" if nearest else ""
        super().__init__(f"unknown topic {topic!r}.{hint} There are: {', '.join(TOPICS)}")


def parse_topics(text: str) -> tuple[str, ...]:
    """Read topics separated by commas; raises `TopicsError`."""
    topics = tuple(topic.strip() for topic in text.split(","))
    for topic in topics:
        if topic not in TOPICS:
            raise TopicsError(topic)
    return topics
