"""Commands are the same in a clone and in a folder without the suite, as its documents write them."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from conformance import exit_codes
from conformance.cli import main
from conformance.installed import installed, meant

PACKAGE = Path(__file__).parents[2] / "conformance"
MATH = "conformance/vectors/boundary_math.jsonl"


@pytest.fixture
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return an empty folder, which is the working directory."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.usefixtures("elsewhere")
def test_the_suite_is_found_where_it_is_installed() -> None:
    """A whole folder or a file of it; what it hasn't stays what was asked for."""
    assert installed(Path("conformance")) == PACKAGE
    assert installed(Path("conformance/cases/no-such")) == Path("conformance/cases/no-such")
    assert installed(Path("conformance/cases/cells")) == PACKAGE / "cases" / "cells"
    assert installed(Path("my-cases")) == Path("my-cases")
    assert installed(Path("my/conformance")) == Path("my/conformance")


def test_a_folder_of_that_name_comes_first(elsewhere: Path) -> None:
    """It is the user's own."""
    (elsewhere / "conformance").mkdir()
    assert installed(Path("conformance/cases")) == Path("conformance/cases")


@pytest.mark.usefixtures("elsewhere")
@pytest.mark.parametrize("named", [MATH, "conformance/vectors/boundary_m*.jsonl"])
def test_vectors_are_verified(named: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Also by a pattern that the shell, or a system without one, leaves as it is."""
    assert main(["verify", named]) == exit_codes.OK
    assert "boundary_math.jsonl: " in capsys.readouterr().out


def test_a_pattern_without_files_is_an_error(elsewhere: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is named as it was written."""
    pattern = str(elsewhere / "no-*.jsonl")
    assert main(["verify", pattern]) == exit_codes.USAGE
    assert f"no such file: {pattern}" in capsys.readouterr().err


@pytest.mark.usefixtures("elsewhere")
def test_cases_are_looked_over(capsys: pytest.CaptureFixture[str]) -> None:
    """As by every command that reads case files."""
    assert main(["lint", "conformance/cases/contact-plane"]) == exit_codes.OK
    assert "0 problems" in capsys.readouterr().out


@pytest.mark.usefixtures("elsewhere")
@pytest.mark.parametrize(
    "words",
    [
        ["lint", "conformance/cases/contact-plane/ori*.yaml"],
        ["fmt", "--check", "conformance/cases/contact-plane/ori*.yaml"],
        ["list", "conformance/cases/contact-plane/ori*.yaml", "--path", "conformance/cases/contact-plane"],
        ["export", "conformance/cases/contact-plane/ori*.yaml", "--poses", "0", "-o", "vectors.jsonl"],
    ],
)
def test_patterns_of_case_files_are_expanded(words: list[str]) -> None:
    """By every command that reads them: shells of Windows don't."""
    assert main(words) == exit_codes.OK


def test_a_file_may_be_called_like_a_pattern(elsewhere: Path) -> None:
    """It is meant, then, and nothing else."""
    (elsewhere / "a.yaml").touch()
    assert meant(Path("*.yaml")) == [Path("a.yaml")]
    if os.name != "nt":
        (elsewhere / "*.yaml").touch()
        assert meant(Path("*.yaml")) == [Path("*.yaml")]
