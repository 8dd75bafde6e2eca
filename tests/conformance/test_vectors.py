"""Oracle and engine give what retail gave, on every shipped record."""

from __future__ import annotations

import pytest
from shipped_vectors import VECTORS, library

from conformance.candidates.registry import make_candidate
from conformance.vector_library import GEOMETRY_FILES, WORLD_FILE
from conformance.verification import verify_file

RECORDS = {
    "math.jsonl": 268,
    "polygon.jsonl": 529,
    "bsp.jsonl": 600,
    "find_collisions.jsonl": 851,
    "transition.jsonl": 430,
    "boundary_math.jsonl": 101,
    "boundary_polygon.jsonl": 434,
    "boundary_bsp.jsonl": 240,
    "boundary_find_collisions.jsonl": 398,
    "boundary_transition.jsonl": 191,
    "walk.jsonl": 44,
    "sphere.jsonl": 311,
    "cylsphere.jsonl": 309,
    "objects.jsonl": 201,
    "terrain.jsonl": 360,
    "cells.jsonl": 205,
    "world_transition.jsonl": 221,
    "world_walk.jsonl": 17,
    "tick.jsonl": 368,
}
"""How many records each file has."""


def test_every_file_is_asked() -> None:
    """A file of records that is not in the table above would be asked by nobody."""
    shared = {*GEOMETRY_FILES, WORLD_FILE}
    assert {path.name for path in VECTORS.glob("*.jsonl")} == {*RECORDS, *shared}


@pytest.mark.parametrize("file", RECORDS)
@pytest.mark.parametrize("candidate", ["oracle", "engine"])
def test_a_candidate_agrees_with_retail(candidate: str, file: str) -> None:
    """Nothing fails, nothing is skipped, and the advisory records agree too."""
    tally = verify_file(VECTORS / file, make_candidate(candidate), library())
    assert [failure.record and failure.record.id for failure in tally.failures] == []
    assert tally.skipped.total() == 0
    assert tally.passed + tally.advisory == RECORDS[file]
    assert tally.advisory_agreeing == tally.advisory
