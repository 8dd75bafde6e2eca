"""The writes that led to a wrong answer: retail's and the candidate's, where they begin to differ."""

from __future__ import annotations

from itertools import takewhile
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

MOST_COMMON: Final = 6
"""Lines shown of those that both wrote before they differ."""
MOST_EACH: Final = 8
"""Lines shown of each from where they differ."""
MOST_ALONE: Final = 20
"""Lines shown where there is nothing to compare."""
_MARK: Final = "> "


def compared_writes(retail: Sequence[str], candidate: Sequence[str], who: str) -> Iterator[str]:
    """Write the last lines that both have in common, and how either goes on; the first of these are marked.

    Parameters
    ----------
    retail, candidate : sequences of str
        The lines of both.
    who : str
        What the candidate is called.
    """
    pairs = zip(retail, candidate, strict=False)
    common = [line for line, _ in takewhile(lambda pair: pair[0] == pair[1], pairs)]
    if len(common) > MOST_COMMON:
        yield f"    ... {_counted(len(common) - MOST_COMMON)} of both"
    yield from (f"    {line}" for line in common[-MOST_COMMON:])
    rest = {"retail": retail[len(common) :], who: candidate[len(common) :]}
    if not any(rest.values()):
        yield "    both write the same"
        return
    for name, lines in rest.items():
        yield f"  {_MARK}{name}: {lines[0] if lines else 'nothing more'}"
        yield from _first(lines[1:], MOST_EACH - 1)


def lone_writes(lines: Sequence[str]) -> Iterator[str]:
    """Write the first lines of one that has no other to be compared with."""
    yield from _first(lines, MOST_ALONE)


def _first(lines: Sequence[str], most: int) -> Iterator[str]:
    yield from (f"    {line}" for line in lines[:most])
    if len(lines) > most:
        yield f"    ... {_counted(len(lines) - most)} more"


def _counted(count: int) -> str:
    return f"{count} line" if count == 1 else f"{count} lines"
