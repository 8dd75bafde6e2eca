"""Hunting known bugs: what counts as caught, and that the draws are the same every time."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from shipped_cases import shipped_cases

from conformance.bug_hunt import FAMILIES, Kill, Record, first_difference, hunt
from conformance.candidates.bug_candidate import KnownBug
from conformance.candidates.known_bugs import list_bugs
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.console import Progress
from conformance.query import Errored, Query, Result, Skipped
from conformance.report.kills import as_json, cells, kill_table, markdown_table, verdict

DOCUMENT = Path(__file__).parents[2] / "docs" / "known-bugs.md"
BUGS = {bug.id: bug for bug in list_bugs()}
HARMLESS = KnownBug("harmless", "nothing", "the same", ())
"""Replaces nothing, so nothing can catch it."""


def hunted(*bugs: KnownBug, draws: int = 0) -> list[Record]:
    """Hunt with every case that a bug names, and some random queries."""
    cases = [shipped_cases()[bug.case] for bug in bugs if bug.case]
    with Progress() as progress:
        return hunt(bugs, cases, draws=draws, progress=progress)


def test_a_bug_is_caught_by_its_case_and_at_random() -> None:
    """Both are told with the output that shows it; further queries are not asked."""
    (record,) = hunted(BUGS["cell-origin"], draws=30)
    assert record.named_case == Kill("find_collisions", "contact_plane.d", "origin-step-down-touching")
    assert record.random is not None
    assert 1 <= record.random.draw <= 30
    assert sum(record.different.values()) == 1
    assert record.unexplained == ()


def test_draws_are_the_same_every_time() -> None:
    """A number in the table can be looked up again."""
    first, again = (hunted(BUGS["cell-origin"], draws=10)[0].random for _ in range(2))
    assert first == again


def test_what_nothing_catches_is_told() -> None:
    """Unless a reason is recorded."""
    (record,) = hunted(HARMLESS, draws=2)
    assert record.random is None
    assert record.unexplained == ("its case", "random queries")
    assert sum(record.asked.values()) == 2 * len(FAMILIES)
    (explained,) = hunted(replace(HARMLESS, survives="it is none"))
    assert explained.unexplained == ()
    assert cells(explained)[3:] == ("it is none", "it is none")
    assert verdict([record, explained]) == (
        "1 of 2 known bugs are caught or explained; missed by: bug:harmless (its case, random queries)"
    )


def test_the_rate_of_a_rated_bug_counts_every_draw() -> None:
    """It is asked on after it was caught."""
    (record,) = hunted(replace(BUGS["float32-registers"], case="origin-step-down-touching"), draws=10)
    assert all(record.asked[family] <= 10 for family in FAMILIES)
    assert sum(record.asked.values()) > 30
    assert record.rates.startswith("collision calls ")
    assert record.rates in cells(record)[4]


def test_outcomes_that_are_no_answers() -> None:
    """Where retail has no answer nothing can differ; a bug that fails is caught."""
    query = Query("block_offset", {})
    answer = Result({"v": [0.0, 0.0, 0.0]})
    assert first_difference(query, Skipped("x"), answer) == ""
    assert first_difference(query, answer, Errored("x")) == "no answer"
    assert first_difference(query, answer, Result({"v": [0.0, 1.0, 0.0]})) == "v.y"


def test_the_table_in_three_forms() -> None:
    """Terminal, Markdown, JSON: the same rows."""
    (record,) = hunted(BUGS["vertex-plane"])
    assert kill_table([record]).row_count == 1
    head, rule, row = markdown_table([record]).splitlines()
    assert (head.count("|"), rule.count("|"), row.count("|")) == (6, 6, 6)
    assert row.startswith("| bug:vertex-plane | ")
    (data,) = as_json([record])
    assert data["cases"] == [
        {"op": "find_collisions", "output": "contact_plane.d", "where": "step-down-scaled-static", "draw": 0}
    ]


@pytest.mark.parametrize("family", FAMILIES)
def test_retail_answers_random_queries(family: str) -> None:
    """A family that the oracle skips or fails at would catch nothing."""
    answers = []
    oracle = OracleCandidate()
    from conformance import bug_hunt

    bug_hunt.draw_queries(FAMILIES[family], 20, lambda query, _: answers.append(oracle.answer(query)))
    assert len(answers) == 20
    assert all(isinstance(answer, Result) for answer in answers)


def test_the_document_tells_what_the_suite_finds() -> None:
    """Every column of docs/known-bugs.md but the draws, which depend on Hypothesis's version."""
    records = hunted(*list_bugs())
    lines = DOCUMENT.read_text(encoding="utf-8").splitlines()
    written = [line.strip("| ").split(" | ")[:4] for line in lines if line.startswith("| bug:")]
    assert written == [list(cells(record)[:4]) for record in records]
