"""Findings on disk."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from conformance.journal import JournalError
from conformance.mutation.asking import Question
from conformance.mutation.journal import Journal, digest_of
from conformance.mutation.mutant import Mutant, Operator
from conformance.mutation.trial import Finding, Verdict
from conformance.query import Query

if TYPE_CHECKING:
    from pathlib import Path

MUTANT = Mutant("a.py", "f", "02", Operator.SIGN, "-x", "x", 1, 3, "return -x", range(3, 4))
FOUND = Finding(MUTANT, Verdict.CASE, "ramp", "v.x", 7)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Write a journal of one finding."""
    file = tmp_path / "below" / "mutants.jsonl"
    with Journal(file, "old", resume=False) as journal:
        journal.note(FOUND)
    return file


def test_a_run_goes_on_where_it_was(path: Path) -> None:
    """With the same oracle and questions a finding stands."""
    journal = Journal(path, "old", resume=True)
    assert journal.finding(MUTANT) == FOUND
    assert journal.hint(MUTANT) == "ramp"


def test_after_a_change_a_finding_is_a_hint(path: Path) -> None:
    """It stays one, also if the next run is ended before it judges anything."""
    for _ in range(2):
        with Journal(path, "new", resume=True) as journal:
            assert journal.finding(MUTANT) is None
            assert journal.hint(MUTANT) == "ramp"


def test_without_resume_nothing_is_known(path: Path) -> None:
    """And the file begins anew, but not one that holds findings, which would be lost."""
    with pytest.raises(JournalError, match=r"mutants\.jsonl holds findings already"):
        Journal(path, "old", resume=False)
    path.write_text('{"suite": "old"}\n', encoding="utf-8")
    with Journal(path, "old", resume=False) as journal:
        assert journal.finding(MUTANT) is None
        assert journal.hint(MUTANT) == ""
    assert path.read_text(encoding="utf-8") == '{"suite": "old"}\n'


def test_a_line_without_its_end_is_made_again(path: Path) -> None:
    """What a run was writing when it was killed does not keep the next one from going on."""
    with path.open("a", encoding="utf-8") as file:
        file.write('{"mutant": ["a.py"')
    with Journal(path, "old", resume=True) as journal:
        assert journal.finding(MUTANT) == FOUND
    assert len(path.read_text(encoding="utf-8").splitlines()) == 2


@pytest.mark.parametrize("line", ["no json", "[1]", '{"id": "a-case"}', '{"mutant": ["f"], "verdict": null}'])
def test_another_file_is_refused(path: Path, line: str) -> None:
    """The error says which line it is."""
    path.write_text(f'{{"suite": "old"}}\n{line}\n', encoding="utf-8")
    with pytest.raises(JournalError, match=r"mutants\.jsonl:2:"):
        Journal(path, "old", resume=True)


def test_the_digest_is_of_sources_and_questions() -> None:
    """A change of either is another digest."""
    asked = Question(Query("normalize_check_small", {"v": [1.0, 0.0, 0.0]}), "one", pose=False)
    digests = {
        digest_of({"a.py": "x"}, [asked]),
        digest_of({"a.py": "y"}, [asked]),
        digest_of({"a.py": "x"}, []),
    }
    assert len(digests) == 3
    assert digest_of({"a.py": "x"}, [asked]) in digests
