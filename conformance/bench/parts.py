"""Equal parts of the suite: each has its share of the long walks, which are most of a run's time."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.case import Case
    from conformance.query import Query


def spread(cases: Sequence[Case], count: int) -> list[list[Case]]:
    """Deal cases out like cards, the longest first and every other row from the other end.

    Of the retail's time that the suite takes, forty walks of a thousand take two thirds: parts that are cut
    without regard to them differ by a factor of ten.

    Parameters
    ----------
    cases : sequence of Case
    count : int
        How many parts; together they are all cases.
    """
    parts: list[list[Case]] = [[] for _ in range(count)]
    for place, case in enumerate(sorted(cases, key=_length, reverse=True)):
        row, column = divmod(place, count)
        parts[column if row % 2 == 0 else -1 - column].append(case)
    return parts


def _length(case: Case) -> int:
    """Return how many steps a case asks for: ticks of walks, one for any other query."""
    return sum(map(_steps, case.queries))


def _steps(query: Query) -> int:
    return max(1, len(query.inputs.get("ticks", ())))
