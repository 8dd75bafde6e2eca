"""Segments of a walk become ticks: moves, held inputs, points to head for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from conformance.loader import load_file

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.case import Case
    from conformance.source import Problem

WALK = """\
id: walk
title: A walk
why: To be loaded.
retail: [CTransition::find_valid_position]
scene:
  cells:
    - id: 0xA9B40151
      pose: {origin: [10, 20, 94], yaw: 0}
      geometry: {tree: both, shapes: [{floor: {size: [20, 20]}}]}
mover: {spheres: two-spheres, state: [edge_slide]}
query:
  op: walk
  start: {cell: 0xA9B40151, origin: [10, 20, 94], yaw: 0}
  ticks:
    - {still: 2}
expect:
  at: [{tick: 1, outcome: still}]
  always: {contact: false}
"""
BODY = WALK.replace("mover: {spheres: two-spheres, state: [edge_slide]}\n", "").replace(
    "op: walk\n",
    """op: body_walk
  quantum: 0.25
  body: {spheres: one-sphere, state: [gravity], transient_state: [active], acceleration: [0, 0, -9.8]}
""",
)


def loaded(folder: Path, text: str, *segments: str) -> tuple[list[Case], list[Problem]]:
    """Load a walk with other segments."""
    path = folder / "walk.yaml"
    lines = "\n".join(f"    - {segment}" for segment in segments)
    path.write_text(text.replace("    - {still: 2}", lines) if segments else text, encoding="utf-8")
    found = load_file(path)
    return list(found.cases), list(found.problems)


def ticks(folder: Path, text: str, *segments: str) -> list[dict[str, Any]]:
    """Return the ticks of a walk that is right."""
    (case,), problems = loaded(folder, text, *segments)
    assert not problems
    found: list[dict[str, Any]] = case.queries[0].inputs["ticks"]
    return found


def test_a_move_is_repeated(tmp_path: Path) -> None:
    """Each tick is a step of its own; numbers are float32; rotation and contact only where given."""
    found = ticks(
        tmp_path, WALK, "{move: [0, 0.1, 0], times: 2}", "{move: [0, 0, 1], contact_ok: 0, yaw: 180}"
    )
    assert found == [
        *[{"move": [0.0, 0.10000000149011612, 0.0]}] * 2,
        {"move": [0.0, 0.0, 1.0], "contact_ok": 0, "rotation": [0.0, 0.0, 0.0, 1.0]},
    ]


def test_a_point_is_headed_for_from_where_the_moves_lead(tmp_path: Path) -> None:
    """The direction is level and found once a segment, not from where the mover really is."""
    found = ticks(
        tmp_path,
        WALK,
        "{toward: [10, 24], stride: 0.5, times: 8}",
        "{still: 1}",
        "{toward: [13, 24], stride: 1}",
    )
    assert found == [*[{"move": [0.0, 0.5, 0.0]}] * 8, {"move": [0.0, 0.0, 0.0]}, {"move": [1.0, 0.0, 0.0]}]


def test_a_held_input(tmp_path: Path) -> None:
    """A body is set to the velocity in every tick; a tick without input sets nothing."""
    found = ticks(
        tmp_path,
        BODY,
        "{velocity: [0, 4, 0], times: 2, omega: [0, 0, 1]}",
        "{toward: [12, 22], speed: 3}",
        "{still: 1, quantum: 0.125}",
        "{local_velocity: [0, 1, 0]}",
    )
    assert found == [
        *[{"q": 0.25, "omega": [0.0, 0.0, 1.0], "set_velocity": [0.0, 4.0, 0.0]}] * 2,
        {"q": 0.25, "set_velocity": [3.0, 0.0, 0.0]},
        {"q": 0.125},
        {"q": 0.25, "set_local_velocity": [0.0, 1.0, 0.0]},
    ]


def test_a_body_becomes_its_block(tmp_path: Path) -> None:
    """Names become bits, the start its position; what is not given is left to the format's defaults."""
    text = BODY.replace("[active],", "[active, contact], velocity: [1, 0, 0], friction: 0.5,").replace(
        "acceleration: [0, 0, -9.8]",
        "contact: {plane: [0, 0, 1, -94], cell: 0xA9B40151, is_water: false}",
    )
    (case,), problems = loaded(tmp_path, text.replace("contact: false", "contact: true"))
    assert not problems
    body = case.queries[0].inputs["body"]
    assert (body["state"], body["transient_state"]) == (0x400, 0x81)
    assert body["position"]["origin"] == [10.0, 20.0, 94.0]
    assert (body["velocity"], body["friction"]) == ([1.0, 0.0, 0.0], 0.5)
    assert (body["contact_plane"], body["contact_plane_cell"]) == ([0.0, 0.0, 1.0, -94.0], 0xA9B40151)
    assert "acceleration" not in body


def test_walks_are_also_run_in_random_poses(tmp_path: Path) -> None:
    """Four of them; the pins are those of the walk as written."""
    (case,), _ = loaded(tmp_path, WALK)
    assert [query.label for query in case.queries] == ["walk", *(f"walk[pose {n}]" for n in range(1, 5))]
    assert [(pin.path, pin.ticks and (pin.ticks.first, pin.ticks.last)) for pin in case.expect] == [
        ("outcome", (1, 1)),
        ("contact", (0, 1)),
    ]


MISTAKES = {
    "no way to move": (WALK, "{still: 2}", "{times: 3}", "no way to move", "exactly one of"),
    "two ways": (WALK, "{still: 2}", "{still: 2, move: [0, 0, 0]}", "'move', 'still'", "exactly one of"),
    "no stride": (
        WALK,
        "{still: 2}",
        "{toward: [1, 2], times: 3}",
        "'toward'",
        "'toward' and 'stride' together",
    ),
    "no speed": (
        BODY,
        "{still: 2}",
        "{toward: [1, 2], times: 3}",
        "'toward'",
        "'toward' and 'speed' together",
    ),
    "speed of a recorded move": (
        WALK,
        "{still: 2}",
        "{toward: [1, 2], speed: 3}",
        "the unknown key 'speed'",
        "one of",
    ),
    "both counts": (
        WALK,
        "{still: 2}",
        "{still: 2, times: 3}",
        "both 'still' and 'times'",
        "number of ticks",
    ),
    "no ticks": (WALK, "{still: 2}", "{still: 0}", "the number 0", "greater than or equal to 1"),
    "nowhere to go": (
        WALK,
        "{still: 2}",
        "{toward: [10, 20], stride: 1}",
        "the point where",
        "another point",
    ),
    "unknown place": (
        BODY,
        "    - {still: 2}",
        "    - {local_velocity: [0, 1, 0]}\n    - {toward: [0, 0], speed: 1}",
        "a point after a velocity",
        "'velocity'",
    ),
    "unknown state": (BODY, "[gravity]", "[gravitas]", "the text 'gravitas'", "did you mean 'gravity'?"),
    "a start elsewhere": (
        WALK,
        "start: {cell: 0xA9B40151",
        "start: {cell: 0xA9B40199",
        "the cell",
        "a cell of",
    ),
    "a tick beyond the walk": (WALK, "{tick: 1,", "{tick: 2,", "the tick 2", "one of the ticks 0 to 1"),
    "a part beyond the walk": (
        WALK,
        "always: {",
        "always: {from: 7, ",
        "the tick 7",
        "one of the ticks 0 to 1",
    ),
    "a part that ends before": (
        WALK,
        "always: {",
        "always: {from: 1, to: 0, ",
        "from 1 to 0",
        "does not end",
    ),
    "nothing pinned": (WALK, ", outcome: still", "", "no field", "at least one field"),
    "unknown field of a tick": (
        WALK,
        "outcome: still",
        "outcom: still",
        "'outcom'",
        "did you mean 'outcome'?",
    ),
    "field of a wrong type": (WALK, "contact: false", "contact: 2", "2 (int)", "a flag"),
    "neither at nor always": (WALK, "  always:", "  allways:", "'allways'", "did you mean 'always'?"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_located(name: str, tmp_path: Path) -> None:
    """There is one problem, on the line that was changed, and it names the mistake."""
    text, old, new, found, expected = MISTAKES[name]
    assert old in text
    cases, (problem,) = loaded(tmp_path, text.replace(old, new, 1))
    assert cases == []
    assert found in problem.found
    assert expected in f"{problem.expected} {problem.hint}"
    line = text[: text.index(old)].count("\n") + new.count("\n") + 1
    assert problem.location.line == line
