"""The list of mutants that nothing could notice."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from conformance.branches.measure import oracle_sources
from conformance.mutation.equivalents import (
    EquivalentsError,
    explained,
    read_equivalents,
    wrong_entries,
)
from conformance.mutation.mutant import Mutant, Operator
from conformance.mutation.operators import plans
from conformance.mutation.run import DOCUMENTS
from conformance.mutation.trial import Finding, Verdict

if TYPE_CHECKING:
    from pathlib import Path

MUTANT = Mutant("a.py", "f", "02", Operator.SIGN, "-x", "x", 1, 3, "return -x", range(3, 4))
LIST = """\
a.f:
  - reason: It is symmetric.
    mutants:
      - {operator: sign, before: -x}
"""


def write(folder: Path, text: str) -> Path:
    """Write a list."""
    path = folder / "list.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_an_entry_covers_what_it_describes(tmp_path: Path) -> None:
    """All that it names must be so, and the function too."""
    entries = read_equivalents(write(tmp_path, LIST))
    entry = explained(entries, MUTANT)
    assert entry is not None
    assert (entry.reason, entry.where) == ("It is symmetric.", "list.yaml:4:9")
    other = Mutant("a.py", "g", "02", Operator.SIGN, "-x", "x", 1, 3, "return -x", range(3, 4))
    assert explained(entries, other) is None


@pytest.mark.parametrize(
    ("text", "place", "found"),
    [
        ("[]", "list.yaml:1:1", "expected  functions"),
        ("a.f: 3", "list.yaml:1:6", "a list of groups"),
        ("a.f:\n  - {mutants: [{before: x}]}", "list.yaml:2:5", "why nothing notices them"),
        ("a.f:\n  - {reason: r, mutants: []}", "list.yaml:2:26", "a list of mutants"),
        ("a.f:\n  - {reason: r, mutants: [{befor: x}]}", "list.yaml:2:28", "did you mean 'before'?"),
        ("a.f:\n  - {reason: r, mutants: [{nth: x}]}", "list.yaml:2:33", "a number"),
    ],
)
def test_a_wrong_list_is_located(tmp_path: Path, text: str, place: str, found: str) -> None:
    """With what was expected there."""
    with pytest.raises(EquivalentsError) as error:
        read_equivalents(write(tmp_path, text))
    assert str(error.value).startswith(place)
    assert found in str(error.value)


def test_an_entry_about_nothing_is_wrong(tmp_path: Path) -> None:
    """So edits of the oracle do not leave it behind."""
    entries = read_equivalents(write(tmp_path, LIST))
    assert list(wrong_entries(entries, [], [])) == [
        "list.yaml:4:9: a.f has no such mutant: operator 'sign', before '-x'"
    ]


def test_an_entry_about_a_mutant_that_is_noticed_is_wrong(tmp_path: Path) -> None:
    """It says what notices it."""
    entries = read_equivalents(write(tmp_path, LIST))
    noticed = Finding(MUTANT, Verdict.CASE, "ramp", "v.x", 7)
    (wrong,) = wrong_entries(entries, [MUTANT], [noticed])
    assert wrong.startswith("list.yaml:4:9: ramp notices a.py:3 f, sign: ")
    missed = Finding(MUTANT, Verdict.SURVIVED, asked=7)
    assert not list(wrong_entries(entries, [MUTANT], [missed]))


def test_the_shipped_list_speaks_of_mutants_that_exist() -> None:
    """Whether they are noticed is what `conformance mutants` finds out."""
    mutants = [plan.mutant for plan in plans(oracle_sources(), DOCUMENTS)]
    entries = read_equivalents()
    assert entries
    assert list(wrong_entries(entries, mutants, [])) == []
