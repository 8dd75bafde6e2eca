"""The random part of the suite, run as users run it: it fails on a bug, keeps the case, replays it first."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import conformance

SUITE = Path(conformance.__file__).parent
STEP_DOWN = f"{SUITE / 'test_poses.py'}::test_find_collisions[step_down]"
BLOCK_OFFSET = f"{SUITE / 'test_poses.py'}::test_frame[block_offset]"


def run(rootdir: Path, *arguments: str) -> tuple[int, list[str]]:
    """Run pytest in a process of its own with the gate's profile; return its exit code and output."""
    environment = {**os.environ, "CI": "1", "PYTHONPATH": str(SUITE.parent), "PYTHONUTF8": "1"}
    environment.pop("PYTEST_ADDOPTS", None)  # options of the run around this one
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-ra",
        "--rootdir",
        str(rootdir),
        "-p",
        "no:cacheprovider",
    ]
    finished = subprocess.run(
        [*command, *arguments],
        capture_output=True,
        check=False,
        cwd=rootdir,
        env=environment,
        encoding="utf-8",
    )
    return finished.returncode, (finished.stdout + finished.stderr).splitlines()


def test_a_bug_is_found_kept_and_replayed(tmp_path: Path) -> None:
    """The lost cell origin is named in one line; the next run asks the shrunk case before anything else."""
    (tmp_path / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
    code, lines = run(tmp_path, STEP_DOWN, "--candidate", "bug:cell-origin")
    assert code == 1, lines
    (reason,) = [line for line in lines if line.startswith("FAILED")]
    assert "contact_plane.d: retail " in reason
    assert "ULPs" in reason
    (found,) = (tmp_path / ".conformance" / "found").iterdir()
    assert any(f'rerun: pytest "{found}" --candidate bug:cell-origin' in line for line in lines)
    replay = (BLOCK_OFFSET, "--cases", str(found.parent), "-vv")
    code, lines = run(tmp_path, *replay, "--candidate", "bug:cell-origin")
    assert code == 1, lines
    asked = [line for line in lines if "PASSED" in line or "FAILED" in line]
    assert f"{found.name}::{found.stem} FAILED" in asked[0]
    assert "test_frame[block_offset] PASSED" in asked[1]
    strict = ("-W", "error", "--junitxml", str(tmp_path / "junit.xml"))  # as a build server may run it
    code, lines = run(tmp_path, *replay, "--candidate", "oracle", *strict)
    assert code == 0, lines


def test_random_queries_are_counted(tmp_path: Path) -> None:
    """The summary tells how many random queries were compared."""
    (tmp_path / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
    code, lines = run(tmp_path, BLOCK_OFFSET, "--candidate", "oracle")
    assert code == 0, lines
    assert any("10 random queries" in line for line in lines)
