"""Choosing cases by topic, retail function, operation and place, and counting what there is."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any, Final

from conformance.installed import installed
from conformance.loader import BUILT_IN_CASES
from conformance.source import nearest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from conformance.case import Case


@dataclass(frozen=True, slots=True)
class Filters:
    """What cases are asked for; a case has to meet every word of every kind.

    Attributes
    ----------
    tags : sequence of str
        Topics, each of which it has.
    functions : sequence of str
        Functions of retail, each of which it cites: ``CLASS::name``, or the name alone.
    ops : sequence of str
        Operations, one of which it asks; a case has only one.
    paths : sequence of str
        Patterns such as ``walks/*.yaml``, the name of a folder or file, or its path; its file meets one.
    """

    tags: Sequence[str] = ()
    functions: Sequence[str] = ()
    ops: Sequence[str] = ()
    paths: Sequence[str] = ()

    def accept(self, case: Case) -> bool:
        """Tell whether a case is asked for."""
        return (
            set(self.tags) <= set(case.tags)
            and all(any(_is_named(one, name) for one in functions_of(case)) for name in self.functions)
            and (not self.ops or case.op in self.ops)
            and (not self.paths or any(_is_at(case, pattern) for pattern in self.paths))
        )


def functions_of(case: Case) -> tuple[str, ...]:
    """Return the functions of retail that a case cites, without their steps, each once."""
    return tuple(dict.fromkeys(citation.partition(" ")[0] for citation in case.retail))


def place_of(case: Case) -> PurePosixPath:
    """Return a case's file: below the folder of the built-in cases, or as messages call it."""
    file = Path(case.location.file).resolve()
    built_in = BUILT_IN_CASES.resolve()
    if file.is_relative_to(built_in):
        return PurePosixPath(file.relative_to(built_in).as_posix())
    return PurePosixPath(Path(case.location.file).as_posix())


def _is_named(function: str, name: str) -> bool:
    return name in {function, function.rpartition("::")[2]}


def _is_at(case: Case, pattern: str) -> bool:
    place, path = place_of(case), Path(pattern)
    below = path.as_posix()  # of a backslash, too, where those separate folders
    if below in place.parts or place.match(below) or place.is_relative_to(below):
        return True
    return Path(case.location.file).resolve().is_relative_to(installed(path).resolve())


def _tags(case: Case) -> Iterable[str]:
    return case.tags


def _ops(case: Case) -> Iterable[str]:
    return (case.op,)


def _places(case: Case) -> Iterable[str]:
    return (str(place_of(case)),)


WORDS: Final[Mapping[str, Callable[[Case], Iterable[str]]]] = {
    "tag": _tags,
    "function": functions_of,
    "op": _ops,
    "file": _places,
}
"""What cases can be counted by: the words that a case has of each kind."""


def count(cases: Iterable[Case], kind: str) -> list[tuple[str, int]]:
    """Count cases by one of `WORDS`, the most frequent first, then by name."""
    counts = Counter(word for case in cases for word in WORDS[kind](case))
    return sorted(counts.items(), key=lambda item: (-item[1], item[0]))


def hints(cases: Sequence[Case], filters: Filters) -> list[str]:
    """Say of every word that no case at all has what comes nearest to it, or where to look."""
    asked = (("tag", filters.tags), ("function", filters.functions), ("op", filters.ops))
    told: list[str] = []
    for kind, names in asked:
        known = {word for case in cases for word in WORDS[kind](case)}
        short = {word.rpartition("::")[2] for word in known} if kind == "function" else set()
        for name in names:
            if name not in known | short:
                near = nearest(name, sorted(known | short))
                there_is = near or f"`conformance list --count {kind}` says what there is"
                told.append(f"no case has the {kind} {name!r}: {there_is}")
    return told


def as_record(case: Case) -> dict[str, Any]:
    """Return what `conformance list --json` tells of a case."""
    return {
        "id": case.id,
        "title": case.title,
        "file": Path(case.location.file).as_posix(),
        "line": case.location.line,
        "op": case.op,
        "tags": list(case.tags),
        "retail": list(case.retail),
        "pins": list(dict.fromkeys(pin.path for pin in case.expect)),
    }
