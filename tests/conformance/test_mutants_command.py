"""`conformance mutants`, with one question and the mutants of one function."""

from __future__ import annotations

from pathlib import Path

import pytest

from conformance import exit_codes
from conformance.cli import main
from conformance.mutation import asking, run
from conformance.mutation.asking import Question
from conformance.query import Query

SITE = "vector.Vector3.normalize_check_small"
ONLY = ["mutants", "--documents", "01", "--only", SITE]
LONG = Question(Query("normalize_check_small", {"v": [3.0, 1.0, 4.0]}), "long", pose=False)


@pytest.fixture
def journal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Ask a single vector, and keep findings in a folder of the test."""
    monkeypatch.setattr(run, "questions", lambda: [LONG])
    return str(tmp_path / "journal.jsonl")


def test_mutants_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    """With place, kind, and what becomes what."""
    assert main([*ONLY, "--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(line.startswith("vector.py:") for line in lines)
    assert any(line.endswith("comparison: 'm < EPS' becomes 'm <= EPS'") for line in lines)


def test_survivors_and_scores_are_shown(journal: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A score below the least one fails the run, one above it does not."""
    assert main([*ONLY, "--journal", journal]) == 1
    out = capsys.readouterr().out
    assert "not noticed: vector.py:" in out
    assert "less than 95 %" in out
    assert main([*ONLY, "--journal", journal, "--resume", "--least", "10"]) == 0
    assert "mutants are noticed" in capsys.readouterr().out


def test_a_resumed_run_asks_nothing_twice(journal: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """All that the journal knows is taken from it."""
    main([*ONLY, "--journal", journal])
    monkeypatch.setattr(run, "reaches", None)
    assert main([*ONLY, "--journal", journal, "--resume", "--least", "10"]) == 0


def test_a_run_that_is_ended_keeps_what_it_found(
    journal: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """And says how to go on."""

    def stop(*_: object) -> object:
        raise KeyboardInterrupt

    monkeypatch.setattr(run, "reaches", stop)
    assert main([*ONLY, "--journal", journal]) == exit_codes.BROKEN_OFF
    assert "--resume goes on" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--only", "polygon.Polygon.make_plan"], "did you mean 'polygon.Polygon.make_plane'?"),
        (["--documents", "99"], "documents are 01 to 10"),
        (["--sample", "5", "--output", "page.md"], "--output goes with no choice"),
        (["--jobs", "10000"], "--jobs 10000: from 1 to "),
    ],
)
def test_a_wrong_command_line(arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Each says what there is instead."""
    assert main(["mutants", *arguments]) == 2
    assert message in capsys.readouterr().err


def test_findings_are_not_lost(journal: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A journal that holds some is only gone on with."""
    main([*ONLY, "--journal", journal])
    found = Path(journal).read_bytes()
    assert main([*ONLY, "--journal", journal]) == exit_codes.USAGE
    assert "--resume goes on with it, another --journal begins anew" in capsys.readouterr().err
    assert Path(journal).read_bytes() == found


def test_what_cannot_be_written_is_told(
    journal: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The page's place before any mutant is asked about."""
    assert main([*ONLY, "--journal", str(tmp_path)]) == exit_codes.CANNOT_WRITE
    monkeypatch.setattr(run, "judge", None)
    assert main(["mutants", "--journal", journal, "--output", str(tmp_path)]) == exit_codes.CANNOT_WRITE
    assert f"cannot write {tmp_path}" in capsys.readouterr().err


def test_the_poses_are_five_hundred() -> None:
    """As the page says."""
    assert sum(asking.POSES.values()) == 500
