"""`conformance show`: what a case is about, seen from another side than pass or fail."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.one_case import add_case, add_pose, find_case, query_of
from conformance.commands.options import UsageError, add_candidate_option, candidate_from

if TYPE_CHECKING:
    import argparse

    from conformance.case import Case
    from conformance.protocol.dialects import Dialect
    from conformance.query import Query

HELP: Final = (
    "show the work that a case takes or what an engine is sent for it, or draw its scene as a picture"
)
EXAMPLES: Final = (
    "conformance show --work walk-cellar-descent",
    "conformance show --work my-cases/ramp.yaml::my-first-ramp --pose 3",
    "conformance show walk-cellar-descent -o cellar.png --candidate bug:cell-origin",
    "conformance show origin-step-down-touching --messages decimal > case.jsonl",
    "conformance serve --candidate oracle < case.jsonl",
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_case(parser)
    parser.add_argument(
        "--work",
        action="store_true",
        help="the engine's work: nodes visited, polygons and objects tested, cells listed, stages skipped; "
        "beside it the same without shortcuts, and what linear scans instead of trees would test",
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE",
        help="draw the scene as a PNG file: cells, both movers, their contact planes, the polygon in "
        "question; of a walk the first tick that differs (needs the extra `viz`)",
    )
    parser.add_argument(
        "--messages",
        choices=("decimal", "hex"),
        metavar="FLOATS",
        help="the session in which a cmd: engine is asked it, line by line, floats as decimal or hex: its "
        "stdin under a debugger",
    )
    add_pose(parser)
    add_candidate_option(parser, default="oracle")


def run(args: argparse.Namespace) -> int:
    """Print what was asked for, and return the exit code: 1 if the case fails to run."""
    if not args.work and args.output is None and args.messages is None:
        raise UsageError("nothing to show was asked for; there are: --work, --output FILE, --messages FLOATS")
    if args.messages is not None and (args.work or args.output is not None):
        raise UsageError("--messages are lines for an engine: nothing else is shown beside them")
    case = find_case(args.case)
    query = query_of(case, args.pose)
    if args.messages is not None:
        return _show_messages(query, args.messages)
    if args.output is not None:
        code = _draw(case, query, args)
        if code != exit_codes.OK or not args.work:
            return code
    return _show_work(query)


def _show_messages(query: Query, dialect: Dialect) -> int:
    from conformance.console import print_document
    from conformance.protocol.transcript import messages_of

    print_document(b"".join(messages_of(query, dialect)).decode("utf-8"))
    return exit_codes.OK


def _show_work(query: Query) -> int:
    from conformance.console import make_console
    from conformance.report.work import work_table
    from conformance.work import NoWorkError, measure_work

    console = make_console()
    console.print(f"{query.label} ({query.op})")
    try:
        console.print(work_table(measure_work(query)))
    except NoWorkError as error:
        console.print(str(error))
        return exit_codes.FAILURES if error.failed else exit_codes.NOTHING_RAN
    return exit_codes.OK


def _draw(case: Case, query: Query, args: argparse.Namespace) -> int:
    """Write the picture; an operation without a scene has none."""
    from conformance.candidates.base import close
    from conformance.candidates.registry import make_candidate
    from conformance.console import make_console
    from conformance.files import write_bytes
    from conformance.report.html.entries import Judge
    from conformance.report.html.library import MissingVizError
    from conformance.report.html.picture import picture
    from conformance.report.html.view import view_of

    candidate = candidate_from(args)
    pinned = case.expect if args.pose == 0 else ()
    asked = replace(case, queries=(query,), expect=pinned)
    entry = Judge(candidate, make_candidate("oracle"), ()).entry(asked)
    complaints = close(candidate)
    view = view_of(entry.details, candidate.name) if entry.details else None
    if view is None:
        make_console().print(
            f"{query.label}: {query.op} computes with numbers only; there is nothing to draw"
        )
        return exit_codes.NOTHING_RAN
    try:
        write_bytes(args.output, picture(view, query.label))
    except MissingVizError as error:
        raise UsageError(str(error)) from error
    for line in (f"{args.output}: {query.label}, {entry.status.value}", *complaints):
        make_console().print(line)
    return exit_codes.FAILURES if complaints else exit_codes.OK
