"""What commands about one case share: which case, in which pose, and how its query ended."""

from __future__ import annotations

from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse

    from conformance.case import Case, Loaded, Vary
    from conformance.query import Outcome, Query

_SEPARATOR: Final = "::"
_OTHERS: Final = " A case of another file is FILE::ID."


def add_case(parser: argparse.ArgumentParser) -> None:
    """Add the argument that names the case, for `find_case`."""
    parser.add_argument(
        "case",
        metavar="CASE-ID|FILE::ID",
        help="a built-in case, or a case of a file (of a file with one case, the file will do)",
    )


def add_pose(parser: argparse.ArgumentParser) -> None:
    """Add the option ``--pose``, for `query_of`."""
    parser.add_argument(
        "--pose",
        type=whole_from(0),
        default=0,
        metavar="N",
        help="the case in its Nth random pose (default: 0, as written)",
    )


def find_case(text: str, vary: Vary | None = None) -> Case:
    """Return the case ``CASE-ID`` or ``FILE::ID``, or the only one of a ``FILE``.

    Raises
    ------
    UsageError
        There is none, or the file alone does not say which.
    """
    from conformance.case_folders import CASE_SUFFIXES
    from conformance.loader import AS_WRITTEN, NoCasesError, load_mentioning, load_paths

    file, _, case_id = text.rpartition(_SEPARATOR)
    if not file and Path(text).suffix in CASE_SUFFIXES:
        file, case_id = text, ""
    vary = vary or AS_WRITTEN
    try:
        found = None if file else _named(case_id, load_mentioning(case_id, vary))
        if found is not None:
            return found
        loaded = load_paths([Path(file)] if file else (), vary)
    except (NoCasesError, OSError) as error:
        raise UsageError(str(error)) from error
    found = _named(case_id, loaded) if case_id else _only(file, loaded)
    if found is None:
        where, others = (f"in {file}", "") if file else ("among the built-in cases", _OTHERS)
        hints = f"{_hint(case_id, loaded)}{_mistakes(loaded)}{others}"
        raise UsageError(f"no case {case_id!r} {where}.{hints}")
    return found


def _named(case_id: str, loaded: Loaded) -> Case | None:
    return next((case for case in loaded.cases if case.id == case_id), None)


def _only(file: str, loaded: Loaded) -> Case:
    if len(loaded.cases) == 1:
        return loaded.cases[0]
    named = "".join(f"\n  {file}{_SEPARATOR}{case.id}" for case in loaded.cases)
    raise UsageError(f"{file} holds {len(loaded.cases)} cases, expected one.{_mistakes(loaded)}{named}")


def _hint(case_id: str, loaded: Loaded) -> str:
    nearest = get_close_matches(case_id, [case.id for case in loaded.cases], n=1)
    return f" Did you mean {nearest[0]!r}?" if nearest else ""


def _mistakes(loaded: Loaded) -> str:
    count = len(loaded.problems)
    return f" {count} mistakes keep cases from loading, see `conformance lint`." if count else ""


def query_of(case: Case, pose: int) -> Query:
    """Return a case in one of its poses; raises `UsageError` if it has fewer."""
    if pose >= len(case.queries):
        raise UsageError(f"{case.id} has {len(case.queries) - 1} random poses, there is no pose {pose}")
    return case.queries[pose]


def ending(outcome: Outcome) -> tuple[str, int]:
    """Return the line that tells how a query ended, and the exit code."""
    from conformance.query import Errored, Skipped

    if isinstance(outcome, Errored):
        return f"failed: {outcome.context}", exit_codes.FAILURES
    if isinstance(outcome, Skipped):
        return f"skipped: {outcome.reason}", exit_codes.NOTHING_RAN
    result = outcome.fields.get("result")
    return "answered" if result is None else f"result: {result}", exit_codes.OK
