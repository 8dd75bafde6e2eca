"""Who is asked: retail, the same with other roundings, exact arithmetic, and the candidate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from conformance.candidates.model_candidate import double, single
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.registry import make_candidate
from conformance.exact.candidate import ExactCandidate
from conformance.stress.findings import RETAIL

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.candidates.base import Candidate
    from conformance.query import Outcome, Query


@dataclass(frozen=True, slots=True)
class Models:
    """Everyone who is asked.

    Attributes
    ----------
    roundings : Mapping of str to callable
        The oracle with retail's roundings, as ``retail``, and with others: how each is asked.
    exact : ExactCandidate
        What errors are measured against.
    candidate : Candidate
        What must be retail.
    """

    roundings: Mapping[str, Callable[[Query], Outcome]]
    exact: ExactCandidate
    candidate: Candidate

    def retail(self, query: Query) -> Outcome:
        """Ask retail."""
        return self.roundings[RETAIL](query)


@dataclass(frozen=True, slots=True)
class Spec:
    """How a candidate is made, in any process.

    Attributes
    ----------
    name : str
        As ``--candidate`` takes it.
    read_timeout : float or None
        Seconds within which an engine in a process of its own must reply.
    """

    name: str
    read_timeout: float | None = None


def make_models(candidate: Spec) -> Models:
    """Make everyone."""
    roundings = {
        RETAIL: OracleCandidate().answer,
        "single": single().unrounded,
        "double": double().unrounded,
    }
    return Models(
        roundings, ExactCandidate(), make_candidate(candidate.name, read_timeout=candidate.read_timeout)
    )
