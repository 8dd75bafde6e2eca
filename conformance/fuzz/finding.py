"""What a target raises when input was accepted, or refused, in a way that it must not be."""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance.yaml_source import split_lines

if TYPE_CHECKING:
    from conformance.source import Problem


class FindingError(AssertionError):
    """Input that was read without an error, and is not what was read; or an error without a place."""


def require(condition: object, what: str) -> None:
    """Raise `FindingError` unless something holds; asserts may be switched off, this may not."""
    if not condition:
        raise FindingError(what)


def check_place(problem: Problem, text: bytes) -> None:
    """Check that a problem is told in full, and lies inside the file or just behind its end."""
    lines = split_lines(text.decode("utf-8", errors="replace"))
    place = problem.location
    require(problem.found and problem.expected, f"a problem without words: {problem!r}")
    require(1 <= place.line <= len(lines) + 1, f"line {place.line} of {len(lines)}: {problem.summary}")
    line = lines[place.line - 1] if place.line <= len(lines) else ""
    require(1 <= place.column <= len(line) + 1, f"column {place.column} of {len(line)}: {problem.summary}")
    require(str(problem), "a problem that cannot be printed")
