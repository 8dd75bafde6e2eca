"""A severity of a sweep: everyone is asked the same queries, and held against exact and against retail."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.exact.candidate import UNDECIDED
from conformance.exact.errors import errors
from conformance.query import Result, Skipped
from conformance.stress.findings import CANDIDATE, DIFFERING, RETAIL, Findings, Reading
from conformance.stress.quantities import Tally
from conformance.stress.standing import Standing
from conformance.stress.sweep import Sweep
from conformance.stress.worst import worst_case

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from conformance.exact.errors import ErrorSample
    from conformance.query import Outcome, Query
    from conformance.stress.models import Models
    from conformance.stress.sweep import Probe, Say

WORST_BY: Final = ("contact_metres", "position_metres", "flips")
"""What makes a query the worst of its severity."""


class ErrorSweep(Sweep):
    """A sweep of queries, each part one severity.

    Parameters
    ----------
    family, name, axis : str
        As in `Sweep`.
    severities : sequence of float
        Rising.
    probes : callable
        Makes the queries of a severity.
    """

    def __init__(
        self,
        family: str,
        name: str,
        axis: str,
        severities: Sequence[float],
        probes: Callable[[float], Iterable[Probe]],
    ) -> None:
        self.family = family
        self.name = name
        self.axis = axis
        self.severities = tuple(severities)
        self.probes = probes

    @property
    def parts(self) -> int:
        """Number of severities."""
        return len(self.severities)

    def run(self, part: int, models: Models, say: Say) -> Findings:
        """Ask everyone the queries of a severity."""
        severity = self.severities[part]
        asked = Severity(self, severity, models)
        for count, probe in enumerate(self.probes(severity), start=1):
            asked.ask(probe)
            say(f"{self.family}, {self.name} at {severity:g}: {count} queries")
        return asked.findings()


class Severity:
    """What was asked at one severity so far."""

    def __init__(self, sweep: Sweep, severity: float, models: Models) -> None:
        self._sweep = sweep
        self._severity = severity
        self._models = models
        self._tallies = {name: Tally() for name in (*models.roundings, CANDIDATE)}
        for tally in self._tallies.values():
            tally.count("refused", 0)
        self._tallies[CANDIDATE].count(DIFFERING, 0)
        self._standing = Standing(sweep, models.candidate.name)
        self._worst: dict[str, tuple[float, Query]] = {}

    def ask(self, probe: Probe) -> None:
        """Ask everyone one query."""
        query = probe.query
        exact, given = self._models.exact.unrounded(query), self._models.candidate.answer(query)
        for name, ask in self._models.roundings.items():
            outcome = ask(query)
            sample = self._measure(name, outcome, exact, probe)
            if name == RETAIL:
                self._tallies[CANDIDATE].count(DIFFERING, self._differs(outcome, given, query))
                self._keep(sample, query)
        if not isinstance(given, Skipped):
            self._measure(CANDIDATE, given, exact, probe)

    def findings(self) -> Findings:
        """Return what was found."""
        sweep = self._sweep
        found = Findings()
        self._standing.tell(found)
        for name, tally in self._tallies.items():
            if name == CANDIDATE and not self._standing.asked:
                continue
            quantities = tally.quantities()
            found.readings.append(Reading(sweep.family, sweep.name, self._severity, name, quantities))
        for quantity, (value, query) in self._worst.items():
            found.worst.append(worst_case(sweep, self._severity, quantity, value, query))
        return found

    def _measure(self, name: str, outcome: Outcome, exact: Outcome, probe: Probe) -> ErrorSample | None:
        tally = self._tallies[name]
        if not isinstance(outcome, Result):
            tally.count("refused")
            return None
        if probe.watch is not None:
            tally.note(probe.watch(outcome.fields))
        if isinstance(exact, Skipped) and exact.reason.startswith(UNDECIDED):
            tally.count("undecided")
        sample = errors(outcome, exact)
        if sample is not None:
            tally.add(sample)
        return sample

    def _differs(self, retail: Outcome, given: Outcome, query: Query) -> bool:
        return self._standing.differs(query.op, retail, given, f" at {self._severity:g}")

    def _keep(self, sample: ErrorSample | None, query: Query) -> None:
        """Remember the query if retail has answered none worse."""
        for quantity in WORST_BY:
            value: Any = None if sample is None else getattr(sample, quantity)
            size = float(len(value)) if isinstance(value, tuple) else value
            if size and (quantity not in self._worst or self._worst[quantity][0] < size):
                self._worst[quantity] = (size, query)
