"""What a run has found so far, and how it is written down."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

from conformance.bench.machine import machine, versions
from conformance.json_writing import json_text

if TYPE_CHECKING:
    from conformance.bench.figures import Summary
    from conformance.bench.timing import Comparison
    from conformance.query import Query


@dataclass(frozen=True, slots=True)
class Ratio:
    """One line of the table: the engine beside another implementation at the same work.

    Attributes
    ----------
    scene, op : str
        Where, and what was asked.
    reference : str
        Beside whom: ``oracle``, ``native`` (and ``native, sorted``: given its queries in the engine's order),
        ``fcl``, ``coal``, ``trimesh``, ``engine`` (the noise check, and one thread beside several), or, after
        ``engine,``, how it differs.
    batch, threads : int
        Queries in one call of the engine, and on how many threads.
    comparison : Comparison
        What was measured.
    note : str
        What the reader should know.
    """

    scene: str
    op: str
    reference: str
    batch: int
    threads: int
    comparison: Comparison
    note: str = ""

    def to_record(self) -> dict[str, Any]:
        """Write it for JSON."""
        found = self.comparison
        return {
            "scene": self.scene,
            "op": self.op,
            "reference": self.reference,
            "batch": self.batch,
            "threads": self.threads,
            "ratio": found.ratio.middle,
            "spread": [found.ratio.low, found.ratio.high],
            "rounds": found.rounds,
            "ours_ns": found.ours.middle,
            "theirs_ns": found.theirs.middle,
            "agreement": found.agreement,
            "note": self.note,
        }


@dataclass(frozen=True, slots=True)
class Curve:
    """Cost against a size.

    Attributes
    ----------
    name, op : str
        What grows, and what was asked.
    sizes : tuple of int
        Rising.
    costs : tuple of Summary
        Nanoseconds a query, for each size.
    exponent : float or None
        Of the power law that fits; None where no power law is meant.
    """

    name: str
    op: str
    sizes: tuple[int, ...]
    costs: tuple[Summary, ...]
    exponent: float | None

    def to_record(self) -> dict[str, Any]:
        """Write it for JSON."""
        return {
            "name": self.name,
            "op": self.op,
            "sizes": list(self.sizes),
            "costs_ns": [cost.to_record() for cost in self.costs],
            "exponent": self.exponent,
        }


@dataclass(frozen=True, slots=True)
class Point:
    """One implementation in the work-precision plot.

    Attributes
    ----------
    scene, label : str
        Where, and who.
    cost : float
        Nanoseconds a query.
    errors : dict of str to float
        Name of a measure to its value; 0 is no error.
    """

    scene: str
    label: str
    cost: float
    errors: dict[str, float]

    def to_record(self) -> dict[str, Any]:
        """Write it for JSON."""
        return {"scene": self.scene, "label": self.label, "cost_ns": self.cost, "errors": self.errors}


@dataclass(frozen=True, slots=True)
class MessageCost:
    """What messages add to the cases that ask an operation, for an engine that takes no time itself.

    Attributes
    ----------
    op, dialect : str
        What was asked, and how floats were written.
    queries : int
        How many were asked.
    in_process, messages : float
        Processor time of all of them in seconds: what they take without messages, and what messages add.
    """

    op: str
    dialect: str
    queries: int
    in_process: float
    messages: float

    @property
    def share(self) -> float:
        """What messages add, as a part of what there is without them."""
        return self.messages / self.in_process

    def to_record(self) -> dict[str, Any]:
        """Write it for JSON."""
        return {**asdict(self), "share": self.share}


@dataclass(frozen=True, slots=True, eq=False)
class Worst:
    """The query of a scene in which retail is farthest from exact.

    Attributes
    ----------
    scene, measure : str
        Where, and what was measured.
    value : float
        The error, in the unit of the measure.
    query : Query
        What was asked.
    """

    scene: str
    measure: str
    value: float
    query: Query


@dataclass(slots=True)
class Report:
    """Everything that a run finds; it can be written at any moment.

    Attributes
    ----------
    seed : int
        Of all random points.
    ratios, curves, points : list
        In order of measurement.
    messages : list of MessageCost
        Of each dialect, the operations on which messages spend most first.
    omissions : list of str
        What was not measured, and why.
    failures : list of str
        Answers that differ where they must not.
    facts : dict
        What else was counted.
    worst : list of Worst
        One for each scene that was measured against exact.
    """

    seed: int
    ratios: list[Ratio] = field(default_factory=list)
    curves: list[Curve] = field(default_factory=list)
    points: list[Point] = field(default_factory=list)
    messages: list[MessageCost] = field(default_factory=list)
    omissions: list[str] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)
    facts: dict[str, Any] = field(default_factory=dict)
    worst: list[Worst] = field(default_factory=list)

    def omit(self, what: str, why: str) -> None:
        """Remember once that something was not measured."""
        line = f"{what}: {why}"
        if line not in self.omissions:
            self.omissions.append(line)

    def keep_worst(self, scene: str, measure: str, value: float, query: Query) -> None:
        """Remember the worst query of a scene."""
        self.worst.append(Worst(scene, measure, value, query))

    @property
    def empty(self) -> bool:
        """Whether nothing was measured."""
        return not (self.ratios or self.curves or self.points)

    def to_json(self) -> str:
        """Write all of it."""
        record = {
            "seed": self.seed,
            "machine": machine(),
            "versions": versions(),
            "ratios": [ratio.to_record() for ratio in self.ratios],
            "scaling": [curve.to_record() for curve in self.curves],
            "work_precision": [point.to_record() for point in self.points],
            "messages": [cost.to_record() for cost in self.messages],
            "facts": self.facts,
            "omissions": self.omissions,
            "failures": self.failures,
        }
        return json_text(record, indent=2)
