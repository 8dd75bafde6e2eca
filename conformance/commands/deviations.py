"""`conformance deviations`: what is recorded of an engine, and drafts of what could be."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError, add_candidate_option, candidate_from, check_candidate
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse

    from conformance.candidates.base import Candidate
    from conformance.loader import Case
    from conformance.verdict import Failure

HELP: Final = "show how a candidate is known to differ from retail, or draft entries for how it does"
EXAMPLES: Final = (
    "conformance deviations --candidate engine",
    "conformance deviations my-deviations.yaml",
    'conformance deviations --suggest --candidate "cmd:./my-engine" -o my-deviations.yaml',
    "conformance lint --deviations my-deviations.yaml",
    'pytest conformance --candidate "cmd:./my-engine" --deviations my-deviations.yaml',
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "file",
        nargs="?",
        metavar="FILE",
        help="a deviation file, or the name of an engine that the suite knows (default: the candidate's)",
    )
    add_candidate_option(parser, default="engine")
    parser.add_argument(
        "--suggest",
        action="store_true",
        help="ask the candidate every case and draft an entry for each difference; reasons, links and days "
        "are left out: a draft is refused until somebody has filled them in",
    )
    parser.add_argument(
        "--cases",
        action="append",
        default=[],
        type=Path,
        metavar="PATH",
        help="files or folders of cases to ask (repeatable; default: the built-in cases)",
    )
    parser.add_argument(
        "--poses", type=whole_from(0), metavar="N", help="random poses in which to ask each scene case"
    )
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="write the draft there")


def run(args: argparse.Namespace) -> int:
    """List or draft; exit code 1 if an entry has expired, 4 if a draft was made of nothing."""
    if args.suggest:
        if args.file is not None:
            raise UsageError(f"--suggest drafts a new file: {args.file} would not be read")
        return _suggest(args)
    if args.cases or args.output is not None or args.poses is not None:
        raise UsageError("--cases, --poses and --output belong to --suggest")
    return _list(args)


def _list(args: argparse.Namespace) -> int:
    from conformance.console import make_console
    from conformance.deviations.known import BadDeviationsError, load_deviations, today

    if args.file is None:
        check_candidate(args)
    try:
        deviations = load_deviations(args.file, args.candidate)
    except BadDeviationsError as error:
        raise UsageError(str(error)) from error
    console = make_console()
    expired = 0
    for entry in deviations.entries:
        is_over = entry.deviation.has_expired(today())
        expired += is_over
        state = f"expired on {entry.deviation.until}" if is_over else f"until {entry.deviation.until}"
        console.print(entry.deviation.words, style="red" if is_over else "bold")
        console.print(f"  {entry.deviation.reason}\n  {entry.deviation.link}\n  {state}, {entry.location}")
    count = len(deviations.entries)
    console.print(
        f"{deviations.engine}: {count} deviation{'' if count == 1 else 's'}, {expired} of them expired"
    )
    return exit_codes.FAILURES if expired else exit_codes.OK


def _suggest(args: argparse.Namespace) -> int:
    from conformance.candidates.base import close
    from conformance.console import print_document
    from conformance.deviations.drafts import draft
    from conformance.files import check_writable, write_text

    if args.output is not None:
        check_writable(args.output)
    candidate = candidate_from(args)
    try:
        failures, compared = _ask(_cases(args), candidate)
    finally:
        close(candidate)
    text = draft(failures, engine=args.candidate)
    if args.output is None:
        print_document(text)
    else:
        write_text(args.output, text)
    cases = f"{len(failures)} failing case{'' if len(failures) == 1 else 's'}"
    sys.stderr.write(f"{cases}; {compared} queries compared\n")
    if failures and args.output is not None:
        sys.stderr.write(f"the draft has no reasons: conformance lint --deviations {args.output}\n")
    return exit_codes.OK if compared or failures else exit_codes.NOTHING_RAN


def _cases(args: argparse.Namespace) -> tuple[Case, ...]:
    from conformance.loader import NoCasesError, Vary, load_paths

    try:
        loaded = load_paths(args.cases, Vary(poses=args.poses))
    except NoCasesError as error:
        raise UsageError(str(error)) from error
    if loaded.problems:
        raise UsageError(f"{len(loaded.problems)} cases are wrong: see `conformance lint`")
    return loaded.cases


def _ask(cases: tuple[Case, ...], candidate: Candidate) -> tuple[dict[str, list[Failure]], int]:
    """Return the candidate's own failures by the case's id, and how many queries were compared."""
    from conformance.candidates.oracle_candidate import OracleCandidate
    from conformance.console import Progress
    from conformance.verdict import judge

    failures: dict[str, list[Failure]] = {}
    oracle, compared = OracleCandidate(), 0
    with Progress() as progress:
        for number, case in enumerate(cases, start=1):
            progress.say(f"case {number} of {len(cases)}, {len(failures)} failing")
            verdict = judge(case, candidate, oracle)
            compared += verdict.compared
            found = [failure for failure in verdict.failures if failure.who == candidate.name]
            failures.update({case.id: found} if found else {})
    return failures, compared
