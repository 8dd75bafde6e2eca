"""`conformance stress` from end to end: a small run, being broken off, budgets, exit codes, files."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

pytest.importorskip("flint", reason="the extra `exact` is not installed")

from conformance import cli, exit_codes
from conformance.bench import plots as bench_plots
from conformance.life.layout import lay_out
from conformance.loader import load_paths
from conformance.stress import runner, settings
from conformance.stress.findings import CANDIDATE, Findings, Picture, Reading
from conformance.stress.models import Spec
from conformance.stress.plots import write_plots
from conformance.stress.runner import Plan
from conformance.stress.settings import Settings
from conformance.workers import MOST_WORKERS

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

TINY = Settings(seed=settings.DEFAULT_SEED, probes=1, grid=4, ticks=150, quick=True)
WITHIN = Reading("scale", "scale 1", 0.0, CANDIDATE, {"differing": 0.0, "contact_metres": 0.0})


def stress(*arguments: object) -> int:
    """Run the command in this process."""
    return cli.main(["stress", "--quick", "--jobs", "1", *(str(argument) for argument in arguments)])


def run_with(
    monkeypatch: pytest.MonkeyPatch, found: Callable[[Plan, Findings], None], *arguments: object
) -> int:
    """Run the command with other findings."""
    monkeypatch.setattr(runner, "run_plan", lambda plan, into, _say: found(plan, into))
    return stress(*arguments)


def test_a_small_run(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The engine is retail at every point; the worst queries are cases without mistakes."""
    monkeypatch.setattr(settings, "quick", lambda _seed: TINY)
    files = ("--json", tmp_path / "new" / "stress.json", "--worst", tmp_path / "worst")
    assert stress("--family", "scale", *files) == exit_codes.OK
    told = json.loads((tmp_path / "new" / "stress.json").read_text(encoding="utf-8"))
    assert told["candidate"] == "engine"
    assert told["seed"] == settings.DEFAULT_SEED
    assert told["families"] == ["scale"]
    assert told["differences"] == told["failures"] == []
    out = capsys.readouterr().out
    assert "D off the true plane (m)" in out
    for file in (tmp_path / "worst").iterdir():
        raw = file.read_bytes()
        assert lay_out(raw, file.name).encode("utf-8") == raw
    cases = load_paths([tmp_path / "worst"])
    assert cases.problems == ()
    assert {case.tags for case in cases.cases} == {("stress", "scale")}


def test_a_candidate_that_is_not_retail_fails(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The first differences are told, and the bound that is broken."""
    monkeypatch.setattr(settings, "quick", lambda _seed: TINY)
    assert stress("--family", "scale", "--candidate", "bug:vertex-plane") == exit_codes.FAILURES
    out = capsys.readouterr().out
    assert "differs: scale, scale 0.5 at 0: contact_plane.d: retail" in out
    assert "failure: budget: scale: differing at most 0:" in out


def test_what_is_broken_off_keeps_its_results(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Ctrl-C ends the run; what was found until then is shown and written, and half a run is not green."""

    def found(_plan: Plan, into: Findings) -> None:
        into.readings.append(WITHIN)
        raise KeyboardInterrupt

    assert run_with(monkeypatch, found, "--json", tmp_path / "stress.json") == exit_codes.BROKEN_OFF
    told = json.loads((tmp_path / "stress.json").read_text(encoding="utf-8"))
    assert len(told["readings"]) == 1
    assert told["notes"] == ["the run was broken off: what follows is what there was until then"]
    assert "broken off" in capsys.readouterr().out


def test_what_cannot_be_written_is_told(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the code for that, after all that was found has been shown."""
    taken = tmp_path / "a file"
    taken.write_text("", encoding="utf-8")
    within = lambda _plan, into: into.readings.append(WITHIN)  # noqa: E731
    assert run_with(monkeypatch, within, "--json", taken / "stress.json") == exit_codes.CANNOT_WRITE
    said = capsys.readouterr()
    assert "scale" in said.out
    assert "conformance stress:" in said.err


def test_the_list_of_comparisons_is_written(tmp_path: Path) -> None:
    """Whole, without asking anything."""
    file = tmp_path / "list.md"
    assert stress("--comparisons", file) == exit_codes.OK
    assert file.read_text(encoding="utf-8").startswith("# Every comparison of documents 02 to 05")


def test_exit_codes_say_how_it_ended(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Nothing asked is 4, a broken budget 1."""
    budget = tmp_path / "strict.yaml"
    budget.write_text(
        "candidate: engine\n"
        "bounds: [{family: scale, quantity: contact_metres, at_least: 1.0, reason: A test.}]\n",
        encoding="utf-8",
    )
    assert run_with(monkeypatch, lambda *_: None) == exit_codes.NOTHING_RAN
    within = lambda _plan, into: into.readings.append(WITHIN)  # noqa: E731
    assert run_with(monkeypatch, within) == exit_codes.OK
    assert run_with(monkeypatch, within, "--budget", budget) == exit_codes.FAILURES


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--family", "translatoin"), "no family 'translatoin'; there are translation, rotation"),
        (("--seed", "-1"), "a seed is not negative"),
        (("--jobs", "0"), f"--jobs 0: from 1 to {MOST_WORKERS} processes are possible"),
        (("--jobs", "1000000000"), "--jobs 1000000000: from 1 to "),
        (("--candidate", "engin"), "Did you mean 'engine'?"),
        (("--budget", "no/such.yaml"), "cannot read"),
    ],
)
def test_a_wrong_command_line_is_told(
    capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], message: str
) -> None:
    """Exit code 2, and what is wrong."""
    assert stress(*arguments) == exit_codes.USAGE
    assert message in capsys.readouterr().err


def test_a_file_that_is_no_budget_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With the place of the mistake."""
    path = tmp_path / "budget.yaml"
    path.write_text("candidate: engine\nbound: []\n", encoding="utf-8")
    assert stress("--budget", path) == exit_codes.USAGE
    assert "budget.yaml:2:1" in capsys.readouterr().err


def test_plots_that_cannot_be_drawn_are_told_before_the_run(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without matplotlib everything else works."""

    def absent(name: str) -> Any:
        raise ImportError(name)

    monkeypatch.setattr(bench_plots, "import_module", absent)
    assert stress("--plots", tmp_path) == exit_codes.USAGE
    assert "plots need matplotlib (extra `bench`)" in capsys.readouterr().err


def test_plots_are_drawn_in_both_formats(tmp_path: Path) -> None:
    """A sheet for each family with curves, and one of the squares."""
    pytest.importorskip("matplotlib", reason="skipped: matplotlib is not installed")
    readings = [
        Reading("scale", "scale 0.5", severity, model, {"formula_metres": severity / 1e6})
        for severity in (0.0, 1.0, 10.0)
        for model in ("retail", "single", "double")
    ]
    found = Findings(readings, [Picture("edge", ("x", "y"), ((0, 1), (2, 3)))])
    paths = write_plots(found, Plan(TINY, ("scale",), Spec("engine"), 1), tmp_path)
    assert {path.name for path in paths} == {"scale.svg", "scale.png", "signs.svg", "signs.png"}
    assert all(path.stat().st_size > 1000 for path in paths)
