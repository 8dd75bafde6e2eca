"""Deviation files: finding them by an engine's name, and reading them with every mistake told."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance.deviations.entries import DeviationFile
from conformance.source import Fault
from conformance.yaml_model import read_model

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from conformance.deviations.entries import Deviation
    from conformance.source import Location, Problem
    from conformance.yaml_source import Document

FOLDER: Final = Path(__file__).parent
"""Deviations that come with the suite, each file named after its engine."""
MOST_CASES: Final = 12
"""Cases that one pattern may be about; beyond that it excuses more than anybody has looked at."""


class DeviationError(Exception):
    """A deviation file that cannot be used; `problems` say where and why."""

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__("\n".join(str(problem) for problem in problems))
        self.problems = problems


@dataclass(frozen=True, slots=True)
class Entry:
    """A deviation and the place where it is written."""

    deviation: Deviation
    location: Location


@dataclass(frozen=True, slots=True)
class Deviations:
    """What one file records.

    Attributes
    ----------
    engine : str
        Whose deviations they are.
    entries : tuple of Entry
        In file order.
    document : Document or None
        The file, for problems that show its lines; None if there is no file.
    """

    engine: str
    entries: tuple[Entry, ...] = ()
    document: Document | None = None

    def about(self, case_id: str) -> tuple[Entry, ...]:
        """Return the entries about a case."""
        return tuple(entry for entry in self.entries if entry.deviation.about(case_id))

    def unmatched(self, case_ids: Collection[str]) -> tuple[Entry, ...]:
        """Return the entries that are about none of these cases."""
        return tuple(entry for entry in self.entries if not any(map(entry.deviation.about, case_ids)))


def path_of(name: str) -> Path | None:
    """Return the file that comes with the suite for an engine, if there is one."""
    path = FOLDER / f"{name}.yaml"
    return path if name.isidentifier() and path.is_file() else None


def find_deviations(name: str) -> Deviations:
    """Return what the suite records of an engine by its name; nothing if it has no file."""
    path = path_of(name)
    return Deviations(name) if path is None else read_deviations(path)


def read_deviations(path: Path) -> Deviations:
    """Read a deviation file.

    Raises
    ------
    DeviationError
        It is not one; with every mistake and its place.
    OSError
        It cannot be read at all.
    YamlError
        It is not YAML.
    """
    document, file, problems = read_model(path, DeviationFile)
    if file is None:
        raise DeviationError(problems)
    entries = (
        Entry(deviation, document.locate(("deviations", index)))
        for index, deviation in enumerate(file.deviations)
    )
    return Deviations(file.engine, tuple(entries), document)


def problems_among(deviations: Deviations, case_ids: Collection[str]) -> Iterator[Problem]:
    """Yield what is wrong with entries beside the cases that there are: unknown ids, coarse patterns.

    Parameters
    ----------
    deviations : Deviations
        As read from a file.
    case_ids : collection of str
        Every case.
    """
    document = deviations.document
    if document is None:
        return
    for index, entry in enumerate(deviations.entries):
        count = sum(map(entry.deviation.about, case_ids))
        path = ("deviations", index, "case")
        if not count:
            yield document.problem(
                Fault(path, f"{entry.deviation.case!r}, which is no case", "the id of a case")
            )
        elif count > MOST_CASES:
            found = f"the coarse pattern {entry.deviation.case!r}, about {count} cases"
            yield document.problem(Fault(path, found, f"at most {MOST_CASES}", "name the cases"))
        elif entry.deviation.is_pattern and count == 1:
            found = f"the pattern {entry.deviation.case!r}, about one case"
            yield document.problem(Fault(path, found, "its id"))
