"""`conformance export`: write cases, with retail's answers, as a vector file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse
    from collections import Counter
    from collections.abc import Callable, Iterator, Sequence

    from conformance.loader import Case, Loaded
    from conformance.query import Fields, Query

HELP: Final = "write cases and retail's answers as a vector file that any engine can read"
EXAMPLES: Final = (
    "conformance export -o vectors/cases.jsonl",
    "conformance export my-cases/ --poses 0 -o mine.jsonl",
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "cases",
        nargs="*",
        type=Path,
        metavar="CASES",
        help="case files or folders (default: the built-in cases)",
    )
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE", help="the JSON-lines file to write"
    )
    parser.add_argument(
        "--poses",
        type=whole_from(0),
        metavar="N",
        help="random poses per case (default: what each case says)",
    )


def run(args: argparse.Namespace) -> int:
    """Write the file and return the exit code: 1 if a case could not be written, 4 if none was."""
    from collections import Counter

    from conformance.console import Progress, make_console
    from conformance.vector_errors import VectorError
    from conformance.vector_export import UnsuitablePlaceError, write_vectors

    console = make_console()
    unanswered: Counter[str] = Counter()
    with Progress() as progress:
        progress.say("reading cases")
        loaded = _load(args)
        try:
            written = write_vectors(args.output, _answers(loaded.cases, unanswered, progress.say))
        except (UnsuitablePlaceError, VectorError) as error:
            raise UsageError(str(error)) from error
    for problem in loaded.problems:
        console.print(str(problem), style="red")
    for reason, count in sorted(unanswered.items()):
        console.print(f"{count} not written: {reason}", style="yellow")
    console.print(f"{written} records of {len(loaded.cases)} cases written to {args.output}")
    if not written:
        return exit_codes.NOTHING_RAN
    return exit_codes.FAILURES if loaded.problems or unanswered else exit_codes.OK


def _load(args: argparse.Namespace) -> Loaded:
    from conformance.loader import NoCasesError, Vary, load_paths

    try:
        return load_paths(args.cases, Vary(poses=args.poses))
    except NoCasesError as error:
        raise UsageError(str(error)) from error


def _answers(
    cases: Sequence[Case], unanswered: Counter[str], say: Callable[[str], None]
) -> Iterator[tuple[str, Query, Fields]]:
    from conformance.candidates.registry import make_candidate
    from conformance.query import Result, Skipped

    oracle = make_candidate("oracle")
    for number, case in enumerate(cases, start=1):
        say(f"retail's answers: case {number} of {len(cases)}")
        for query in case.queries:
            outcome = oracle.answer(query)
            if isinstance(outcome, Result):
                yield query.label, query, outcome.fields
            elif isinstance(outcome, Skipped):
                unanswered[outcome.reason] += 1
            else:
                unanswered[outcome.context] += 1
