"""`conformance trace` and `conformance trace-log`: what they print and how they end."""

from __future__ import annotations

import os
import re
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from shipped_cases import shipped_cases

from conformance import cli
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.registry import candidate_names, make_candidate
from conformance.candidates.table import TableCandidate
from conformance.commands import trace
from conformance.loader import BUILT_IN_CASES
from conformance.trace_lines import parse_line
from conformance.trace_text import line_of
from oracle.write_trace import recording
from oracle.writes import Write

if TYPE_CHECKING:
    from conformance.case import Case

ORIGIN = "origin-step-down-touching"
ORIGIN_FILE = BUILT_IN_CASES / "contact-plane" / "origin.yaml"
CELLAR = "walk-cellar-and-back"
CASES = shipped_cases()
MOST_TICKS = 170
"""Of a walk that is traced; the dozen longer ones take a second each, and write as these do."""
TRACED = [case for case in CASES.values() if len(case.queries[0].inputs.get("ticks", ())) <= MOST_TICKS]


def run(capsys: pytest.CaptureFixture[str], *arguments: object) -> tuple[int, list[str], str]:
    """Run a command and return its exit code, the lines it printed and what it complained of."""
    code = cli.main([str(argument) for argument in arguments])
    printed = capsys.readouterr()
    return code, printed.out.splitlines(), printed.err.strip()


def test_the_origin_case_in_the_oracle(capsys: pytest.CaptureFixture[str]) -> None:
    """Every line: the plane is that of the floor at 94 m, and step_sphere_down writes it."""
    code, lines, _ = run(capsys, "trace", ORIGIN)
    assert code == 0
    assert lines == [
        "origin-step-down-touching (find_collisions, oracle)",
        "[bsp] Call: D -> ADJUSTED caller=outside",
        "[cp-write] ContactPlaneValid: 0 -> 1 caller=step_sphere_down",
        "[cp-write] ContactPlane: n=(0,0,0) D=0.000 -> n=(0,0,1) D=-94.000 caller=step_sphere_down",
        "[cp-write] ContactPlaneCellId: 0x00000000 -> 0xA9B40151 caller=step_sphere_down",
        "[walkable] Walkable: none -> polygon 0 caller=step_sphere_down",
        "summary:",
        "  topic     caller            entries  ADJUSTED",
        "  bsp       outside           1        1",
        "  cp-write  step_sphere_down  3        3",
        "  walkable  step_sphere_down  1        1",
        "result: ADJUSTED",
    ]


def test_the_origin_case_in_the_bug_it_is_about(capsys: pytest.CaptureFixture[str]) -> None:
    """The same call writes a plane through the world's origin."""
    code, lines, _ = run(capsys, "trace", ORIGIN, "--candidate", "bug:cell-origin", "--trace", "bsp,cp-write")
    assert code == 0
    assert lines[:5] == [
        "origin-step-down-touching (find_collisions, bug:cell-origin)",
        "[bsp] Call: D -> ADJUSTED caller=outside",
        "[cp-write] ContactPlaneValid: 0 -> 1 caller=step_sphere_down",
        "[cp-write] ContactPlane: n=(0,0,0) D=0.000 -> n=(0,0,1) D=-0.000 caller=step_sphere_down",
        "[cp-write] ContactPlaneCellId: 0x00000000 -> 0xA9B40151 caller=step_sphere_down",
    ]
    assert not any("walkable" in line for line in lines)


def test_the_documents_show_what_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    """The trace, the line of the bug, and the line to log, to the letter."""
    page = (Path(__file__).parents[2] / "docs" / "tracing.md").read_text(encoding="utf-8")
    shown, bug, transits, failure, logged = re.findall(r"^```text\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    assert run(capsys, "trace", ORIGIN)[1] == shown.splitlines()
    assert bug.strip() in run(capsys, "trace", ORIGIN, "--candidate", "bug:cell-origin")[1]
    assert transits.splitlines() == run(capsys, "trace", CELLAR, "--trace", "cell-transit")[1][1:13]
    assert failure.splitlines()[-2].partition(": ")[2] == bug.strip()
    assert parse_line(logged.strip()) is not None


def test_a_case_of_a_file_in_a_pose(capsys: pytest.CaptureFixture[str]) -> None:
    """FILE::ID names a case of any file; --pose picks a variant; --foot tells where the mover was."""
    code, lines, _ = run(
        capsys, "trace", f"{ORIGIN_FILE}::{ORIGIN}", "--pose", 2, "--trace", "cp-write", "--foot"
    )
    assert code == 0
    assert lines[0] == "origin-step-down-touching[pose 2] (find_collisions, oracle)"
    assert all(" foot=(" in line for line in lines if line.startswith("[cp-write]"))


def test_the_only_case_of_a_file_needs_no_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As a found failure is: the file says which."""
    file = tmp_path / "found.yaml"
    code, _, _ = run(capsys, "new", "my-floor", "--like", ORIGIN, "-o", file)
    assert code == 0
    code, lines, _ = run(capsys, "trace", file)
    assert (code, lines[0]) == (0, "my-floor (find_collisions, oracle)")


def test_a_case_that_writes_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    """It is said."""
    code, lines, _ = run(capsys, "trace", "origin-step-down-short", "--trace", "cp-write")
    assert (code, lines[1:]) == (0, ["summary:", "  no writes", "result: OK"])


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ([f"{ORIGIN}x"], f"no case '{ORIGIN}x' among the built-in cases. Did you mean '{ORIGIN}'?"),
        (["my-ramp"], "no case 'my-ramp' among the built-in cases. A case of another file is FILE::ID."),
        (["nowhere.yaml"], "nowhere.yaml does not exist"),
        ([str(ORIGIN_FILE)], f"cases, expected one.\n  {ORIGIN_FILE}::{ORIGIN}\n"),
        ([ORIGIN, "--trace", "cp-wrte"], "unknown topic 'cp-wrte'. Did you mean 'cp-write'? There are: "),
        ([ORIGIN, "--pose", "99"], f"{ORIGIN} has 8 random poses, there is no pose 99"),
        ([ORIGIN, "--candidate", "bug:cel-origin"], "Did you mean 'bug:cell-origin'?"),
        ([f"nowhere.yaml::{ORIGIN}"], "nowhere.yaml does not exist"),
    ],
)
def test_what_is_not_there_is_a_usage_error(
    arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2, and the nearest name where there is one."""
    code, lines, error = run(capsys, "trace", *arguments)
    assert (code, lines) == (2, [])
    assert complaint in error


def test_the_engine_prints_what_the_oracle_prints(capsys: pytest.CaptureFixture[str]) -> None:
    """But for its name."""
    _, retail, _ = run(capsys, "trace", ORIGIN)
    code, lines, _ = run(capsys, "trace", ORIGIN, "--candidate", "engine")
    assert code == 0
    assert lines == [line.replace("oracle", "engine") for line in retail]


def test_a_candidate_that_cannot_be_traced_is_a_usage_error(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is said who can."""
    monkeypatch.setattr(TableCandidate, "name", "foreign", raising=False)
    monkeypatch.setattr(trace, "candidate_from", lambda _args: TableCandidate())
    code, _, error = run(capsys, "trace", ORIGIN)
    assert code == 2
    assert "foreign cannot be traced; oracle, engine and the known bugs (bug:NAME) can" in error


@pytest.mark.parametrize("case", TRACED, ids=lambda case: case.id)
def test_a_trace_accounts_for_every_change(case: Case) -> None:
    """Each write begins where its field's last ended, can be read back, and changes no answer."""
    for query in case.queries:
        with recording(None) as trace:
            traced = OracleCandidate().answer(query)
        assert repr(traced) == repr(OracleCandidate().answer(query))
        last: dict[tuple[int, str], Write] = {}
        for entry in trace.entries:
            assert parse_line(line_of(entry, with_foot=True)) is not None
            if isinstance(entry, Write):
                field = entry.transition, entry.label
                assert field not in last or repr(last[field].after) == repr(entry.before)
                last[field] = entry


@pytest.mark.parametrize("spec", [spec for spec in candidate_names() if spec.startswith("bug:")])
def test_a_known_bug_can_be_traced(spec: str) -> None:
    """Whatever it replaces, it answers as without the trace."""
    bug = make_candidate(spec)
    for case_id in (ORIGIN, "transition-stairs-up"):
        (query,) = CASES[case_id].queries
        with recording(None) as trace:
            traced = bug.answer(query)
        assert trace.entries
        assert repr(traced) == repr(bug.answer(query))


def log_of(path: Path, *lines: str) -> Path:
    """Write a log."""
    path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    return path


@pytest.mark.parametrize(("candidate", "code"), [("oracle", 0), ("bug:cell-origin", 1)])
def test_the_log_of_the_bug_is_suspect_and_that_of_retail_is_not(
    candidate: str, code: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What `trace --foot` prints is a log."""
    _, lines, _ = run(capsys, "trace", ORIGIN, "--candidate", candidate, "--foot")
    assert run(capsys, "trace-log", log_of(tmp_path / "engine.log", *lines))[0] == code


def test_what_a_log_holds_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Counts by caller and plane, mistakes and suspect writes with their place."""
    jump = "[cp-write] ContactPlane: n=(0,0,1) D=-94.020 -> n=(0,0,1) D=-0.000 caller=step_sphere_down"
    log = log_of(tmp_path / "a.log", jump, "[state] oops", "frame 7", f"{jump} foot=(0,0,1.5)")
    code, lines, _ = run(capsys, "trace-log", log, "--radius", 0.5, "--step-height", 1)
    assert code == 1
    assert lines == [
        f"{log}: 4 lines, 2 writes, 1 other lines ignored, 1 malformed",
        f"  {log}:2:8: expected ' FIELD: '",
        "writes by caller:",
        "  2  cp-write  step_sphere_down",
        "planes written most often:",
        "  2  ContactPlane  n=(0,0,1) D=-0.000",
        "suspect writes: 1 (limit 1.500 m = radius 0.500 + step height 1.000)",
        (
            f"  {log}:1: ContactPlane n=(0,0,1) D=-94.020 -> n=(0,0,1) D=-0.000 caller=step_sphere_down: "
            "D jumps by 94.020 m"
        ),
        "suspect writes by caller:",
        "  1  cp-write  step_sphere_down",
    ]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
def test_a_log_in_any_encoding(encoding: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With and without a mark at the beginning; a byte that is no UTF-8 does not end the reading."""
    path = tmp_path / "a.log"
    path.write_bytes("[state] State: 0x0 -> 0x1 caller=f\r\nné\r\n".encode(encoding))
    code, lines, _ = run(capsys, "trace-log", path)
    assert (code, lines[0]) == (0, f"{path}: 2 lines, 1 writes, 1 other lines ignored, 0 malformed")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pipes with a name in a folder")
def test_a_log_may_be_a_pipe(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It can be read once only: nothing of its beginning is lost."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    writer = threading.Thread(target=log_of, args=(pipe, *["[state] State: 0x0 -> 0x1 caller=f"] * 1000))
    writer.start()
    code, lines, _ = run(capsys, "trace-log", pipe)
    writer.join()
    assert (code, lines[0]) == (0, f"{pipe}: 1000 lines, 1000 writes, 0 other lines ignored, 0 malformed")


@pytest.mark.parametrize("lines", [(), ("nothing", "to see")])
def test_a_log_without_a_trace_line_is_not_green(
    lines: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nothing was found to judge: 4."""
    code, printed, _ = run(capsys, "trace-log", log_of(tmp_path / "a.log", *lines))
    assert (code, printed[-1]) == (4, "no trace line was found")


def test_a_log_that_is_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A usage error."""
    code, _, error = run(capsys, "trace-log", tmp_path / "none.log")
    assert code == 2
    assert f"cannot read {tmp_path / 'none.log'}" in error


def test_the_rule_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    """--help says which writes are suspect."""
    with pytest.raises(SystemExit) as ended:
        cli.main(["trace-log", "--help"])
    assert ended.value.code == 0
    assert "radius + step height" in capsys.readouterr().out
