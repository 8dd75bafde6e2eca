"""Asking several number models the same queries, and holding each answer against the exact one."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from time import perf_counter
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from conformance.exact.candidate import UNDECIDED
from conformance.exact.errors import errors
from conformance.exact.summary import ErrorSummary
from conformance.query import Errored, Skipped

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.exact.candidate import ExactAnswer, ExactCandidate
    from conformance.query import Outcome, Query

Answer = TypeVar("Answer")
Ask: TypeAlias = "Callable[[Query], Outcome]"
"""How a model is asked: `OracleCandidate().answer`, `double().unrounded`."""


@dataclass(slots=True)
class Survey:
    """What was asked, and what came of it.

    Attributes
    ----------
    models : Mapping of str to callable
        How each model is asked.
    exact : ExactCandidate
        What they are measured against.
    summaries : dict of str to ErrorSummary
        The errors of each model.
    precisions : Counter of int
        Queries by the working precision, bits, that decided them.
    tied : int
        Queries in which two numbers were found equal although balls alone did not tell.
    undecided : list of Query
        Queries that the highest precision does not decide.
    unanswered : Counter of str
        Queries without an exact answer for other reasons, by reason.
    seconds : Counter of str
        Time each model took, the exact one as ``exact``.
    """

    models: Mapping[str, Ask]
    exact: ExactCandidate
    summaries: dict[str, ErrorSummary] = field(default_factory=dict)
    precisions: Counter[int] = field(default_factory=Counter)
    tied: int = 0
    undecided: list[Query] = field(default_factory=list)
    unanswered: Counter[str] = field(default_factory=Counter)
    seconds: dict[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.summaries = {name: ErrorSummary() for name in self.models}
        self.seconds = dict.fromkeys((*self.models, self.exact.name), 0.0)

    @property
    def asked(self) -> int:
        """How many queries were asked."""
        return self.precisions.total()

    def ask(self, query: Query) -> None:
        """Ask every model one query."""
        answer: ExactAnswer = self._timed(self.exact.name, self.exact.perform, query)
        self.precisions[answer.precision] += 1
        self.tied += bool(answer.ties)
        match answer.outcome:
            case Skipped(reason) if reason.startswith(UNDECIDED):
                self.undecided.append(query)
            case Skipped(reason) | Errored(reason):
                self.unanswered[reason] += 1
        for name, ask in self.models.items():
            sample = errors(self._timed(name, ask, query), answer.outcome)
            if sample is not None:
                self.summaries[name].add(sample, query)

    def _timed(self, name: str, ask: Callable[[Query], Answer], query: Query) -> Answer:
        begin = perf_counter()
        answer = ask(query)
        self.seconds[name] += perf_counter() - begin
        return answer
