"""Mistakes that a validator reports in the words of the case format: found, expected, hint."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from pydantic_core import PydanticCustomError

if TYPE_CHECKING:
    from conformance.source import DocPath

MISTAKE: Final = "mistake"
"""Type of the pydantic error that carries a worded mistake."""


def mistake(found: str, expected: str, hint: str = "", *, at: DocPath = ()) -> PydanticCustomError:
    """Make an error to raise in a validator; `at` is the way from the validated value to the mistake."""
    context = {"found": found, "expected": expected, "hint": hint, "at": at}
    return PydanticCustomError(MISTAKE, "found {found}, expected {expected}", context)
