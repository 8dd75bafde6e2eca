"""Error budgets: read with every mistake told, and broken by what they should be broken by."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

pytest.importorskip("flint", reason="the extra `exact` is not installed")

from conformance.stress.budgets import (
    FOLDER,
    BudgetError,
    bit_for_bit,
    broken_bounds,
    find_budget,
    read_budget,
)
from conformance.stress.families import FAMILIES
from conformance.stress.findings import Findings, Reading

if TYPE_CHECKING:
    from pathlib import Path

SHIPPED = sorted(FOLDER.glob("*.yaml"))
assert SHIPPED, f"no budgets in {FOLDER}"

TWO_SIDED = """\
candidate: engine
bounds:
  - family: translation
    sweep: pose
    severity: {at_least: 100.0}
    quantity: contact_metres
    at_least: 0.01
    at_most: 0.1
    reason: Known.
"""


def written(tmp_path: Path, text: str) -> Path:
    """Write a budget file."""
    path = tmp_path / "budget.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def found(*readings: tuple[float, str, float]) -> Findings:
    """Return findings of one sweep: severity, model, and error of each."""
    return Findings(
        [
            Reading("translation", "pose", severity, model, {"contact_metres": error})
            for severity, model, error in readings
        ]
    )


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_shipped_budgets_are_about_their_candidate_and_every_family(path: Path) -> None:
    """Each bound has a reason; no family is forgotten."""
    budget = read_budget(path)
    assert budget.candidate == path.stem
    assert {bound.family for bound in budget.bounds} == set(FAMILIES)
    assert all(len(bound.reason) > 20 for bound in budget.bounds)


@pytest.mark.parametrize("name", ["bug:cell-origin", "cmd:../budgets/engine", "cmd:" + 300 * "x"])
def test_a_candidate_without_a_budget_is_retail_bit_for_bit(name: str) -> None:
    """In every family; also one whose name would lead to another file, or to none at all."""
    budget = find_budget(name)
    assert budget == bit_for_bit(name)
    assert {(bound.family, bound.quantity, bound.at_most) for bound in budget.bounds} == {
        (family, "differing", 0.0) for family in FAMILIES
    }


@pytest.mark.parametrize("error", [0.001, 0.5, float("nan")])
def test_a_bound_is_broken_from_both_sides(tmp_path: Path, error: float) -> None:
    """By less, by more, and by what is not a number."""
    budget = read_budget(written(tmp_path, TWO_SIDED))
    (told,) = broken_bounds(budget, found((100.0, "candidate", error)), whole=True)
    assert told.startswith("translation, pose: contact_metres at least 0.01 and at most 0.1:")
    assert told.endswith("in pose at 100 (1 of 1 severities)")


def test_a_bound_holds_for_the_candidate_at_its_severities_only(tmp_path: Path) -> None:
    """Retail's reading, and those at other severities, are not meant."""
    budget = read_budget(written(tmp_path, TWO_SIDED))
    findings = found((100.0, "candidate", 0.05), (99.0, "candidate", 7.0), (100.0, "retail", 7.0))
    assert list(broken_bounds(budget, findings, whole=True)) == []


def test_a_bound_about_nothing_is_broken_in_a_whole_run(tmp_path: Path) -> None:
    """In part of a run it may be about what was not asked."""
    budget, findings = read_budget(written(tmp_path, TWO_SIDED)), found((1.0, "candidate", 0.0))
    (told,) = broken_bounds(budget, findings, whole=True)
    assert "it is about no reading of this run" in told
    assert list(broken_bounds(budget, findings, whole=False)) == []
    assert list(broken_bounds(budget, Findings(), whole=True)) == []


@pytest.mark.parametrize(
    ("wrong", "right", "told"),
    [
        ("famly", "family", "the unknown key 'famly'"),
        ("translaton", "translation", "did you mean 'translation'?"),
        ("contact_meters", "contact_metres", "did you mean 'contact_metres'?"),
        ("reason: ''", "reason: Known.", "some text"),
        ("at_least: '0.01'", "at_least: 0.01", "a number"),
    ],
)
def test_mistakes_are_told_where_they_are(tmp_path: Path, wrong: str, right: str, told: str) -> None:
    """With the place in the file, and what was probably meant."""
    path = written(tmp_path, TWO_SIDED.replace(right, wrong))
    with pytest.raises(BudgetError) as error:
        read_budget(path)
    assert told in str(error.value)
    assert "budget.yaml:" in str(error.value)


def test_a_bound_needs_an_end(tmp_path: Path) -> None:
    """Or it could not be broken."""
    text = TWO_SIDED.replace("    at_least: 0.01\n", "").replace("    at_most: 0.1\n", "")
    with pytest.raises(BudgetError, match="a bound without an end"):
        read_budget(written(tmp_path, text))
