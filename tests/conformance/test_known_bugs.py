"""Candidates that are wrong on purpose: wrong where they should be, right elsewhere, and tidy."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
import pytest
from shipped_cases import shipped_cases
from shipped_vectors import VECTORS, library, records

from conformance.candidates import known_bugs
from conformance.candidates.bug_candidate import BugCandidate, KnownBug
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.oracle_ops import geometry
from conformance.candidates.replacements import Method, replaced
from conformance.compare import differences, pin_differences
from conformance.query import Errored, Fields, Query, Result
from oracle import land_block_struct
from oracle.env_cell import EnvCell

CELL = 0xA9B40151
POSE = {"cell": CELL, "origin": [100.0, 50.0, 94.0], "rotation": [0.9238795, 0.0, 0.0, 0.38268343]}
"""Turned by 45 degrees about z, moved to (100, 50, 94)."""
CASES = shipped_cases()
BEYOND = (2838, 13341)
"""A cell outside of the world (2048 a side) that the decimal constant cuts differently; found by search."""
NEIGHBOURS = {
    "cell-origin": "step-down-rests-on-floor",
    "cell-rotation": "origin-step-down-touching",
    "walkable-synthesis": "origin-step-down-touching",
    "vertex-plane": "origin-step-down-touching",
    "renormalised-plane": "origin-step-down-touching",
    "last-known-cell": "transition-walk-on-floor",
    "quaternion-rotation": "origin-step-down-touching",
    "float32-registers": "step-down-rests-on-floor",
    "floor-z-0.66417": "walkable-slope-above-limit",
    "eps-0.00015": "step-down-rests-on-floor",
    "strict-sphere": "bounding-sphere-first-miss",
    "signed-walkable": "check-walkable-edge-equality",
    "edge-test-early-return": "check-walkable-edge-past-equality",
    "path6b-second-sphere": "clipped-hits-wall",
    "placement-keeps-polygon": "initial-placement-two-spheres",
    "neg-normal-sign": "contact-one-sphere-back-face",
    "slide-dead-end-ok": "slide-straight-into-wall",
    "sliding-normal-z": "adjust-offset-sliding-normal",
    "scaled-offset": "step-down-rests-on-floor",
    "step-up-restores-plane": "contact-wall-too-high",
    "no-substep-reset": "transition-fall-and-land",
    "third-step-down": "bug-no-substep-reset",
    "neg-poly-kept": "transition-wall-slide",
    "building-across-border": "bug-cell-list-unpruned",
    "portal-side": "bug-cell-list-unpruned",
    "cell-list-unpruned": "bug-building-across-border",
    "terrain-split-decimal": "bug-building-across-border",
    "cylinder-step-up-unrotated": "cylinder-walker-steps-upon",
    "cylinder-by-bounds": "cylinder-walker-steps-upon",
    "sphere-landing-dry": "sphere-step-down-onto",
    "shape-fall-through": "object-hit-is-recorded",
}
"""For each bug a case that goes the same way and must not notice it."""


def step_down(height: float, *, called_as: str = "cell") -> Query:
    """Ask for a step down of 0.5 with a sphere of 0.48 at a height above the floor triangle."""
    pose = {"cell": CELL, "origin": [100.0, 50.0, 94.0 + height], "rotation": [1.0, 0.0, 0.0, 0.0]}
    mover = {
        "spheres": [[0.0, 0.0, 0.0, 0.48]],
        "scale": 1.0,
        "state": 0,
        "step_up_height": 0.6,
        "step_down_height": 1.5,
        "ethereal": 0,
        "step_down": 1,
        "gravity": 1,
    }
    path = {"step_down": 1, "step_down_amt": 0.5, "walk_interp": 1.0, "walkable_allowance": 0.66417414}
    inputs: dict[str, Any] = {
        "geometry": "seed_tri",
        "pose": POSE,
        "scale": 1.0,
        "as": called_as,
        "mover": mover,
        "from": pose,
        "to": pose,
        "seed": {},
        "path": path,
    }
    return Query("find_collisions", inputs, {"seed_tri": library().geometries["seed_tri"]})


def bug(bug_id: str) -> BugCandidate:
    """Return the candidate of a known bug."""
    return known_bugs.bug_candidates()[f"bug:{bug_id}"]


def fields(candidate: OracleCandidate | BugCandidate, query: Query) -> Fields:
    """Return a candidate's answer."""
    outcome = candidate.answer(query)
    assert isinstance(outcome, Result), outcome
    return outcome.fields


def bits(x: float) -> int:
    """Return the 32 bits of a float32."""
    value: int = struct.unpack("<I", struct.pack("<f", x))[0]
    return value


def test_the_floor_triangle_gives_the_world_plane() -> None:
    """Retail: the plane is in block coordinates, D = -94, and the sphere is lifted to rest."""
    answer = fields(OracleCandidate(), step_down(0.4))
    assert answer["result"] == "ADJUSTED"
    assert answer["contact_plane"]["plane"][:3] == [0.0, 0.0, 1.0]
    assert bits(answer["contact_plane"]["plane"][3]) == 0xC2BC0000
    assert answer["contact_plane"]["cell_id"] == CELL
    assert answer["check"]["origin"][2] == pytest.approx(94.48, abs=1e-4)


def test_out_of_reach_the_floor_triangle_gives_no_plane() -> None:
    """Retail: half a metre above, a sphere of 0.48 touches nothing."""
    answer = fields(OracleCandidate(), step_down(0.5))
    assert (answer["result"], answer["contact_plane"]) == ("OK", {"valid": 0})


def test_cell_origin_leaves_the_plane_in_cell_space() -> None:
    """The only field that differs is the plane's constant: 0 where retail has -94."""
    query = step_down(0.4)
    found = differences(
        fields(OracleCandidate(), query),
        fields(bug("cell-origin"), query),
        op="find_collisions",
        zero_signs="equal",
    )
    assert [(d.name, d.retail, d.candidate) for d in found] == [("contact_plane.d", -94.0, 0.0)]


def test_cell_origin_leaves_the_object_call_right() -> None:
    """As a static's part the same geometry gives retail's plane."""
    query = step_down(0.4, called_as="static")
    assert fields(bug("cell-origin"), query) == fields(OracleCandidate(), query)


def test_cell_origin_is_caught_by_many_vectors() -> None:
    """Whole transitions spread it: more than half of the shipped ones differ."""
    shipped = [r for r in records(VECTORS / "transition.jsonl") if not r.uncertain]
    wrong = 0
    for record in shipped:
        answer = fields(bug("cell-origin"), record.query)
        wrong += bool(differences(record.expected, answer, op="transition", zero_signs="equal"))
    assert wrong > len(shipped) / 2


@pytest.mark.parametrize("known", [b for b in known_bugs.list_bugs() if b.case], ids=lambda b: b.id)
def test_a_bug_is_caught_by_its_case(known: KnownBug) -> None:
    """Retail meets every pin of it; the bug answers, and misses the named output first."""
    case = CASES[known.case]
    retail = fields(OracleCandidate(), case.queries[0])
    wrong = fields(BugCandidate(known), case.queries[0])
    assert pin_differences(case.expect, retail, op=case.op) == []
    assert [d.name for d in pin_differences(case.expect, wrong, op=case.op)][:1] == [known.output]


@pytest.mark.parametrize("known", known_bugs.list_bugs(), ids=lambda b: b.id)
def test_a_bug_is_right_where_its_mistake_does_not_matter(known: KnownBug) -> None:
    """It is one mistake: on a case close by every output is retail's, to the bit."""
    case = CASES[NEIGHBOURS[known.id]]
    retail = fields(OracleCandidate(), case.queries[0])
    given = fields(BugCandidate(known), case.queries[0])
    assert differences(retail, given, op=case.op, zero_signs="distinct") == []


def test_last_known_cell_is_caught_by_vectors() -> None:
    """The ground truth of a tick's seeding shows where the cell's id goes, and nothing else differs."""
    found = {}
    for record in records(VECTORS / "tick.jsonl"):
        if record.query.op == "seed":
            answer = fields(bug("last-known-cell"), record.query)
            wrong = differences(record.expected, answer, op="seed", zero_signs="equal")
            found[record.id] = [d.name for d in wrong]
    names = ["contact_plane.cell_id", "last_known_contact_plane.cell_id"]
    assert found["tk_02222"] == names
    assert all(wrong in ([], names) for wrong in found.values())


def test_no_cell_is_cut_differently_by_the_decimal() -> None:
    """The peers' constant turns over 34 numbers later than 2^-32; no cell of the world is that near."""
    half, decimal = 0x80000000, 2.3283064e-10
    assert (half + 33) * decimal < 0.5 <= (half + 34) * decimal
    columns = np.arange(256 * 8, dtype=np.int64)
    x, y = columns[:, np.newaxis], columns[np.newaxis, :]
    mixed = (y * ((214614067 * x + 1813693831) % 2**32) - 1109124029 * x - 1369149221) % 2**32
    distances = np.abs(mixed - half)
    assert distances.min() == 440
    assert np.unravel_index(distances.argmin(), distances.shape) == (657, 1857)


def test_terrain_split_decimal_is_wrong_beyond_the_world() -> None:
    """The mistake is there: at coordinates that no id can name a cell is cut the other way."""
    retail = land_block_struct.cuts_sw_to_ne
    x, y = BEYOND
    with replaced(bug("terrain-split-decimal").bug.replacements):
        assert land_block_struct.cuts_sw_to_ne is not retail
        assert not land_block_struct.cuts_sw_to_ne(x, y)
    assert retail(x, y)


def test_every_bug_is_described() -> None:
    """Ids are unique, and each entry says what it does and what retail does."""
    bugs = known_bugs.list_bugs()
    assert bugs
    assert len({bug.id for bug in bugs}) == len(bugs)
    assert all(bug.mistake and bug.retail and bug.replacements for bug in bugs)
    assert all((bug.case and bug.output) or bug.survives for bug in bugs)
    assert repr(BugCandidate(bugs[0])).startswith("BugCandidate('cell-origin': the cell call")


def test_the_oracle_is_whole_again_afterwards() -> None:
    """After an answer the attribute is retail's own."""
    retail = EnvCell.cache_local_space
    bug("cell-origin").answer(step_down(0.4))
    assert EnvCell.cache_local_space is retail


def test_the_oracle_is_whole_again_after_an_error() -> None:
    """Also when the answer fails inside."""
    retail = EnvCell.cache_local_space
    broken = Method(EnvCell, "cache_local_space", lambda _: None)
    outcome = BugCandidate(KnownBug("x", "breaks", "works", (broken,))).answer(step_down(0.4))
    assert isinstance(outcome, Errored)
    assert EnvCell.cache_local_space is retail


def test_a_bug_has_its_own_geometry() -> None:
    """What a wrong oracle has built is not what the right one uses, and is kept between answers."""
    made: list[int] = []

    def counting(retail: Any) -> Any:
        def build(neutral: Any) -> Any:
            made.append(1)
            return retail(neutral)

        return build

    candidate = BugCandidate(KnownBug("x", "builds", "builds", (Method(geometry, "_build", counting),)))
    OracleCandidate().answer(step_down(0.4))
    candidate.answer(step_down(0.4))
    candidate.answer(step_down(0.4))
    assert made == [1]
