"""Mutants that nothing could notice, each with the reason; an entry that is not true is a mistake."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from conformance.source import Fault, describe, nearest
from conformance.yaml_source import YamlError, read_document

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

    from conformance.mutation.mutant import Mutant
    from conformance.mutation.trial import Finding
    from conformance.source import DocPath
    from conformance.yaml_source import Document

EQUIVALENTS: Final = Path(__file__).parent / "equivalents.yaml"
"""The list that ships with the package."""
_TEXTS: Final = ("operator", "statement", "before", "after")
_KEYS: Final = (*_TEXTS, "nth")


class EquivalentsError(Exception):
    """The list cannot be read; says where, and what is wrong."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One or several mutants of a function that change nothing.

    Attributes
    ----------
    function : str
        Module and function: ``polygon.Polygon.make_plane``.
    wanted : Mapping of str to (str or int)
        What the mutants have: ``operator``, ``statement``, ``before``, ``after``, ``nth``; those that are
        named.
    reason : str
        Why nothing could notice them.
    where : str
        Place of the entry in its file.
    """

    function: str
    wanted: Mapping[str, str | int]
    reason: str
    where: str

    def covers(self, mutant: Mutant) -> bool:
        """Tell whether it speaks of a mutant."""
        given = {
            "operator": mutant.operator.label,
            "statement": mutant.statement,
            "before": mutant.before,
            "after": mutant.after,
            "nth": mutant.nth,
        }
        return mutant.site == self.function and all(given[key] == value for key, value in self.wanted.items())


def read_equivalents(path: Path = EQUIVALENTS) -> tuple[Entry, ...]:
    """Read a list: under each function groups of ``mutants`` with a ``reason``.

    Raises
    ------
    EquivalentsError
        It is not such a list.
    """
    try:
        document = read_document(path, path.name)
    except YamlError as error:
        raise EquivalentsError(str(error.problem)) from error
    entries: list[Entry] = []
    for at, function, group in _groups(document):
        reason = _checked(document, (*at, "reason"), group.get("reason"), str, "why nothing notices them")
        mutants = _checked(document, (*at, "mutants"), group.get("mutants"), list, "a list of mutants")
        for index, wanted in enumerate(mutants):
            place = (*at, "mutants", index)
            _check_wanted(document, place, wanted)
            entries.append(Entry(function, wanted, reason, str(document.locate(place))))
    return tuple(entries)


def explained(entries: Sequence[Entry], mutant: Mutant) -> Entry | None:
    """Return the entry that speaks of a mutant, if there is one."""
    return next((entry for entry in entries if entry.covers(mutant)), None)


def wrong_entries(
    entries: Sequence[Entry], mutants: Collection[Mutant], findings: Sequence[Finding]
) -> Iterator[str]:
    """Say of each entry that is not true why: it speaks of no mutant, or of one that is noticed.

    Parameters
    ----------
    entries : sequence of Entry
        The list.
    mutants : collection of Mutant
        All that there are.
    findings : sequence of Finding
        Of those that were judged.
    """
    for entry in entries:
        if not any(entry.covers(mutant) for mutant in mutants):
            yield f"{entry.where}: {entry.function} has no such mutant: {_shown(entry)}"
        for finding in findings:
            if finding.killed and entry.covers(finding.mutant):
                yield f"{entry.where}: {finding.by} notices {finding.mutant}"


def _groups(document: Document) -> Iterator[tuple[DocPath, str, dict[str, Any]]]:
    functions = _checked(document, (), document.data, dict, "functions, and groups of mutants under each")
    for function, groups in functions.items():
        listed = _checked(document, (function,), groups, list, "a list of groups of mutants")
        for index, group in enumerate(listed):
            at = (function, index)
            yield at, function, _checked(document, at, group, dict, "a reason, and mutants")


def _check_wanted(document: Document, at: DocPath, wanted: Any) -> None:
    keys = ", ".join(_KEYS)
    for key, value in _checked(document, at, wanted, dict, f"some of {keys}").items():
        if key not in _KEYS:
            found = f"the unknown key '{key}'"
            fault = Fault((*at, key), found, f"one of {keys}", nearest(key, _KEYS), key=True)
            raise EquivalentsError(str(document.problem(fault)))
        kind, expected = (str, "text") if key in _TEXTS else (int, "a number")
        _checked(document, (*at, key), value, kind, expected)


def _checked(document: Document, at: DocPath, value: Any, kind: type, expected: str) -> Any:
    if isinstance(value, kind) and value:
        return value
    raise EquivalentsError(str(document.problem(Fault(at, describe(value), expected))))


def _shown(entry: Entry) -> str:
    return ", ".join(f"{key} {value!r}" for key, value in entry.wanted.items())
