"""Thresholds: retail's comparisons, asked at neighbouring float32s about the value where they turn.

Each threshold has two numbers that are stepped, float32 by float32, over a square: the one that decides,
about the value at which the exact decision turns, and one that enters the same sums. The square is drawn; a
few of its columns say how often retail does not decide as exact arithmetic does, so many steps from the turn.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from conformance.query import Result
from conformance.stress.comparisons import COMPARISONS
from conformance.stress.findings import (
    CANDIDATE,
    DIFFERING,
    EXACT_YES,
    RETAIL,
    RETAIL_YES,
    Findings,
    Picture,
    Reading,
)
from conformance.stress.standing import Standing
from conformance.stress.steps import stepped, turning_point
from conformance.stress.sweep import Sweep
from conformance.stress.worst import worst_case

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from conformance.query import Outcome, Query
    from conformance.stress.comparisons import Comparison
    from conformance.stress.models import Models
    from conformance.stress.settings import Settings
    from conformance.stress.sweep import Say

FAMILY: Final = "thresholds"
AXIS: Final = "float32 steps from where the exact decision turns"
TOLD: Final = (-8, -2, -1, 0, 1, 2, 8)
"""Columns that are told as severities, steps; at 0 is the first float32 behind the turn."""


def sweeps(settings: Settings) -> Sequence[Sweep]:
    """Return the family: a sweep for each comparison."""
    return [ThresholdSweep(comparison, settings.grid) for comparison in COMPARISONS]


class ThresholdSweep(Sweep):
    """A square about one comparison.

    Parameters
    ----------
    comparison : Comparison
    edge : int
        Of the square, float32 steps; a comparison may ask for a share of it.
    """

    family = FAMILY
    axis = AXIS
    cost = 10

    def __init__(self, comparison: Comparison, edge: int) -> None:
        self.name = comparison.name
        self.comparison = comparison
        half = edge // comparison.share // 2
        self.steps = range(-half, half)

    @property
    def parts(self) -> int:
        """A square is asked whole."""
        return 1

    def run(self, part: int, models: Models, say: Say) -> Findings:
        """Ask everyone at every point of the square."""
        comparison, square = self.comparison, Square(self, models)
        turn = turning_point(*comparison.between, lambda value: square.exactly(value, comparison.beside))
        for row in self.steps:
            say(f"{self.family}, {self.name}: row {row} of part {part}")
            beside = stepped(comparison.beside, row)
            for column in self.steps:
                square.ask(row, column, comparison.query(stepped(turn, column), beside))
        return square.findings()


@dataclass(frozen=True, slots=True)
class Point:
    """What everyone decided at one point.

    Attributes
    ----------
    column : int
        Steps from the turn.
    exact : bool or None
        None without an answer: it stayed undecided.
    others : Mapping of str to bool or None
        Retail, other roundings, and the candidate.
    same : bool
        Whether the candidate's answer is retail's, on every bit.
    """

    column: int
    exact: bool | None
    others: Mapping[str, bool | None]
    same: bool

    def is_wrong(self, model: str) -> bool:
        """Tell whether a model decides otherwise than exact arithmetic."""
        return self.exact is not None and self.others[model] is not self.exact


class Square:
    """Decisions at the points of a square, asked row by row."""

    def __init__(self, sweep: ThresholdSweep, models: Models) -> None:
        self._sweep = sweep
        self._models = models
        self._rows: dict[int, list[Point]] = {}
        self._standing = Standing(sweep, models.candidate.name)
        self._worst: tuple[int, Query] | None = None

    def exactly(self, value: float, beside: float) -> bool:
        """Return the exact decision at a point.

        Raises
        ------
        ValueError
            If there is none.
        """
        outcome = self._models.exact.unrounded(self._sweep.comparison.query(value, beside))
        decision = self._decision(outcome)
        if decision is None:
            raise ValueError(f"{self._sweep.name}: no decision at {value!r}, {beside!r}: {outcome}")
        return decision

    def ask(self, row: int, column: int, query: Query) -> None:
        """Ask everyone one query."""
        exact, given = self._models.exact.unrounded(query), self._models.candidate.answer(query)
        outcomes = {name: ask(query) for name, ask in self._models.roundings.items()}
        differs = self._standing.differs(query.op, outcomes[RETAIL], given, f" at {column} / {row}")
        outcomes[CANDIDATE] = given
        others = {name: self._decision(outcome) for name, outcome in outcomes.items()}
        point = Point(column, self._decision(exact), others, not differs)
        self._rows.setdefault(row, []).append(point)
        if point.is_wrong(RETAIL) and (self._worst is None or self._worst[0] < abs(column)):
            self._worst = (abs(column), query)

    def findings(self) -> Findings:
        """Return the picture, and what was measured."""
        sweep, found = self._sweep, Findings()
        self._standing.tell(found)
        found.pictures.append(Picture(sweep.name, sweep.comparison.axes, tuple(self._signs())))
        for column in (column for column in TOLD if column in sweep.steps):
            points = [p for row in self._rows.values() for p in row if p.column == column]
            found.readings += [self._reading(model, column, points) for model in self._asked()]
        half = float(len(self._rows) // 2)
        whole = [point for row in self._rows.values() for point in row]
        found.readings += [self._reading(model, half, whole, whole=True) for model in self._asked()]
        if self._worst is not None:
            steps, query = self._worst
            found.worst.append(worst_case(sweep, steps, "disagreeing", float(steps), query))
        return found

    def _decision(self, outcome: Outcome) -> bool | None:
        return self._sweep.comparison.decide(outcome.fields) if isinstance(outcome, Result) else None

    def _asked(self) -> Iterable[str]:
        """Return whose decisions are told: the candidate's only if it has taken part at every point."""
        return self._models.roundings if self._standing.skipped else (*self._models.roundings, CANDIDATE)

    def _signs(self) -> Iterable[tuple[int, ...]]:
        for row in self._rows.values():
            yield tuple(
                RETAIL_YES * (point.others[RETAIL] is True) + EXACT_YES * (point.exact is True)
                for point in row
            )

    def _reading(
        self, model: str, severity: float, points: Sequence[Point], *, whole: bool = False
    ) -> Reading:
        wrong = [point for point in points if point.is_wrong(model)]
        quantities = {"disagreeing": float(len(wrong)), "answers": float(len(points))}
        quantities["undecided"] = float(sum(point.exact is None for point in points))
        if whole:
            quantities["band_steps"] = float(max(_band(row, model) for row in self._rows.values()))
            quantities["reversals"] = float(max(_reversals(row, model) for row in self._rows.values()))
        if model == CANDIDATE:
            quantities[DIFFERING] = float(sum(not point.same for point in points))
        return Reading(FAMILY, self._sweep.name, severity, model, quantities)


def _band(row: Sequence[Point], model: str) -> int:
    """Return how many steps from a row's own exact turn a model is still wrong; 0 if it never is.

    A row that the exact turn does not cross is not counted.
    """
    turns = [b.column for a, b in itertools.pairwise(row) if a.exact is not b.exact]
    if len(turns) != 1:
        return 0
    # The turn is between two float32s: its neighbours on either side are one step away.
    steps = (p.column - turns[0] + (p.column >= turns[0]) for p in row if p.is_wrong(model))
    return max((abs(step) for step in steps), default=0)


def _reversals(row: Sequence[Point], model: str) -> int:
    """Return how often decisions turn back along a row; 0 if they turn at most once."""
    decisions = [point.others[model] for point in row]
    turns = sum(a is not b for a, b in itertools.pairwise(decisions))
    return max(turns - 1, 0)
