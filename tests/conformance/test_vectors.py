"""The oracle gives what retail gave, on every shipped record that its operations cover."""

from __future__ import annotations

import pytest
from shipped_vectors import VECTORS, library

from conformance.candidates.registry import make_candidate
from conformance.verification import verify_file

COVERED = {
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
    "tick.jsonl": 368,
}
SKIPPED = {"tick.jsonl": 47}
"""Bodies that walk in a world of terrain, buildings and objects."""


@pytest.mark.parametrize("file", COVERED)
def test_the_oracle_agrees_with_retail(file: str) -> None:
    """Nothing fails, only what needs a world is skipped, and the advisory records agree too."""
    tally = verify_file(VECTORS / file, make_candidate("oracle"), library())
    assert [failure.record and failure.record.id for failure in tally.failures] == []
    assert all("terrain" in reason for reason in tally.skipped)
    assert tally.skipped.total() == SKIPPED.get(file, 0)
    assert tally.passed + tally.advisory + tally.skipped.total() == COVERED[file]
    assert tally.advisory_agreeing == tally.advisory
