"""Walks and bodies of the oracle: what a tick writes, and what is skipped."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest
from shipped_vectors import VECTORS, records

from conformance.candidates.engine_candidate import EngineCandidate
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.oracle_ops.body import Body, NamedCell
from conformance.candidates.oracle_ops.body_walk import Recorder, UntrackedBody
from conformance.query import Query, Result, Skipped
from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.errors import NotPortedError
from oracle.physics_object import PhysicsObj
from oracle.physics_state import ETHEREAL_PS, MISSILE_PS
from oracle.position import Position
from oracle.transient_state import ACTIVE_TS, CHECK_ETHEREAL_TS
from oracle.world import World

if TYPE_CHECKING:
    from conformance.query import Fields
    from conformance.vector_io import VectorRecord

TICK = VECTORS / "tick.jsonl"
EIGHTH = 0.125


def first(path: str, **wanted: Any) -> VectorRecord:
    """Return the first shipped record with these inputs."""
    shipped = records(VECTORS / path)
    return next(r for r in shipped if all((key in r.query.inputs) is value for key, value in wanted.items()))


def answer(query: Query, **inputs: Any) -> Fields:
    """Return the oracle's answer to a query with other inputs."""
    outcome = OracleCandidate().answer(Query(query.op, {**query.inputs, **inputs}, query.geometries))
    assert isinstance(outcome, Result), outcome
    return outcome.fields


def body_walk() -> Query:
    """Return a body in cells."""
    return next(r for r in records(TICK) if r.query.op == "body_walk" and "cells" in r.query.inputs).query


def falling(**fields: Any) -> dict[str, Any]:
    """Return a body high above everything."""
    given = body_walk().inputs["body"]
    position = given["position"]
    x, y, z = position["origin"]
    return {**given, "position": {**position, "origin": [x, y, z + 100.0]}, "velocity": [0.0] * 3, **fields}


def test_what_is_not_specified_is_skipped() -> None:
    """A body that would become solid again asks its cells what no document says."""
    query = body_walk()
    body = {**query.inputs["body"], "transient_state": ACTIVE_TS | CHECK_ETHEREAL_TS}
    outcome = OracleCandidate().answer(Query(query.op, {**query.inputs, "body": body}, query.geometries))
    assert isinstance(outcome, Skipped)
    assert "check_collisions" in outcome.reason


def test_gravity_moves_in_the_second_tick() -> None:
    """A body released at rest is still in the first tick; cell, rotation and state are not repeated."""
    steps = answer(body_walk(), body=falling(), ticks=[{"q": EIGHTH}, {"q": EIGHTH}])["ticks"]
    assert [step["r"] for step in steps] == ["still", "moved"]
    assert steps[0]["v"] == [0.0, 0.0, f32(EIGHTH * f32(-9.8))]
    assert steps[1]["t"] == "A1"
    assert {"cell", "rot", "state", "cp", "sn", "cn", "kill"}.isdisjoint(steps[1])


def test_an_inactive_body_is_woken_by_a_velocity() -> None:
    """Both ways of setting one; omega is stored first and written while it is not zero."""
    ticks = [
        {"q": EIGHTH},
        {"q": EIGHTH, "set_velocity": [1.0, 0.0, 0.0]},
        {"q": EIGHTH, "set_local_velocity": [2.0, 0.0, 0.0], "omega": [0.0, 0.0, 1.0]},
    ]
    body = falling(transient_state=0, state=0, acceleration=[0.0] * 3)
    steps = answer(body_walk(), body=body, ticks=ticks)["ticks"]
    assert [step["r"] for step in steps] == ["inactive", "moved", "moved"]
    assert [step["v"][0] for step in steps] == [0.0, 1.0, 2.0]
    assert ["om" in step for step in steps] == [False, False, True]
    assert steps[2]["cv"][0] != 0.0


def test_a_body_without_spheres() -> None:
    """Its name for the tick comes before that of standing still."""
    steps = answer(body_walk(), body=falling(spheres=[]), ticks=[{"q": EIGHTH}])["ticks"]
    assert steps[0]["r"] == "nosphere"


@pytest.mark.parametrize(("move", "r"), [(EPS, "skip"), (2.0 * EPS, 1)])
def test_a_move_within_the_tolerance_only_turns(move: float, r: int | str) -> None:
    """The walker takes the rotation; EPS itself is no move."""
    query = first("walk.jsonl", cells=True).query
    start = {**query.inputs["start"], "origin": [0.0, 0.0, 500.0]}
    half_turn = [0.0, 0.0, 0.0, 1.0]
    ticks = [{"move": [move, 0.0, 0.0], "rotation": half_turn}, {"move": [1.0, 0.0, 0.0]}]
    steps = answer(query, start=start, ticks=ticks)["ticks"]
    assert steps[0]["r"] == r
    assert steps[1]["rot"] == half_turn


def test_a_body_that_leaves_the_loaded_cells_is_lost() -> None:
    """It has no cell any more, and that tick is the last."""
    query = next(r.query for r in records(TICK) if len(r.query.inputs.get("cells", ())) > 1)
    given = query.inputs["body"]
    x, y, z = given["position"]["origin"]
    above = {**given["position"], "origin": [x, y, z + 100.0]}
    body = {**given, "position": above, "velocity": [4.0, 0.0, 0.0]}
    steps = answer(query, body=body, ticks=[{"q": EIGHTH}] * 3)["ticks"]
    assert [step["r"] for step in steps] == ["lost"]


def test_what_a_body_in_cells_touches_is_not_tracked() -> None:
    """A missile that touches an ethereal static stays a missile."""
    body = UntrackedBody({"state": MISSILE_PS}, World())
    ethereal = PhysicsObj(0, ETHEREAL_PS, Position(), scale=1.0, part_array=None)
    made = body.make_transition()
    made.collision_info.collide_object.append(ethereal)
    assert body.handle_all_collisions(made.collision_info, 0, 0) == 0
    assert (body.state, body.collision_table) == (MISSILE_PS, {})


def test_a_position_outside_of_the_body_s_cell() -> None:
    """The cell object is written if its id is not the position's."""
    body = Body({}, World())
    body.cell = NamedCell(7)
    assert Recorder(body).tick({"q": EIGHTH})["cell_object"] == 7
    body.m_position.objcell_id = 7
    assert "cell_object" not in Recorder(body).tick({"q": EIGHTH})


def test_a_body_in_no_cell_is_not_simulated() -> None:
    """Position cell 0: the frame runs, the body only becomes inactive."""
    query = next(r.query for r in records(TICK) if r.query.op == "update_object_gates")
    body = {**query.inputs["body"], "position": {**query.inputs["body"]["position"], "cell": 0}}
    steps = answer(query, body=body, last_update=0.0, update_time=0.0, times=[1.0, 0.5])["steps"]
    assert [step["gate"] for step in steps] == ["run", "reset"]
    assert (steps[0]["quanta"], steps[0]["transient_state"]) == ([], 0)


def test_a_cell_that_only_has_a_name() -> None:
    """Whatever else is asked of it says what is missing."""
    cell = NamedCell(7)
    for question in (
        cell.find_collisions,
        cell.point_in_cell,
        cell.find_transit_cells,
        cell.find_transit_cells_of_parts,
    ):
        with pytest.raises(NotPortedError, match="0x00000007"):
            question()


def test_a_body_s_defaults_are_those_of_a_new_object() -> None:
    """FORMAT.md, BODY."""
    body = Body({}, World())
    assert (body.state, body.transient_state, body.m_position.objcell_id) == (0x400C08, 0, 0)
    assert (body.friction, body.elasticity) == (f32(0.95), f32(0.05))
    assert (body.weenie_obj, body.movement_manager) == (None, None)


def test_a_body_outside_of_the_world_does_not_act() -> None:
    """It is active, and has no cell: nothing happens, in the engine either (06 UO-1)."""
    query = first("tick.jsonl", world=True, ticks=True).query
    position = {**query.inputs["body"]["position"], "cell": 0x7777_0100}
    body = {**query.inputs["body"], "position": position, "transient_state": ACTIVE_TS}
    elsewhere = Query(query.op, {**query.inputs, "body": body, "ticks": [{"q": EIGHTH}]}, query.geometries)
    for candidate in (OracleCandidate(), EngineCandidate()):
        outcome = candidate.answer(elsewhere)
        assert isinstance(outcome, Result), outcome
        assert [step["r"] for step in outcome.fields["ticks"]] == ["inactive"]


def test_a_place_that_is_no_number_is_skipped() -> None:
    """No document says which land cell lies under it (10 2.7, NM-9)."""
    where = {"cell": 0xA9B4_0001, "point": [math.nan, 0.0, 0.0]}
    outcome = OracleCandidate().answer(Query("landdefs_get_outside_lcoord", where, {}))
    assert isinstance(outcome, Skipped), outcome
    assert "nan as a whole number" in outcome.reason
