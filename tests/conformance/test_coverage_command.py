"""`conformance coverage`, and the page that it writes."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

from conformance import loader
from conformance.branches import known_gaps
from conformance.branches.known_gaps import REASONS
from conformance.branches.measure import INSTRUMENTS, oracle_sources
from conformance.branches.reasons import NEVER_CALLED, Kind, Reason
from conformance.cli import main
from conformance.report.coverage import share

PAGE = Path(__file__).parents[2] / "docs" / "oracle-coverage.md"
ENTRY = re.compile(r"^- `(\w+)\.py` `([\w.]+)`, (?:`(.+)` → (.+?)|(never called)): (.+)$", re.MULTILINE)
CASE = """\
id: one-vector
title: A vector
why: It is long enough.
retail: ["AC1Legacy::Vector3 §2.3"]
query: {op: normalize_check_small, v: [3, 0, 4]}
"""


@pytest.fixture
def one_case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Make a single case the built-in ones, and forget all reasons."""
    file = tmp_path / "case.yaml"
    file.write_text(CASE, encoding="utf-8")
    monkeypatch.setattr(loader, "BUILT_IN_CASES", file)
    monkeypatch.setattr(known_gaps, "REASONS", {})


@pytest.mark.usefixtures("one_case")
def test_gaps_without_a_reason_are_failures(capsys: pytest.CaptureFixture[str]) -> None:
    """Each is told with its place and its source line."""
    assert main(["coverage"]) == 1
    lines = capsys.readouterr().out.splitlines()
    at = next(i for i, line in enumerate(lines) if "Vector3.normalize_check_small: if" in line)
    assert re.match(r"vector\.py:\d+ Vector3\.normalize_check_small: if .+: true$", lines[at])
    assert lines[at + 1].strip().startswith("if ")
    assert lines[at + 2].strip() == "no reason is recorded"
    assert re.fullmatch(r"1 queries; (\d+) gaps, \1 of them without a reason", lines[-1])


@pytest.mark.usefixtures("one_case")
def test_reasons_must_be_true(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """One about a function that is called, and one about a function that is not there."""
    wrong = Reason(Kind.NOT_ASKED, "?")
    monkeypatch.setattr(
        known_gaps,
        "REASONS",
        {"vector.Vector3.normalize_check_small": {NEVER_CALLED: wrong}, "vector.nothing": {}},
    )
    assert main(["coverage", "--gaps", "none"]) == 1
    out = capsys.readouterr().out
    assert "stale reason: vector.Vector3.normalize_check_small: it is called" in out
    assert "unknown reason: vector.nothing: the oracle has no such function." in out


@pytest.mark.usefixtures("one_case")
def test_the_page_lists_what_the_run_has_found(tmp_path: Path) -> None:
    """The sums of a document are those of its files."""
    page = tmp_path / "page.md"
    assert main(["coverage", "--gaps", "none", "--output", str(page)]) == 1
    text = page.read_text(encoding="utf-8")
    rows = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("| 0")]
    assert rows
    for document in {row[0] for row in rows}:
        total, *files = [int(row[2]) for row in rows if row[0] == document]
        assert total == sum(files)
    assert "### No reason recorded: " in text


def test_the_page_is_about_cases_only(capsys: pytest.CaptureFixture[str]) -> None:
    """Random queries differ between versions of Hypothesis."""
    assert main(["coverage", "--draws", "5", "--output", "page.md"]) == 2
    assert "--output does not go with --draws" in capsys.readouterr().err


@pytest.mark.usefixtures("one_case")
def test_without_coverage_it_says_what_to_install(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A message, no traceback."""
    monkeypatch.setitem(sys.modules, "coverage", None)
    assert main(["coverage"]) == 2
    assert "pip install 'retail-conformance[coverage]'" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("taken", "total", "text"), [(2, 2, "100 %"), (1999, 2000, "99.9 %"), (0, 3, "0.0 %"), (0, 0, "100 %")]
)
def test_shares_are_rounded_down(taken: int, total: int, text: str) -> None:
    """Only the whole is 100 %."""
    assert share(taken, total) == text


def test_the_document_has_every_reason_and_no_other() -> None:
    """The page is written by the command; this holds it together with the table of reasons."""
    written = {
        (f"{file}.{name}", NEVER_CALLED if never else f"{condition}: {way}"): text
        for file, name, condition, way, never, text in ENTRY.findall(PAGE.read_text(encoding="utf-8"))
    }
    recorded = {
        (name, key): reason.text for name, entries in REASONS.items() for key, reason in entries.items()
    }
    assert len(recorded) > 20
    assert written == recorded


def test_the_document_has_every_module_with_branches() -> None:
    """A new module of the oracle asks for a new page; at least 98 of 100 branches are reached."""
    text = PAGE.read_text(encoding="utf-8")
    listed = set(re.findall(r"^\| [^|]+ \| (\w+\.py) \|", text, re.MULTILINE))
    branching = {
        name
        for name, source in oracle_sources().items()
        if re.search(r"^ +(if|for|while) ", source, re.MULTILINE)
    }
    assert listed <= branching
    assert len(listed) > 40
    assert not listed & INSTRUMENTS
    (whole,) = re.findall(r"^\| all \| all files \| (\d+) \| (\d+) \| .+ \|$", text, re.MULTILINE)
    branches, reached = map(int, whole)
    assert reached >= 0.98 * branches
