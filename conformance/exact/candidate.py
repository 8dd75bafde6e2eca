"""The exact candidate: the oracle's own functions without any rounding, every decision certified."""

from __future__ import annotations

import math
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from flint import ctx

from conformance.candidates.model_candidate import NumberScope
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.output_rounding import rounded_outputs
from conformance.candidates.table import describe
from conformance.exact.ball import Ball
from conformance.exact.ties import SHOWN_DIGITS, UndecidedError, counting_ties
from conformance.floats import to_float32
from conformance.query import Errored, Result, Skipped

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from conformance.query import Fields, Outcome, Query

LADDER: Final = (128, 256, 512, 1024)
"""Working precisions, bits; a query goes up until everything is decided.

Many queries have a tie, which is found from 128 bits on, so beginning with less would cost more."""
OUTPUT_BITS: Final = 60
"""Bits to which every number that is told is certain: more than the double it is told as."""
UNDECIDED: Final = "undecided"
"""What the reason of a query begins with that the highest precision does not decide."""


@dataclass(frozen=True, slots=True)
class ExactAnswer:
    """What the exact model makes of a query.

    Attributes
    ----------
    outcome : Outcome
        Its numbers are the doubles nearest to the exact ones. `Skipped` with a reason that begins with
        `UNDECIDED` if a comparison, or a number that is told, stayed open at the highest precision.
    precision : int
        Working precision of the last run, bits.
    runs : int
        How often the query was run.
    ties : int
        Comparisons of the last run whose sides were found equal (`conformance.exact.residues`).
    """

    outcome: Outcome
    precision: int
    runs: int
    ties: int


class ExactCandidate(OracleCandidate):
    """Answers with the exact model.

    Stores and registers are exact, constants and inputs are retail's float32 values (times of the clock are
    doubles and stay so: they are never told as anything else). It performs every operation of the oracle;
    signs of zero mean nothing in its answers.

    Parameters
    ----------
    ladder : sequence of int
        Working precisions in bits, growing.
    """

    name = "exact"

    def __init__(self, ladder: Sequence[int] = LADDER) -> None:
        self._scopes = {precision: NumberScope(Ball) for precision in ladder}

    def answer(self, query: Query) -> Outcome:
        """Perform one operation; numbers are rounded once to the format that its outputs have."""
        return self._perform(query, partial(_rounded, query.op)).outcome

    def unrounded(self, query: Query) -> Outcome:
        """Perform one operation; numbers are the doubles nearest to the exact ones."""
        return self.perform(query).outcome

    def perform(self, query: Query) -> ExactAnswer:
        """Perform one operation, with more precision until everything is decided."""
        return self._perform(query, _told)

    def _perform(self, query: Query, tell: Callable[[Fields], Fields]) -> ExactAnswer:
        outcome: Outcome = Skipped(f"{UNDECIDED}: no working precision")
        precision = runs = ties = 0
        for precision, scope in self._scopes.items():
            runs += 1
            with _working_at(precision), scope.active(), counting_ties() as counted:
                decided, outcome = self._decided(query, tell)
            ties = counted.count
            if decided:
                break
        return ExactAnswer(outcome, precision, runs, ties)

    def _decided(self, query: Query, tell: Callable[[Fields], Fields]) -> tuple[bool, Outcome]:
        operation = self.operations.get(query.op)
        if operation is None:
            return True, Skipped(f"{self.missing}: operation {query.op}")
        try:
            return True, Result(tell(operation(query)))
        except UndecidedError as error:
            return False, Skipped(f"{UNDECIDED}: {error}")
        except self.unable as error:
            return True, Skipped(self.reason(error))
        except Exception as error:  # noqa: BLE001 - a candidate records its failures, the run goes on
            return True, Errored(describe(error))


@contextmanager
def _working_at(precision: int) -> Iterator[None]:
    """Compute with so many bits inside the block."""
    before = ctx.prec
    ctx.prec = precision
    try:
        yield
    finally:
        ctx.prec = before


def _told(value: Any) -> Any:
    """Return an answer in Python floats."""
    if isinstance(value, Ball):
        return _certain(value)
    if isinstance(value, dict):
        return {name: _told(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [_told(each) for each in value]
    return value


def _certain(value: Ball) -> float:
    """Return the nearest double of a number that is known well enough; raises `UndecidedError` otherwise.

    A number close to zero need not have all its bits: the same accuracy relative to one is enough. What may
    be zero, then, is told as zero.
    """
    number = value.arb
    if number.is_finite() and not number.is_exact():
        slack = abs(number.mid()) + 1
        if not number.rad() * 2**OUTPUT_BITS <= slack:
            raise UndecidedError(f"{number.str(SHOWN_DIGITS)} is told, at {ctx.prec} bits")
        if number.contains(0):
            return 0.0
    return float(number)


def _rounded(op: str, fields: Fields) -> Fields:
    """Return an answer as records have it: float32 where they have one, Python floats elsewhere."""
    rounded: Fields = _told(rounded_outputs(op, fields, (float, Ball), _single))
    return rounded


def _single(value: Ball | float) -> float:
    """Return the nearest float32 of a number; raises `UndecidedError` if it is not known well enough.

    The nearest double may be in the middle between two, and the number beside it.
    """
    if not isinstance(value, Ball):
        return to_float32(value)
    near = _certain(value)
    low, high = (to_float32(math.nextafter(near, end)) for end in (-math.inf, math.inf))
    if low == high or near - low != high - near or value == near:
        return to_float32(near)
    return low if value < near else high
