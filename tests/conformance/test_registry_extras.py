"""Candidates that need an extra: refused with the remedy where it is not installed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from conformance import cli, exit_codes
from conformance.candidates import registry
from conformance.candidates.registry import MissingExtraError, make_candidate

if TYPE_CHECKING:
    from pathlib import Path

NOWHERE = {"exact": ("no_such_module", "pip install it")}


@pytest.mark.parametrize("name", ["single", "double"])
def test_number_models_are_candidates(name: str) -> None:
    """They need nothing but the oracle, and are called what they are asked for as."""
    assert make_candidate(name).name == name


def test_exact_is_a_candidate_with_its_extra() -> None:
    """Of all built-in candidates only it needs one."""
    pytest.importorskip("flint", reason="the extra `exact` is not installed")
    assert make_candidate("exact").name == "exact"


def test_a_missing_extra_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is missing and how to get it; the others are not concerned."""
    monkeypatch.setattr(registry, "EXTRAS", NOWHERE)
    with pytest.raises(MissingExtraError, match="candidate 'exact' needs no_such_module: pip install it"):
        make_candidate("exact")
    assert make_candidate("oracle").name == "oracle"


def test_a_missing_extra_is_a_usage_error_of_commands(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """No traceback: the message, and the exit code of a wrong command line."""
    monkeypatch.setattr(registry, "EXTRAS", NOWHERE)
    (tmp_path / "empty.jsonl").write_text("", encoding="utf-8")
    assert cli.main(["verify", str(tmp_path), "--candidate", "exact"]) == exit_codes.USAGE
    assert "needs no_such_module" in capsys.readouterr().err
