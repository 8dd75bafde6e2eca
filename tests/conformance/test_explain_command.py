"""`conformance explain`: the steps that retail takes in a case, what they decide and what they write."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from conformance import cli, exit_codes
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.case import Vary
from conformance.life.explanation import TICKS, Citations, NoTickError, explain
from conformance.life.step_source import ORACLE, statements_of
from conformance.life.steps_taken import RetailCall, Step, watch
from conformance.loader import BUILT_IN_CASES, load_file
from conformance.report.steps import step_lines
from conformance.retail_index import shipped_index
from conformance.traced import answer_traced
from oracle.writes import TOPICS

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.query import Query

ORIGIN_FILE = BUILT_IN_CASES / "contact-plane" / "origin.yaml"
ORIGIN = f"{ORIGIN_FILE}::origin-step-down-touching"
WALK_FILE = BUILT_IN_CASES / "walks" / "single-floor.yaml"
WALK_ID = "walk-single-floor"
LOOP = '''\
def f(items):
    """Nothing of retail."""
    # FC-1: the first
    total = 0
    for item in items:  # 07 4.2
        # a remark
        if (
            item
        ):  # FC-2, FC-3
            total += item
    return total
'''


def query_of(file: Path, case_id: str) -> Query:
    """Return a case of a file as it is written."""
    (query,) = [case.queries[0] for case in load_file(file, Vary(poses=0)).cases if case.id == case_id]
    return query


def told(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[str]:
    """Run the command, which must succeed, and return its lines."""
    assert cli.main(["explain", *arguments]) == exit_codes.OK
    return capsys.readouterr().out.splitlines()


def test_the_origin_case_is_told_step_by_step(capsys: pytest.CaptureFixture[str]) -> None:
    """What the case cites has a star; conditions say how they went; calls say what they returned."""
    lines = told(capsys, ORIGIN)
    begin = lines.index("* BSPTREE::find_collisions (03 FC-1…15) -> ADJUSTED")
    assert lines[begin + 1 : begin + 6] == [
        "    FC-1     s0 = path.localspace_sphere[0]",
        "    FC-4     if path.check_walkable: no",
        "*   FC-5     if path.step_down: yes",
        "*   BSPTREE::step_sphere_down (03 SD-1…12) -> ADJUSTED",
        "*     SD-1     amt = -(path.step_down_amt * path.walk_interp)",
    ]
    starred = [line.split()[1] for line in lines if line.startswith("*     SD-")]
    assert starred == [f"SD-{number}" for number in range(1, 13)]
    assert "*     Plane::localtoglobal (01 PL-1…4)" in lines
    assert lines[-3:] == [
        "  [cp-write] ContactPlaneCellId: 0x00000000 -> 0xA9B40151 caller=step_sphere_down",
        "  [walkable] Walkable: none -> polygon 0 caller=step_sphere_down",
        "result: ADJUSTED",
    ]


def test_depth_leaves_out_what_is_inside(capsys: pytest.CaptureFixture[str]) -> None:
    """At one level there are calls, without their steps."""
    lines = told(capsys, ORIGIN, "--depth", "1", "--pose", "2")
    steps = lines[lines.index("steps (* what the case cites):") + 1 : lines.index("writes:")]
    assert lines[0].startswith("origin-step-down-touching[pose 2]: ")
    assert steps[-1] == "* BSPTREE::find_collisions (03 FC-1…15) -> ADJUSTED"
    assert all("::" in line for line in steps)


def test_a_walk_is_told_tick_by_tick(capsys: pytest.CaptureFixture[str]) -> None:
    """Each tick once: their writes, one after the other, are the writes of the walk."""
    query = query_of(WALK_FILE, WALK_ID)
    short = replace(query, inputs={**query.inputs, TICKS: query.inputs[TICKS][:4]})
    _, whole = answer_traced(OracleCandidate(), short, TOPICS)
    ticks = [explain(short, tick) for tick in range(4)]
    assert [repr(entry) for tick in ticks for entry in tick.entries] == [repr(entry) for entry in whole]
    assert all("CTransition::find_valid_position" in tick.functions for tick in ticks)
    assert any(
        "CTransition::find_valid_position" in line
        for line in told(capsys, f"{WALK_FILE}::{WALK_ID}", "--tick", "1")
    )


@pytest.mark.parametrize(
    ("case", "arguments", "complaint"),
    [
        (ORIGIN, ("--tick", "0"), "origin-step-down-touching has no ticks: it is no walk"),
        (f"{WALK_FILE}::{WALK_ID}", (), "ticks: choose one with --tick 0…"),
        (f"{WALK_FILE}::{WALK_ID}", ("--tick", "100000"), "ticks: choose one with --tick 0…"),
        (ORIGIN, ("--pose", "99"), "there is no pose 99"),
        (f"{ORIGIN}x", (), "Did you mean 'origin-step-down-touching'?"),
    ],
)
def test_what_is_not_there_is_a_usage_error(
    case: str, arguments: tuple[str, ...], complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2, and which ticks there are."""
    assert cli.main(["explain", case, *arguments]) == exit_codes.USAGE
    assert complaint in capsys.readouterr().err


def test_a_level_of_nothing_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    """As any option that makes no sense."""
    with pytest.raises(SystemExit) as ended:
        cli.main(["explain", ORIGIN, "--depth", "0"])
    assert ended.value.code == exit_codes.USAGE
    assert "found 0, expected a whole number, 1 or more" in capsys.readouterr().err


def test_watching_changes_nothing() -> None:
    """Neither the answer nor the debugger or coverage tool that was there before."""
    query = query_of(ORIGIN_FILE, "origin-step-down-touching")
    before = sys.gettrace()
    outcome, items = watch(query)
    assert sys.gettrace() is before
    assert repr(outcome) == repr(OracleCandidate().answer(query))
    assert any(isinstance(item, RetailCall) and item.has_steps for item in items)


def test_a_walk_needs_a_tick() -> None:
    """The library says so, too; where there is but one, it is that."""
    walk = query_of(WALK_FILE, WALK_ID)
    with pytest.raises(NoTickError, match="choose one"):
        explain(walk)
    short = replace(walk, inputs={**walk.inputs, TICKS: walk.inputs[TICKS][:1]})
    assert repr(explain(short)) == repr(explain(short, 0))


def test_labels_belong_to_the_statement_that_they_stand_at(tmp_path: Path) -> None:
    """A comment with a line of its own to the next one, any other to that of its line."""
    file = tmp_path / "loop.py"
    file.write_text(LOOP, encoding="utf-8")
    statements = statements_of(str(file))
    assert (statements[4].text, statements[4].label, statements[4].remark) == (
        "total = 0",
        "FC-1",
        "the first",
    )
    assert (statements[5].text, statements[5].label) == ("for item in items", "07 4.2")
    assert statements[5].is_loop
    assert statements[7] is statements[9]
    assert (statements[7].text, statements[7].label, statements[7].body) == (
        "if item",
        "FC-2, FC-3",
        (10, 10),
    )
    assert [statements[line].label for line in (2, 10, 11)] == ["", "", ""]


def test_the_oracle_has_steps_in_every_document() -> None:
    """Labels of the form ``FC-7`` are steps of the specification, and none of its documents is without."""
    known = {step for document in shipped_index().values() for step in document["steps"]}
    found = [
        statement.label
        for file in sorted(ORACLE.glob("*.py"))
        for statement in statements_of(str(file)).values()
        if statement.label
    ]
    plain = {label for label in found if label[0].isalpha() and label.replace("-", "").isalnum()}
    assert len(plain) > 300
    assert {label for label in plain if label not in known} == set()
    assert {label[:2] for label in found if label[0].isdigit()} >= {"07", "08", "09", "10"}


def test_citations_are_ranges_steps_sections_or_whole_functions() -> None:
    """A range covers what is between; a section its parts; a function alone has no cited step."""
    cited = Citations(["A::f SD-2…SD-4, SD-9", "A::g §4.2", "A::h"])
    assert [number for number in range(1, 11) if cited.has_step("A::f", f"SD-{number}")] == [2, 3, 4, 9]
    assert cited.has_step("A::g", "07 4.2.1")
    assert not cited.has_step("A::g", "07 4.20")
    assert cited.has_step("A::f", "SD-1, SD-2")
    assert cited.has_function("A::h")
    assert not cited.has_step("A::h", "SD-2")
    assert cited.missing(frozenset({"A::f"})) == ["A::g", "A::h"]


def test_a_loop_counts_its_items() -> None:
    """The look for another item that ends a loop is no step."""
    _, items = watch(query_of(ORIGIN_FILE, "origin-step-down-touching"))
    (spheres,) = [
        item for item in items if isinstance(item, RetailCall) and item.function == "SPHEREPATH::init_sphere"
    ]
    assert [item.statement.label for item in spheres.items if isinstance(item, Step)] == [
        "SPI-1",
        "SPI-2",
        "SPI-3",
    ]


def test_what_builds_the_scene_is_told_however_often_it_is_asked() -> None:
    """A geometry that the oracle has built before is built anew, so that the steps are the same."""
    query = query_of(BUILT_IN_CASES / "polygon" / "plane.yaml", "make-plane-mean-distance")
    first, second = (
        list(step_lines(explain(query).items, Citations(["CPolygon::make_plane MP-5"]))) for _ in range(2)
    )
    assert first == second
    assert first[0] == "* CPolygon::make_plane (02 MP-1…6)"
    assert [line.split()[1] for line in first if line.startswith("*   ")] == ["MP-5"]


def test_a_cited_function_without_steps_is_shown() -> None:
    """The specification tells some functions in a formula, which has no labels."""
    query = query_of(BUILT_IN_CASES / "math" / "frames.yaml", "frame-set-rotate-zero")
    lines = list(step_lines(explain(query).items, Citations(["Frame::set_rotate §4.4"])))
    assert any(line.startswith("* Frame::set_rotate ") for line in lines)
    assert list(step_lines(explain(query).items, Citations([]))) == []
