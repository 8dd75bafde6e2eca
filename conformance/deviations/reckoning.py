"""Holding what came of a case against what is recorded of the engine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from conformance.deviations.entries import first_line

if TYPE_CHECKING:
    import datetime as dt
    from collections.abc import Sequence

    from conformance.deviations.entries import Deviation
    from conformance.deviations.files import Deviations, Entry
    from conformance.verdict import Failure, Verdict


@dataclass(frozen=True, slots=True)
class Reckoning:
    """What a case's failures are, once the recorded ones are taken out.

    Attributes
    ----------
    unexplained : tuple of Failure
        Failures that are not recorded, or not so.
    held : tuple of Entry
        Deviations that showed as recorded.
    complaints : tuple of str
        What is wrong with deviations about the case: expired, or not seen; located, a line each.
    """

    unexplained: tuple[Failure, ...] = ()
    held: tuple[Entry, ...] = ()
    complaints: tuple[str, ...] = ()


def reckon(
    deviations: Deviations, case_id: str, verdict: Verdict, *, candidate: str, today: dt.date
) -> Reckoning:
    """Separate a case's failures into recorded ones and others.

    Parameters
    ----------
    deviations : Deviations
        What is recorded of the candidate.
    case_id : str
    verdict : Verdict
        What came of the case.
    candidate : str
        Name of the candidate: what the oracle itself fails at is never excused.
    today : date
        Entries whose last day is before it have expired, and excuse nothing.
    """
    entries = deviations.about(case_id)
    valid = [entry for entry in entries if not entry.deviation.has_expired(today)]
    recorded = [entry.deviation for entry in valid]
    unexplained = [failure for failure in verdict.failures if not _is_recorded(failure, recorded, candidate)]
    held = [entry for entry in valid if _shows(entry.deviation, verdict.failures, candidate)]
    complaints = [
        f"{entry.location}: the deviation has expired on {entry.deviation.until}: {entry.deviation.words}"
        for entry in entries
        if entry.deviation.has_expired(today)
    ]
    complaints += [
        f"{entry.location}: the deviation does not show ({_instead(verdict)}): {entry.deviation.words}"
        for entry in valid
        if not any(entry is other for other in held)
    ]
    return Reckoning(tuple(unexplained), tuple(held), tuple(complaints))


def _is_recorded(failure: Failure, recorded: Sequence[Deviation], candidate: str) -> bool:
    """Tell whether all of a failure is recorded: every difference, or the error."""
    if failure.who != candidate:
        return False
    if not failure.found:
        return any(deviation.covers_error(failure.error) for deviation in recorded)
    return all(any(deviation.covers(difference) for deviation in recorded) for difference in failure.found)


def _shows(deviation: Deviation, failures: Sequence[Failure], candidate: str) -> bool:
    """Tell whether a deviation is seen in some query of its case."""
    return any(
        deviation.covers_error(failure.error)
        if not failure.found
        else any(map(deviation.covers, failure.found))
        for failure in failures
        if failure.who == candidate
    )


def _instead(verdict: Verdict) -> str:
    """Say what came of a case in which a deviation was expected."""
    if verdict.failures:
        return f"instead {first_line(verdict.failures[0].summary)}"
    return "the case passes" if verdict.compared else f"not compared: {'; '.join(verdict.skipped)}"
