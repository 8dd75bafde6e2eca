"""Files of cases: finding them, reading them, keeping ids unique.

A mistake in one case does not lose the others; what cannot be read is a `Problem` with its place.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from conformance.case import Case, Loaded, Vary
from conformance.case_folders import yaml_files
from conformance.case_maker import load_case
from conformance.installed import meant
from conformance.source import Fault, Location, Problem, describe
from conformance.yaml_source import Document, YamlError, read_document

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from conformance.source import DocPath

__all__ = [
    "BUILT_IN_CASES",
    "Case",
    "Loaded",
    "NoCasesError",
    "Vary",
    "case_files",
    "duplicate_id",
    "load_document",
    "load_file",
    "load_mentioning",
    "load_paths",
]

BUILT_IN_CASES: Final = Path(__file__).parent / "cases"
"""Folder of the cases that ship with the package."""
AS_WRITTEN: Final = Vary()
"""Every case with its own `vary`."""


class NoCasesError(Exception):
    """A path that was asked for holds no case."""


def load_paths(paths: Sequence[Path] = (), vary: Vary = AS_WRITTEN) -> Loaded:
    """Load every case of files and folders, in a fixed order.

    Parameters
    ----------
    paths : sequence of Path
        Files, or folders to search; without any, the cases of the package.
    vary : Vary
        Overrides of the cases' own `vary`.

    Raises
    ------
    NoCasesError
        A path is not there, holds no case file, or its files hold neither a case nor a problem.
    """
    loaded: dict[Path, Loaded] = {}
    for path in paths or (BUILT_IN_CASES,):
        files = _by_place(path)
        loaded |= {place: load_file(file, vary) for place, file in files.items() if place not in loaded}
        if not any(loaded[place].cases or loaded[place].problems for place in files):
            raise NoCasesError(f"no case in {path}")
    cases = [case for one in loaded.values() for case in one.cases]
    duplicates, kept = split_duplicates(cases)
    problems = [problem for one in loaded.values() for problem in one.problems]
    return Loaded(tuple(kept), (*problems, *duplicates))


def load_mentioning(word: str, vary: Vary = AS_WRITTEN) -> Loaded:
    """Load only those of the package's files that a word stands in; a case stands where its id does.

    To read all of them takes seconds, of which a command about one case needs a few hundredths.
    """
    said = word.encode("utf-8")
    files = [file for file in case_files(BUILT_IN_CASES) if said in file.read_bytes()]
    return load_paths(files, vary) if files else Loaded()


def case_files(path: Path) -> list[Path]:
    """List the case files at or below a path, sorted; raises `NoCasesError` if there are none.

    Folders below it that pytest does not enter are left out by everybody: hidden ones, what builds leave
    behind, and virtual environments. A file that links lead to as well is listed once, where it comes first.
    """
    return list(_by_place(path).values())


def _by_place(path: Path) -> dict[Path, Path]:
    """Return what `case_files` lists, by where links lead to."""
    places: dict[Path, Path] = {}
    for one in meant(path):
        for place, file in _by_place_in(one).items():
            places.setdefault(place, file)
    return places


def _by_place_in(path: Path) -> dict[Path, Path]:
    if path.is_file():
        return {path.resolve(): path}
    if not path.is_dir():
        raise NoCasesError(f"{path} does not exist")
    files = yaml_files(path)
    if not files:
        raise NoCasesError(f"no *.yaml file in {path}")
    places: dict[Path, Path] = {}
    for file in files:
        places.setdefault(file.resolve(), file)
    return places


def load_file(path: Path, vary: Vary = AS_WRITTEN) -> Loaded:
    """Load the cases of one file.

    Raises
    ------
    OSError
        The file cannot be read at all.
    """
    try:
        document = read_document(path, _shown(path))
    except YamlError as error:
        return Loaded(problems=(error.problem,))
    return load_document(document, vary)


def load_document(document: Document, vary: Vary = AS_WRITTEN) -> Loaded:
    """Load the cases of a document that was read."""
    cases: list[Case] = []
    problems: list[Problem] = []
    below_cases = list(_case_data(document, problems))
    problems += [
        problem
        for path, problem in document.refusals
        if not any(path[: len(below)] == below for below, _ in below_cases)
    ]
    for below, data in below_cases:
        case, found = load_case(document, below, data, vary)
        problems += found
        cases += [case] if case else []
    duplicates, kept = split_duplicates(cases)
    ordered = sorted((*problems, *duplicates), key=lambda problem: problem.location)
    return Loaded(tuple(kept), tuple(ordered))


def _shown(path: Path) -> str:
    """Return how messages call a file: from the working directory, if it is below that."""
    whole, here = path.resolve(), Path.cwd()
    return str(whole.relative_to(here)) if whole.is_relative_to(here) else str(path)


def split_duplicates(cases: Iterable[Case]) -> tuple[list[Problem], list[Case]]:
    """Separate the cases whose id another case has taken before."""
    first: dict[str, Case] = {}
    problems = [
        duplicate_id(case, other.location)
        for case in cases
        if (other := first.setdefault(case.id, case)) is not case
    ]
    return problems, list(first.values())


def duplicate_id(case: Case, first: Location) -> Problem:
    """Tell that a case's id is taken by the case at `first`."""
    found = f"the id {case.id!r} again (first at {first})"
    line = case.source.splitlines()[case.location.line - case.first_line]
    return Problem(case.location, "id", found, "an id of its own", "", line, case.id)


def _case_data(document: Document, problems: list[Problem]) -> Iterator[tuple[DocPath, Any]]:
    """Yield the cases of a document: the whole of it, or the items of its ``cases``."""
    data = document.data
    if not isinstance(data, dict):
        problems.append(document.problem(Fault((), describe(data), "a case, or 'cases' with a list of them")))
    elif "cases" not in data:
        yield (), data
    elif not isinstance(data["cases"], list) or not data["cases"]:
        fault = Fault(("cases",), describe(data["cases"]), "a list of at least one case")
        problems.append(document.problem(fault))
    else:
        others = [key for key in data if key != "cases"]
        problems += [
            document.problem(Fault((key,), f"the key '{key}'", "only 'cases'", key=True)) for key in others
        ]
        yield from ((("cases", index), item) for index, item in enumerate(data["cases"]))
