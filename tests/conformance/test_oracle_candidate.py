"""The oracle as a candidate: what it covers, and that it never raises."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from own_queries import own_queries
from shipped_vectors import FILES, VECTORS, library, records

from conformance.candidates.oracle_candidate import OPS, OracleCandidate
from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.candidates.oracle_ops.state_block import geometry_of
from conformance.fields import normalise
from conformance.own_operations import OWN_OUTPUTS
from conformance.query import Errored, Query, Result, Skipped

if TYPE_CHECKING:
    from conformance.vector_io import VectorRecord


def test_an_operation_without_a_port_is_skipped() -> None:
    """The reason names the operation."""
    outcome = OracleCandidate().answer(Query(op="swim", inputs={}))
    assert outcome == Skipped("not ported yet: operation swim")


def transition_record() -> VectorRecord:
    """Return a shipped transition in one cell."""
    return next(r for r in records(VECTORS / "transition.jsonl") if len(r.query.inputs["cells"]) == 1)


def test_a_failure_is_an_error_that_says_where() -> None:
    """A query that names no geometry fails inside; the last place is told, nothing is raised."""
    outcome = OracleCandidate().answer(Query("transition", transition_record().query.inputs))
    assert isinstance(outcome, Errored)
    assert outcome.context.startswith("KeyError")
    assert "scene.py" in outcome.context


def test_answers_do_not_depend_on_what_was_asked_before() -> None:
    """The same query twice, with others in between, gives the same answer."""
    oracle = OracleCandidate()
    asked = records(VECTORS / "find_collisions.jsonl")[:40]
    first = [oracle.answer(record.query) for record in asked]
    assert [oracle.answer(record.query) for record in reversed(asked)][::-1] == first


def test_the_oracle_covers_every_operation() -> None:
    """Whatever a shipped record asks, and the suite's own operations."""
    asked = {record.query.op for path in FILES for record in records(path)}
    assert not asked & OWN_OUTPUTS.keys()
    assert asked | OWN_OUTPUTS.keys() == OPS.keys()


@pytest.mark.parametrize("op", sorted(OWN_OUTPUTS))
def test_own_operations_answer_with_their_fields(op: str) -> None:
    """The fields of their shape, plain numbers, and the same when asked again: no world is changed."""
    oracle, query = OracleCandidate(), own_queries()[op]
    outcome = oracle.answer(query)
    assert isinstance(outcome, Result), outcome
    assert normalise(op, outcome.fields) == outcome.fields
    assert oracle.answer(query) == outcome


def test_a_polygon_is_found_in_its_geometry() -> None:
    """`walkable_geometry` is found by identity; a polygon of nothing is an error."""
    first, second = library().geometries["seed_tri"], library().geometries["seed_tri_front"]
    walkable = oracle_geometry(second).polygons[0]
    assert geometry_of(walkable, [first, second]) == "seed_tri_front"
    with pytest.raises(LookupError, match="no geometry"):
        geometry_of(walkable, [first])
