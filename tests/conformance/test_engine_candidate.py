"""The engine as a candidate: it answers as the oracle does, and never raises."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from shipped_vectors import VECTORS, library, records

from conformance.candidates.engine_candidate import EngineCandidate
from conformance.candidates.engine_ops import running, state_ops
from conformance.candidates.engine_ops.world_cache import engine_shape, sole_world
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.compare import differences
from conformance.query import Errored, Query, Result, Skipped
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from conformance.query import Fields
    from conformance.vector_io import VectorRecord


def fields(candidate: EngineCandidate | OracleCandidate, record: VectorRecord) -> Fields:
    """Return a candidate's answer."""
    outcome = candidate.answer(record.query)
    assert isinstance(outcome, Result)
    return outcome.fields


@pytest.mark.parametrize("file", ["math", "boundary_transition", "boundary_find_collisions"])
def test_engine_and_oracle_agree_on_the_signs_of_zero(file: str) -> None:
    """The vectors take -0 for 0; the engine does not."""
    for record in records(VECTORS / f"{file}.jsonl"):
        retail, answer = fields(OracleCandidate(), record), fields(EngineCandidate(), record)
        assert differences(retail, answer, op=record.query.op, zero_signs="distinct") == []


def test_what_the_engine_does_not_do_is_skipped() -> None:
    """The reason names the operation."""
    outcome = EngineCandidate().answer(Query(op="find_treasure", inputs={}))
    assert outcome == Skipped("the engine does not offer it: operation find_treasure")


def test_what_nobody_knows_is_skipped_by_both_sides() -> None:
    """07 4.6: sphere 0 is 2 metres beside a ball that sphere 1 overlaps, and steps down: root of 2.25 - 4."""
    cell = 0xA9B40100
    ball = {
        "id": 1,
        "pose": pose(cell, 0.0, 0.0),
        "scale": 1.0,
        "state": 0,
        "spheres": [[0.0, 0.0, 0.0, 1.0]],
    }
    mover = {
        "spheres": [[0.0, 0.0, 0.0, 0.5], [-2.0, 0.0, 0.0, 0.5]],
        "scale": 1.0,
        "state": 3,
        "step_up_height": 0.5,
        "step_down_height": 1.5,
        "ethereal": 0,
        "step_down": 1,
        "gravity": 1,
    }
    record = {
        "op": "object_call",
        "function": "object",
        "cell": {"id": cell, "pose": pose(cell, 0.0, 0.0), "geometry": None},
        "objects": [ball],
        "mover": mover,
        "from": pose(cell, 2.0, 3.0),
        "to": pose(cell, 2.0, 1.0),
        "seed": {},
        "path": {"step_down": 1, "step_down_amt": 0.5, "walk_interp": 1.0, "walkable_allowance": 0.5},
    }
    query = query_from_record(record, {})
    for candidate in (OracleCandidate(), EngineCandidate()):
        outcome = candidate.answer(query)
        assert isinstance(outcome, Skipped)
        assert "retail's answer is not known: a step down onto a sphere" in outcome.reason


def pose(cell: int, x: float, z: float) -> Fields:
    """Return a POSE block, not turned."""
    return {"cell": cell, "origin": [x, 0.0, z], "rotation": [1.0, 0.0, 0.0, 0.0]}


def transition_record() -> VectorRecord:
    """Return a shipped transition in one cell."""
    return next(r for r in records(VECTORS / "transition.jsonl") if len(r.query.inputs["cells"]) == 1)


def test_a_mover_may_be_on_land_that_is_not_there() -> None:
    """Its cell id is then one of no landblock; engine and oracle agree on what becomes of it."""
    query = transition_record().query
    outdoors = {**query.inputs["from"], "cell": 0xA9B40001}
    inputs = {**query.inputs, "from": outdoors, "to": {**query.inputs["to"], "cell": 0xA9B40001}}
    outdoors_query = Query(query.op, inputs, query.geometries)
    retail, answer = (c.answer(outdoors_query) for c in (OracleCandidate(), EngineCandidate()))
    assert isinstance(retail, Result)
    assert retail == answer


def test_a_failure_is_an_error_not_an_exception() -> None:
    """A cell that no world can have is told with the engine's own words."""
    query = transition_record().query
    (cell,) = query.inputs["cells"]
    tilted = {**cell, "pose": {**cell["pose"], "rotation": [2.0, 0.0, 0.0, 0.0]}}
    outcome = EngineCandidate().answer(Query(query.op, {**query.inputs, "cells": [tilted]}, query.geometries))
    assert isinstance(outcome, Errored)
    assert "pose, rotation: squared length 4.0 is not 1 within 0.001" in outcome.context


def test_a_scaled_cell_is_an_error() -> None:
    """A cell is tested at scale 1."""
    record = next(r for r in records(VECTORS / "find_collisions.jsonl") if r.query.inputs["as"] == "cell")
    query = Query(record.query.op, {**record.query.inputs, "scale": 2.0}, record.query.geometries)
    outcome = EngineCandidate().answer(query)
    assert isinstance(outcome, Errored)
    assert "a cell is tested at scale 1, not 2.0" in outcome.context


def test_a_geometry_is_compiled_once() -> None:
    """The same geometry object has one shape and one world, however often it is asked about."""
    geometry = library().geometries["ramp_24"]
    assert engine_shape(geometry) is engine_shape(geometry)
    assert sole_world(geometry) is sole_world(geometry)


def test_a_long_trace_is_complete(monkeypatch: pytest.MonkeyPatch) -> None:
    """When there is too little room for a trace, the query is run again with enough."""
    record = max(records(VECTORS / "transition.jsonl"), key=lambda r: len(r.expected["trace"]))
    assert len(record.expected["trace"]) > 20
    monkeypatch.setattr(running, "TRACE_CAPACITY", 3)
    assert state_ops.transition(record.query)["trace"] == record.expected["trace"]
