"""`conformance show`: the work of a case."""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance import exit_codes
from conformance.cli import main

if TYPE_CHECKING:
    import pytest


def test_work_is_shown_beside_brute_force(capsys: pytest.CaptureFixture[str]) -> None:
    """Of every transition of a walk."""
    assert main(["show", "--work", "walk-single-floor"]) == exit_codes.OK
    out = capsys.readouterr().out
    assert "polygons tested" in out
    assert "of the polygon tests of brute force are avoided" in out


def test_what_runs_no_transition_has_no_work(capsys: pytest.CaptureFixture[str]) -> None:
    """A single call of a tree takes no shortcuts."""
    assert main(["show", "--work", "origin-step-down-touching"]) == exit_codes.NOTHING_RAN
    assert "runs no transition" in capsys.readouterr().out


def test_something_has_to_be_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    """The message says what there is."""
    assert main(["show", "origin-step-down-touching"]) == exit_codes.USAGE
    assert "--work" in capsys.readouterr().err
