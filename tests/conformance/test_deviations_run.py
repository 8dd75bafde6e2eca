"""Deviations in pytest runs and on the command line, as a user meets them."""

from __future__ import annotations

from pathlib import Path

import pytest
from deviation_files import FAILING, ORIGIN, deviation_file

from conformance import loader, profiles
from conformance.cli import main

pytest_plugins = ["pytester"]

IMPORTED = loader, profiles
"""A run within this process forgets what it imports; NumPy and hypothesis cannot be imported again."""
ROOT = Path(__file__).parents[2]
BUG = ("--candidate", "bug:cell-origin")
COUNTS = "conformance: 2 cases, 2 queries compared, 0 skipped, 0 random queries"


@pytest.fixture
def run(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> pytest.Pytester:
    """Return a project of its own that can use the plug-in."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.setenv("CI", "1")  # pytest does not shorten the summary there
    pytester.makeconftest("from conformance.conftest import pytest_addoption\n")
    return pytester


def ran(project: pytest.Pytester, *options: str, **changes: object) -> pytest.RunResult:
    """Run the two cases against a deviation file."""
    path = deviation_file(project.path, **changes)
    args = ("--cases", str(ORIGIN), "--poses", "0", "--deviations", str(path))
    return project.runpytest_inprocess(*args, *(options or BUG))


def test_a_recorded_failure_is_expected(run: pytest.Pytester) -> None:
    """The run is green, and says how many and why."""
    result = ran(run)
    result.assert_outcomes(passed=1, xfailed=1)
    assert result.ret == pytest.ExitCode.OK
    result.stdout.fnmatch_lines(
        [
            f"{COUNTS}, 1 failing as recorded, candidate bug:cell-origin",
            f"XFAIL *::{FAILING} - *deviation: The cell's origin is not passed.",
        ]
    )


def test_a_recorded_failure_that_passes_is_red(run: pytest.Pytester) -> None:
    """With the place of the entry to remove."""
    result = ran(run, "--candidate", "oracle")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines([f"FAILED *::{FAILING} - *bug.yaml:3:5: the deviation does not show*passes*"])


def test_another_failure_is_red(run: pytest.Pytester) -> None:
    """As without a deviation, and the command to run it again names the file."""
    result = ran(run, observed="1.0 (0x3F800000)")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(
        [
            "*rerun: pytest *--deviations*bug.yaml*",
            f"FAILED *::{FAILING} - contact_plane.d: retail -94.0*",
        ]
    )


def test_an_expired_one_is_red(run: pytest.Pytester) -> None:
    """It excuses nothing any more."""
    ran(run, until="2001-01-01").assert_outcomes(passed=1, failed=1)


def test_one_about_no_case_is_red(run: pytest.Pytester) -> None:
    """Although every test passes."""
    result = ran(run, "--candidate", "oracle", case="origin-step-up-touching")
    result.assert_outcomes(passed=2)
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    result.stdout.fnmatch_lines(["conformance: *bug.yaml:3:5: the deviation is about no case*"])


def test_one_about_a_case_of_another_file_is_not(run: pytest.Pytester) -> None:
    """Who runs one file has not asked for all that the record may be about."""
    path = deviation_file(run.path)
    planes = loader.BUILT_IN_CASES / "math" / "planes.yaml"
    result = run.runpytest_inprocess(str(planes), "--deviations", str(path), "--candidate", "oracle")
    assert result.ret == pytest.ExitCode.OK


def test_one_about_a_case_left_out_is_not(run: pytest.Pytester) -> None:
    """A part of a run is no reason to remove it."""
    result = ran(run, *BUG, "-k", "not touching")
    assert result.ret == pytest.ExitCode.OK


def test_a_file_with_mistakes_is_a_usage_error(run: pytest.Pytester) -> None:
    """Before anything is run; so is one that is not there."""
    result = ran(run, case="*")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["*the coarse pattern '[*]'*"])
    result = run.runpytest_inprocess("--cases", str(ORIGIN), "--deviations", "nowhere.yaml")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["*cannot read nowhere.yaml: *"])


def test_the_list(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Each entry with its reason; an expired one makes the command fail."""
    assert main(["deviations"]) == 0
    assert capsys.readouterr().out == "engine: 0 deviations, 0 of them expired\n"
    path = deviation_file(tmp_path, until="2001-01-01")
    assert main(["deviations", str(path)]) == 1
    assert capsys.readouterr().out.splitlines() == [
        f"{FAILING}: contact_plane.d is -0.0 (0x80000000)",
        "  The cell's origin is not passed.",
        "  https://example.org/1",
        f"  expired on 2001-01-01, {path}:3:5",
        "bug:cell-origin: 1 deviation, 1 of them expired",
    ]


def test_a_suggestion(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The entry of the failing case, without a reason; nothing for who does not fail."""
    draft = tmp_path / "draft.yaml"
    asked = ["deviations", "--suggest", "--cases", str(ORIGIN), "--poses", "0"]
    assert main([*asked, *BUG, "-o", str(draft)]) == 0
    told = capsys.readouterr().err.splitlines()
    assert [line.split(";")[0] for line in told[:-1]] == ["1 failing case"]
    assert told[-1] == f"the draft has no reasons: conformance lint --deviations {draft}"
    lines = draft.read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("# A draft: ")
    assert lines[2:] == [
        'engine: "bug:cell-origin"',
        "deviations:",
        "  # contact_plane.d: retail -94.0 (0xC2BC0000), bug:cell-origin -0.0 (0x80000000), 1.1e9 ULPs",
        f'  - case: "{FAILING}"',
        '    field: "contact_plane.d"',
        '    observed: "-0.0 (0x80000000)"',
        "    reason:",
        "    link:",
        "    until:",
    ]
    assert main(["lint", str(ORIGIN), "--deviations", str(draft)]) == 1
    assert "deviations[0].reason" in capsys.readouterr().out
    assert main([*asked, "--candidate", "oracle"]) == 0
    assert capsys.readouterr().out == 'engine: "oracle"\ndeviations: []\n'


@pytest.mark.parametrize(
    "words",
    [["--suggest", "a.yaml"], ["--poses", "1"], ["nowhere.yaml"], ["--candidate", "bug:nosuch"]],
)
def test_usage(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """What cannot be meant is told."""
    assert main(["deviations", *words]) == 2
    assert capsys.readouterr().err.startswith("conformance deviations: ")


def test_fewer_poses_than_none_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    """By the option itself, which says what it takes."""
    with pytest.raises(SystemExit) as stop:
        main(["deviations", "--suggest", "--poses", "-1"])
    assert stop.value.code == 2
    assert "argument --poses: found -1, expected a whole number, 0 or more" in capsys.readouterr().err
