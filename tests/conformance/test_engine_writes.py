"""The engine's trace of writes is the oracle's, line for line, and tracing it changes no answer."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

import pytest
from shipped_cases import shipped_cases
from shipped_vectors import VECTORS, records

from conformance.candidates.engine_candidate import EngineCandidate
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.query import Result
from conformance.report.traces import summary_lines
from conformance.trace_text import line_of
from conformance.traced import answer_traced
from oracle.writes import TOPICS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.case import Case
    from conformance.query import Query
    from conformance.trace_text import Entry

SAMPLED: Final = {
    "find_collisions": 13,
    "boundary_find_collisions": 13,
    "transition": 7,
    "boundary_transition": 7,
    "walk": 15,
    "tick": 17,
    "sphere": 23,
    "cylsphere": 23,
    "objects": 17,
    "world_transition": 17,
    "world_walk": 8,
}
"""Every how many records of a file one is compared."""
FIRST_TICKS: Final = 20
"""Of walks this is not the whole: interpreted, the longest take half a minute."""
CALLING: Final = frozenset(
    {
        "find_collisions",
        "object_call",
        "transition",
        "object_transition",
        "world_transition",
        "walk",
        "world_walk",
        "body_walk",
    }
)
"""Operations that make calls of trees; of others, what prepares them writes."""
CASES = [case for case in shipped_cases().values() if case.op in CALLING]
COMPARED = [case for i, case in enumerate(CASES) if "walk" in case.op or i % 4 == 0]
"""Every walk, and every fourth of the others."""


def sample(file: str) -> list[Query]:
    """Return some records' queries."""
    found = [record.query for record in records(VECTORS / f"{file}.jsonl") if record.query.op in CALLING]
    return found[:: SAMPLED[file]]


def shortened(query: Query) -> Query:
    """Leave out what follows after the first ticks of a walk."""
    if "ticks" not in query.inputs:
        return query
    return replace(query, inputs={**query.inputs, "ticks": query.inputs["ticks"][:FIRST_TICKS]})


def lines(entries: Sequence[Entry]) -> list[str]:
    """Return everything that lines tell, and the number of the transition."""
    return [f"{entry.transition} {line_of(entry, with_foot=True)}" for entry in entries]


def compare(query: Query) -> int:
    """Compare both traces and return how many lines they have."""
    retail, written = answer_traced(OracleCandidate(), query, TOPICS)
    traced, also = answer_traced(EngineCandidate(), query, TOPICS)
    assert isinstance(retail, Result), query.label
    assert repr(traced) == repr(EngineCandidate().answer(query))
    assert lines(also) == lines(written)
    assert summary_lines(also) == summary_lines(written)
    return len(written)


@pytest.mark.parametrize("file", SAMPLED)
def test_engine_and_oracle_write_the_same_lines(file: str) -> None:
    """Values, order, callers and calls of trees are the same in a sample of every file."""
    queries = sample(file)
    assert len(queries) >= 3
    assert sum(compare(shortened(query)) for query in queries) > 2 * len(queries)


@pytest.mark.parametrize("case", COMPARED, ids=lambda case: case.id)
def test_engine_and_oracle_write_the_same_lines_in_cases(case: Case) -> None:
    """The same of cases as they are written, of walks in the first ticks."""
    compare(shortened(case.queries[0]))
