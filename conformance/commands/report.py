"""`conformance report`: cases and what came of them, as one HTML file to look at."""

from __future__ import annotations

import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.one_case import find_case
from conformance.commands.options import UsageError, add_candidate_option, candidate_from
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse
    from collections.abc import Collection, Sequence

    from conformance.case import Case
    from conformance.console import Progress
    from conformance.report.html.entries import Entry, Judge
    from conformance.report.html.page import Report
    from conformance.source import Problem

HELP: Final = "write an HTML page: which cases fail, in which fields, who wrote what, and the scene"
EXAMPLES: Final = (
    "conformance report --candidate engine --all-failed -o report.html",
    "conformance report walk-cellar-descent --candidate bug:cell-origin -o cellar.html",
    'conformance report my-cases --candidate "cmd:./my-engine" --no-views -o report.html',
)
_TOPICS: Final = "cp-write"


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "cases",
        nargs="*",
        metavar="CASE",
        help="a CASE-ID, FILE::ID, FILE or folder (repeatable; without any: every built-in case)",
    )
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE", help="the page, one file (*.html)"
    )
    parser.add_argument(
        "--all-failed",
        action="store_true",
        help="ask all, but give only those a page of their own that fail; the others are counted and listed",
    )
    parser.add_argument(
        "--poses",
        type=whole_from(0),
        metavar="N",
        help="ask each case in N random poses besides as written (default: as many as the case says)",
    )
    parser.add_argument(
        "--trace-writes",
        default=_TOPICS,
        metavar="TOPICS",
        help="whose writes to show; comma-separated, see `conformance trace --help` (default: %(default)s)",
    )
    parser.add_argument(
        "--no-views",
        action="store_true",
        help="without 3-D views: a smaller page, which needs no extra",
    )
    add_candidate_option(parser, default="engine")


def run(args: argparse.Namespace) -> int:
    """Write the page, and return the exit code: 1 on any failure, 4 when nothing was compared."""
    from conformance.console import make_console
    from conformance.files import check_writable, write_text
    from conformance.report.html.entries import Status
    from conformance.report.html.page import page

    check_writable(args.output)
    report = _report(args)
    write_text(args.output, page(report))
    counts = ", ".join(f"{report.counts[status]} {status.value}" for status in Status)
    make_console().print(f"{args.output}: {counts}")
    if not report.whole:
        sys.stderr.write("conformance report: broken off; the page shows what was asked so far\n")
    if report.failed:
        return exit_codes.FAILURES
    if not report.whole:
        return exit_codes.BROKEN_OFF
    return exit_codes.OK if report.counts[Status.PASSED] else exit_codes.NOTHING_RAN


def _report(args: argparse.Namespace) -> Report:
    from conformance.candidates.base import close
    from conformance.candidates.registry import make_candidate
    from conformance.console import Progress
    from conformance.report.html.entries import Judge
    from conformance.report.html.page import Report
    from conformance.report.html.view import views_of

    library = _library(args)
    topics = _topics(args.trace_writes)
    cases, problems = _cases(args.cases, args.poses)
    candidate = candidate_from(args)
    judge = Judge(candidate, make_candidate("oracle"), topics, only_failed=args.all_failed)
    with Progress() as progress:
        entries = _entries(judge, cases, progress)
        complaints = close(candidate)
        progress.say("the scenes")
        views = None if args.no_views else views_of(entries, candidate.name)
    return Report(candidate.name, entries, problems, complaints, views, library, len(entries) == len(cases))


def _entries(judge: Judge, cases: Sequence[Case], progress: Progress) -> list[Entry]:
    """Ask every case; Ctrl-C ends the asking, not the report."""
    entries: list[Entry] = []
    with suppress(KeyboardInterrupt):
        for number, case in enumerate(cases, start=1):
            progress.say(f"case {number} of {len(cases)}: {case.id}")
            entries.append(judge.entry(case))
    return entries


def _library(args: argparse.Namespace) -> str:
    from conformance.report.html.library import MissingVizError, plotly_source

    try:
        return "" if args.no_views else plotly_source()
    except MissingVizError as error:
        raise UsageError(f"{error}; or --no-views") from error


def _topics(text: str) -> Collection[str]:
    from conformance.traced import TopicsError, parse_topics

    try:
        return parse_topics(text)
    except TopicsError as error:
        raise UsageError(str(error)) from error


def _cases(given: list[str], poses: int | None) -> tuple[list[Case], list[Problem]]:
    """Return the cases that are named, each once, and what keeps others from being read."""
    from conformance.loader import NoCasesError, Vary, load_paths

    vary = Vary(poses)
    paths = [Path(text) for text in given if _is_there(text)]
    try:
        loaded = load_paths(paths, vary) if paths or not given else None
    except (NoCasesError, OSError) as error:
        raise UsageError(str(error)) from error
    cases = list(loaded.cases) if loaded else []
    cases += [find_case(text, vary) for text in given if not _is_there(text)]
    unique = {(case.id, case.location): case for case in cases}
    return list(unique.values()), list(loaded.problems) if loaded else []


def _is_there(text: str) -> bool:
    """Tell whether an argument is a file, a folder or a pattern of files."""
    from conformance.installed import meant

    return any(path.exists() for path in meant(Path(text)))
