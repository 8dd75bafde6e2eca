"""Kinds of failure: a mistake shows in thousands of random queries, and is told once."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final, NamedTuple

from conformance.fields import MISSING
from conformance.shapes import Kind

if TYPE_CHECKING:
    from conformance.compare import Difference

FEW_ULPS: Final = 4
"""Up to here a float has been rounded in another way; beyond, it is another number."""
NO_ANSWER: Final = "no answer"
_NUMBER: Final = re.compile(r"\b(?:0[xX][0-9a-fA-F]+|\d+)\b")
_WORD_OF_NUMBERS: Final = re.compile(r"\w*\d\w*")
"""An address or an id, in whatever way an engine writes it."""
_ANY_NUMBER: Final = "#"
_LONGEST: Final = 160
"""Characters of what a candidate says about an error that count."""


class FailureKind(NamedTuple):
    """What failures have in common that are told once.

    Attributes
    ----------
    op : str
        The operation that was asked.
    field : str
        The first output that differs, as reports call it, any index of a list alike; or `NO_ANSWER`.
    cause : str
        In what way.
    """

    op: str
    field: str
    cause: str

    def __str__(self) -> str:
        return f"{self.op}: {self.field}: {self.cause}"


def kind_of_difference(op: str, first: Difference) -> FailureKind:
    """Return the kind of a wrong answer, by its first difference."""
    return FailureKind(op, _without_numbers(first.name), _cause(first))


def kind_of_error(op: str, who: str, context: str) -> FailureKind:
    """Return the kind of a missing answer, by who failed to give it and what was said about it."""
    said = _WORD_OF_NUMBERS.sub(_ANY_NUMBER, context)
    return FailureKind(op, NO_ANSWER, f"{who} failed: {said}"[:_LONGEST])


def _cause(first: Difference) -> str:
    if first.retail is MISSING or first.candidate is MISSING:
        return "a field too many" if first.retail is MISSING else "a field is missing"
    if first.retail is None or first.candidate is None:
        return "none in retail" if first.retail is None else "none in the candidate"
    if first.note:
        return _without_numbers(first.note)
    if first.kind is Kind.STATE:
        return f"{first.retail} in retail, {first.candidate} in the candidate"
    ulps = first.ulps
    return "rounded differently" if ulps is not None and ulps <= FEW_ULPS else "another value"


def _without_numbers(text: str) -> str:
    return _NUMBER.sub(_ANY_NUMBER, text)
