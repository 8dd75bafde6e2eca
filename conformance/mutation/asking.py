"""What a mutant is asked: every built-in case as it is written, then random poses, the same in every run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from conformance.bug_hunt import FAMILIES, draw_queries
from conformance.commands.options import UsageError
from conformance.loader import Vary, load_paths

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.query import Query

POSES: Final[Mapping[str, int]] = {
    "collision calls": 130,
    "transitions": 130,
    "single calls": 120,
    "rare encounters": 100,
    "objects": 20,
}
"""Random poses of each family of queries."""


@dataclass(frozen=True, slots=True)
class Question:
    """Something that every mutant may be asked.

    Attributes
    ----------
    query : Query
        What is asked.
    name : str
        The case's id, or the family and the number of the draw.
    pose : bool
        Whether it is a random pose, not a case.
    """

    query: Query
    name: str
    pose: bool


def questions() -> list[Question]:
    """Gather what is asked.

    Raises
    ------
    UsageError
        A built-in case is wrong.
    """
    loaded = load_paths(vary=Vary(poses=0))
    if loaded.problems:
        raise UsageError(f"{len(loaded.problems)} built-in cases are wrong: see `conformance lint`")
    asked = [Question(case.queries[0], case.id, pose=False) for case in loaded.cases]
    for family, count in POSES.items():
        asked += _drawn(family, count)
    return asked


def _drawn(family: str, count: int) -> list[Question]:
    drawn: list[Question] = []

    def take(query: Query, draw: int) -> None:
        drawn.append(Question(query, f"{family} {draw}", pose=True))

    draw_queries(FAMILIES[family], count, take)
    return drawn
