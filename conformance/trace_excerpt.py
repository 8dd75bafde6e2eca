"""Asking a failed query once more, to show who wrote what about the place where it went wrong."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from conformance.query import Result
from conformance.report.excerpts import compared_writes, lone_writes
from conformance.report.ticks import tick_of
from conformance.trace_text import line_of
from conformance.traced import Traceable, answer_traced

if TYPE_CHECKING:
    from collections.abc import Collection

    from conformance.candidates.base import Candidate
    from conformance.compare import Difference
    from conformance.query import Query

_TICKS: Final = "ticks"
_TRACED: Final = ("trace", _TICKS)
"""Outputs of the operations that make calls of trees: only their writes mean something."""
_CALLS: Final = "t"
"""Output of a tick that has run a transition."""


def excerpt(
    query: Query,
    found: Collection[Difference],
    oracle: Candidate,
    candidate: Candidate,
    topics: Collection[str],
) -> tuple[str, ...]:
    """Write what retail and a candidate wrote in a query or, of a walk, in the first tick that differs.

    Parameters
    ----------
    query : Query
        What was asked.
    found : collection of Difference
        Where the answer was wrong.
    oracle, candidate : Candidate
        Who answers for retail, and who was wrong.
    topics : collection of str
        Which of `oracle.writes.TOPICS` to show.

    Returns
    -------
    tuple of str
        At most 30 lines; none for an operation that calls no tree.
    """
    tick = tick_of(tuple(found))
    asked = query if tick is None else _until(query, tick)
    truth = _writes(oracle, asked, tick, topics)
    if truth is None:
        return ()
    where = "writes" if tick is None else f"writes in tick {tick}"
    what = f"{where} ({', '.join(topics)})"
    if candidate is oracle:
        return f"  {what}:", *lone_writes(truth)
    given = _writes(candidate, asked, tick, topics)
    if given is None:
        return f"  retail's {what}; {candidate.name} shows none:", *lone_writes(truth)
    return f"  {what}:", *compared_writes(truth, given, candidate.name)


def _until(query: Query, tick: int) -> Query:
    """Leave out the ticks of a walk that follow."""
    return replace(query, inputs={**query.inputs, _TICKS: query.inputs[_TICKS][: tick + 1]})


def _writes(who: Candidate, query: Query, tick: int | None, topics: Collection[str]) -> list[str] | None:
    """Return the lines of a query, or of a tick; None if there is nothing to trace."""
    if not isinstance(who, Traceable):
        return None
    outcome, entries = answer_traced(who, query, topics)
    if not isinstance(outcome, Result) or not any(key in outcome.fields for key in _TRACED):
        return None
    number = None if tick is None else _transition(outcome, tick)
    return [line_of(entry) for entry in entries if number in (None, entry.transition)]


def _transition(outcome: Result, tick: int) -> int:
    """Return the number of a tick's transition; 0, which no transition has, if it has run none."""
    ran = [_CALLS in fields for fields in outcome.fields[_TICKS][: tick + 1]]
    return sum(ran) if len(ran) > tick and ran[tick] else 0
