"""Error budgets: how far a candidate may be off, family by family, and why; YAML files, checked.

A bound with both ends says what is known: an error that disappears is as much a change as one that grows.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Final

from pydantic import Field, model_validator

from conformance.exact.errors import rank
from conformance.schema.mistakes import mistake
from conformance.schema.values import Strictly
from conformance.source import nearest
from conformance.stress.families import FAMILIES
from conformance.stress.findings import CANDIDATE, DIFFERING
from conformance.stress.quantities import HEADINGS, MEDIAN
from conformance.yaml_model import read_model

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.stress.findings import Findings, Reading

FOLDER: Final = Path(__file__).parent / "budgets"
"""Budgets that come with the suite, each named after its candidate."""


class BudgetError(Exception):
    """A budget file that cannot be used; its message says where and why."""


class Severities(Strictly):
    """Which severities a bound is about, in the unit of the sweep's axis; the ends count."""

    at_least: float = -math.inf
    at_most: float = math.inf


class Bound(Strictly):
    """What a quantity may come to; without a sweep, in every sweep of its family."""

    family: str
    sweep: str | None = None
    severity: Severities = Severities()
    quantity: str
    at_least: float | None = None
    at_most: float | None = None
    reason: str = Field(min_length=1, description="Why it is so.")

    @model_validator(mode="after")
    def _names_are_known(self) -> Bound:
        for key, name, known in (
            ("family", self.family, tuple(FAMILIES)),
            ("quantity", self.quantity.removesuffix(MEDIAN), tuple(HEADINGS)),
        ):
            if name not in known:
                raise mistake(
                    f"the {key} {name!r}", f"one of {', '.join(known)}", nearest(name, known), at=(key,)
                )
        if self.at_least is None and self.at_most is None:
            raise mistake("a bound without an end", "'at_least', 'at_most', or both")
        return self

    @property
    def words(self) -> str:
        """What it says, in one line."""
        where = self.family if self.sweep is None else f"{self.family}, {self.sweep}"
        low = [] if self.at_least is None else [f"at least {self.at_least:g}"]
        high = [] if self.at_most is None else [f"at most {self.at_most:g}"]
        return f"{where}: {self.quantity} {' and '.join([*low, *high])}"

    def about(self, reading: Reading) -> bool:
        """Tell whether a reading is one of those that it bounds."""
        return (
            reading.model == CANDIDATE
            and reading.family == self.family
            and self.sweep in {None, reading.sweep}
            and self.severity.at_least <= reading.severity <= self.severity.at_most
            and self.quantity in reading.quantities
        )

    def broken_by(self, value: float) -> bool:
        """Tell whether a value is outside; NaN always is."""
        above = self.at_least is None or value >= self.at_least
        below = self.at_most is None or value <= self.at_most
        return not (above and below)


class Budget(Strictly):
    """A budget file."""

    candidate: str
    bounds: list[Bound] = Field(min_length=1)


def bit_for_bit(candidate: str) -> Budget:
    """Return the budget of a candidate that has none: in every family its answers are retail's."""
    reason = "A candidate conforms by giving retail's answer, on every bit."
    bounds = [Bound(family=name, quantity=DIFFERING, at_most=0.0, reason=reason) for name in FAMILIES]
    return Budget(candidate=candidate, bounds=bounds)


def find_budget(candidate: str) -> Budget:
    """Return the budget that comes with the suite for a candidate, or `bit_for_bit`."""
    # Other names are commands and modules: they may hold anything, and be longer than a file's name.
    path = FOLDER / f"{candidate}.yaml" if candidate.isidentifier() else None
    return bit_for_bit(candidate) if path is None or not path.is_file() else read_budget(path)


def read_budget(path: Path) -> Budget:
    """Read a budget file.

    Raises
    ------
    BudgetError
        It is not a budget; with every mistake and its place.
    OSError
        It cannot be read at all.
    YamlError
        It is not YAML.
    """
    _, budget, problems = read_model(path, Budget)
    if budget is None:
        raise BudgetError("\n".join(str(problem) for problem in problems))
    return budget


def broken_bounds(budget: Budget, findings: Findings, *, whole: bool) -> Iterator[str]:
    """Say of each bound that does not hold by how much, and where it is broken most.

    Parameters
    ----------
    budget : Budget
    findings : Findings
    whole : bool
        Whether every severity was asked: then a bound about a family in which the candidate has answered,
        but about no reading of it, is broken as well.
    """
    for bound in budget.bounds:
        about = [reading for reading in findings.readings if bound.about(reading)]
        if not about and whole and findings.has_answered(bound.family):
            yield f"{bound.words}: it is about no reading of this run"
        broken = [reading for reading in about if bound.broken_by(reading.quantities[bound.quantity])]
        if broken:
            worst = max(broken, key=lambda reading: rank(reading.quantities[bound.quantity]))
            value = worst.quantities[bound.quantity]
            yield (
                f"{bound.words}: {value:.6g} in {worst.sweep} at {worst.severity:g} "
                f"({len(broken)} of {len(about)} severities)"
            )
