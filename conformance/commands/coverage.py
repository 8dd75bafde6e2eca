"""`conformance coverage`: which branches of the oracle the cases reach."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

    from rich.console import Console

    from conformance.branches.measure import Measurement
    from conformance.branches.reasons import Gap
    from conformance.case import Case
    from conformance.query import Query

HELP: Final = "run the built-in cases on the oracle and show which of its branches they do not reach"
EXAMPLES: Final = (
    "conformance coverage",
    "conformance coverage --gaps all",
    "conformance coverage --draws 500",
    "conformance coverage --output docs/oracle-coverage.md",
)
_RULE: Final = """\
The oracle is the port of retail. A branch of it that no case takes is a rule of retail that no case shows:
write a case for it, or, if no valid input leads there, record the reason under the function and the text of
the condition in conformance/branches/known_gaps.py. A reason for what is reached is a mistake as well.

Exit codes: 0 every branch is reached or has a reason, 1 one is not, or a reason is wrong, 2 usage,
4 nothing ran.
"""
_PIPED_WIDTH: Final = 120
"""Columns of the table where no terminal says how wide it is."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    options = parser.add_argument_group("what is measured", _RULE)
    options.add_argument(
        "--poses",
        type=whole_from(0),
        metavar="N",
        help="random poses per case (default: what each case says)",
    )
    options.add_argument(
        "--draws",
        type=whole_from(0),
        default=0,
        metavar="N",
        help="also ask N random queries of each family, and count what they reach (default: %(default)s)",
    )
    options.add_argument(
        "--gaps",
        choices=("open", "all", "none"),
        default="open",
        help="list the branches without a reason, all that are not reached, or none (default: %(default)s)",
    )
    options.add_argument("-o", "--output", type=Path, metavar="FILE", help="write the page of the documents")


def run(args: argparse.Namespace) -> int:
    """Print the table and the gaps and return the exit code."""
    from conformance.branches.known_gaps import REASONS
    from conformance.branches.reasons import gaps
    from conformance.console import make_console

    if args.output is not None and args.draws:
        raise UsageError("the page is about cases: --output does not go with --draws")
    measurement, whole = _measure(_cases(args.poses), args.draws)
    found = gaps(measurement.reached, REASONS)
    mistakes = _mistakes(measurement) if whole else []
    console = make_console()
    _print(console, measurement, found, args.gaps)
    for mistake in mistakes:
        console.print(mistake, style="red")
    if not whole:
        console.print("broken off: this is what was reached so far; no page is written", style="yellow")
        return exit_codes.BROKEN_OFF
    if args.output is not None:
        _write(args.output, measurement, found)
    if not measurement.queries:
        return exit_codes.NOTHING_RAN
    open_gaps = [gap for gap in found if not gap.reason]
    return exit_codes.FAILURES if mistakes or open_gaps else exit_codes.OK


def _cases(poses: int | None) -> tuple[Case, ...]:
    from conformance.loader import Vary, load_paths

    loaded = load_paths(vary=Vary(poses=poses))
    if loaded.problems:
        raise UsageError(f"{len(loaded.problems)} built-in cases are wrong: see `conformance lint`")
    return loaded.cases


def _measure(cases: tuple[Case, ...], draws: int) -> tuple[Measurement, bool]:
    """Return what was reached, and whether all was asked."""
    from conformance.branches.measure import CoverageMissingError, measure
    from conformance.bug_hunt import FAMILIES, draw_queries
    from conformance.console import Progress

    whole = True

    def asking(ask: Callable[[Query], None]) -> None:
        nonlocal whole
        try:
            ask_all(ask)
        except KeyboardInterrupt:
            whole = False

    def ask_all(ask: Callable[[Query], None]) -> None:
        for number, case in enumerate(cases, start=1):
            progress.say(f"cases: {number} of {len(cases)}")
            for query in case.queries:
                ask(query)
        for family in FAMILIES if draws else ():
            progress.say(f"random queries: {family}")
            draw_queries(FAMILIES[family], draws, lambda query, _: ask(query))

    with Progress() as progress:
        try:
            return measure(asking), whole
        except CoverageMissingError as error:
            raise UsageError(str(error)) from error


def _mistakes(measurement: Measurement) -> list[str]:
    from conformance.branches.known_gaps import REASONS
    from conformance.branches.reasons import stale_reasons, unknown_reasons

    functions = {site.key: reach.function for site, reach in measurement.reached.items()}
    return [
        *(f"no answer to {failure}" for failure in measurement.failures),
        *(f"unknown reason: {text}" for text in unknown_reasons(functions, REASONS)),
        *(f"stale reason: {text}" for text in stale_reasons(measurement.reached, REASONS)),
    ]


def _print(console: Console, measurement: Measurement, found: list[Gap], which: str) -> None:
    from conformance.branches.measure import oracle_sources
    from conformance.report.coverage import coverage_table, gap_lines

    if not console.is_terminal:
        console.width = _PIPED_WIDTH
    console.print(coverage_table(measurement.reached, found), soft_wrap=False)
    shown = [gap for gap in found if which == "all" or (which == "open" and not gap.reason)]
    for line in gap_lines(shown, oracle_sources()):
        console.print(line)
    without = sum(not gap.reason for gap in found)
    console.print(
        f"{measurement.queries} queries; {len(found)} gaps, {without} of them without a reason",
        style="red" if without else "green",
    )


def _write(path: Path, measurement: Measurement, found: list[Gap]) -> None:
    from conformance.branches.measure import INSTRUMENTS
    from conformance.files import write_text
    from conformance.report.coverage import page

    write_text(path, page(measurement, found, INSTRUMENTS))
