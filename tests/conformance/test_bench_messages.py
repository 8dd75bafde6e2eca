"""What messages cost, measured with an engine that has its answers ready."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from conformance.bench import messages
from conformance.bench.messages import measure_messages
from conformance.bench.report import Report
from conformance.bench.timing import DisagreementError
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.loader import load_paths
from conformance.protocol.server import outcome_body
from conformance.query import Result

if TYPE_CHECKING:
    from conformance.protocol.dialects import Dialect

CASES = load_paths([Path(__file__).parents[2] / "conformance" / "cases" / "contact-plane"]).cases[:2]
assert len({case.op for case in CASES}) == 1, "the first two cases about contact planes ask the same"


def test_both_dialects_are_measured() -> None:
    """By both clocks, and nothing disagrees: every answer came through."""
    report, said = Report(1), []
    measure_messages([CASES[:1], CASES[1:]], report, said.append)
    assert {line.reference for line in report.ratios} == {"answers at hand"}
    assert [re.sub(r"[\d.]+%", "some", line.note) for line in report.ratios] == [
        "messages, floats decimal: some more processor time",
        "messages, floats decimal: some more wall time",
        "messages, floats hex: some more processor time",
        "messages, floats hex: some more wall time",
    ]
    assert [line.comparison.rounds for line in report.ratios] == [2, 2, 2, 2]
    queries = sum(len(case.queries) for case in CASES)
    assert [(cost.op, cost.dialect, cost.queries) for cost in report.messages] == [
        (CASES[0].op, "decimal", queries),
        (CASES[0].op, "hex", queries),
    ]
    assert said == [
        "messages: round 1 of 2, 1 cases: retail's answers to them",
        "messages: round 1 of 2, 1 cases: decimal and hex",
        "messages: round 2 of 2, 1 cases: retail's answers to them",
        "messages: round 2 of 2, 1 cases: decimal and hex",
    ]


def test_nobody_has_seen_a_scene_before() -> None:
    """What retail keeps of a scene is made anew by everybody, as it is in a run of the suite."""
    outcomes = [[OracleCandidate().answer(query) for query in case.queries] for case in CASES]
    (first, _), (second, at_hand) = (messages._own_cases(CASES, outcomes) for _ in range(2))
    scenes = [cases[0].queries[0].geometries for cases in (CASES, first, second)]
    assert len({id(geometry) for scene in scenes for geometry in scene.values()}) == 3 * len(scenes[0])
    assert [[at_hand[query] for query in case.queries] for case in second] == outcomes


def test_a_wrong_answer_is_no_measurement(monkeypatch: pytest.MonkeyPatch) -> None:
    """If what comes back is not what was sent, its time means nothing."""

    def garbled(op: str, outcome: Result, dialect: Dialect) -> dict[str, Any]:
        return outcome_body(op, Result({**outcome.fields, "trace": "D9"}), dialect)

    monkeypatch.setattr(messages, "outcome_body", garbled)
    with pytest.raises(DisagreementError, match=f"^{CASES[0].id}: trace: retail D3"):
        measure_messages([CASES], Report(1), lambda _said: None)
