"""Programs of engines: found before anything is asked, as the system that starts them finds them."""

from __future__ import annotations

import shlex
import sys
from typing import TYPE_CHECKING

import pytest

from conformance.protocol import process
from conformance.protocol.process import CommandError, check_program, command_line

if TYPE_CHECKING:
    from pathlib import Path


def test_what_runs_this_is_a_program() -> None:
    """With arguments, and by its whole path, which may have spaces in it."""
    check_program(command_line([sys.executable, "-c", "pass"]))


def test_a_name_is_searched_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """On the search path, as the system would; elsewhere it is not found."""
    name = "an-engine.exe" if sys.platform == "win32" else "an-engine"
    (tmp_path / name).touch(mode=0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    check_program("an-engine --flag")
    monkeypatch.setenv("PATH", str(tmp_path / "elsewhere"))
    with pytest.raises(CommandError, match=r"^found no program 'an-engine' that can be run, in the command "):
        check_program("an-engine --flag")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no permission to execute")
def test_what_may_not_be_run_is_no_program(tmp_path: Path) -> None:
    """A file without the permission is there, and of no use."""
    (tmp_path / "engine").touch(mode=0o644)
    with pytest.raises(CommandError, match="that can be run"):
        check_program(shlex.quote(str(tmp_path / "engine")))


@pytest.mark.parametrize(
    ("command", "names"),
    [
        ("engine --flag", ["engine", "engine --flag"]),
        (r"C:\My Games\engine.exe -v", [r"C:\My", r"C:\My Games\engine.exe", r"C:\My Games\engine.exe -v"]),
        (r'"C:\My Games\engine.exe" -v', [r"C:\My Games\engine.exe"]),
    ],
)
def test_windows_tries_how_far_a_name_goes(command: str, names: list[str]) -> None:
    """Without quotation marks, up to each space; with them, what is between them."""
    assert process._programs(command) == names
