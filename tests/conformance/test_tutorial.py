"""The tutorial of docs/writing-cases.md, word for word: its files are written, its commands run, in order."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import NamedTuple

import pytest

from conformance import cli

pytest_plugins = ["pytester"]

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "writing-cases.md"
CONFTEST = "from conformance.conftest import pytest_addoption\n"
SECTION = re.compile(r"^## Your first case.*?(?=^## )", re.DOTALL | re.MULTILINE)
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.DOTALL | re.MULTILINE)
FILE = re.compile(r"Make a folder `([\w-]+)` and in it `([\w.-]+)`:")


class Block(NamedTuple):
    """A fenced block: its language, empty for commands, and its text."""

    language: str
    text: str


def tutorial() -> tuple[str, list[Block]]:
    """Return the tutorial's text and its blocks."""
    section = SECTION.search(PAGE.read_text(encoding="utf-8"))
    assert section is not None
    return section[0], [Block(*found) for found in BLOCK.findall(section[0])]


def shown(text: str) -> list[str]:
    """Return the lines that something printed, as on any system."""
    return text.replace("\\", "/").splitlines()


def run(command: str, pytester: pytest.Pytester, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """Run a line of the tutorial, which must succeed, and return what it prints."""
    program, *arguments = shlex.split(command)
    if program == "pytest":
        result = pytester.runpytest_subprocess(*arguments)
        capsys.readouterr()
        assert result.ret == pytest.ExitCode.OK
        return [str(line) for line in result.outlines]
    assert program == "conformance"
    assert cli.main(arguments) == 0
    return shown(capsys.readouterr().out)


def test_a_newcomer_gets_what_the_tutorial_says(
    pytester: pytest.Pytester, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each command succeeds and prints the lines that are shown after it; the pins hold, too."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.delenv("PYTEST_ADDOPTS", raising=False)  # a newcomer has none
    pytester.makeconftest(CONFTEST)
    text, blocks = tutorial()
    place = FILE.search(text)
    assert place is not None
    file = pytester.path / place[1] / place[2]
    file.parent.mkdir()
    printed: list[str] = []
    commands: list[str] = []
    for block in blocks:
        if block.language == "yaml":  # the second one is to be added to the first
            before = file.read_text(encoding="utf-8") if file.exists() else ""
            file.write_text(before + block.text, encoding="utf-8")
        elif not block.language:
            commands += block.text.splitlines()
            printed = [line for one in block.text.splitlines() for line in run(one, pytester, capsys)]
        elif "yaww" not in block.text:  # the mistake is made in `test_docs`
            assert [line for line in block.text.splitlines() if line not in printed] == []
    assert [command.split()[:2] for command in commands] == [
        ["conformance", "lint"],
        ["pytest", "my-cases/ramp.yaml"],
        ["conformance", "explain"],
    ]
    assert run(commands[1], pytester, capsys)[-1].startswith("=")


def test_the_other_commands_of_the_page_exist(capsys: pytest.CaptureFixture[str]) -> None:
    """Every option that the table of commands names is one of its command."""
    rows = re.findall(
        r"^\| `conformance (\w+)[^|]*\|[^|]*\|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE
    )
    assert set(rows) == {"list", "new", "fmt", "explain"}
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        row = re.match(r"\| `conformance (\w+)", line)
        if row:
            with pytest.raises(SystemExit):
                cli.main([row[1], "--help"])
            known = capsys.readouterr().out
            assert [option for option in re.findall(r"--[a-z-]+", line) if option not in known] == []
