"""The work that the engine does for a query: with shortcuts, without, and what brute force would be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from conformance.candidates.engine_candidate import EngineCandidate
from conformance.candidates.engine_ops.probing import probing
from conformance.query import Errored, Skipped
from engine.linear_scan import scanning

if TYPE_CHECKING:
    from conformance.query import Query
    from engine.probes import Work


class NoWorkError(Exception):
    """A query of which no work can be told; `failed`: because the engine failed."""

    def __init__(self, reason: str, *, failed: bool) -> None:
        self.failed = failed
        super().__init__(reason)


@dataclass(frozen=True, slots=True)
class WorkReport:
    """What a query takes.

    Attributes
    ----------
    planned : Work
        With the shortcuts that the engine takes by itself.
    unplanned : Work
        Without any.
    walks : int
        Walks through trees, without shortcuts.
    scanned : int
        Polygons that as many linear scans would test.
    """

    planned: Work
    unplanned: Work
    walks: int
    scanned: int

    @property
    def avoided(self) -> float:
        """The part of brute force's polygon tests that is not made; 0 if it makes none."""
        return 1.0 - self.planned.polygons / self.scanned if self.scanned else 0.0


def measure_work(query: Query) -> WorkReport:
    """Ask the engine a query, and return what it took.

    Raises
    ------
    NoWorkError
        If the engine fails or does not answer it, or if no transition is run for it.
    """
    with probing() as probe, scanning() as scan:
        outcome = EngineCandidate().answer(query)
    if isinstance(outcome, Errored):
        raise NoWorkError(f"failed: {outcome.context}", failed=True)
    if isinstance(outcome, Skipped):
        raise NoWorkError(f"skipped: {outcome.reason}", failed=False)
    if not probe.with_shortcuts.queries:
        raise NoWorkError(f"{query.op} runs no transition", failed=False)
    return WorkReport(probe.with_shortcuts, probe.without, scan.walks, scan.polygons)
