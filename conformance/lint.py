"""Looking over case files without running them: every mistake, and what would be one day."""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance.loader import load_paths
from conformance.source import Problem

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from conformance.loader import Case

LONGEST_TITLE = 110
"""Characters; a longer title does not fit a report's line."""


def lint(paths: Sequence[Path] = ()) -> list[Problem]:
    """Find everything that is wrong with case files.

    Parameters
    ----------
    paths : sequence of Path
        Files, or folders to search; without any, the cases of the package.

    Returns
    -------
    list of Problem
        Mistakes that keep a case from running, then those of style, each in file order.

    Raises
    ------
    NoCasesError
        A path is not there or holds no case file.
    """
    loaded = load_paths(paths)
    style = [problem for case in loaded.cases for problem in style_problems(case)]
    return [*loaded.problems, *style]


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
    line = case.source.splitlines()[case.location.line - case.first_line]
    return Problem(case.location, path, found, expected, hint, line, case.id)
