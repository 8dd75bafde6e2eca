"""Failures found at random become cases that load again and ask the same."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from shipped_vectors import one_of_each

from conformance.candidates.registry import make_candidate
from conformance.compare import Difference, differences
from conformance.found import found_cases_dir, found_document, retail_function, write_found
from conformance.inputs import REQUIRED
from conformance.loader import load_file
from conformance.query import Result
from conformance.retail_index import check_citation
from conformance.shapes import Kind

if TYPE_CHECKING:
    from conformance.vector_io import VectorRecord

FOUND_OPS = tuple(list(REQUIRED)[: list(REQUIRED).index("cross_cells") + 1])
"""What random queries ask of parts 1 and 2, the walks (which replay tick by tick) left out."""
D_LOST = Difference("contact_plane.plane[3]", "contact_plane.d", Kind.FLOAT32, -94.0, 0.0)


def records() -> list[VectorRecord]:
    """Return one shipped record of each operation of parts 1 and 2, walks left out."""
    found: dict[str, VectorRecord] = {}
    for record in one_of_each():
        if record.query.op in FOUND_OPS:
            found.setdefault(record.query.op, record)
    assert len(found) == len(FOUND_OPS) == 67
    return list(found.values())


def test_the_folder() -> None:
    """Found cases live below the project's root."""
    assert found_cases_dir(Path("project")) == Path("project/.conformance/found")


@pytest.mark.parametrize("record", records(), ids=lambda record: record.query.op)
def test_a_found_case_asks_the_same(record: VectorRecord, tmp_path: Path) -> None:
    """Written, loaded and asked again, the query gives the same answer, bit for bit."""
    path = write_found(tmp_path, record.query, [D_LOST], candidate="engine", provenance="a test")
    loaded = load_file(path)
    assert [str(problem) for problem in loaded.problems] == []
    (case,) = loaded.cases
    assert case.id == path.stem
    (query,) = case.queries
    assert query.op == record.query.op
    answer = make_candidate("oracle").answer(query)
    assert isinstance(answer, Result)
    assert differences(record.expected, answer.fields, op=query.op, zero_signs="equal") == []


def test_the_same_failure_is_the_same_file(tmp_path: Path) -> None:
    """A file is named by what is asked, not by when or by whom; other queries get other files."""
    first, second = records()[:2]
    one = write_found(tmp_path, first.query, [D_LOST], candidate="engine", provenance="a test")
    same = write_found(tmp_path, first.query, [], candidate="bug:x", provenance="another")
    other = write_found(tmp_path, second.query, [], candidate="engine", provenance="a test")
    assert one == same
    assert other != one
    assert sorted(tmp_path.iterdir()) == sorted({one, other})


def test_provenance_is_told() -> None:
    """The case says who found it, with which candidate, and what differed first."""
    query = records()[0].query
    document = found_document(query, [D_LOST], candidate="engine", provenance="test_x, profile ci")
    assert document["why"].startswith(
        "Found by test_x, profile ci, candidate engine. First difference: contact_plane.d: retail -94.0"
    )
    crashed = found_document(query, [], candidate="engine", provenance="test_x, profile ci")
    assert "First difference: engine failed to answer." in crashed["why"]


@pytest.mark.parametrize("op", [*FOUND_OPS, "walk", "world_walk", "body_walk"])
def test_operations_cite_their_retail_function(op: str) -> None:
    """Every operation that is asked at random has a function that the specification knows."""
    check_citation(retail_function(op))
