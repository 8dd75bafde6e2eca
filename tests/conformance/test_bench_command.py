"""`conformance bench` from end to end: a small run, being broken off, exit codes, files."""

from __future__ import annotations

import json
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from conformance import cli, exit_codes
from conformance.bench import benchmark, ops
from conformance.bench.contests import Contest
from conformance.bench.figures import Summary
from conformance.bench.plots import write_plots
from conformance.bench.report import Curve, Point, Ratio, Report
from conformance.bench.scaling import Scaling
from conformance.bench.scenes import make_scene
from conformance.bench.settings import SECTIONS, Settings, full, quick
from conformance.bench.timing import Comparison, DisagreementError
from conformance.bench.variants import variants_of
from conformance.case import Loaded
from conformance.loader import BUILT_IN_CASES, load_paths

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from conformance.case import Case

SIZES = dict.fromkeys((ops.STRIKE, ops.STEP_DOWN, ops.FIND_COLLISIONS, ops.TOUCH), 8)
COMPARED = Comparison(Summary(2.0, 1.5, 2.5), Summary(100.0, 90.0, 110.0), Summary(200.0, 190.0, 210.0), 5)
LINE = Ratio("room", "strike", "oracle", 1, 1, COMPARED)


def tiny(*sections: str) -> Settings:
    """Return the smallest run."""
    sizes = {**SIZES, ops.CONTACT_WALK: 4, ops.FREE_FLIGHT: 4, ops.TICK: 2}
    return Settings(3, sections, ("room",), 1, 1, sizes, 4, ((2, 1), (3, 2)), 200, 1)


def run_with(monkeypatch: pytest.MonkeyPatch, measure: Callable[..., None], *arguments: object) -> int:
    """Run the command with another measurement and return the exit code."""
    monkeypatch.setattr(benchmark, "measure", measure)
    return cli.main(["bench", *(str(argument) for argument in arguments)])


def test_a_small_run_measures_everything_beside_the_oracle() -> None:
    """Every operation that both do is compared in calls of every size, and nothing disagrees."""
    report = Report(3)
    benchmark.measure(tiny("oracle"), report, lambda _: None)
    assert report.failures == []
    beside = {(line.op, line.batch) for line in report.ratios if line.reference == "oracle"}
    for op in (ops.STRIKE, ops.STEP_DOWN, ops.FIND_COLLISIONS, ops.CONTACT_WALK, ops.FREE_FLIGHT, ops.TICK):
        assert {(op, 1), (op, 100), (op, 10_000)} <= beside
    assert all(line.comparison.ratio.middle > 0.0 for line in report.ratios)
    assert {line.batch for line in report.ratios if line.reference == "engine, contact_walk"} == {
        1000,
        10_000,
    }
    assert report.facts["polygons"]["room"] == [64]
    assert "peers: not asked for (--peers): fcl, coal, trimesh" in report.omissions


def test_the_noise_check_is_the_engine_beside_itself() -> None:
    """It is told as such, and so is what other work before it costs; both give the same answers."""
    report = Report(3)
    benchmark.measure(tiny("noise"), report, lambda _: None)
    assert report.failures == []
    after = "engine, after other work"
    assert [(line.op, line.reference, line.note) for line in report.ratios] == [
        (ops.STRIKE, "engine", "noise check"),
        (ops.STRIKE, after, ""),
        (ops.FIND_COLLISIONS, after, ""),
        (ops.CONTACT_WALK, "engine", "noise check"),
        (ops.CONTACT_WALK, after, ""),
    ]


def test_threads_are_measured_beside_one() -> None:
    """In two sizes of call where they are fastest; each operation has a curve."""
    report = Report(3)
    contest = Contest(make_scene("room"), tiny("threads"), report, np.random.default_rng(1), lambda _: None)
    for op, batch, variants in variants_of(["threads"]):
        if op == ops.STRIKE:
            contest.beside_itself(op, batch, variants)
    assert [(line.batch, line.threads, line.note) for line in report.ratios] == [
        (batch, 2, "beside one thread") for batch in (10_000, 100_000)
    ]
    assert [(curve.name, curve.sizes) for curve in report.curves] == [("threads, room", (1, 2))]


def test_shortcuts_are_measured_beside_none() -> None:
    """So is the order of a batch beside that of asking; an answer that differed would be a failure."""
    report = Report(3)
    benchmark.measure(tiny("plans"), report, lambda _: None)
    assert report.failures == []
    found = {(line.op, line.reference) for line in report.ratios}
    shortened, free = {ops.CONTACT_WALK, ops.FREE_FLIGHT, ops.TICK}, {ops.FREE_FLIGHT}
    assert {op for op, reference in found if reference == "engine, no shortcuts"} == shortened
    assert {op for op, reference in found if reference == "engine, as drawn"} == set(ops.ENGINE_OPS) - free
    assert len(found) == len(report.ratios) == 8


def test_messages_are_measured_over_parts_of_the_suite(monkeypatch: pytest.MonkeyPatch) -> None:
    """A quarter of it in a quick run, all of it in a whole one; no case twice."""
    cases = load_paths([BUILT_IN_CASES / "contact"]).cases
    assert len(cases) > 12
    asked: list[list[Case]] = []
    monkeypatch.setattr(benchmark, "load_paths", lambda: Loaded(cases))
    monkeypatch.setattr(
        benchmark, "measure_messages", lambda rounds, *_: asked.append([*chain.from_iterable(rounds)])
    )
    for size in (quick, full):
        benchmark.measure(size(3, ("messages",), None), Report(3), lambda _: None)
    some, every = asked
    assert abs(len(some) - len(cases) / 4) <= 3
    assert len(set(some)) == len(some)
    assert set(every) == set(cases)
    assert len(every) == len(cases)


def test_curves_have_a_cost_for_each_size() -> None:
    """Moves of more and more sub-steps cost more; each size has its own."""
    report = Report(3)
    Scaling(tiny("scaling"), report, np.random.default_rng(1), lambda _: None).lengths()
    (curve,) = report.curves
    assert curve.sizes == (1, 2, 4, 8, 16, 32)
    assert len(curve.costs) == 6
    assert curve.exponent is not None


def test_a_disagreement_is_a_failure_and_the_run_goes_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """Times of wrong answers are not reported."""

    def disagree(_contest: Contest, op: str, **_others: Any) -> None:
        raise DisagreementError(f"{op} is wrong")

    monkeypatch.setattr(Contest, "beside_itself", disagree)
    report = Report(3)
    benchmark.measure(tiny("noise"), report, lambda _: None)
    assert len(report.failures) == 3
    assert report.ratios == []


def test_what_is_broken_off_keeps_its_results(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Ctrl-C ends the run; what was measured until then is shown and written."""

    def measure(_settings: Settings, report: Report, _say: Any) -> None:
        report.ratios.append(LINE)
        raise KeyboardInterrupt

    target = tmp_path / "new" / "bench.json"
    code = run_with(monkeypatch, measure, "--quick", "--seed", 9, "--json", target)
    record = json.loads(target.read_text(encoding="utf-8"))
    assert code == exit_codes.BROKEN_OFF
    assert record["seed"] == 9
    assert len(record["ratios"]) == 1
    assert "everything after that: the run was broken off" in record["omissions"]
    assert "broken off" in capsys.readouterr().out


def test_exit_codes_say_how_it_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing measured is 4, a wrong answer 1."""
    assert run_with(monkeypatch, lambda *_: None, "--quick") == 4

    def wrong(_settings: Settings, report: Report, _say: Any) -> None:
        report.failures.append("wrong")

    assert run_with(monkeypatch, wrong, "--quick") == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--only", "nothing"), "no section 'nothing'"),
        (("--fixtures", "no/such/folder"), "no such folder"),
        (("--seed", "-1"), "not negative"),
        (("--page", "no/such/page.md"), "cannot read"),
    ],
)
def test_a_wrong_command_line_is_told(
    capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], message: str
) -> None:
    """Exit code 2, and what is wrong."""
    assert cli.main(["bench", *arguments]) == 2
    assert message in capsys.readouterr().err


def test_a_quick_run_is_less_of_everything() -> None:
    """Fewer scenes, rounds and queries than a full one."""
    small, large = quick(1, SECTIONS, None), full(1, SECTIONS, None)
    assert set(small.scenes) < set(large.scenes)
    assert small.rounds < large.rounds
    assert all(small.sizes[op] < large.sizes[op] for op in small.sizes)


def test_plots_are_drawn_in_both_formats(tmp_path: Path) -> None:
    """One file of each kind for ratios, curves and points."""
    pytest.importorskip("matplotlib", reason="skipped: matplotlib is not installed")
    report = Report(1, ratios=[LINE])
    costs = (Summary(10.0, 9.0, 11.0), Summary(20.0, 19.0, 21.0))
    report.curves.append(Curve("polygons", "strike", (60, 600), costs, 0.3))
    report.points.append(Point("room", "oracle", 1e6, {"position (m)": 0.0}))
    report.points.append(Point("room", "engine", 1e3, {"position (m)": 1e-6}))
    names = {path.name for path in write_plots(report, tmp_path)}
    drawn = ("ratios", "scaling", "work-precision")
    assert names == {f"{name}.{kind}" for name in drawn for kind in ("svg", "png")}
    assert all((tmp_path / name).stat().st_size > 1000 for name in names)
