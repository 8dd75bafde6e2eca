"""What messages cost, measured with an engine that has its answers ready."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from conformance.bench import messages
from conformance.bench.messages import measure_messages
from conformance.bench.report import Report
from conformance.bench.timing import DisagreementError
from conformance.loader import load_paths
from conformance.protocol.server import outcome_body
from conformance.query import Result

if TYPE_CHECKING:
    from conformance.protocol.dialects import Dialect

CASES = load_paths([Path(__file__).parents[2] / "conformance" / "cases" / "contact-plane"]).cases[:2]
assert CASES, "no case about contact planes"


def test_both_dialects_are_measured() -> None:
    """A line each, in which nothing disagrees: every answer came through."""
    report, said = Report(1), []
    measure_messages(CASES, 2, report, said.append)
    assert [(line.reference, line.note) for line in report.ratios] == [
        ("answers at hand", "messages, floats decimal; processor time"),
        ("answers at hand", "messages, floats hex; processor time"),
    ]
    assert [line.comparison.rounds for line in report.ratios] == [2, 2]
    assert said[-1] == "messages, floats hex: round 2 of 2"


def test_a_wrong_answer_is_no_measurement(monkeypatch: pytest.MonkeyPatch) -> None:
    """If what comes back is not what was sent, its time means nothing."""

    def garbled(op: str, outcome: Result, dialect: Dialect) -> dict[str, Any]:
        return outcome_body(op, Result({**outcome.fields, "trace": "D9"}), dialect)

    monkeypatch.setattr(messages, "outcome_body", garbled)
    with pytest.raises(DisagreementError, match=f"^{CASES[0].id}: trace: retail D3"):
        measure_messages(CASES, 1, Report(1), lambda _said: None)
