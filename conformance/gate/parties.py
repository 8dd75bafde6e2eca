"""Who takes part in a gate, and what is known of them before it begins."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import datetime as dt
    from pathlib import Path

    from conformance.candidates.base import Candidate
    from conformance.deviations.files import Deviations
    from conformance.gate.config import Gate


@dataclass(frozen=True, slots=True)
class Parties:
    """Who takes part.

    Attributes
    ----------
    gate : Gate
        What is asked.
    spec : str
        The candidate, as ``--candidate`` takes it.
    read_timeout : float or None
        Seconds within which an engine in a process of its own must reply.
    candidate, oracle : Candidate
        Who is tested, and who answers for retail.
    deviations : Deviations
        How the candidate is known to differ.
    today : date
        By which they expire.
    suite_digest, candidate_digest : str
        Of retail and the comparison, and of the candidate; the latter is empty if nobody can tell.
    unchanged : frozenset of str
        Digests of what has passed in an earlier run.
    evidence : Path
        Folder of the evidence.
    """

    gate: Gate
    spec: str
    read_timeout: float | None
    candidate: Candidate
    oracle: Candidate
    deviations: Deviations
    today: dt.date
    suite_digest: str
    candidate_digest: str
    unchanged: frozenset[str]
    evidence: Path
