"""The gate's stage of speed: how a ratio is measured, kept, and held against what was kept."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest
from faux import serve_command
from gate_command import Gate

from conformance import exit_codes
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.gate import speed
from conformance.gate.speed import Baseline, BaselineError, measure_ratio, read_baseline
from conformance.loader import BUILT_IN_CASES
from conformance.query import Query, Result, Skipped

if TYPE_CHECKING:
    from pathlib import Path

SLOWED = """
from conformance.candidates.oracle_candidate import OracleCandidate


class Slowed(OracleCandidate):
    def answer(self, query):
        return [super(Slowed, self).answer(query) for _ in range(4)][-1]
"""
"""A candidate that is right, and takes four times as long as it might."""


class Slow:
    """Answers the same, after counting how often it is asked."""

    def __init__(self, name: str, *, skips: bool = False) -> None:
        self.name = name
        self.skips = skips
        self.asked = 0

    def answer(self, _query: Query) -> Result | Skipped:
        """Answer."""
        self.asked += 1
        return Skipped("no") if self.skips else Result({})


def test_both_are_asked_as_often() -> None:
    """One round more than is timed; what one of them skips is not timed."""
    queries = [Query("walk", {}), Query("walk", {})]
    first, second = Slow("a"), Slow("b")
    ratio, count = measure_ratio(queries, first, second, lambda _text: None)
    assert count == 2
    assert ratio is not None
    assert 0.0 < ratio.low <= ratio.middle <= ratio.high
    assert first.asked == second.asked == 2 * 6
    assert measure_ratio(queries, Slow("a", skips=True), second, lambda _text: None) == (None, 0)


def test_baselines(tmp_path: Path) -> None:
    """Read as written; of other queries, beside another Python, or no baseline at all, refused."""
    path = tmp_path / "baseline.json"
    baseline = Baseline("engine", 40.0, 39.0, 42.0, "abc", speed.PYTHON)
    path.write_text(baseline.to_json(), encoding="utf-8")
    assert read_baseline(path, "abc") == baseline
    with pytest.raises(BaselineError, match="measured with other cases"):
        read_baseline(path, "abd")
    path.write_text(replace(baseline, python="2.7").to_json(), encoding="utf-8")
    with pytest.raises(BaselineError, match=r"found Python 2\.7, expected 3\."):
        read_baseline(path, "abc")
    for text in ("{", "[]", '{"candidate": "x"}', replace(baseline, ratio=0.0).to_json(), '{"a": 1, "a": 2}'):
        path.write_text(text, encoding="utf-8")
        with pytest.raises(BaselineError):
            read_baseline(path, "abc")


@pytest.fixture
def walking(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Gate:
    """Return the command on walks, of which it times one, in three rounds."""
    gate, walks = Gate(tmp_path), BUILT_IN_CASES / "worlds" / "ends.yaml"
    monkeypatch.setattr(speed, "ROUNDS", 3)
    monkeypatch.setattr(speed, "MOST_QUERIES", 1)
    gate.config.write_text(f"cases: [{json.dumps(str(walks))}]\n", encoding="utf-8")
    return gate


def test_speed_is_held_against_the_baseline(
    walking: Gate, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """What is as fast as it was passes; what asks retail four times for each answer does not."""
    now, answer = [0.0], OracleCandidate.answer

    def answer_in_a_second(oracle: OracleCandidate, query: Query) -> Any:
        now[0] += 1.0
        return answer(oracle, query)

    monkeypatch.setattr(OracleCandidate, "answer", answer_in_a_second)
    monkeypatch.setattr(speed, "perf_counter", lambda: now[0])
    (walking.folder / "slowed.py").write_text(SLOWED, encoding="utf-8")
    monkeypatch.chdir(walking.folder)
    stored = walking.folder / "baseline.json"
    assert walking("--write-baseline", stored, stage="performance") == exit_codes.OK
    assert json.loads(stored.read_text(encoding="utf-8"))["ratio"] == 1.0
    against = ("--baseline", stored)
    assert walking(*against, stage="performance") == exit_codes.OK
    assert walking(*against, candidate="mod:slowed:Slowed", stage="performance") == exit_codes.FAILURES
    told = (
        "the oracle takes 0.25 (0.25 - 0.25) times as long; stored 1 (1 - 1) of oracle, at least 0.7 demanded"
    )
    assert f"  walks: {told}\n" in capsys.readouterr().out
    (check,) = walking.summary()["checks"]
    assert (check["stage"], check["status"]) == ("performance", "failed")


def test_an_engine_in_a_process_has_a_speed_too(walking: Gate) -> None:
    """Messages are part of it; it passes against what it can reach, and not against a hundred times that."""
    walking.config.write_text(
        walking.config.read_text(encoding="utf-8") + "performance: {baseline: b.json, at_least: 0.01}\n",
        encoding="utf-8",
    )
    command, stored = f"cmd:{serve_command('--candidate', 'oracle')}", walking.folder / "b.json"
    assert walking("--write-baseline", stored, candidate=command, stage="performance") == exit_codes.OK
    assert walking(candidate=command, stage="performance") == exit_codes.OK
    record = json.loads(stored.read_text(encoding="utf-8"))
    stored.write_text(json.dumps({**record, "ratio": 1e4 * record["ratio"]}), encoding="utf-8")
    assert walking(candidate=command, stage="performance") == exit_codes.FAILURES


def test_a_stage_of_speed_needs_a_baseline(walking: Gate, capsys: pytest.CaptureFixture[str]) -> None:
    """2, and how to make one."""
    assert walking(stage="performance") == exit_codes.USAGE
    assert "--write-baseline makes one" in capsys.readouterr().err
