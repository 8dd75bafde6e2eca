"""`conformance list`: which cases are chosen, how they are counted, and how it ends."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest

from conformance import cli, exit_codes
from conformance.loader import BUILT_IN_CASES

if TYPE_CHECKING:
    from pathlib import Path

ORIGIN = str(BUILT_IN_CASES / "contact-plane" / "origin.yaml")
BROKEN = "id: Broken\ntitle: t\n"


def listed(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, list[str], list[str]]:
    """Run the command on one file; return its exit code, what it printed, and what it complained of."""
    code = cli.main(["list", ORIGIN, *arguments])
    printed = capsys.readouterr()
    return code, printed.out.splitlines(), printed.err.splitlines()


def test_every_case_of_a_file_is_listed_with_its_title(capsys: pytest.CaptureFixture[str]) -> None:
    """One line a case in file order, then how many there are."""
    code, lines, complaints = listed(capsys)
    assert (code, complaints) == (exit_codes.OK, [])
    assert lines[0].split("  ")[0].strip() == "origin-step-down-touching"
    assert "Stepping down onto a floor in a turned cell sets the contact plane in world space" in lines[0]
    assert lines[-1] == f"{len(lines) - 1} of {len(lines) - 1} cases"


@pytest.mark.parametrize(
    "filters",
    [
        ("--tag", "step-down"),
        ("--function", "BSPTREE::step_sphere_down"),
        ("--function", "step_sphere_down"),
        ("--op", "find_collisions", "--op", "transition"),
        ("--path", "contact-plane"),
        ("--path", "origin.yaml"),
        ("--path", "contact-plane/*.yaml"),
        ("--path", "contact-plane/"),
        ("--path", str(BUILT_IN_CASES / "contact-plane")),
        ("--path", str(BUILT_IN_CASES / "contact-plane" / "origin.yaml")),
    ],
)
def test_a_filter_keeps_what_meets_it(filters: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    """The case about stepping down meets each of these."""
    code, lines, _ = listed(capsys, *filters)
    assert code == exit_codes.OK
    assert any(line.startswith("origin-step-down-touching ") for line in lines)


def test_tags_and_functions_must_all_be_met(capsys: pytest.CaptureFixture[str]) -> None:
    """A second tag never adds a case, and every case left has both."""
    _, one, _ = listed(capsys, "--tag", "step-down", "--json")
    code, both, _ = listed(capsys, "--tag", "step-down", "--tag", "scale", "--json")
    first, second = json.loads("\n".join(one)), json.loads("\n".join(both))
    assert len(second) < len(first)
    assert code == (exit_codes.OK if second else exit_codes.NOTHING_RAN)
    assert all({"step-down", "scale"} <= set(case["tags"]) for case in second)


def test_json_tells_what_a_case_is(capsys: pytest.CaptureFixture[str]) -> None:
    """Nothing but the list is printed."""
    code, lines, _ = listed(capsys, "--json")
    first = json.loads("\n".join(lines))[0]
    assert code == exit_codes.OK
    assert list(first) == ["id", "title", "file", "line", "op", "tags", "retail", "pins"]
    assert (first["id"], first["op"], first["line"]) == ("origin-step-down-touching", "find_collisions", 4)
    assert first["file"].endswith("contact-plane/origin.yaml")
    assert "BSPTREE::step_sphere_down SD-1…SD-12" in first["retail"]


def test_cases_are_counted_by_operation(capsys: pytest.CaptureFixture[str]) -> None:
    """The counts add up to the cases, of which each asks one operation."""
    code, lines, _ = listed(capsys, "--count", "op")
    counts = [int(line.split()[0]) for line in lines[:-1]]
    assert code == exit_codes.OK
    assert counts == sorted(counts, reverse=True)
    assert lines[-1] == f"{sum(counts)} of {sum(counts)} cases"


@pytest.mark.parametrize(
    ("filters", "complaint"),
    [
        (("--tag", "stepdown"), "no case has the tag 'stepdown': did you mean 'step-down'?"),
        (("--op", "zzz"), "no case has the op 'zzz': `conformance list --count op` says what there is"),
        (("--op", "find_colisions"), "no case has the op 'find_colisions': did you mean 'find_collisions'?"),
        (("--path", "walks"), "no case meets all of this together, in walks"),
    ],
)
def test_nothing_is_not_green(
    filters: tuple[str, ...], complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 4, and the nearest word that there is."""
    code, lines, complaints = listed(capsys, *filters)
    assert code == exit_codes.NOTHING_RAN
    assert lines[-1].startswith("0 of ")
    assert complaints == [complaint]


def test_mistakes_are_not_passed_over(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file that cannot be read makes the list incomplete: exit code 1."""
    (tmp_path / "broken.yaml").write_text(BROKEN, encoding="utf-8")
    assert cli.main(["list", str(tmp_path), ORIGIN]) == exit_codes.FAILURES
    assert "cases from being listed, see `conformance lint`" in capsys.readouterr().err


def test_a_folder_that_is_not_there_is_a_usage_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2."""
    assert cli.main(["list", str(tmp_path / "none")]) == exit_codes.USAGE
    assert "does not exist" in capsys.readouterr().err
