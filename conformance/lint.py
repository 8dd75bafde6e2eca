"""Looking over case files without running them: every mistake, and what would be one day."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from conformance.deviations.files import FOLDER, DeviationError, problems_among, read_deviations
from conformance.loader import load_paths
from conformance.source import Location, Problem
from conformance.yaml_source import YamlError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from conformance.loader import Case

LONGEST_TITLE = 110
"""Characters; a longer title does not fit a report's line."""


def lint(paths: Sequence[Path] = (), *, deviations: Sequence[Path] = ()) -> list[Problem]:
    """Find everything that is wrong with case files, and with deviation files beside them.

    Parameters
    ----------
    paths : sequence of Path
        Files, or folders to search; without any, the cases of the package.
    deviations : sequence of Path
        Deviation files, whose entries must be about some of the cases, but not about many.

    Returns
    -------
    list of Problem
        Mistakes that keep a case from running, those of style, those of deviations, each in file order.

    Raises
    ------
    NoCasesError
        A path is not there or holds no case file.
    OSError
        A deviation file cannot be read at all.
    """
    loaded = load_paths(paths)
    style = [problem for case in loaded.cases for problem in style_problems(case)]
    ids = [case.id for case in loaded.cases]
    recorded = [problem for path in deviations for problem in deviation_problems(path, ids)]
    return [*loaded.problems, *style, *recorded]


def own_deviations() -> list[Path]:
    """List the deviation files that come with the suite."""
    return sorted(FOLDER.glob("*.yaml"))


def deviation_problems(path: Path, case_ids: Sequence[str]) -> list[Problem]:
    """Find everything that is wrong with a deviation file, given the ids of all cases."""
    try:
        return list(problems_among(read_deviations(path), case_ids))
    except DeviationError as error:
        return error.problems
    except YamlError as error:
        return [error.problem]


def style_problems(case: Case) -> Iterator[Problem]:
    """Yield what a reader of a case would stumble over."""
    if len(case.title) > LONGEST_TITLE:
        found = f"a title of {len(case.title)} characters"
        yield _problem(case, "title", found, f"at most {LONGEST_TITLE}", "say the rest in `why`")
    if case.title.endswith("."):
        yield _problem(case, "title", "a full stop at the end", "a title without one")
    if not case.tags:
        yield _problem(case, "tags", "no tags", "at least one topic to select the case by")
    if case.why == case.title:
        yield _problem(case, "why", "the title again", "what goes wrong in an engine that differs")


def _problem(case: Case, path: str, found: str, expected: str, hint: str = "") -> Problem:
    location = _place_of(case, path)
    line = case.source.splitlines()[location.line - case.first_line]
    return Problem(location, path, found, expected, hint, line, case.id)


def _place_of(case: Case, key: str) -> Location:
    """Return where a key of a case stands, or the case where it has none, or has it beside others."""
    for number, line in enumerate(case.source.splitlines(), start=case.first_line):
        if found := re.match(rf"[\s-]*(?={key}\s*:)", line):
            return Location(case.location.file, number, found.end() + 1)
    return case.location
