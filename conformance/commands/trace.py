"""`conformance trace`: who writes planes, walkables, sliding normals and state while a case runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.commands.one_case import add_case, add_pose, ending, find_case, query_of
from conformance.commands.options import UsageError, add_candidate_option, candidate_from

if TYPE_CHECKING:
    import argparse

    from conformance.traced import Traceable

HELP: Final = "run a case and show every write of contact planes, walkables, state and cells, and by whom"
EXAMPLES: Final = (
    "conformance trace origin-step-down-touching",
    "conformance trace walk-cellar-and-back --candidate engine --trace cell-transit",
    "conformance trace origin-step-down-touching --candidate bug:cell-origin --trace cp-write,bsp",
    "conformance trace my-cases/ramp.yaml::my-first-ramp --pose 3",
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_case(parser)
    parser.add_argument(
        "--trace",
        metavar="TOPICS",
        help="comma-separated: cp-write, lkp-write, walkable, sliding, state, cell-transit, bsp "
        "(default: all)",
    )
    add_pose(parser)
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
