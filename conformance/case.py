"""A case, ready to be asked, and what files of cases hold."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from conformance.report.scene import scene_line

if TYPE_CHECKING:
    from conformance.pins import Pin
    from conformance.query import Query
    from conformance.source import Location, Problem


@dataclass(frozen=True, slots=True)
class Vary:
    """How many random poses to run each scene case in, and from which seed; None: as the case says."""

    poses: int | None = None
    seed: int | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """One case, ready to be asked.

    Attributes
    ----------
    id : str
        For life, unique over all files.
    title, why : str
        What it shows, and what goes wrong in an engine that differs.
    retail : tuple of str
        The functions and steps of the specification that decide it.
    tags : tuple of str
        Topics.
    location : Location
        Where it begins.
    queries : tuple of Query
        The case as written, then the same moved to random poses. Labels are the id and the variant.
    expect : tuple of Pin
        Outputs of the first query that are known.
    source : str
        Its own lines of the file.
    first_line : int
        Number of the first of them.
    """

    id: str
    title: str
    why: str
    retail: tuple[str, ...]
    tags: tuple[str, ...]
    location: Location
    queries: tuple[Query, ...]
    expect: tuple[Pin, ...]
    source: str
    first_line: int

    @property
    def op(self) -> str:
        """The operation it asks for."""
        return self.queries[0].op

    @property
    def scene_line(self) -> str:
        """The scene and query in a line."""
        return scene_line(self.queries[0])


@dataclass(frozen=True, slots=True)
class Loaded:
    """What files hold: the cases that can be run and the problems of the others, both in file order."""

    cases: tuple[Case, ...] = ()
    problems: tuple[Problem, ...] = ()
