"""What the 3-D view of a case shows: solids, movers, planes, polygons; and the picture of it."""

from __future__ import annotations

import builtins
import importlib.util
import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from conformance import exit_codes
from conformance.candidates.registry import make_candidate
from conformance.cli import main
from conformance.loader import Vary, load_paths
from conformance.query import Query
from conformance.report.html.entries import Judge
from conformance.report.html.library import MissingVizError, viz_module
from conformance.report.html.solids import Frame, Solid, solids_of, sphere_polygons
from conformance.report.html.steps import Mover, steps_of
from conformance.report.html.view import View, plane_patch, polygon_in_question, view_data, view_of

if TYPE_CHECKING:
    from conformance.query import Fields

CASES = Path(__file__).parents[2] / "conformance" / "cases"
CELLAR = CASES / "walks" / "cellar.yaml"
ORIGIN = CASES / "contact-plane" / "origin.yaml"
POSE = {"cell": 1, "origin": [1.0, 2.0, 3.0], "rotation": [1.0, 0.0, 0.0, 0.0]}
FLOOR = ((-1.0, -1.0, 2.0), (1.0, -1.0, 2.0), (1.0, 1.0, 2.0), (-1.0, 1.0, 2.0))


def view(file: Path, case_id: str, candidate: str = "oracle") -> View:
    """Return the view of a case as written."""
    (case,) = [case for case in load_paths([file], Vary(0)).cases if case.id == case_id]
    who = make_candidate(candidate)
    entry = Judge(who, make_candidate("oracle"), ("cp-write",)).entry(case)
    assert entry.details is not None
    found = view_of(entry.details, who.name)
    assert found is not None
    return found


def test_a_walk_has_a_step_for_the_start_and_each_tick() -> None:
    """Both movers go down to z = 90; the planes under them change from stair to ramp to floor."""
    seen = view(CELLAR, "walk-cellar-descent")
    assert [step.label for step in seen.steps[:2]] == ["start", "tick 0"]
    assert len(seen.steps) == 164
    assert all(step.retail == step.candidate for step in seen.steps)
    last = seen.steps[-1].retail
    assert last is not None
    assert last.position[2] == pytest.approx(90.005, abs=1e-3)
    assert last.plane == (0.0, 0.0, 1.0, -90.0)
    corners = polygon_in_question(last, seen.solids)
    assert corners is not None
    assert {round(corner[2], 3) for corner in corners} == {90.0}


def test_a_walk_begins_at_the_tick_that_differs() -> None:
    """It is tick 0, the step after the start."""
    seen = view(CELLAR, "walk-cellar-descent", "bug:cell-origin")
    assert seen.shown == 1
    step = seen.steps[1]
    assert step.retail != step.candidate


def test_a_call_shows_what_is_asked_and_answered() -> None:
    """The polygon that the answer names is the floor of the cell, in the landblock's frame."""
    seen = view(ORIGIN, "origin-step-down-touching")
    assert [step.label for step in seen.steps] == ["from", "to, as asked", "answer"]
    mover = seen.steps[-1].retail
    assert mover is not None
    corners = polygon_in_question(mover, seen.solids)
    assert corners is not None
    assert {corner[2] for corner in corners} == {94.0}


@pytest.mark.parametrize("folder", ["bsp", "polygon", "objects", "terrain", "ticks"])
def test_every_case_can_be_viewed(folder: str) -> None:
    """As data that JSON can hold; those that only compute have no view."""
    oracle = make_candidate("oracle")
    judge = Judge(oracle, oracle, ("cp-write",))
    views = 0
    for case in load_paths([CASES / folder], Vary(0)).cases:
        details = judge.entry(case).details
        assert details is not None
        seen = view_of(details, "oracle")
        if seen is not None:
            views += 1
            assert json.dumps(view_data(seen), allow_nan=False)
    assert views


@pytest.mark.parametrize("op", ["frame_localtoglobal", "landdefs_get_outside_lcoord", "frame_is_equal"])
def test_numbers_are_no_scene(op: str) -> None:
    """A point that lies nowhere is not drawn."""
    query = Query(op, {"point": [1.0, 2.0, 3.0]})
    (step,) = steps_of(query, {}, {}, Frame(0))
    assert (step.retail, step.candidate) == (None, None)


def test_another_landblock_lies_beside() -> None:
    """192 m to the east, and as many to the north for each of y."""
    frame = Frame(0xA9B40001)
    assert frame.offset(0xAAB30001) == (192.0, -192.0, 0.0)
    assert frame.offset(0) == (0.0, 0.0, 0.0)
    pose = {"cell": 0xAAB40001, "origin": [1.0, 2.0, 3.0], "rotation": [1.0, 0.0, 0.0, 0.0]}
    assert frame.place(pose, [(1.0, 0.0, 0.0)], 2.0) == ((195.0, 2.0, 3.0),)


def test_land_is_cut_as_retail_cuts_it() -> None:
    """Two triangles a cell, 24 m wide."""
    query = Query("terrain_block", {"block": 0xA9B4, "heights": [5.0] * 81})
    (land,) = solids_of(query, Frame(0xA9B40000))
    assert len(land.polygons) == 128
    corners = {corner for triangle in land.polygons for corner in triangle}
    assert len(corners) == 81
    assert max(corners) == (192.0, 192.0, 5.0)


def test_what_is_nowhere_is_left_out() -> None:
    """A candidate may answer NaN."""
    query = Query(
        "bsp_adjust_to_plane", {"geometry": "g", "sphere": [0.0, 0.0, 0.0, 0.5], "curr": [0.0, 0.0, 1.0]}
    )
    nan = float("nan")
    steps = steps_of(query, {"center": [0.0, 0.0, 0.5]}, {"center": [nan, 0.0, 0.0]}, Frame(0))
    assert steps[-1].retail == Mover((0.0, 0.0, 0.5), ((0.0, 0.0, 0.5, 0.5),), geometry="g")
    assert steps[-1].candidate is None


@pytest.mark.parametrize(
    "answer",
    [
        {"result": 1},
        {"check": None, "contact_plane": 7},
        {"check": POSE, "walkable": "x"},
        {"check": POSE, "contact_plane": {"valid": 1, "plane": ["a", 0.0, 0.0, 1.0]}},
        {"check": {"cell": "x", "origin": [1.0], "rotation": 5}},
        {"check": {"cell": 1, "origin": [1e300, 0.0, 0.0], "rotation": [1.0, 0.0, 0.0, 0.0]}},
        {"check": {"cell": 1, "origin": ["<b>", 0.0, 0.0], "rotation": [1.0, 0.0, 0.0, 0.0]}},
    ],
)
def test_an_answer_of_another_shape(answer: Fields) -> None:
    """An engine may answer anything; what was asked is shown nevertheless."""
    mover = {"spheres": [[0.0, 0.0, 0.5, 0.5]], "scale": 1.0}
    query = Query("find_collisions", {"mover": mover, "from": POSE, "to": POSE})
    steps = steps_of(query, {"check": POSE}, answer, Frame(1))
    assert [step.label for step in steps] == ["from", "to, as asked", "answer"]
    assert [step.candidate is None for step in steps] == [False, False, True]
    assert json.dumps(view_data(View([], steps, ("retail", "x"), 2)), allow_nan=False)


def test_a_plane_without_a_direction() -> None:
    """It is not drawn, nor is one whose direction is lost in squaring it."""
    for size in (0.0, 1e-160):
        assert plane_patch(Mover((1.0, 2.0, 3.0), plane=(0.0, 0.0, size, 1e8))) is None


def test_a_candidate_without_an_answer_stays_behind() -> None:
    """What was asked is shown, retail's answer too."""
    query = Query(
        "bsp_adjust_to_plane", {"geometry": "g", "sphere": [0.0, 0.0, 0.0, 0.5], "curr": [0.0, 0.0, 1.0]}
    )
    steps = steps_of(query, {"center": [0.0, 0.0, 0.5]}, None, Frame(0))
    assert [step.candidate is None for step in steps] == [False, False, True]


def test_the_plane_is_drawn_under_the_mover() -> None:
    """A square of 1.8 m about its foot, in the frame of the plane's landblock."""
    mover = Mover((3.0, 4.0, 9.0), plane=(0.0, 0.0, 1.0, -2.0), block=(192.0, 0.0, 1.0))
    patch = plane_patch(mover)
    assert patch is not None
    assert {corner[2] for corner in patch} == {3.0}
    assert [abs(corner[0] - 3.0) for corner in patch] == pytest.approx([0.9] * 4)


def test_the_polygon_in_question_is_the_nearest_in_the_plane() -> None:
    """Not one that is nearer but faces another way; none without a plane."""
    beside = tuple((x + 5.0, y, z) for x, y, z in FLOOR)
    solids = [Solid("cell", "g", (beside, tuple(reversed(FLOOR)), FLOOR))]
    mover = Mover((0.0, 0.0, 2.5), plane=(0.0, 0.0, 1.0, -2.0))
    assert polygon_in_question(mover, solids) == FLOOR
    assert polygon_in_question(Mover((0.0, 0.0, 2.5), polygon=0, geometry="g"), solids) == beside
    assert polygon_in_question(Mover((0.0, 0.0, 2.5), polygon=9, geometry="g"), solids) is None
    assert polygon_in_question(Mover((0.0, 0.0, 2.5)), solids) is None
    assert polygon_in_question(replace(mover, polygon=0, geometry="not there"), solids) == FLOOR


def test_spheres_are_closed() -> None:
    """Every corner is a radius away from the centre."""
    for corners in sphere_polygons((1.0, 2.0, 3.0), 0.5):
        for x, y, z in corners:
            assert (x - 1.0) ** 2 + (y - 2.0) ** 2 + (z - 3.0) ** 2 == pytest.approx(0.25)


def test_without_the_extra_it_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """The report names the extra, and the option that does without."""
    found = importlib.util.find_spec
    absent = "conformance.report.html.library.find_spec"
    monkeypatch.setattr(absent, lambda name: None if name == "plotly" else found(name))
    with pytest.raises(MissingVizError, match=r"retail-conformance\[viz\]"):
        viz_module("plotly.offline", "plotly")
    assert viz_module("builtins", "builtins") is builtins
    assert main(["report", str(ORIGIN), "-o", str(tmp_path / "x.html")]) == exit_codes.USAGE
    assert "--no-views" in capsys.readouterr().err


def test_a_picture_is_a_png(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of a walk that goes wrong, whatever the case is called."""
    pytest.importorskip("matplotlib", reason="skipped: matplotlib is not installed")
    file = tmp_path / "pictures" / "case.png"
    case = f"{ORIGIN}::origin-step-down-touching"
    assert main(["show", case, "-o", str(file), "--candidate", "bug:cell-origin"]) == exit_codes.OK
    assert file.read_bytes().startswith(b"\x89PNG\r\n")
    assert "failed" in capsys.readouterr().out


def test_numbers_have_no_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Nothing is written, and the exit code says that nothing was done."""
    cases = load_paths([CASES / "math"], Vary(0)).cases
    case = next(case for case in cases if case.op == "frame_is_equal")
    named = f"{CASES / 'math' / Path(case.location.file).name}::{case.id}"
    assert main(["show", named, "-o", str(tmp_path / "x.png")]) == exit_codes.NOTHING_RAN
    assert "nothing to draw" in capsys.readouterr().out
    assert not list(tmp_path.iterdir())
