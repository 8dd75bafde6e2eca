"""Asking every known bug every pinned case and random queries, to see what catches it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from conformance.candidates.bug_candidate import BugCandidate
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.compare import differences, pin_differences
from conformance.query import Result, Skipped
from conformance.strategies.cell_queries import CELL_OPS, cell_queries
from conformance.strategies.collisions import DISPATCHES, find_collisions, transitions
from conformance.strategies.encounters import ENCOUNTERS
from conformance.strategies.geometry_queries import BSP_OPS, POLYGON_OPS, geometry_queries
from conformance.strategies.land_queries import LAND_DEFS_OPS, land_defs_queries
from conformance.strategies.math_queries import FRAME_OPS, MOVER_OPS, frame_queries, mover_queries
from conformance.strategies.object_calls import FUNCTIONS, object_calls, object_transitions
from conformance.strategies.world_encounters import WORLD_ENCOUNTERS
from conformance.strategies.world_queries import LAND_OPS, land_queries, world_transitions

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from conformance.candidates.bug_candidate import KnownBug
    from conformance.case import Case
    from conformance.console import Progress
    from conformance.query import Outcome, Query

DRAWS: Final = 2000
"""Random queries of each family."""
FAMILIES: Final[Mapping[str, st.SearchStrategy[Query]]] = {
    "collision calls": st.one_of([find_collisions(dispatch) for dispatch in DISPATCHES]),
    "transitions": transitions(),
    "single calls": st.one_of(
        [
            *(geometry_queries(op) for op in (*POLYGON_OPS, *BSP_OPS)),
            *(frame_queries(op) for op in FRAME_OPS),
            *(mover_queries(op) for op in MOVER_OPS),
            *(land_defs_queries(op) for op in LAND_DEFS_OPS),
        ]
    ),
    "rare encounters": st.one_of([*ENCOUNTERS.values(), *WORLD_ENCOUNTERS.values()]),
    "objects": st.one_of([object_transitions(), *(object_calls(function) for function in FUNCTIONS)]),
    "cells": st.one_of([*map(cell_queries, CELL_OPS), *map(land_queries, LAND_OPS)]),
    "worlds": world_transitions(),
}
"""What is asked at random: BSP calls of every path, transitions, small operations, rarities; then objects,
cells and land by themselves, and transitions in whole worlds."""
_SEED: Final = 20130424
"""Makes the draws the same in every run of one Hypothesis version."""
_TRACE: Final = "trace"
_FAILED: Final = "no answer"
"""What stands for the output where a candidate failed."""


@dataclass(frozen=True, slots=True)
class Kill:
    """A query on which a bug and retail differ.

    Attributes
    ----------
    op : str
        What was asked.
    output : str
        The first output that differs, as reports call it.
    where : str
        The case's id, or the family of random queries.
    draw : int
        Which random query of the family it was, from 1; 0 for a case.
    """

    op: str
    output: str
    where: str
    draw: int = 0


@dataclass(slots=True)
class Record:
    """What is known of one bug.

    Attributes
    ----------
    bug : KnownBug
        The bug.
    cases : list of Kill
        The pinned cases that catch it.
    random : Kill or None
        The first random query that does.
    asked, different : Mapping of str to int
        Random queries by family that both answered, and those that differ; until the bug was caught, or
        all of them if its rate is wanted.
    """

    bug: KnownBug
    cases: list[Kill] = field(default_factory=list)
    random: Kill | None = None
    asked: dict[str, int] = field(default_factory=dict)
    different: dict[str, int] = field(default_factory=dict)

    @property
    def named_case(self) -> Kill | None:
        """What the case written against the bug shows."""
        return next((kill for kill in self.cases if kill.where == self.bug.case), None)

    @property
    def rates(self) -> str:
        """How many of the random queries differ, by family."""
        return ", ".join(f"{family} {self.different[family]} of {n}" for family, n in self.asked.items())

    @property
    def unexplained(self) -> tuple[str, ...]:
        """What should have caught the bug and did not, without a recorded reason."""
        if self.bug.survives:
            return ()
        caught = {"its case": self.named_case, "random queries": self.random}
        return tuple(name for name, kill in caught.items() if kill is None)


class HuntBrokenOffError(KeyboardInterrupt):
    """Ctrl-C during a hunt; `records` say what was found so far."""

    def __init__(self, records: list[Record]) -> None:
        super().__init__()
        self.records = records


def hunt(
    bugs: Iterable[KnownBug], cases: Sequence[Case], *, draws: int = DRAWS, progress: Progress
) -> list[Record]:
    """Ask every bug every case as written, and random queries until one catches it.

    Parameters
    ----------
    bugs : iterable of KnownBug
        Who is hunted.
    cases : sequence of Case
        Asked in the pose they are pinned in.
    draws : int
        Random queries of each family; 0 asks the cases only.
    progress : Progress
        Where to say how far it is.

    Raises
    ------
    HuntBrokenOffError
        On Ctrl-C, with what was found so far.
    """
    hunters = [Hunter(bug) for bug in bugs]
    records = [hunter.record for hunter in hunters]
    try:
        for number, case in enumerate(cases, start=1):
            progress.say(f"pinned cases: {number} of {len(cases)}")
            for hunter in hunters:
                hunter.ask_case(case)
        for family in FAMILIES if draws else ():
            _hunt_at_random(hunters, family, draws, progress)
    except KeyboardInterrupt:
        raise HuntBrokenOffError(records) from None
    return records


def _hunt_at_random(hunters: Sequence[Hunter], family: str, draws: int, progress: Progress) -> None:
    oracle = OracleCandidate()

    def ask(query: Query, draw: int) -> None:
        progress.say(f"{family}: draw {draw} of {draws}")
        wanting = [hunter for hunter in hunters if hunter.wants_random]
        truth = oracle.answer(query) if wanting else Skipped("everything is caught")
        for hunter in wanting:
            hunter.ask_random(query, truth, family, draw)

    draw_queries(FAMILIES[family], draws, ask)


class Hunter:
    """Asks one bug, and notes where it differs from retail."""

    def __init__(self, bug: KnownBug) -> None:
        self.record = Record(bug)
        self._candidate = BugCandidate(bug)

    @property
    def wants_random(self) -> bool:
        """Whether more random queries would tell something."""
        return self.record.random is None or self.record.bug.rated

    def ask_case(self, case: Case) -> None:
        """Ask a case as written; what counts is the outputs that it pins."""
        output = first_missed_pin(case, self._candidate.answer(case.queries[0]))
        if output:
            self.record.cases.append(Kill(case.op, output, case.id))

    def ask_random(self, query: Query, truth: Outcome, family: str, draw: int) -> None:
        """Ask one random query, if retail has an answer to it."""
        record = self.record
        if not isinstance(truth, Result):
            return
        output = first_difference(query, truth, self._candidate.answer(query))
        record.asked[family] = record.asked.get(family, 0) + 1
        record.different[family] = record.different.get(family, 0) + bool(output)
        if output and record.random is None:
            record.random = Kill(query.op, output, family, draw)


def first_missed_pin(case: Case, given: Outcome) -> str:
    """Return the first pinned output that an answer to a case misses, empty if none."""
    if not isinstance(given, Result):
        return _FAILED
    missed = pin_differences(case.expect, given.fields, op=case.op)
    return missed[0].name if missed else ""


def first_difference(query: Query, truth: Outcome, given: Outcome) -> str:
    """Return the first output that differs from retail's answer, empty if none or if retail has none.

    The trace comes last: not every engine has one.
    """
    if not isinstance(truth, Result):
        return ""
    if not isinstance(given, Result):
        return _FAILED
    found = differences(truth.fields, given.fields, op=query.op, zero_signs="distinct")
    names = sorted((difference.name for difference in found), key=lambda name: name == _TRACE)
    return names[0] if names else ""


def draw_queries(
    queries: st.SearchStrategy[Query],
    draws: int,
    ask: Callable[[Query, int], None],
    *,
    draw_seed: int = _SEED,
) -> None:
    """Draw queries, the same in every run with a seed, and hand each one on with its number."""
    count = 0

    def take(query: Query) -> None:
        nonlocal count
        count += 1
        ask(query, count)

    once = settings(
        max_examples=draws,
        phases=[Phase.generate],
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )
    seed(draw_seed)(once(given(queries)(take)))()
