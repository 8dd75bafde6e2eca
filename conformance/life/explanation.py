"""What retail does in a case: the steps it takes, what they write, and what the case cites of them."""

from __future__ import annotations

import copy
import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.life.steps_taken import RetailCall, watch
from conformance.retail_index import cited_steps
from conformance.step_outputs import STEP_OF
from conformance.traced import answer_traced
from oracle.writes import TOPICS

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from conformance.life.steps_taken import Item, Say
    from conformance.query import Outcome, Query
    from conformance.trace_text import Entry

TICKS: Final = "ticks"
"""The input of a walk that lists its ticks."""

_RANGE: Final = re.compile(r"([A-Z][A-Z0-9]*-)(\d+)\s*(?:…|\.\.\.)\s*(?:[A-Z][A-Z0-9]*-)?(\d+)")


class NoTickError(LookupError):
    """A walk has fewer ticks, or none was chosen, or a case is no walk."""


@dataclass(frozen=True, slots=True)
class Explanation:
    """What retail did.

    Attributes
    ----------
    outcome : Outcome
        The answer; with a tick, that of the walk up to it.
    items : sequence of Step or RetailCall
        The outermost calls of retail, in order.
    entries : sequence of Entry
        What was written meanwhile, and calls of trees.
    """

    outcome: Outcome
    items: Sequence[Item]
    entries: Sequence[Entry]

    @property
    def functions(self) -> frozenset[str]:
        """The functions of retail that ran."""
        return frozenset(call.function for call in _calls(self.items))


def explain(query: Query, tick: int | None = None, say: Say | None = None) -> Explanation:
    """Ask the oracle and tell what it does.

    Parameters
    ----------
    query : Query
        What is asked.
    tick : int, optional
        Of a walk, the tick to tell of: what the walk up to it does, and the walk before it does not. A walk
        of one tick needs none.
    say : callable, optional
        Is told how far it has come.

    Raises
    ------
    NoTickError
        There is no such tick, or the query is a walk of several and none is given.
    """
    ticks = query.inputs[TICKS] if query.op in STEP_OF else ()
    if tick is None and not ticks:
        return _run(query, say)
    if not ticks:
        raise NoTickError(f"{query.label} has no ticks: it is no walk")
    if len(ticks) == 1 and tick is None:
        tick = 0
    if tick is None or tick >= len(ticks):
        raise NoTickError(f"{query.label} has {len(ticks)} ticks: choose one with --tick 0…{len(ticks) - 1}")
    before, whole = _run(_of_ticks(query, tick), say), _run(_of_ticks(query, tick + 1), say)
    return Explanation(whole.outcome, whole.items[len(before.items) :], whole.entries[len(before.entries) :])


def _run(query: Query, say: Say | None) -> Explanation:
    _, entries = answer_traced(OracleCandidate(), query, TOPICS)
    outcome, items = watch(_afresh(query), say)
    return Explanation(outcome, items, entries)


def _afresh(query: Query) -> Query:
    """Copy a query, so that its scene is not one that the oracle has built before: that is part of a run."""
    geometries = {name: replace(geometry) for name, geometry in query.geometries.items()}
    return replace(query, inputs=copy.deepcopy(query.inputs), geometries=geometries)


def _of_ticks(query: Query, count: int) -> Query:
    return replace(query, inputs={**query.inputs, TICKS: query.inputs[TICKS][:count]})


def _calls(items: Iterable[Item]) -> Iterator[RetailCall]:
    for item in items:
        if isinstance(item, RetailCall):
            yield item
            yield from _calls(item.items)


class Citations:
    """What a case cites: functions of retail, some of them with steps.

    Parameters
    ----------
    retail : iterable of str
        ``FUNCTION`` or ``FUNCTION STEPS``, as cases have them.
    """

    def __init__(self, retail: Iterable[str]) -> None:
        steps: dict[str, list[str]] = {}
        for citation in retail:
            function, _, cited = citation.partition(" ")
            steps.setdefault(function, []).extend(_each(cited))
        self._steps: Mapping[str, list[str]] = steps

    def has_function(self, function: str) -> bool:
        """Tell whether a function is cited."""
        return function in self._steps

    def has_step(self, function: str, label: str) -> bool:
        """Tell whether a step is cited: by its label, or ``§4.2`` for the sections of ``07 4.2``."""
        cited = self._steps.get(function, ())
        return any(_covers(one, name) for one in cited for name in label.split(", "))

    def missing(self, functions: frozenset[str]) -> list[str]:
        """List the cited functions that are not among those that ran."""
        return [function for function in self._steps if function not in functions]


def _each(text: str) -> list[str]:
    """Write out ranges: ``SD-1…SD-3`` is three steps."""

    def written_out(match: re.Match[str]) -> str:
        return ", ".join(f"{match[1]}{number}" for number in range(int(match[2]), int(match[3]) + 1))

    return cited_steps(_RANGE.sub(written_out, text))


def _covers(cited: str, label: str) -> bool:
    name = label.rpartition(" ")[2]
    if not cited.startswith("§"):
        return cited == name
    return name == cited[1:] or name.startswith(f"{cited[1:]}.")
