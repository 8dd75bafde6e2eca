"""The gate: how it ends, what it writes, what it skips."""

from __future__ import annotations

import datetime as dt
import hashlib
import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

import pytest
from deviation_files import FAILING, ORIGIN, deviation_file
from faux import faux_command
from gate_command import TWO_CASES, Gate
from hypothesis import given
from hypothesis import strategies as st
from shipped_cases import shipped_cases

from conformance import exit_codes
from conformance.candidates.known_bugs import list_bugs
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.registry import make_candidate
from conformance.compare import Difference
from conformance.deviations.files import Deviations
from conformance.deviations.reckoning import reckon
from conformance.gate import config, digests, pages, pinned
from conformance.gate.evidence import EvidenceError, badge_record, passed_before
from conformance.gate.junit import junit_xml
from conformance.gate.outcome import Check, GateRun, Stage, Status
from conformance.gate.pinned import judged
from conformance.loader import Vary, load_file
from conformance.query import Query
from conformance.report.html.library import MissingVizError
from conformance.shapes import Kind
from conformance.verdict import Failure, Verdict, judge

if TYPE_CHECKING:
    from collections.abc import Sequence

BUGS = {bug.id: bug for bug in list_bugs() if bug.case}
assert BUGS, "no known bugs with a case"
TODAY = dt.date(2030, 1, 1)


@pytest.fixture
def gate(tmp_path: Path) -> Gate:
    """Return the command, on the two cases about a cell's origin."""
    return Gate(tmp_path)


def run_of(*statuses: Status, asked: Sequence[Stage] = (Stage.CASES,), whole: bool = True) -> GateRun:
    """Return a run whose checks ended so."""
    checks = [Check(Stage.CASES, f"case-{n}", status, 1) for n, status in enumerate(statuses)]
    return GateRun(tuple(asked), checks, whole=whole)


@pytest.mark.parametrize(
    ("statuses", "code"),
    [
        ([Status.PASSED, Status.SKIPPED, Status.RECORDED, Status.UNCHANGED], exit_codes.OK),
        ([Status.UNCHANGED], exit_codes.OK),
        ([Status.PASSED, Status.BROKEN, Status.FAILED], exit_codes.FAILURES),
        ([Status.PASSED, Status.BROKEN], exit_codes.BROKEN),
        ([Status.SKIPPED], exit_codes.NOTHING_RAN),
        ([], exit_codes.NOTHING_RAN),
    ],
)
def test_exit_codes(statuses: list[Status], code: int) -> None:
    """A wrong answer counts more than a missing one, and that more than nothing."""
    assert run_of(*statuses).exit_code == code


def test_each_stage_must_show_something() -> None:
    """One that has shown nothing is named, whatever the others show."""
    run = run_of(Status.PASSED, asked=(Stage.CASES, Stage.WALKS))
    assert (run.exit_code, run.empty_stages) == (exit_codes.NOTHING_RAN, [Stage.WALKS])
    assert GateRun((), whole=True).exit_code == exit_codes.NOTHING_RAN


def test_a_run_that_was_broken_off_is_not_green() -> None:
    """But red if it was red by then."""
    assert run_of(Status.PASSED, whole=False).exit_code == exit_codes.BROKEN_OFF
    assert run_of(Status.FAILED, whole=False).exit_code == exit_codes.FAILURES


def test_a_clean_candidate_passes(gate: Gate, capsys: pytest.CaptureFixture[str]) -> None:
    """0, and the folder holds what was seen, each file as its sum says."""
    assert gate() == exit_codes.OK
    out = capsys.readouterr().out.splitlines()
    assert out == ["cases: 2 passed; 2 compared", f"gate: pass; evidence: {gate.evidence}"]
    sums = (gate.evidence / "SHA256SUMS").read_text(encoding="utf-8").splitlines()
    named = dict(reversed(line.split("  ")) for line in sums)
    assert list(named) == [
        "summary.json",
        "junit.xml",
        "environment.json",
        "seeds.json",
        "badge.json",
        "report.html",
    ]
    for name, digest in named.items():
        assert hashlib.sha256((gate.evidence / name).read_bytes()).hexdigest() == digest
    summary = gate.summary()
    assert (summary["verdict"], summary["exit_code"], summary["candidate"]) == ("pass", 0, "oracle")
    assert [check["status"] for check in summary["checks"]] == ["passed", "passed"]
    badge = json.loads((gate.evidence / "badge.json").read_text(encoding="utf-8"))
    assert (badge["message"], badge["color"]) == ("2 cases", "brightgreen")


def test_a_bug_does_not(gate: Gate, capsys: pytest.CaptureFixture[str]) -> None:
    """1, with the first difference, in the report as well."""
    assert gate("--case", FAILING, candidate="bug:cell-origin") == exit_codes.FAILURES
    out = capsys.readouterr().out
    assert f"  {FAILING}: {FAILING}: contact_plane.d: retail -94.0" in out
    assert f"  every field, the source and the scene: {gate.evidence / 'report.html'}\n" in out
    assert "nothing was shown" not in out
    assert FAILING in (gate.evidence / "report.html").read_text(encoding="utf-8")
    assert gate.summary()["verdict"] == "disagreement"


def test_the_report_shows_the_scene_of_what_fails(gate: Gate, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the library is installed; without it there is a report all the same."""
    pytest.importorskip("plotly", reason="the extra `viz` is not installed")
    monkeypatch.setattr(pages, "plotly_source", lambda: "/* the library */")
    gate(candidate="bug:cell-origin")
    text = (gate.evidence / "report.html").read_text(encoding="utf-8")
    assert text.count('class="view"') == 1
    assert "/* the library */" in text

    def missing() -> str:
        raise MissingVizError("plotly")

    monkeypatch.setattr(pages, "plotly_source", missing)
    gate(candidate="bug:cell-origin")
    assert 'class="view"' not in (gate.evidence / "report.html").read_text(encoding="utf-8")


def test_the_report_of_an_earlier_run_does_not_stay(gate: Gate) -> None:
    """Beside evidence of a run that asks no cases nobody would know what it is about."""
    gate(candidate="bug:cell-origin")
    assert (gate.evidence / "report.html").exists()
    gate.config.write_text("poses: {count: 1, seed: 3}\n", encoding="utf-8")
    assert gate(candidate="oracle", stage="poses") == exit_codes.OK
    assert not (gate.evidence / "report.html").exists()


def test_the_verdict_is_told_where_it_cannot_be_written(
    gate: Gate, capsys: pytest.CaptureFixture[str]
) -> None:
    """After minutes, with the exit code of what could not be done."""
    gate.evidence.write_text("in the way", encoding="utf-8")
    assert gate(candidate="bug:cell-origin") == exit_codes.CANNOT_WRITE
    assert "gate: disagreement" in capsys.readouterr().out


def test_a_recorded_bug_passes(gate: Gate) -> None:
    """And is counted; a record that does not show is a disagreement."""
    path = deviation_file(gate.folder)
    assert gate("--deviations", path, candidate="bug:cell-origin") == exit_codes.OK
    assert gate.summary()["stages"]["cases"]["recorded"] == 1
    assert gate("--deviations", path) == exit_codes.FAILURES


def test_a_deviation_about_no_case_is_red(gate: Gate) -> None:
    """But not one about a case that is filtered away."""
    path = deviation_file(gate.folder, case="origin-step-up-touching")
    assert gate("--deviations", path) == exit_codes.FAILURES
    path = deviation_file(gate.folder)
    assert gate("--deviations", path, "--case", "*-short") == exit_codes.OK


def test_ctrl_c_leaves_evidence(gate: Gate, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of what was seen until then, which is not all."""

    def breaking(*_asked: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(pinned, "case_digest", breaking)
    assert gate() == exit_codes.BROKEN_OFF
    summary = gate.summary()
    assert (summary["verdict"], summary["whole"], summary["checks"]) == ("broken off", False, [])


def test_nothing_of_a_stage_leaves_it_out(tmp_path: Path) -> None:
    """So that it need not show anything."""
    path = tmp_path / "gate.yaml"
    path.write_text("poses: {count: 0}\nwalks: {count: 0}\nstress: {families: []}\n", encoding="utf-8")
    assert config.read_config(path, config.FULL).stages == (Stage.CASES,)


def test_all_filtered_away(gate: Gate, capsys: pytest.CaptureFixture[str]) -> None:
    """4: nothing was shown to be right."""
    assert gate("--case", "nothing-*") == exit_codes.NOTHING_RAN
    assert "cases: nothing was shown" in capsys.readouterr().out


def test_a_broken_candidate(gate: Gate) -> None:
    """3: it ends before it has introduced itself."""
    assert gate(candidate=f"cmd:{faux_command('refuses')}") == exit_codes.BROKEN
    assert {check["status"] for check in gate.summary()["checks"]} == {"broken"}


def test_a_candidate_that_hangs_is_given_up(gate: Gate, monkeypatch: pytest.MonkeyPatch) -> None:
    """3, after the first case that has taken all patience; the evidence says so."""
    monkeypatch.setattr(pinned, "PATIENCE", 0.0)
    assert gate(candidate=f"cmd:{faux_command('refuses')}") == exit_codes.BROKEN
    summary = gate.summary()
    assert ([check["name"] for check in summary["checks"]], summary["whole"]) == ([FAILING], False)
    assert summary["notes"][0].startswith(f"given up at {FAILING}, after ")


def test_what_is_unchanged_is_skipped(gate: Gate) -> None:
    """Twice in a row, too; not if another candidate is asked, and never by a full gate."""
    assert gate() == exit_codes.OK
    for _ in range(2):
        assert gate("--skip-unchanged", gate.evidence) == exit_codes.OK
        assert gate.summary()["stages"]["cases"]["unchanged"] == 2
    assert gate("--skip-unchanged", gate.evidence, candidate="bug:cell-origin") == exit_codes.FAILURES
    assert gate.summary()["stages"]["cases"]["unchanged"] == 0
    assert gate("--full", "--skip-unchanged", gate.evidence) == exit_codes.USAGE


def test_random_queries(gate: Gate) -> None:
    """Families are asked from the seed that is told, and the first wrong query is kept and summed."""
    gate.config.write_text("poses: {count: 6, seed: 3}\n", encoding="utf-8")
    assert gate(candidate="bug:float32-registers", stage="poses") == exit_codes.FAILURES
    seeds = json.loads((gate.evidence / "seeds.json").read_text(encoding="utf-8"))
    assert seeds["poses"] == {"count": 6, "seed": 3}
    wrong = next(check for check in gate.summary()["checks"] if check["status"] == "failed")
    (case,) = load_file(gate.evidence / "found" / wrong["message"].rpartition("kept: ")[2]).cases
    verdict = judge(case, make_candidate("bug:float32-registers"), OracleCandidate())
    assert verdict.failures
    assert f"found/{case.id}.yaml" in (gate.evidence / "SHA256SUMS").read_text(encoding="utf-8")


@pytest.mark.parametrize("bug", [bug for bug in BUGS.values() if not bug.survives], ids=lambda bug: bug.id)
def test_each_known_bug_fails_the_gate(bug: Any, gate: Gate) -> None:
    """1, and the evidence names the case; more cases and stages can only add to what fails."""
    case = shipped_cases()[bug.case]
    gate.config.write_text(
        TWO_CASES.format(json.dumps(str(Path(case.location.file).resolve()))), encoding="utf-8"
    )
    assert gate("--case", case.id, candidate=f"bug:{bug.id}") == exit_codes.FAILURES
    (check,) = gate.summary()["checks"]
    assert (check["name"], check["status"]) == (case.id, "failed")
    assert case.id in (gate.evidence / "report.html").read_text(encoding="utf-8")


def test_an_error_alone_is_broken() -> None:
    """Beside a wrong answer it is a disagreement."""
    query = Query("plane_set_height", {}, label="x")
    error = Failure(query, "engine", error="ended\n  log")
    wrong = Failure(query, "engine", found=(Difference("r", "r", Kind.BITS, 1, 2),))

    def status(*failures: Failure) -> Status:
        verdict = Verdict(1, failures=list(failures))
        return judged(verdict, reckon(Deviations("x"), "x", verdict, candidate="engine", today=TODAY))[0]

    assert status(error) is Status.BROKEN
    assert status(error, wrong) is Status.FAILED
    assert status() is Status.PASSED


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("cases: []", "gate.yaml:1:8: cases"),
        ("posses: {count: 1}", "did you mean 'poses'?"),
        ("poses: {count: -1}", "gate.yaml:1:16: poses.count"),
        ("stress: {families: [drifts]}", "did you mean 'drift'?"),
        ("performance: {baseline: b.json, at_least: 0}", "performance.at_least"),
        ("performance: {baseline: nowhere.json}", "cannot read"),
        ("deviations: nowhere.yaml", "cannot read"),
        ("cases: [nowhere]", "does not exist"),
    ],
)
def test_mistakes_in_a_configuration(
    text: str, told: str, gate: Gate, capsys: pytest.CaptureFixture[str]
) -> None:
    """2, with the place, before anything is asked."""
    few = "" if "cases" in text else f"cases: [{json.dumps(str(ORIGIN))}]\n"
    gate.config.write_text(f"{text}\n{few}", encoding="utf-8")
    stage = "performance" if "nowhere.json" in text else "cases"
    assert gate(stage=stage) == exit_codes.USAGE
    assert told in capsys.readouterr().err
    assert not gate.evidence.exists()


def test_a_budget_is_read_before_anything_is_asked(gate: Gate, capsys: pytest.CaptureFixture[str]) -> None:
    """2: not after minutes."""
    pytest.importorskip("flint", reason="the extra `exact` is not installed")
    for name, told in (("nowhere.yaml", "cannot read"), (gate.config.name, "not a budget")):
        few = f"cases: [{json.dumps(str(ORIGIN))}]\n"
        gate.config.write_text(f"{few}stress: {{families: [drift], budget: {name}}}\n", encoding="utf-8")
        assert gate(stage="stress") == exit_codes.USAGE
        assert told in capsys.readouterr().err
    assert not gate.evidence.exists()


def test_a_configuration_changes_a_preset(tmp_path: Path) -> None:
    """What it does not say stays; paths are relative to its folder, the name of an engine is none."""
    path = tmp_path / "gate.yaml"
    path.write_text("poses: {count: 7}\ncases: [mine]\ndeviations: engine\n", encoding="utf-8")
    changed = config.read_config(path, config.QUICK)
    assert changed == replace(
        config.QUICK, poses=config.Draws(count=7), cases=(tmp_path / "mine",), deviations="engine"
    )


def test_the_suite_can_be_named_where_it_is_not(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside cases of one's own; elsewhere than in a clone it is what is installed."""
    path = tmp_path / "gate.yaml"
    path.write_text("cases: [conformance/cases, mine]\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    asked = config.read_config(path, config.QUICK).cases
    assert asked == (Path(config.__file__).parents[1] / "cases", tmp_path / "mine")


def test_stress_families_are_those_there_are() -> None:
    """They are named twice, because those of the suite come with an extra."""
    pytest.importorskip("flint", reason="the extra `exact` is not installed")
    from conformance.stress.families import FAMILIES

    assert tuple(FAMILIES) == config.STRESS_FAMILIES


def test_junit_counts_and_survives_any_log() -> None:
    """Failures, errors and skips by their names; what XML cannot hold is replaced."""
    run = run_of(Status.PASSED, Status.FAILED, Status.BROKEN, Status.RECORDED)
    run.checks[1] = replace(run.checks[1], message="at <cell> \x1b[31m\nmore")
    (suite,) = ET.fromstring(junit_xml(run))  # noqa: S314 - our own
    assert {name: suite.get(name) for name in ("tests", "failures", "errors", "skipped")} == {
        "tests": "4",
        "failures": "1",
        "errors": "1",
        "skipped": "1",
    }
    failure = suite.find("testcase[@name='case-1']/failure")
    assert failure is not None
    assert failure.get("message") == "at <cell> \ufffd[31m"


@given(st.text())
def test_junit_is_xml(text: str) -> None:
    """Whatever a message says."""
    run = GateRun((Stage.CASES,), [Check(Stage.CASES, "x", Status.FAILED, message=text)])
    ET.fromstring(junit_xml(run))  # noqa: S314 - our own


def test_the_badge_names_deviations() -> None:
    """So that a green one does not say more than it may."""
    badge = badge_record(run_of(Status.PASSED, Status.RECORDED))
    assert badge["message"] == "1 cases, 1 deviations"
    assert badge_record(run_of())["color"] == "lightgrey"


def test_no_evidence_is_a_mistake(tmp_path: Path) -> None:
    """A folder without a summary, or with something else."""
    with pytest.raises(EvidenceError, match="cannot read"):
        passed_before(tmp_path)
    (tmp_path / "summary.json").write_text("[]", encoding="utf-8")
    with pytest.raises(EvidenceError, match="found no summary"):
        passed_before(tmp_path)


def test_digests_change_with_what_they_are_of() -> None:
    """Of a foreign candidate they are what its author says; without that there is none."""
    assert digests.candidate_digest("cmd:x", None) == ""
    assert digests.candidate_digest("cmd:x", "1") != digests.candidate_digest("cmd:x", "2")
    assert digests.candidate_digest("cmd:x", "1") != digests.candidate_digest("cmd:y", "1")
    assert digests.candidate_digest("oracle", None) != digests.candidate_digest("engine", None)
    with pytest.raises(ModuleNotFoundError):
        digests.sources_digest("no_such_package")
    case, other = load_file(ORIGIN, Vary(poses=0)).cases
    one, two = config.Draws(count=1), config.Draws(count=2)
    asked = [(case, None), (other, None), (case, one), (case, two)]
    assert len({digests.case_digest(which, poses, "s", "c") for which, poses in asked}) == len(asked)
    assert digests.case_digest(case, None, "s", "") == ""
