"""`conformance errors` from end to end: random queries, recorded ones, files, and wrong requests."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

pytest.importorskip("flint", reason="the extra `exact` is not installed")

import conformance
from conformance import cli, exit_codes
from conformance.candidates import registry
from conformance.loader import load_paths

VECTORS = Path(conformance.__file__).parent / "vectors"


def test_random_queries(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Every model is measured; the JSON says the same as the table, and the worst queries are cases."""
    wanted = ["--draws", "8", "--json", str(tmp_path / "errors.json"), "--save", str(tmp_path / "worst")]
    assert cli.main(["errors", *wanted]) == exit_codes.OK
    told = json.loads((tmp_path / "errors.json").read_text(encoding="utf-8"))
    assert told["asked"] == 8
    assert told["undecided"] == []
    assert list(told["models"]) == ["retail", "single", "double"]
    assert told["seconds"].keys() == {"retail", "single", "double", "exact"}
    for model in told["models"].values():
        assert model["samples"] == 8
        assert model["measures"]["position_metres"]["count"] == 8 - model["flipped"]
    out = capsys.readouterr().out
    assert "8 queries (8 at 128 bits)" in out
    assert list((tmp_path / "worst").glob("found-*.yaml"))
    assert load_paths([tmp_path / "worst"]).problems == ()


def test_recorded_queries(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Vector files are asked record by record."""
    lines = (VECTORS / "math.jsonl").read_text(encoding="utf-8").splitlines()
    assert lines
    (tmp_path / "few.jsonl").write_text("\n".join(lines[:5]) + "\n", encoding="utf-8")
    assert cli.main(["errors", str(tmp_path / "few.jsonl")]) == exit_codes.OK
    assert "5 queries" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [(["nowhere.jsonl"], "no such file"), (["--family", "songs"], "unknown family 'songs'; there are: ")],
)
def test_wrong_requests(arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A message and the exit code of a wrong command line."""
    assert cli.main(["errors", *arguments]) == exit_codes.USAGE
    assert message in capsys.readouterr().err


def test_a_missing_extra_is_told(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Nothing is measured without the exact model."""
    monkeypatch.setattr(registry, "EXTRAS", {"exact": ("no_such_module", "pip install it")})
    assert cli.main(["errors"]) == exit_codes.USAGE
    assert "needs no_such_module" in capsys.readouterr().err
