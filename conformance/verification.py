"""Verifying a candidate against vector files: asking every record and counting the answers."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.base import ask_ahead
from conformance.compare import differences
from conformance.query import Errored, Skipped
from conformance.summary import skipped_text
from conformance.vector_errors import VectorError
from conformance.vector_io import VectorRecord, read_vectors

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator
    from pathlib import Path

    from conformance.candidates.base import Candidate
    from conformance.compare import Difference
    from conformance.console import Progress
    from conformance.vector_library import Library

_PROGRESS_STEP: Final = 64
"""Records that are asked together, between two updates of the progress line."""


@dataclass(frozen=True, slots=True)
class Failure:
    """One record that failed: with differences, or with what went wrong instead of an answer.

    What went wrong in no line of a file, as an engine that does not stop, has none.
    """

    line: int | None
    record: VectorRecord | None
    differences: tuple[Difference, ...] = ()
    error: str = ""


@dataclass(slots=True)
class Tally:
    """What came of the records of a file, or of several.

    Attributes
    ----------
    passed, failed : int
        Exact records that agree and that do not; a line that cannot be read has failed.
    advisory, advisory_agreeing : int
        Records marked uncertain that were compared, and how many of them agree.
    skipped : Counter of str
        Records the candidate does not do, by its reason.
    failures : list of Failure
        Every failure, in file order.
    chosen : set of str
        Ids of the records that were chosen by their ids and are there.
    """

    passed: int = 0
    failed: int = 0
    advisory: int = 0
    advisory_agreeing: int = 0
    skipped: Counter[str] = field(default_factory=Counter)
    failures: list[Failure] = field(default_factory=list)
    chosen: set[str] = field(default_factory=set)

    @property
    def compared(self) -> int:
        """How many records were held against an answer, or should have been."""
        return self.passed + self.failed + self.advisory

    def add(self, other: Tally) -> None:
        """Count another tally's records too; its failures stay there."""
        self.passed += other.passed
        self.failed += other.failed
        self.advisory += other.advisory
        self.advisory_agreeing += other.advisory_agreeing
        self.skipped += other.skipped
        self.chosen |= other.chosen

    def fail(self, failure: Failure) -> None:
        """Count one failure."""
        self.failed += 1
        self.failures.append(failure)

    def summary(self) -> str:
        """Say the counts in one line: ``N passed, M failed, K skipped (why: count), U advisory``."""
        skipped = skipped_text(self.skipped)
        agree = f" ({self.advisory_agreeing} agree)" if self.advisory else ""
        return f"{self.passed} passed, {self.failed} failed, {skipped}, {self.advisory} advisory{agree}"

    def counts(self) -> dict[str, Any]:
        """Return the counts for a machine to read."""
        return {
            "passed": self.passed,
            "failed": self.failed,
            "skipped": dict(self.skipped),
            "advisory": {"compared": self.advisory, "agreeing": self.advisory_agreeing},
        }


def verify_file(
    path: Path,
    candidate: Candidate,
    library: Library,
    *,
    only: Collection[str] = (),
    progress: Progress | None = None,
    tally: Tally | None = None,
) -> Tally:
    """Ask a candidate every record of a vector file and compare; signs of zero are equal there.

    Parameters
    ----------
    path : Path
        The file.
    candidate : Candidate
        Who is asked.
    library : Library
        The shared geometry of the file's folder.
    only : collection of str
        Ids of the records to ask; empty means all.
    progress : Progress or None
        Where to say how far it is.
    tally : Tally or None
        Where to count; it then holds what was compared also if Ctrl-C ends the run.

    Raises
    ------
    OSError
        If the file cannot be read at all.
    """
    tally = Tally() if tally is None else tally
    count = 0
    for batch in _batches(read_vectors(path, library)):
        if progress is not None:
            progress.say(f"{path.name}: {count} records, {tally.failed} failed")
        count += len(batch)
        asked = [item for item in batch if not only or _id_of(item) in only]
        tally.chosen.update(name for item in asked if only and (name := _id_of(item)))
        ask_ahead(candidate, [item.query for item in asked if isinstance(item, VectorRecord)])
        for item in asked:
            if isinstance(item, VectorError):
                tally.fail(Failure(item.line, None, error=str(item)))
            else:
                _verify_record(item, candidate, tally)
    return tally


def _batches(items: Iterator[VectorRecord | VectorError]) -> Iterator[list[VectorRecord | VectorError]]:
    """Group records that are read, and asked of a candidate that works beside the suite, together."""
    while batch := list(islice(items, _PROGRESS_STEP)):
        yield batch


def _id_of(item: VectorRecord | VectorError) -> str | None:
    return item.id if isinstance(item, VectorRecord) else item.record_id


def _verify_record(record: VectorRecord, candidate: Candidate, tally: Tally) -> None:
    outcome = candidate.answer(record.query)
    if isinstance(outcome, Skipped):
        tally.skipped[outcome.reason] += 1
        return
    if isinstance(outcome, Errored):
        found, error = [], outcome.context
    else:
        found = differences(record.expected, outcome.fields, op=record.query.op, zero_signs="equal")
        error = ""
    if record.uncertain is not None:
        tally.advisory += 1
        tally.advisory_agreeing += not found and not error
    elif found or error:
        tally.fail(Failure(record.line, record, tuple(found), error))
    else:
        tally.passed += 1
