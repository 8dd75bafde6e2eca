"""Candidates that are wrong on purpose: the oracle with one mistake that ports have really made.

A suite that passes one of them has a hole. A bug is a small entry of a table: what it does, what retail
does, which attributes of the oracle are replaced while the candidate answers, and the case that shows it.
"""

from __future__ import annotations

from typing import Final

from conformance.candidates.bug_candidate import BugCandidate, KnownBug
from conformance.candidates.known_bugs import (
    cells,
    limits,
    numbers,
    overlaps,
    planes,
    shapes,
    slides,
    steps,
)

_BUGS: Final = (
    *planes.BUGS,
    *numbers.BUGS,
    *limits.BUGS,
    *overlaps.BUGS,
    *slides.BUGS,
    *steps.BUGS,
    *cells.BUGS,
    *shapes.BUGS,
)


def list_bugs() -> tuple[KnownBug, ...]:
    """Return every known bug."""
    return _BUGS


def bug_candidates() -> dict[str, BugCandidate]:
    """Return a candidate for every known bug, by the candidate's name."""
    return {candidate.name: candidate for candidate in map(BugCandidate, _BUGS)}
