"""Deviation files: read with every mistake told, and held against what a case has shown."""

from __future__ import annotations

import datetime as dt
from typing import TYPE_CHECKING, Any

import pytest
from deviation_files import FAILING, ORIGIN, RECORDED, deviation_file
from hypothesis import given
from hypothesis import strategies as st

from conformance.candidates.registry import make_candidate
from conformance.compare import Difference
from conformance.deviations.drafts import _rounded_up, draft, entries_for
from conformance.deviations.entries import Deviation, observed_text
from conformance.deviations.files import (
    FOLDER,
    MOST_CASES,
    DeviationError,
    Deviations,
    find_deviations,
    problems_among,
    read_deviations,
)
from conformance.deviations.reckoning import Reckoning, reckon
from conformance.lint import lint, own_deviations
from conformance.loader import Vary, load_file
from conformance.query import Query
from conformance.shapes import Kind
from conformance.verdict import Failure, Verdict, judge

if TYPE_CHECKING:
    from pathlib import Path

SHIPPED = own_deviations()
assert SHIPPED, f"no deviation files in {FOLDER}"
TODAY = dt.date(2030, 1, 1)


def entry(**changes: Any) -> Deviation:
    """Return the recorded deviation, with changes; None leaves a key out."""
    data = {key: value for key, value in {**RECORDED, **changes}.items() if value is not None}
    return Deviation.model_validate(data)


def differing(name: str, retail: Any, given: Any, kind: Kind = Kind.FLOAT32) -> Difference:
    """Return a difference of a field that is called the same in records."""
    return Difference(name, name, kind, retail, given)


@pytest.fixture(scope="module")
def verdict() -> Verdict:
    """Return what comes of the case that the bug fails."""
    (case,) = [case for case in load_file(ORIGIN, Vary(poses=0)).cases if case.id == FAILING]
    return judge(case, make_candidate("bug:cell-origin"), make_candidate("oracle"))


def reckoned(path: Path, verdict: Verdict, candidate: str = "bug:cell-origin") -> Reckoning:
    """Hold the failing case against a file."""
    return reckon(read_deviations(path), FAILING, verdict, candidate=candidate, today=TODAY)


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_shipped_files_can_be_read(path: Path) -> None:
    """And are found by the name of their engine."""
    assert read_deviations(path) == find_deviations(path.stem)


def test_an_engine_without_a_file_deviates_nowhere() -> None:
    """Whatever its name looks like."""
    assert find_deviations("cmd:../engine") == Deviations("cmd:../engine")


@pytest.mark.parametrize(
    ("changes", "place", "found"),
    [
        ({"case": "*"}, "3:11", "the coarse pattern '*'"),
        ({"case": "origin-*"}, "3:11", "the coarse pattern 'origin-*'"),
        ({"case": "Origin"}, "3:11", "the text 'Origin'"),
        ({"reason": ""}, "6:13", "the text ''"),
        ({"link": "see chat"}, "7:11", "the text 'see chat'"),
        ({"until": "2030-02-30"}, "8:12", "the text '2030-02-30'"),
        ({"until": "20300101"}, "8:12", "the text '20300101'"),
        ({"observed": None}, "3:5", "0 of 'observed', 'within', 'within_ulps'"),
        ({"within_ulps": 2}, "3:5", "2 of 'observed', 'within', 'within_ulps'"),
        ({"observed": None, "within": 0}, "8:13", "the number 0.0"),
        ({"error": "crash"}, "3:5", "both or neither of 'field' and 'error'"),
        ({"field": None, "error": "crash"}, "4:15", "'observed' with 'error'"),
        ({"owner": "me"}, "9:5", "the unknown key 'owner'"),
    ],
)
def test_mistakes_have_a_place(changes: dict[str, Any], place: str, found: str, tmp_path: Path) -> None:
    """Line and column of the value, or of the entry where something is left out."""
    path = deviation_file(tmp_path, **changes)
    with pytest.raises(DeviationError) as caught:
        read_deviations(path)
    (problem,) = caught.value.problems
    assert problem.found == found
    assert str(problem.location) == f"{path}:{place}"


def test_the_recorded_failure_is_explained(verdict: Verdict, tmp_path: Path) -> None:
    """Nothing is left over."""
    reckoning = reckoned(deviation_file(tmp_path), verdict)
    assert (reckoning.unexplained, reckoning.complaints) == ((), ())
    assert [held.deviation.reason for held in reckoning.held] == [RECORDED["reason"]]


@pytest.mark.parametrize(
    "changes",
    [
        {"observed": "0.0 (0x00000000)"},
        {"field": "contact_plane.n.x"},
        {"observed": None, "within": 93.9},
        {"field": None, "observed": None, "error": "crash"},
    ],
)
def test_another_failure_is_not(changes: dict[str, Any], verdict: Verdict, tmp_path: Path) -> None:
    """It stays a failure, and the deviation, which does not show, is a complaint."""
    path = deviation_file(tmp_path, **changes)
    reckoning = reckoned(path, verdict)
    assert reckoning.unexplained == tuple(verdict.failures)
    (complaint,) = reckoning.complaints
    assert complaint.startswith(f"{path}:3:5: the deviation does not show (instead contact_plane.d: retail")


def test_a_bound_holds_up_to_itself(verdict: Verdict, tmp_path: Path) -> None:
    """The plane is 94 metres off."""
    path = deviation_file(tmp_path, observed=None, within=94)
    assert not reckoned(path, verdict).unexplained


def test_the_last_day_counts(verdict: Verdict, tmp_path: Path) -> None:
    """The day after, the failure is one again, and the complaint says since when."""
    assert not reckoned(deviation_file(tmp_path, until="2030-01-01"), verdict).complaints
    reckoning = reckoned(deviation_file(tmp_path, until="2029-12-31"), verdict)
    assert reckoning.unexplained == tuple(verdict.failures)
    assert "the deviation has expired on 2029-12-31" in reckoning.complaints[0]


def test_a_case_that_passes_is_a_complaint(tmp_path: Path) -> None:
    """So is one that was not compared."""
    path = deviation_file(tmp_path)
    assert "(the case passes)" in reckoned(path, Verdict(compared=1)).complaints[0]
    skipped = Verdict()
    skipped.skipped["engine: no walks"] += 1
    assert "(not compared: engine: no walks)" in reckoned(path, skipped).complaints[0]


def test_the_oracle_is_never_excused(verdict: Verdict, tmp_path: Path) -> None:
    """A failure of somebody else than the candidate stays."""
    assert reckoned(deviation_file(tmp_path), verdict, "engine").unexplained == tuple(verdict.failures)


def test_one_of_two_differences_is_not_enough() -> None:
    """Every difference of a query must be recorded."""
    both = (differing("contact_plane.d", -94.0, -0.0), differing("result", 1, 2, Kind.STATE))
    failure = Failure(Query("plane_set_height", {}, label=FAILING), "engine", found=both)
    known = entry()
    assert known.covers(both[0])
    assert not known.covers(both[1])
    assert not known.covers_error(failure.error)


def test_errors_are_known_by_their_first_line() -> None:
    """What follows is the engine's log."""
    crash = entry(field=None, observed=None, error="the engine ended")
    assert crash.covers_error("the engine ended\n    stderr: x")
    assert not crash.covers_error("the engine ended badly")


def test_errors_are_known_in_any_run() -> None:
    """A message has another number where fewer are sent; other numbers are part of the error."""
    bad = entry(field=None, observed=None, error="bad reply: found NaN: '{\"seq\": 12, ...', expected seq 12")
    assert bad.covers_error("bad reply: found NaN: '{\"seq\": 3, ...', expected seq 3")
    assert not bad.covers_error("bad reply: found NaN: '{\"seq\": 12, ...', expected whole lines")
    assert not entry(field=None, observed=None, error="status 3").covers_error("status 4")


@pytest.mark.parametrize(
    ("said", "recorded"), [("", "(nothing)"), ("\n", "(nothing)"), ("\n  late\nmore", "late")]
)
def test_an_error_may_say_little(said: str, recorded: str) -> None:
    """What is recorded of it is never empty, and it is known by that."""
    (drafted,) = entries_for("x", [Failure(Query("plane_set_height", {}, label="x"), "engine", error=said)])
    assert drafted["error"] == recorded
    assert entry(field=None, observed=None, error=recorded).covers_error(said)


def test_what_an_engine_prints_is_drafted_as_it_can_be_read(tmp_path: Path) -> None:
    """Its colours, too: a deviation file is YAML, and has no control characters."""
    failure = Failure(
        Query("plane_set_height", {}, label="x"), "engine", error="\x1b[31mout of cells\x9b at seq 7"
    )
    path = tmp_path / "draft.yaml"
    text = draft({"x": [failure]}, engine="mine").replace("reason:", "reason: known")
    text = text.replace("link:", "link: https://x.org").replace("until:", "until: 2999-01-01")
    path.write_text(text, encoding="utf-8")
    (read,) = read_deviations(path).entries
    assert read.deviation.error == "?[31mout of cells? at seq N"
    assert read.deviation.covers_error(failure.error)


def test_a_star_is_a_number_in_fields_and_anything_in_ids() -> None:
    """And nothing else is a pattern."""
    known = entry(case="step-up-*", field="tick *: contact_plane.d", observed=None, within_ulps=1)
    assert (known.about("step-up-ledge"), known.about("step-down-ledge")) == (True, False)
    assert known.covers(differing("tick 12: contact_plane.d", 1.0, 1.0 + 2.0**-23))
    assert not known.covers(differing("tick 12: contact_plane.d", 1.0, 1.0 + 2.0**-22))
    assert not known.covers(differing("tick x: contact_plane.d", 1.0, 1.0 + 2.0**-23))
    assert not known.covers(differing("tick 12: contact_planexd", 1.0, 1.0 + 2.0**-23))


def test_nan_is_within_nothing() -> None:
    """Nor is what is no number."""
    known = entry(observed=None, within=1.0e30)
    assert not known.covers(differing("contact_plane.d", 1.0, float("nan")))
    assert not known.covers(differing("contact_plane.d", 1.0, "none"))


def test_long_blocks_are_known_by_their_digest() -> None:
    """Where the report cuts them, so that no end of one is free."""
    one, other = [float(n) for n in range(60)], [*(float(n) for n in range(59)), -1.0]
    texts = [observed_text(differing("cells", [], block, Kind.BLOCK)) for block in (one, other)]
    assert texts[0] != texts[1]
    assert texts[0] == observed_text(differing("cells", [], tuple(one), Kind.BLOCK))


def test_lint_knows_the_cases(tmp_path: Path) -> None:
    """An id that is none, a pattern that is about many, and one that is about a single case."""
    known = [f"step-up-{n}" for n in range(MOST_CASES + 1)]
    many = read_deviations(deviation_file(tmp_path, case="step-up-*"))
    assert [problem.found for problem in problems_among(many, known)] == [
        f"the coarse pattern 'step-up-*', about {MOST_CASES + 1} cases"
    ]
    assert not list(problems_among(many, known[:-1]))
    assert [problem.found for problem in problems_among(many, known[:1])] == [
        "the pattern 'step-up-*', about one case"
    ]
    (problem,) = lint([ORIGIN], deviations=[deviation_file(tmp_path, case="origin-step-up")])
    assert (problem.found, problem.location.line) == ("'origin-step-up', which is no case", 3)


def test_drafts_have_no_reasons(verdict: Verdict, tmp_path: Path) -> None:
    """A draft is refused for what only people know; with that it explains the failure."""
    text = draft({FAILING: verdict.failures}, engine="bug:cell-origin")
    path = tmp_path / "draft.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(DeviationError) as caught:
        read_deviations(path)
    assert [problem.path.rpartition(".")[2] for problem in caught.value.problems] == [
        "reason",
        "link",
        "until",
    ]
    whole = text.replace("reason:", "reason: known").replace("link:", "link: https://x.org")
    path.write_text(whole.replace("until:", "until: 2999-01-01"), encoding="utf-8")
    assert not reckoned(path, verdict).unexplained


def test_drafts_bound_what_varies() -> None:
    """One value is recorded as it is; several of a number by their distance; several others each."""
    ulp = 2.0**-23
    query = Query("plane_set_height", {}, label="x")

    def seen(*found: tuple[Difference, ...]) -> list[dict[str, Any]]:
        failures = [Failure(query, "engine", found=differences) for differences in found]
        entries = list(entries_for("x", failures))
        return [{key: value for key, value in one.items() if key != "case"} for one in entries]

    assert seen((differing("d", 1.0, 1.0 + ulp),), (differing("d", 1.0, 1.0 + 2 * ulp),)) == [
        {"field": "d", "within_ulps": 2}
    ]
    assert seen((differing("d", 1.0, 2.0),), (differing("d", 1.0, 4.07),)) == [{"field": "d", "within": 3.1}]
    assert seen((differing("n", 1, 2, Kind.BITS),), (differing("n", 1, 3, Kind.BITS),)) == [
        {"field": "n", "observed": "0x2"},
        {"field": "n", "observed": "0x3"},
    ]
    failure = Failure(query, "engine", error="ended\n  log")
    assert list(entries_for("x", [failure, failure])) == [{"case": "x", "error": "ended"}]


@given(st.floats(1e-30, 1e30))
def test_bounds_are_rounded_up(value: float) -> None:
    """Never below, and by less than a tenth and a bit."""
    assert value <= _rounded_up(value) <= value * 1.2
