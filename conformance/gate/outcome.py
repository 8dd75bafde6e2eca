"""What a gate's checks came to, and how the whole ends."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, Final

from conformance import exit_codes


class Status(StrEnum):
    """How one check ended."""

    PASSED = "passed"
    FAILED = "failed"
    """An answer is not retail's, a bound is broken, or a deviation does not hold."""
    BROKEN = "broken"
    """The candidate gave no answer: it crashed, hung or replied badly."""
    RECORDED = "recorded"
    """It fails as a deviation says."""
    SKIPPED = "skipped"
    """The candidate does not do it."""
    UNCHANGED = "unchanged"
    """It passed in an earlier run, of the same inputs."""


class Stage(StrEnum):
    """A part of a gate."""

    CASES = "cases"
    POSES = "poses"
    WALKS = "walks"
    STRESS = "stress"
    PERFORMANCE = "performance"


VERDICTS: Final = {
    exit_codes.OK: "pass",
    exit_codes.FAILURES: "disagreement",
    exit_codes.BROKEN: "candidate broken",
    exit_codes.NOTHING_RAN: "nothing ran",
    exit_codes.BROKEN_OFF: "broken off",
}
"""What an exit code is called in the evidence."""
_SHOWN: Final = frozenset(Status) - {Status.SKIPPED}


@dataclass(frozen=True, slots=True)
class Check:
    """One thing that was looked at.

    Attributes
    ----------
    stage : Stage
    name : str
        Id of the case, name of the family, bound of the budget.
    status : Status
    compared : int
        Queries that were compared.
    seconds : float
        How long it took.
    message : str
        What is wrong, or why it was skipped.
    digest : str
        Of everything that its outcome depends on; empty if that cannot be told.
    """

    stage: Stage
    name: str
    status: Status
    compared: int = 0
    seconds: float = 0.0
    message: str = ""
    digest: str = ""

    def to_record(self) -> dict[str, Any]:
        """Write it for JSON; what is empty is left out."""
        record = {
            "stage": self.stage.value,
            "name": self.name,
            "status": self.status.value,
            "compared": self.compared,
            "seconds": round(self.seconds, 6),
        }
        more = {"message": self.message, "digest": self.digest}
        return {**record, **{key: value for key, value in more.items() if value}}


@dataclass(slots=True)
class GateRun:
    """What a gate has seen so far.

    Attributes
    ----------
    asked : tuple of Stage
        The stages that it was asked for: each must show something.
    checks : list of Check
        In the order in which they were made.
    notes : list of str
        What a reader should know: what was left out, and why.
    whole : bool
        Whether it came to its end.
    report : str
        What people are shown of the cases, HTML; empty if none was asked.
    """

    asked: tuple[Stage, ...]
    checks: list[Check] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    whole: bool = False
    report: str = ""

    def leave_out(self, stage: Stage, why: str) -> None:
        """Take a stage that cannot be run out of those that were asked for, and note why."""
        self.asked = tuple(other for other in self.asked if other is not stage)
        self.notes.append(f"{stage.value} was left out: {why}")

    def of(self, stage: Stage) -> list[Check]:
        """Return the checks of a stage."""
        return [check for check in self.checks if check.stage is stage]

    def counts(self, stage: Stage) -> dict[str, int]:
        """Return how many checks of a stage ended how, and how many queries it has compared."""
        found = Counter(check.status for check in self.of(stage))
        compared = sum(check.compared for check in self.of(stage))
        return {"compared": compared, **{status.value: found[status] for status in Status}}

    @property
    def empty_stages(self) -> list[Stage]:
        """The stages that have shown nothing: all was filtered away, or the candidate does none of it."""
        return [stage for stage in self.asked if not any(check.status in _SHOWN for check in self.of(stage))]

    @property
    def exit_code(self) -> int:
        """How the command ends: a wrong answer counts more than a missing one, and that more than nothing."""
        statuses = {check.status for check in self.checks}
        if Status.FAILED in statuses:
            return exit_codes.FAILURES
        if Status.BROKEN in statuses:
            return exit_codes.BROKEN
        if not self.whole:
            return exit_codes.BROKEN_OFF
        return exit_codes.NOTHING_RAN if self.empty_stages or not self.asked else exit_codes.OK
