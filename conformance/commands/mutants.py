"""`conformance mutants`: how many small mistakes in the oracle the suite notices."""

from __future__ import annotations

import random
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError, check_jobs
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from conformance.mutation.equivalents import Entry
    from conformance.mutation.mutant import Mutant
    from conformance.mutation.operators import Plan
    from conformance.mutation.run import Work
    from conformance.mutation.trial import Finding
    from conformance.report.mutation import Scores

HELP: Final = "plant small mistakes in the oracle, one at a time, and show which of them the suite notices"
EXAMPLES: Final = (
    "conformance mutants --sample 200",
    "conformance mutants --only polygon.py",
    "conformance mutants --only transition_step.step_down",
    "conformance mutants --jobs 2",
    "conformance mutants --resume --output docs/mutation-score.md",
)
_RULE: Final = """\
A mutant that nothing notices is a mistake that a port could make unseen: write a case that tells it from
retail (both sides of a limit are two cases), or, if no input could, list it with the reason in
conformance/mutation/equivalents.yaml. An entry about a mutant that is noticed, or that is not there, is a
mistake as well.

Findings are written to the journal one by one; one that holds some is only gone on with. With --resume a run
goes on where it was ended; after a change of the oracle or of the cases it judges anew, and first asks what
noticed a mutant the last time.

Exit codes: 0 the score is reached, 1 it is not, or an entry is wrong, 2 usage, 4 nothing ran, 130 Ctrl-C.
"""
_JOURNAL: Final = Path(".conformance") / "mutants.jsonl"
_LEAST_SCORE: Final = 95.0
_PIPED_WIDTH: Final = 120
"""Columns of the table where no terminal says how wide it is."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    options = parser.add_argument_group("what is planted", _RULE)
    options.add_argument(
        "--only",
        metavar="WHERE",
        help="only mutants of a file (polygon.py) or function (polygon.Polygon.make_plane)",
    )
    options.add_argument(
        "--documents",
        nargs="+",
        metavar="NN",
        help="documents whose functions are mutated (default: all, 01 to 10)",
    )
    options.add_argument("--sample", type=whole_from(1), metavar="N", help="only N mutants, drawn at random")
    options.add_argument("--seed", type=int, default=0, help="of the drawing (default: %(default)s)")
    options.add_argument("--list", action="store_true", help="only list the mutants")
    options.add_argument(
        "--jobs", type=whole_from(1), default=1, metavar="N", help="processes (default: %(default)s)"
    )
    options.add_argument(
        "--journal", type=Path, default=_JOURNAL, metavar="FILE", help="findings (default: %(default)s)"
    )
    options.add_argument("--resume", action="store_true", help="go on with what the journal holds")
    options.add_argument(
        "--least",
        type=float,
        default=_LEAST_SCORE,
        metavar="PERCENT",
        help="score below which the run fails (default: %(default)g)",
    )
    options.add_argument("-o", "--output", type=Path, metavar="FILE", help="write the page of the documents")


def run(args: argparse.Namespace) -> int:
    """Print the scores and the survivors and return the exit code."""
    from conformance.console import make_console
    from conformance.files import check_writable
    from conformance.mutation.run import DOCUMENTS, Work, all_plans

    if args.output is not None and (args.only or args.sample or args.documents):
        raise UsageError("the page is about all mutants: --output goes with no choice of them")
    check_jobs(args.jobs)
    plans = all_plans(args.documents or DOCUMENTS)
    chosen = _chosen(plans, args)
    if args.list:
        console = make_console()
        for number in chosen:
            console.print(str(plans[number].mutant))
        return exit_codes.OK if chosen else exit_codes.NOTHING_RAN
    if args.output is not None:
        check_writable(args.output)
    entries = _equivalents()
    work = Work(tuple(args.documents or DOCUMENTS), chosen, args.jobs, args.journal, args.resume)
    findings = _judged(work, plans)
    mistakes = _mistakes(entries, [plan.mutant for plan in plans], findings, whole=not args.documents)
    return _report(_scores(entries, findings), mistakes, args)


def _chosen(plans: Sequence[Plan], args: argparse.Namespace) -> tuple[int, ...]:
    numbers = [number for number, plan in enumerate(plans) if not args.only or _is_in(plan.mutant, args.only)]
    if not numbers:
        raise UsageError(_nowhere(plans, args))
    if args.sample is not None and args.sample < len(numbers):
        numbers = sorted(random.Random(args.seed).sample(numbers, args.sample))  # noqa: S311 - no secret
    return tuple(numbers)


def _is_in(mutant: Mutant, where: str) -> bool:
    return where in {mutant.file, mutant.file.removesuffix(".py"), mutant.site}


def _nowhere(plans: Sequence[Plan], args: argparse.Namespace) -> str:
    from conformance.source import nearest

    if not args.only:
        return f"no function is ported from {' or '.join(args.documents)}: documents are 01 to 10"
    known = {name for plan in plans for name in (plan.mutant.file, plan.mutant.site)}
    hint = nearest(args.only, sorted(known))
    return f"no mutant in {args.only!r}{f': {hint}' if hint else ''}"


def _equivalents() -> tuple[Entry, ...]:
    from conformance.mutation.equivalents import EquivalentsError, read_equivalents

    try:
        return read_equivalents()
    except EquivalentsError as error:
        raise UsageError(str(error)) from error


def _judged(work: Work, plans: Sequence[Plan]) -> list[Finding]:
    from conformance.console import Progress
    from conformance.journal import JournalError
    from conformance.mutation.run import WorkerLostError, judge

    kept = f"what was found is in {work.journal}: --resume goes on"
    with Progress() as progress:
        try:
            return judge(work, plans, progress.say)
        except JournalError as error:
            raise UsageError(str(error)) from error
        except WorkerLostError as error:
            raise UsageError(f"{error}; {kept}") from error
        except KeyboardInterrupt:
            sys.stderr.write(f"conformance mutants: ended early; {kept}\n")
            raise


def _mistakes(
    entries: Sequence[Entry], mutants: Sequence[Mutant], findings: Sequence[Finding], *, whole: bool
) -> list[str]:
    """Say what is wrong with the list; of other documents than its own it says nothing."""
    from conformance.mutation.equivalents import wrong_entries

    return list(wrong_entries(entries, mutants, findings)) if whole else []


def _scores(entries: Sequence[Entry], findings: Sequence[Finding]) -> Scores:
    from conformance.mutation.equivalents import explained
    from conformance.report.mutation import Scores

    found = {finding.mutant: explained(entries, finding.mutant) for finding in findings if not finding.killed}
    return Scores(findings, {mutant: entry for mutant, entry in found.items() if entry is not None})


def _report(scores: Scores, mistakes: Sequence[str], args: argparse.Namespace) -> int:
    from conformance.console import make_console
    from conformance.files import write_text
    from conformance.mutation.trial import PATIENCE
    from conformance.report.mutation import page, score_table

    console = make_console()
    if not console.is_terminal:
        console.width = _PIPED_WIDTH
    for finding in scores.survivors:
        console.print(f"{finding.verdict.value}: {finding.mutant}")
    console.print(score_table(scores), soft_wrap=False)
    for mistake in mistakes:
        console.print(mistake, style="red")
    if args.output is not None:
        write_text(args.output, page(scores, PATIENCE))
    total = scores.total
    if not total.noticeable:
        return exit_codes.NOTHING_RAN
    reached = 100.0 * total.noticed >= args.least * total.noticeable
    summary = f"{total.noticed} of {total.noticeable} mutants are noticed"
    console.print(
        summary if reached else f"{summary}, less than {args.least:g} %", style="green" if reached else "red"
    )
    return exit_codes.OK if reached and not mistakes else exit_codes.FAILURES
