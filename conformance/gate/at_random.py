"""The stages of random queries: families of calls in random poses, and walks."""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from conformance.bug_hunt import FAMILIES, draw_queries
from conformance.candidates.base import ask_ahead
from conformance.compare import differences
from conformance.found import write_found
from conformance.gate.config import PATIENCE
from conformance.gate.outcome import Check, Stage, Status
from conformance.query import Errored, Skipped
from conformance.report.text import summary_line
from conformance.strategies.walks import body_walks, walks
from conformance.strategies.world_walks import world_body_walks, world_walks

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from hypothesis.strategies import SearchStrategy

    from conformance.compare import Difference
    from conformance.gate.config import Draws
    from conformance.gate.parties import Parties
    from conformance.query import Query

WALKS: Final[Mapping[str, SearchStrategy[Query]]] = {
    "recorded moves in one cell": walks(),
    "bodies in one cell": body_walks(),
    "recorded moves in worlds": world_walks(),
    "bodies in worlds": world_body_walks(),
}
"""Walks of two seconds each: given moves, and bodies that move by themselves."""


@dataclass(slots=True)
class _Family:
    """What came of the queries of a family so far."""

    compared: int = 0
    waited: float = 0.0
    skipped: Counter[str] = field(default_factory=Counter)
    errors: list[str] = field(default_factory=list)
    wrong: list[tuple[Query, list[Difference]]] = field(default_factory=list)


def check_poses(parties: Parties, record: Callable[[Check], None], say: Callable[[str], None]) -> None:
    """Ask the families of random calls, scenes and worlds."""
    _check_all(Stage.POSES, FAMILIES, parties.gate.poses, parties, record, say)


def check_walks(parties: Parties, record: Callable[[Check], None], say: Callable[[str], None]) -> None:
    """Ask random walks."""
    _check_all(Stage.WALKS, WALKS, parties.gate.walks, parties, record, say)


def _check_all(
    stage: Stage,
    families: Mapping[str, SearchStrategy[Query]],
    draws: Draws,
    parties: Parties,
    record: Callable[[Check], None],
    say: Callable[[str], None],
) -> None:
    for name, queries in families.items() if draws.count else ():
        begin = time.perf_counter()
        family = _Family()

        def ask(query: Query, draw: int, name: str = name, family: _Family = family) -> None:
            say(f"{stage.value}: {name}, {draw} of {draws.count}")
            _ask(query, parties, family)

        draw_queries(queries, draws.count, ask, draw_seed=draws.seed)
        record(_concluded(stage, name, family, time.perf_counter() - begin, parties))


def _ask(query: Query, parties: Parties, family: _Family) -> None:
    """Ask one query, unless too many were waited for; the oracle's own failures are red, too."""
    if family.waited > PATIENCE:
        return
    begin = time.perf_counter()
    ask_ahead(parties.candidate, (query,))
    answers = []
    for who in (parties.oracle, parties.candidate):
        outcome = who.answer(query)
        if isinstance(outcome, Skipped):
            family.skipped[f"{who.name}: {outcome.reason}"] += 1
            return
        if isinstance(outcome, Errored):
            family.errors.append(f"{who.name} failed: {outcome.context}")
            family.waited += time.perf_counter() - begin
            return
        answers.append(outcome.fields)
    family.compared += 1
    found = differences(*answers, op=query.op, zero_signs="distinct")
    if found:
        family.wrong.append((query, found))


def _concluded(stage: Stage, name: str, family: _Family, seconds: float, parties: Parties) -> Check:
    """Return the check of a family; the first query that went wrong is kept as a case."""
    status, message = Status.PASSED, ""
    if family.wrong:
        (query, found), count = family.wrong[0], len(family.wrong)
        path = _keep(parties.evidence, query, found, parties.spec)
        first = summary_line(found[0], parties.candidate.name)
        status, message = Status.FAILED, f"{count} of {family.compared} differ; {first}; kept: {path.name}"
    elif family.errors:
        status, message = Status.BROKEN, f"{len(family.errors)} without an answer; {family.errors[0]}"
    elif not family.compared:
        status, message = Status.SKIPPED, "; ".join(family.skipped)
    return Check(stage, name, status, family.compared, seconds, message)


def _keep(evidence: Path, query: Query, found: list[Difference], candidate: str) -> Path:
    return write_found(evidence / "found", query, found, candidate=candidate, provenance="the gate")
