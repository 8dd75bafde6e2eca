"""`conformance show`: what a case is about, seen from another side than pass or fail."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError
from conformance.commands.trace import find_case, pose_number, query_of

if TYPE_CHECKING:
    import argparse

HELP: Final = "show the work that a case takes: with shortcuts, without them, and by brute force"
EXAMPLES: Final = (
    "conformance show --work walk-cellar-descent",
    "conformance show --work my-cases/ramp.yaml::my-first-ramp --pose 3",
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("case", metavar="CASE-ID|FILE::ID", help="a built-in case, or a case of a file")
    parser.add_argument(
        "--work",
        action="store_true",
        help="the engine's work: nodes visited, polygons and objects tested, cells listed, stages skipped; "
        "beside it the same without shortcuts, and what linear scans instead of trees would test",
    )
    parser.add_argument(
        "--pose",
        type=pose_number,
        default=0,
        metavar="N",
        help="the case in its Nth random pose (default: 0, as written)",
    )


def run(args: argparse.Namespace) -> int:
    """Print what was asked for, and return the exit code: 1 if the case fails to run."""
    if not args.work:
        raise UsageError("nothing to show was asked for; there is: --work")
    from conformance.console import make_console
    from conformance.report.work import work_table
    from conformance.work import NoWorkError, measure_work

    query = query_of(find_case(args.case), args.pose)
    console = make_console()
    console.print(f"{query.label} ({query.op})")
    try:
        console.print(work_table(measure_work(query)))
    except NoWorkError as error:
        console.print(str(error))
        return exit_codes.FAILURES if error.failed else exit_codes.NOTHING_RAN
    return exit_codes.OK
