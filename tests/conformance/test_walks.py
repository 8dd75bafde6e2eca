"""Pins of walks, what a tick is once nothing is left out, and how the first diverging tick is told."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import strategies as st

from conformance.candidates.registry import make_candidate
from conformance.case_walk_pins import make_walk_pins
from conformance.compare import pin_differences
from conformance.found import write_found
from conformance.loader import Vary, load_paths
from conformance.outputs import OUTPUTS
from conformance.pins import Pin, Ticks
from conformance.query import Fields, Outcome, Query, Result
from conformance.random_run import DisagreementError, RandomRun, ask_at_random
from conformance.report.scene import scene_line
from conformance.report.ticks import step_id, tick_of, ticks_around
from conformance.step_outputs import STEP_OF, STEP_OUTPUTS, start_of, steps
from conformance.verdict import judge

if TYPE_CHECKING:
    from conformance.case import Case

START = {"cell": 7, "origin": [1.0, 2.0, 3.0], "rotation": [1.0, 0.0, 0.0, 0.0]}
FLOOR = [0.0, 0.0, 1.0, -3.0]
LANDED = {"r": 1, "t": "A1", "pos": [1.0, 2.0, 2.5], "cp": FLOOR, "cp_cell": 7, "onw": 1}
WALKS = Path(__file__).parents[2] / "conformance" / "cases" / "walks"


def walk_query(ticks: int) -> Query:
    """Return a walk of some ticks."""
    return Query("walk", {"start": START, "ticks": [{"move": [0.0, 0.0, 0.0]}] * ticks})


def walked(op: str, start: Fields, *ticks: dict[str, Any]) -> list[Fields]:
    """Return what the mover is after each tick."""
    return list(steps(op, start, ticks))


def test_a_recorded_move_that_fails_changes_nothing() -> None:
    """Place, plane and ground stay; the tick's own collision is its own."""
    start = start_of(walk_query(0))
    first, failed, still = walked(
        "walk", start, {**LANDED, "cn": [0.0, 1.0, 0.0]}, {"r": 0, "t": "K2"}, {"r": "skip"}
    )
    assert (first["outcome"], failed["outcome"], still["outcome"]) == ("moved", "failed", "still")
    for step in (first, failed, still):
        assert (step["position"], step["cell"]) == ([1.0, 2.0, 2.5], 7)
        assert (step["contact"], step["on_walkable"], step["contact_plane"]) == (1, 1, FLOOR)
    assert (first["collision_normal"], failed["collision_normal"]) == ([0.0, 1.0, 0.0], None)
    assert (first["trace"], failed["trace"], still["trace"]) == ("A1", "K2", "")


def test_a_recorded_move_that_succeeds_changes_everything() -> None:
    """A plane or a normal that the tick does not give is gone; another cell is given in every tick."""
    start = start_of(walk_query(0))
    first, second, third = walked(
        "walk",
        start,
        {**LANDED, "sn": [1.0, 0.0, 0.0], "cell": 8},
        {"r": 1, "t": "", "pos": [1.0, 2.0, 2.0], "cell": 8},
        {"r": 1, "t": "", "pos": [1.0, 2.0, 2.0]},
    )
    assert (first["cell"], second["cell"], third["cell"]) == (8, 8, 7)
    assert (first["sliding_normal"], second["sliding_normal"]) == ([1.0, 0.0, 0.0], None)
    assert (second["contact"], second["on_walkable"], second["contact_plane"]) == (0, 0, None)


def test_a_world_walk_keeps_its_cell() -> None:
    """A world gives the cell only when it has changed; water and touched objects are those of each tick."""
    start = start_of(Query("world_walk", {"start": START}))
    ticks = [
        {**LANDED, "cell": 8, "water": 1, "objs": [5]},
        {**LANDED},
        {"r": 0, "t": ""},
        {**LANDED, "cell": 7},
        {**LANDED},
    ]
    found = list(steps("world_walk", start, ticks))
    assert [step["cell"] for step in found] == [8, 8, 8, 7, 7]
    assert [step["water"] for step in found] == [1, 0, 0, 0, 0]
    assert [step["objects"] for step in found] == [[5], [], [], [], []]


def test_a_body_says_what_has_changed() -> None:
    """The plane stays while the contact bit is set, and comes back with it; the cell stays."""
    body = {"position": START, "transient_state": 0x81, "contact_plane": FLOOR, "contact_plane_cell": 7}
    start = start_of(Query("body_walk", {"body": body, "ticks": []}))
    at_rest = {"r": "still", "pos": [1.0, 2.0, 3.0], "v": [0.0, 0.0, 0.0], "ts": 0x83}
    first, second, third = walked(
        "body_walk", start, {**at_rest, "cell": 9}, {**at_rest, "ts": 0x80}, {**at_rest, "ts": 0x81}
    )
    assert (first["contact_plane"], second["contact_plane"], third["contact_plane"]) == (FLOOR, None, FLOOR)
    assert (first["on_walkable"], second["on_walkable"], third["on_walkable"]) == (1, 0, 0)
    assert [step["cell"] for step in (first, second, third)] == [9, 9, 9]


@pytest.mark.parametrize("op", sorted(STEP_OF))
def test_every_field_of_a_step_can_be_pinned(op: str) -> None:
    """What is said of a tick is exactly what its shape has."""
    tick = {"r": 1, "pos": [1.0, 2.0, 3.0], "v": [0.0, 0.0, 0.0], "ts": 0}
    body = {"position": START}
    (step,) = walked(
        op, start_of(Query(op, {"start": START, "body": body if op == "body_walk" else {}})), tick
    )
    assert step.keys() == STEP_OUTPUTS[STEP_OF[op]].fields.keys()
    assert op in OUTPUTS


def test_the_first_tick_that_misses_a_pin_is_told() -> None:
    """All that it misses, and nothing of later ticks."""
    expect = {
        "always": {"from": 1, "contact_plane.d": -3, "on_walkable": True},
        "at": [{"tick": 3, "cell": 9}],
    }
    pins, faults = make_walk_pins("walk", expect, walk_query(4))
    assert faults == []
    lost = {**LANDED, "cp": [0.0, 0.0, 1.0, 0.0], "onw": 0}
    found = pin_differences(pins, {"ticks": [LANDED, LANDED, lost, lost]}, op="walk")
    assert [(d.path, d.name) for d in found] == [
        ("ticks[2].contact_plane[3]", "tick 2: contact_plane.d"),
        ("ticks[2].on_walkable", "tick 2: on_walkable"),
    ]
    (last,) = pin_differences(pins, {"ticks": [lost, LANDED, LANDED, LANDED]}, op="walk")
    assert (last.name, last.retail, last.candidate) == ("tick 3: cell", 9, 7)


def test_a_pinned_tick_must_be_there() -> None:
    """A walk that ends early has missed what is pinned behind its end."""
    pin = Pin("on_walkable", 1, ticks=Ticks(0, 2, start_of(walk_query(3))))
    (missed,) = pin_differences([pin], {"ticks": [LANDED, LANDED]}, op="walk")
    assert missed.name == "tick 2: on_walkable"
    assert str(missed.candidate) == "(absent)"


def test_ticks_about_a_difference() -> None:
    """Two before and the one that differs; what is equal is written once."""
    pins, _ = make_walk_pins("walk", {"always": {"on_walkable": True}}, walk_query(4))
    right, wrong = {"ticks": [LANDED] * 4}, {"ticks": [LANDED, LANDED, LANDED, {"r": 0, "t": "K"}]}
    lost = {"ticks": [LANDED, LANDED, LANDED, {**LANDED, "onw": 0}]}
    found = pin_differences(pins, lost, op="walk")
    assert tick_of(found) == 3
    lines = ticks_around(found, ("retail", right), ("mine", wrong))
    equal = (
        "outcome 1, trace A1, position (1.0, 2.0, 2.5), contact_plane (0.0, 0.0, 1.0, -3.0), "
        "contact_plane_cell 0x00000007, on_walkable 1"
    )
    assert lines == (
        f"  tick 1: {equal}",
        f"  tick 2: {equal}",
        f"  tick 3: retail: {equal}",
        "  tick 3: mine: outcome 0, trace K",
    )
    assert tick_of([]) is None
    assert step_id("cottage", 17) == "cottage#17"
    assert ticks_around([], ("retail", right)) == ()


def test_the_scene_of_a_walk() -> None:
    """How many ticks, and from where."""
    assert scene_line(walk_query(3)) == "walk; 3 ticks from (1.0, 2.0, 3.0)"


class Sinking:
    """The oracle, with a contact plane that is lost at one tick."""

    name = "sinking"

    def answer(self, query: Query) -> Outcome:
        """Answer as retail does, but for tick 20."""
        answer = make_candidate("oracle").answer(query)
        assert isinstance(answer, Result)
        ticks = list(answer.fields["ticks"])
        ticks[20] = {**ticks[20], "cp": [0.0, 0.0, 1.0, 0.0]}
        return Result({"ticks": ticks})


@pytest.fixture(scope="module")
def entry() -> Case:
    """Return the built-in walk into a cottage, as written."""
    cases = load_paths([WALKS / "entry.yaml"], Vary(poses=0)).cases
    return next(case for case in cases if case.id == "walk-cottage-entry")


def test_the_first_diverging_tick_of_a_case_is_named(entry: Case) -> None:
    """Its id, its number and field, and the ticks that lead to it."""
    (failure,) = judge(entry, Sinking(), make_candidate("oracle")).failures
    assert failure.summary.startswith("tick 20: contact_plane.d: retail -94.0 (0xC2BC0000), sinking 0.0")
    text = failure.render(entry, "pytest x")
    assert text.startswith("walk-cottage-entry#20: From the porch")
    assert "\n  tick 18: outcome 1," in text
    assert "\n  tick 20: sinking: outcome 1," in text
    assert "tick 21" not in text


def test_retail_itself_must_meet_the_pins_of_a_walk(entry: Case) -> None:
    """A pin that the oracle misses is told like any other."""
    (failure,) = judge(entry, make_candidate("oracle"), Sinking()).failures
    assert failure.summary.startswith("tick 20: contact_plane.d: pinned -94.0 (0xC2BC0000), sinking 0.0")


def test_a_walk_that_is_found_can_be_asked_again(entry: Case, tmp_path: Path) -> None:
    """Kept as a case it has the same inputs, and the same answer."""
    path = write_found(tmp_path, entry.queries[0], [], candidate="sinking", provenance="a test")
    loaded = load_paths([path])
    assert loaded.problems == ()
    (found,) = loaded.cases
    assert found.queries[0].inputs == entry.queries[0].inputs
    assert judge(found, Sinking(), make_candidate("oracle")).failures[0].summary.startswith("tick 20: ")


def test_a_random_walk_that_fails_shows_its_ticks(entry: Case) -> None:
    """The run keeps the ticks that lead to the difference, for the explanation."""
    run = RandomRun()
    walk = st.just(entry.queries[0])
    with pytest.raises(DisagreementError, match=r"tick 20: contact_plane\.d"):
        ask_at_random(walk, Sinking(), make_candidate("oracle"), name="walk", multiple=0.01, run=run)
    assert [line.split(": ")[0] for line in run.around] == [
        "  tick 18",
        "  tick 19",
        "  tick 20",
        "  tick 20",
    ]
