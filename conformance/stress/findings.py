"""What a run finds: readings of each severity, sign pictures, worst cases, and differences from retail."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from conformance.json_writing import json_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

RETAIL: Final = "retail"
CANDIDATE: Final = "candidate"
DIFFERING: Final = "differing"
"""Quantity of the candidate alone: answers that are not retail's, bit for bit."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What one model's answers at one severity come to.

    Attributes
    ----------
    family, sweep : str
        Where.
    severity : float
        In the unit of the sweep's axis.
    model : str
        ``retail``, ``single``, ``double`` or ``candidate``.
    quantities : Mapping of str to float
        The largest value of each quantity (`conformance.stress.quantities`), or a count.
    """

    family: str
    sweep: str
    severity: float
    model: str
    quantities: Mapping[str, float]

    def to_record(self) -> dict[str, Any]:
        """Write it for JSON."""
        return {
            "family": self.family,
            "sweep": self.sweep,
            "severity": self.severity,
            "model": self.model,
            "quantities": dict(self.quantities),
        }


@dataclass(frozen=True, slots=True)
class Picture:
    """Decisions over a grid of neighbouring float32s.

    Attributes
    ----------
    name : str
        The comparison.
    axes : (str, str)
        What changes along a row and from row to row.
    signs : tuple of tuple of int
        Rows of 0 to 3: `RETAIL_YES` and `EXACT_YES` added up.
    """

    name: str
    axes: tuple[str, str]
    signs: tuple[tuple[int, ...], ...]

    def to_record(self) -> dict[str, Any]:
        """Write it for JSON: each row a string of digits."""
        rows = ["".join(map(str, row)) for row in self.signs]
        return {"name": self.name, "axes": list(self.axes), "rows": rows}


RETAIL_YES: Final = 1
EXACT_YES: Final = 2


@dataclass(frozen=True, slots=True)
class Worst:
    """The query of a sweep that retail answers worst, as a case.

    Attributes
    ----------
    family, sweep : str
        Where.
    severity : float
        In the unit of the sweep's axis.
    quantity : str
        What was worst.
    value : float
        How bad.
    document : str
        The case, YAML.
    """

    family: str
    sweep: str
    severity: float
    quantity: str
    value: float
    document: str


@dataclass(slots=True)
class Findings:
    """What was found so far; those of several parts add up.

    Attributes
    ----------
    readings, pictures, worst : list
        In the order of the sweeps.
    differences : list of str
        Answers of the candidate that are not retail's, the first difference of each.
    errors : list of str
        Answers that it has not given: it crashed, hung, or replied badly.
    failures : list of str
        What else is wrong: a worker that died, a budget that is broken.
    notes : list of str
        What a reader should know: what was not asked, and why.
    costs : dict of str to float
        Seconds of work, by family.
    """

    readings: list[Reading] = field(default_factory=list)
    pictures: list[Picture] = field(default_factory=list)
    worst: list[Worst] = field(default_factory=list)
    differences: list[str] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    costs: dict[str, float] = field(default_factory=dict)

    def add(self, other: Findings) -> None:
        """Take over what a part has found."""
        self.readings += other.readings
        self.pictures += other.pictures
        self.worst += other.worst
        self.differences += other.differences
        self.errors += other.errors
        self.failures += other.failures
        self.notes += [note for note in other.notes if note not in self.notes]
        for family, seconds in other.costs.items():
            self.costs[family] = self.costs.get(family, 0.0) + seconds

    @property
    def families(self) -> list[str]:
        """The families that have readings, in their order."""
        return list(dict.fromkeys(reading.family for reading in self.readings))

    def has_answered(self, family: str | None = None) -> bool:
        """Tell whether the candidate has taken part in a family, or in any."""
        return any(r.model == CANDIDATE and family in {None, r.family} for r in self.readings)

    def sweeps(self, family: str) -> list[str]:
        """Return the sweeps of a family that have readings, in their order."""
        return list(dict.fromkeys(r.sweep for r in self.readings if r.family == family))

    def curve(self, family: str, sweep: str, model: str, quantity: str) -> list[tuple[float, float]]:
        """Return severity and value of a quantity, by rising severity."""
        return sorted(
            (r.severity, r.quantities[quantity])
            for r in self.readings
            if (r.family, r.sweep, r.model) == (family, sweep, model) and quantity in r.quantities
        )

    def worst_of_sweeps(self) -> Iterator[Worst]:
        """Yield of each sweep and quantity the worst."""
        largest: dict[tuple[str, str, str], Worst] = {}
        for worst in self.worst:
            key = (worst.family, worst.sweep, worst.quantity)
            if key not in largest or largest[key].value < worst.value:
                largest[key] = worst
        yield from largest.values()

    def to_json(self, facts: Mapping[str, Any]) -> str:
        """Write all of it, after the facts of the run."""
        record = {
            **facts,
            "seconds": self.costs,
            "readings": [reading.to_record() for reading in self.readings],
            "pictures": [picture.to_record() for picture in self.pictures],
            "differences": self.differences,
            "errors": self.errors,
            "failures": self.failures,
            "notes": self.notes,
        }
        return json_text(record, indent=1)
