"""Kinds of failure: alike enough to be told once."""

from __future__ import annotations

import pytest

from conformance.compare import Difference
from conformance.fields import MISSING
from conformance.shapes import Kind
from conformance.soak.kinds import NO_ANSWER, FailureKind, kind_of_difference, kind_of_error


@pytest.mark.parametrize(
    ("kind", "retail", "candidate", "note", "cause"),
    [
        (Kind.FLOAT32, 1.0, 1.0000001192092896, "", "rounded differently"),
        (Kind.FLOAT32, 1.0, 1.00000059604644775, "", "another value"),
        (Kind.FLOAT32, 1.0, -1.0, "", "another value"),
        (Kind.FLOAT32, 0.0, -0.0, "the sign of zero", "the sign of zero"),
        (Kind.FLOAT32, 1.0, 1.1, "not a float32", "not a float32"),
        (Kind.STATE, "OK", "SLID", "", "OK in retail, SLID in the candidate"),
        (Kind.COUNT, 3, 4, "", "another value"),
        (Kind.BLOCK, MISSING, 4, "no such output field", "a field too many"),
        (Kind.FLOAT32, 1.0, MISSING, "", "a field is missing"),
        (Kind.BLOCK, None, {}, "", "none in retail"),
        (Kind.BLOCK, {}, None, "", "none in the candidate"),
        (Kind.BLOCK, [1], [1, 2], "1 items, candidate 2", "# items, candidate #"),
    ],
)
def test_a_cause_is_how_it_differs(
    kind: Kind, retail: object, candidate: object, note: str, cause: str
) -> None:
    """Values that differ in the same way have the same cause."""
    first = Difference("ticks[12].x", "tick 12: x", kind, retail, candidate, note)
    assert kind_of_difference("walk", first) == FailureKind("walk", "tick #: x", cause)


def test_errors_are_alike_but_for_their_numbers() -> None:
    """Addresses and indices in what an engine says are no other error."""
    one = kind_of_error("walk", "cmd:./v2", "bad cell 0xA9B40151 at 7fe2")
    assert one == kind_of_error("walk", "cmd:./v2", "bad cell 0xA9B40152 at 12")
    assert one == FailureKind("walk", NO_ANSWER, "cmd:./v2 failed: bad cell # at #")
    assert len(kind_of_error("walk", "engine", "x" * 1000).cause) == 160


def test_a_kind_is_told_in_a_line() -> None:
    """Operation, output and cause."""
    assert str(FailureKind("walk", "x", "another value")) == "walk: x: another value"
