"""Engines in processes and Python objects wherever a candidate is accepted."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest
from faux import faux_command, queries, right

from conformance import profiles
from conformance.cli import main
from conformance.loader import BUILT_IN_CASES

if TYPE_CHECKING:
    from pathlib import Path

pytest_plugins = ["pytester"]

IMPORTED = profiles
"""A run within this process forgets what it imports; half of hypothesis cannot be imported a second time."""
PLANES = BUILT_IN_CASES / "math" / "planes.yaml"
BLOCKS = "block-offset"
CONFTEST = "from conformance.conftest import pytest_addoption\n"


@pytest.fixture
def records(tmp_path: Path) -> Path:
    """Write the faux engine's queries as a vector file, and one that it does not do."""
    lines = [{"id": q.label, "op": q.op, **q.inputs, "expect": right(q).fields} for q in queries()]
    other = {"id": "other", "op": "frame_cache", "rotation": [1, 0, 0, 0], "expect": {"m": [1, 0, 0] * 3}}
    path = tmp_path / "records.jsonl"
    path.write_text("".join(f"{json.dumps(line)}\n" for line in (*lines, other)), encoding="utf-8")
    return path


def verified(capsys: pytest.CaptureFixture[str], *arguments: object) -> tuple[int, list[str]]:
    """Return the exit code of `conformance verify` and its lines."""
    code = main(["verify", *map(str, arguments)])
    return code, capsys.readouterr().out.splitlines()


def test_verify_asks_a_process(records: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is not declared is skipped, by name, and counted."""
    code, lines = verified(capsys, records, "--candidate", f"cmd:{faux_command('good')}")
    assert code == 0
    counts = "6 passed, 0 failed, 1 skipped (operation frame_cache is not declared: 1), 0 advisory"
    assert lines[-1] == f"total: {counts}"


def test_verify_goes_on_after_a_crash(records: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The record has the engine's last words; the others are compared."""
    candidate = f"cmd:{faux_command('crash', 4)}"
    code, lines = verified(capsys, records, "--candidate", candidate)
    assert code == 1
    assert lines[1].startswith(f"  {records}:4 q4: {candidate} failed: the engine ended with exit status 3")
    assert lines[2:4] == ["    stderr: about to fail", "    stderr: assertion in cell 7"]
    assert lines[-1].startswith("total: 5 passed, 1 failed, 1 skipped")


def test_verify_tells_a_bad_stop(records: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is nobody's record, and red."""
    candidate = f"cmd:{faux_command('sour')}"
    code, lines = verified(capsys, records, "--candidate", candidate)
    assert code == 1
    assert "  the engine ended with exit status 4 when it was stopped, expected 0" in lines
    assert lines[-1].startswith("total: 6 passed, 1 failed, 1 skipped")


def test_the_rerun_command_quotes_the_engine(records: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It can be copied."""
    candidate = f"cmd:{faux_command('ulp')}"
    code, lines = verified(capsys, records, "--max-differences", 1, "--candidate", candidate)
    assert code == 1
    assert f'  rerun: conformance verify "{records}" --id q1 --candidate "{candidate}"' in lines


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ("cmd:", "found no command, expected a program, as in cmd:./my-engine"),
        ("cmd:./no-such-engine --flag", "found no program './no-such-engine' that can be run"),
        ("mod:no_such_module:Engine", "ModuleNotFoundError: No module named 'no_such_module'"),
        ("cmnd:./engine", "cmd:COMMAND and mod:PACKAGE.MODULE:FACTORY for engines of your own"),
    ],
)
def test_a_bad_name_is_a_usage_error(
    spec: str, message: str, records: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before anything is asked."""
    assert main(["verify", str(records), "--candidate", spec]) == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("seconds", ["0", "-1", "inf", "nan", "soon"])
def test_a_time_is_finite(seconds: str, records: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """An engine that hangs must be noticed."""
    with pytest.raises(SystemExit) as caught:
        main(["verify", str(records), "--read-timeout", seconds])
    assert caught.value.code == 2
    assert "--read-timeout" in capsys.readouterr().err


@pytest.fixture
def run(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> pytest.Pytester:
    """Return a project of its own that can use the plug-in."""
    monkeypatch.setenv("CI", "1")
    pytester.makeconftest(CONFTEST)
    return pytester


def test_the_suite_asks_a_process(run: pytest.Pytester) -> None:
    """Cases that it does not do are skipped by name."""
    candidate = f"cmd:{faux_command('good')}"
    result = run.runpytest_inprocess("--cases", str(PLANES), "--candidate", candidate)
    counts = result.parseoutcomes()
    assert (counts["passed"], counts.get("failed", 0)) == (1, 0)
    assert counts["skipped"] > 1
    result.stdout.fnmatch_lines([f"conformance: * 1 queries compared, * candidate {candidate}"])
    result.stdout.fnmatch_lines(["conformance: *operation plane_localtoglobal is not declared: *"])


def test_the_suite_tells_what_an_engine_did(run: pytest.Pytester) -> None:
    """The log's end, and the command that runs the case again."""
    candidate = f"cmd:{faux_command('crash', 1)}"
    result = run.runpytest_inprocess(
        "--cases", str(PLANES), "-k", BLOCKS, "--candidate", candidate, "--read-timeout", "7"
    )
    result.assert_outcomes(failed=1, deselected=result.parseoutcomes()["deselected"])
    result.stdout.fnmatch_lines(
        [
            "*failed: the engine ended with exit status 3 before it replied",
            "    stderr: assertion in cell 7",
            "*rerun: pytest * --read-timeout 7.0*",
            "FAILED *the engine ended with exit status 3 before it replied",
        ]
    )


def test_the_suite_is_red_for_a_bad_stop(run: pytest.Pytester) -> None:
    """Though every case has passed."""
    candidate = f"cmd:{faux_command('sour')}"
    result = run.runpytest_inprocess("--cases", str(PLANES), "-k", BLOCKS, "--candidate", candidate)
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    assert result.parseoutcomes()["passed"] == 1
    result.stdout.fnmatch_lines(
        [f"conformance: {candidate}: the engine ended with exit status 4 when it was stopped, expected 0"]
    )


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--candidate", "cmd: "], "*--candidate: found no command, expected a program*"),
        (["--candidate", "cmd:./no-such-engine"], "*--candidate: found no program './no-such-engine'*"),
        (["--candidate", "mod:x"], "*--candidate: found mod:x, expected mod:package.module:factory*"),
        (["--read-timeout", "0"], "*--read-timeout: found 0, expected seconds, more than 0*"),
    ],
)
def test_bad_options_are_usage_errors(options: list[str], message: str, run: pytest.Pytester) -> None:
    """Before anything is collected."""
    result = run.runpytest_inprocess("--cases", str(PLANES), *options)
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines([message])
