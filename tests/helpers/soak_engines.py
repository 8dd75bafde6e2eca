"""Engines for tests of campaigns, as ``mod:`` candidates: retail, and wrong in one way."""

from __future__ import annotations

import os
from pathlib import Path

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.query import Errored, Query, Result, Skipped
from oracle.arithmetic import f32

WRONG, FAILING, MISSING = "position_", "landdefs_", "bsp_"
"""Beginnings of the operations that `Faulty` answers wrongly, fails at, and leaves out."""
MARK = Path("died-once")
"""What `Mortal` leaves behind, in the current folder."""


class Right:
    """Answers as retail does."""

    def __init__(self) -> None:
        self._oracle = OracleCandidate()

    def answer(self, query: Query) -> object:
        """Answer a query."""
        return self._oracle.answer(query)


class Faulty(Right):
    """Is wrong in one operation, fails in a second, leaves out a third."""

    def answer(self, query: Query) -> object:
        """Answer a query."""
        if query.op.startswith(FAILING):
            return Errored("out of blocks")
        if query.op.startswith(MISSING):
            return Skipped("no trees")
        outcome = super().answer(query)
        return shifted(outcome) if query.op.startswith(WRONG) else outcome


class Forgetful(Right):
    """Is wrong once it has been asked something else."""

    def __init__(self) -> None:
        super().__init__()
        self._asked: set[str] = set()

    def answer(self, query: Query) -> object:
        """Answer a query."""
        self._asked.add(query.op)
        outcome = super().answer(query)
        return shifted(outcome) if query.op.startswith(WRONG) and len(self._asked) > 1 else outcome


class Silent(Right):
    """Answers nothing."""

    def answer(self, query: Query) -> object:
        """Fail to answer a query."""
        return Errored("out of order")


class Idle(Right):
    """Does nothing."""

    ops = ()


class Mortal(Right):
    """Ends its process with the first query, once in a folder."""

    def answer(self, query: Query) -> object:
        """Answer a query, or die."""
        if not MARK.exists():
            MARK.touch()
            os._exit(9)
        return super().answer(query)


def shifted(outcome: object) -> object:
    """Return retail's point, a metre to the east."""
    if not isinstance(outcome, Result):
        return outcome
    x, y, z = outcome.fields["v"]
    return Result({"v": [f32(x + 1.0), y, z]})
