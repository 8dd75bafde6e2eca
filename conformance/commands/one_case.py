"""What commands about one case share: which case, in which pose, and how its query ended."""

from __future__ import annotations

import argparse
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError

if TYPE_CHECKING:
    from collections.abc import Collection

    from conformance.case import Case, Loaded, Vary
    from conformance.query import Outcome, Query

_SEPARATOR: Final = "::"


def add_case(parser: argparse.ArgumentParser) -> None:
    """Add the argument that names the case, for `find_case`."""
    parser.add_argument("case", metavar="CASE-ID|FILE::ID", help="a built-in case, or a case of a file")


def add_pose(parser: argparse.ArgumentParser) -> None:
    """Add the option ``--pose``, for `query_of`."""
    parser.add_argument(
        "--pose",
        type=pose_number,
        default=0,
        metavar="N",
        help="the case in its Nth random pose (default: 0, as written)",
    )


def pose_number(text: str) -> int:
    """Read the number of a pose."""
    number = int(text)
    if number < 0:
        raise argparse.ArgumentTypeError(f"{number} is not the number of a pose")
    return number


def find_case(text: str, vary: Vary | None = None) -> Case:
    """Return the case ``CASE-ID`` or ``FILE::ID``; raises `UsageError` if there is none."""
    from conformance.loader import AS_WRITTEN, NoCasesError, load_mentioning, load_paths

    file, _, case_id = text.rpartition(_SEPARATOR)
    vary = vary or AS_WRITTEN
    try:
        found = None if file else _named(case_id, load_mentioning(case_id, vary))
        if found is not None:
            return found
        loaded = load_paths([Path(file)] if file else (), vary)
    except (NoCasesError, OSError) as error:
        raise UsageError(str(error)) from error
    found = _named(case_id, loaded)
    if found is None:
        raise _no_case(case_id, f"in {file}" if file else "among the built-in cases", loaded)
    return found


def _named(case_id: str, loaded: Loaded) -> Case | None:
    return next((case for case in loaded.cases if case.id == case_id), None)


def _no_case(case_id: str, where: str, loaded: Loaded) -> UsageError:
    wrong = f" {len(loaded.problems)} mistakes keep cases from loading, see `conformance lint`."
    hint = _hint(case_id, [case.id for case in loaded.cases])
    return UsageError(f"no case {case_id!r} {where}.{hint}{wrong if loaded.problems else ''}")


def query_of(case: Case, pose: int) -> Query:
    """Return a case in one of its poses; raises `UsageError` if it has fewer."""
    if pose >= len(case.queries):
        raise UsageError(f"{case.id} has {len(case.queries) - 1} random poses, there is no pose {pose}")
    return case.queries[pose]


def _hint(name: str, known: Collection[str]) -> str:
    nearest = get_close_matches(name, list(known), n=1)
    return f" Did you mean {nearest[0]!r}?" if nearest else ""


def ending(outcome: Outcome) -> tuple[str, int]:
    """Return the line that tells how a query ended, and the exit code."""
    from conformance.query import Errored, Skipped

    if isinstance(outcome, Errored):
        return f"failed: {outcome.context}", exit_codes.FAILURES
    if isinstance(outcome, Skipped):
        return f"skipped: {outcome.reason}", exit_codes.NOTHING_RAN
    result = outcome.fields.get("result")
    return "answered" if result is None else f"result: {result}", exit_codes.OK
