"""`conformance trace`: who writes planes, walkables, sliding normals and state while a case runs."""

from __future__ import annotations

import argparse
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError, add_candidate_option, candidate_from

if TYPE_CHECKING:
    from collections.abc import Collection

    from conformance.case import Case, Vary
    from conformance.query import Outcome, Query
    from conformance.traced import Traceable

HELP: Final = "run a case and show every write of contact planes, walkables, state and cells, and by whom"
EXAMPLES: Final = (
    "conformance trace origin-step-down-touching",
    "conformance trace walk-cellar-descent --candidate engine --trace cell-transit",
    "conformance trace origin-step-down-touching --candidate bug:cell-origin --trace cp-write,bsp",
    "conformance trace my-cases/ramp.yaml::my-first-ramp --pose 3",
)
_SEPARATOR: Final = "::"


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("case", metavar="CASE-ID|FILE::ID", help="a built-in case, or a case of a file")
    parser.add_argument(
        "--trace",
        metavar="TOPICS",
        help="comma-separated: cp-write, lkp-write, walkable, sliding, state, cell-transit, bsp "
        "(default: all)",
    )
    parser.add_argument(
        "--pose",
        type=pose_number,
        default=0,
        metavar="N",
        help="the case in its Nth random pose (default: 0, as written)",
    )
    parser.add_argument(
        "--foot", action="store_true", help="end each line with the mover's lowest point: foot=(x,y,z)"
    )
    add_candidate_option(parser, default="oracle")


def run(args: argparse.Namespace) -> int:
    """Print the writes and their summary, and return the exit code: 1 if the case fails to run."""
    from conformance.console import make_console
    from conformance.report.traces import summary_lines, trace_lines
    from conformance.traced import answer_traced

    topics = _topics(args.trace)
    candidate = _traceable(args)
    query = query_of(find_case(args.case), args.pose)
    outcome, written = answer_traced(candidate, query, topics)
    console = make_console()
    console.print(f"{query.label} ({query.op}, {candidate.name})")
    for line in (*trace_lines(written, with_foot=args.foot), "summary:", *summary_lines(written)):
        console.print(line)
    text, code = ending(outcome)
    console.print(text)
    return code


def pose_number(text: str) -> int:
    """Read the number of a pose."""
    number = int(text)
    if number < 0:
        raise argparse.ArgumentTypeError(f"{number} is not the number of a pose")
    return number


def _topics(text: str | None) -> tuple[str, ...]:
    from conformance.traced import TopicsError, parse_topics
    from oracle.writes import TOPICS

    try:
        return TOPICS if text is None else parse_topics(text)
    except TopicsError as error:
        raise UsageError(str(error)) from error


def _traceable(args: argparse.Namespace) -> Traceable:
    from conformance.traced import Traceable

    candidate = candidate_from(args)
    if not isinstance(candidate, Traceable):
        traceable = "oracle, engine and the known bugs (bug:NAME)"
        raise UsageError(f"{candidate.name} cannot be traced; {traceable} can")
    return candidate


def find_case(text: str, vary: Vary | None = None) -> Case:
    """Return the case ``CASE-ID`` or ``FILE::ID``; raises `UsageError` if there is none."""
    from conformance.loader import AS_WRITTEN, NoCasesError, load_paths

    file, _, case_id = text.rpartition(_SEPARATOR)
    try:
        loaded = load_paths([Path(file)] if file else (), vary or AS_WRITTEN)
    except (NoCasesError, OSError) as error:
        raise UsageError(str(error)) from error
    cases = {case.id: case for case in loaded.cases}
    if case_id not in cases:
        wrong = f" {len(loaded.problems)} mistakes keep cases from loading, see `conformance lint`."
        lint = wrong if loaded.problems else ""
        where = f"in {file}" if file else "among the built-in cases"
        raise UsageError(f"no case {case_id!r} {where}.{_hint(case_id, cases)}{lint}")
    return cases[case_id]


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
