"""How a candidate stands beside retail in a part of a sweep: what differs, what is missing, what it skips."""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance.compare import differences
from conformance.query import Errored, Result, Skipped
from conformance.report.text import summary_line

if TYPE_CHECKING:
    from conformance.query import Outcome
    from conformance.stress.findings import Findings
    from conformance.stress.sweep import Sweep


class Standing:
    """The candidate's answers, taken one by one.

    Parameters
    ----------
    sweep : Sweep
        In which it is asked.
    candidate : str
        What it is called.

    Attributes
    ----------
    asked, skipped : int
        In how many queries it takes part, and in how many not.
    """

    def __init__(self, sweep: Sweep, candidate: str) -> None:
        self.asked = 0
        self.skipped = 0
        self._sweep = sweep
        self._candidate = candidate
        self._differences: list[str] = []
        self._errors: list[str] = []
        self._notes: dict[str, None] = {}

    def differs(self, op: str, retail: Outcome, given: Outcome, where: str = "") -> bool:
        """Take an answer; tell whether it is another than retail's, on its bits.

        Parameters
        ----------
        op : str
            What was asked.
        retail, given : Outcome
            Both answers. One that the candidate skips, or fails to give, is not another answer; it is told
            apart.
        where : str
            Of the sweep.
        """
        place = f"{self._sweep.family}, {self._sweep.name}{where}"
        if isinstance(given, Skipped) and not isinstance(retail, Skipped):
            self.skipped += 1
            self._notes[f"{self._sweep.family}: skipped by {self._candidate}: {given.reason}"] = None
            return False
        self.asked += 1
        if isinstance(given, Errored) and isinstance(retail, Result):
            self._errors.append(f"{place}: {op}: {self._candidate} has no answer: {given.context}")
            return False
        told = difference(retail, given, op, self._candidate)
        if told is not None:
            self._differences.append(f"{place}: {told}")
        return told is not None

    def tell(self, found: Findings) -> None:
        """Add what was seen to what else was found."""
        found.differences += self._differences
        found.errors += self._errors
        found.notes += self._notes


def difference(retail: Outcome, given: Outcome, op: str, candidate: str) -> str | None:
    """Say how an answer of the candidate differs from retail's, on its bits; None where it does not."""
    if isinstance(retail, Result) and isinstance(given, Result):
        found = differences(retail.fields, given.fields, op=op, zero_signs="distinct")
        return summary_line(found[0], candidate) if found else None
    if isinstance(retail, Result) or isinstance(given, Result) or type(retail) is not type(given):
        return f"{op}: retail says {_told(retail)}, {candidate} says {_told(given)}"
    return None


def _told(outcome: Outcome) -> str:
    return "an answer" if isinstance(outcome, Result) else repr(outcome)
