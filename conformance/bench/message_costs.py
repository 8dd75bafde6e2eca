"""What messages have cost in rounds of cases, as lines of a report."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

from conformance.bench.report import MessageCost, Ratio
from conformance.bench.timing import comparison
from conformance.candidates.command_candidate import WINDOW

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from conformance.protocol.dialects import Dialect


@dataclass(frozen=True, slots=True)
class Seconds:
    """What a case takes: what a run in process takes as well (retail, comparison), and what messages add."""

    in_process: float
    messages: float

    def __add__(self, other: Seconds) -> Seconds:
        return Seconds(self.in_process + other.in_process, self.messages + other.messages)


@dataclass(frozen=True, slots=True)
class Cost:
    """What it took to judge cases over the protocol.

    Attributes
    ----------
    queries : int
        How many were asked.
    processor : Seconds
        The suite's work, its threads included.
    wall : Seconds
        The time somebody waits for, the engine's replies included.
    """

    queries: int
    processor: Seconds
    wall: Seconds

    def __add__(self, other: Cost) -> Cost:
        return Cost(self.queries + other.queries, self.processor + other.processor, self.wall + other.wall)


NOTHING: Final = Cost(0, Seconds(0.0, 0.0), Seconds(0.0, 0.0))
_CLOCKS: Final = ("processor", "wall")


def message_ratios(name: str, dialect: Dialect, rounds: Sequence[Mapping[str, Cost]]) -> list[Ratio]:
    """Return a line for each clock: a run in process beside the same run over the protocol.

    Parameters
    ----------
    name : str
        Who is asked in process.
    dialect : {"decimal", "hex"}
    rounds : sequence of mapping of str to Cost
        What each round took, by operation.
    """
    return [_ratio(name, dialect, clock, rounds) for clock in _CLOCKS]


def _ratio(name: str, dialect: Dialect, clock: str, rounds: Sequence[Mapping[str, Cost]]) -> Ratio:
    """Return the line of a clock: that of all rounds together, as a few long walks are most of a run."""
    costs = [sum(of_ops.values(), NOTHING) for of_ops in rounds]
    ours, theirs = _nanoseconds(costs, clock)
    (our_whole,), (their_whole,) = _nanoseconds([sum(costs, NOTHING)], clock)
    found = comparison(ours, theirs)
    whole = replace(
        found,
        ratio=replace(found.ratio, middle=their_whole / our_whole),
        ours=replace(found.ours, middle=our_whole),
        theirs=replace(found.theirs, middle=their_whole),
    )
    added = our_whole / their_whole - 1.0
    note = f"messages, floats {dialect}: {added:.1%} more {clock} time"
    return Ratio("cases", "judge", name, WINDOW, 1, whole, note)


def _nanoseconds(costs: Sequence[Cost], clock: str) -> tuple[list[float], list[float]]:
    """Return what a query takes over the protocol and in process."""
    ours, theirs = [], []
    for cost in costs:
        seconds: Seconds = getattr(cost, clock)
        ours.append(1e9 * (seconds.in_process + seconds.messages) / cost.queries)
        theirs.append(1e9 * seconds.in_process / cost.queries)
    return ours, theirs


def costs_by_operation(dialect: Dialect, rounds: Sequence[Mapping[str, Cost]]) -> list[MessageCost]:
    """Return where the messages' time goes, most of it first."""
    found: dict[str, Cost] = {}
    for of_ops in rounds:
        for op, cost in of_ops.items():
            found[op] = found.get(op, NOTHING) + cost
    costs = [
        MessageCost(op, dialect, cost.queries, cost.processor.in_process, cost.processor.messages)
        for op, cost in found.items()
    ]
    return sorted(costs, key=lambda cost: -cost.messages)
