"""`conformance fuzz`: give the readers of strangers' input inputs that nobody thought of."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError
from conformance.option_types import whole_from

if TYPE_CHECKING:
    import argparse

    from conformance.fuzz.session import Report
    from conformance.fuzz.targets import Target

HELP: Final = "fuzz a reader of foreign input: case files, vector files, the world compiler (extra `fuzz`)"
EXAMPLES: Final = (
    "conformance fuzz yaml --runs 1000000",
    "conformance fuzz world --runs 100000 --new more-inputs/",
    "conformance fuzz vectors --replay findings/crash-0123abcd",
)
_RULE: Final = """\
yaml      files of cases, from bytes to queries
vectors   vector files with their shared geometry and worlds
world     the engine's world compiler, and a move in what it accepts

An input must be refused with an error that has a place, or be accepted and stand up to an independent check.
Anything else is a finding: its input is kept, and --replay runs it without the fuzzer. Inputs to start from
are those that ship in conformance/fuzz/corpus. Ctrl-C ends the run and reports what was done so far.

Exit codes: 0 nothing was found, 1 a finding, a hang or a killed worker, 2 usage, 4 nothing was run,
130 Ctrl-C.
"""
_RUNS: Final = 100_000
_FINDINGS: Final = Path("findings")


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    options = parser.add_argument_group("what is fuzzed", _RULE)
    options.add_argument("target", choices=("yaml", "vectors", "world"), help="which reader")
    options.add_argument(
        "--runs", type=whole_from(1), default=_RUNS, metavar="N", help="executions (default: %(default)s)"
    )
    options.add_argument(
        "--seed", type=whole_from(1), metavar="N", help="of the choices (default: a new one)"
    )
    options.add_argument(
        "--findings", type=Path, default=_FINDINGS, metavar="DIR", help="where failing inputs are kept"
    )
    options.add_argument("--new", type=Path, metavar="DIR", help="also keep inputs that reach something new")
    options.add_argument(
        "--replay", type=Path, nargs="+", metavar="FILE", help="run these inputs once, without the fuzzer"
    )


def run(args: argparse.Namespace) -> int:
    """Fuzz, print what came of it, and return the exit code."""
    from conformance.fuzz.targets import TARGETS

    target = TARGETS[args.target]
    return _replay(target, args.replay) if args.replay else _fuzz(target, args)


def _replay(target: Target, files: list[Path]) -> int:
    """Run inputs as they are; what one raises is shown whole."""
    from conformance.console import make_console

    console, once = make_console(), target.load()
    for file in files:
        try:
            data = file.read_bytes()
        except OSError as error:
            raise UsageError(f"cannot read {file}: {error}") from error
        console.print(f"{file}: {'accepted' if once(data) else 'refused'}")
    return exit_codes.OK


def _fuzz(target: Target, args: argparse.Namespace) -> int:
    from conformance.console import Progress
    from conformance.fuzz.session import FuzzerMissingError, fuzz

    with tempfile.TemporaryDirectory() as scratch, Progress() as progress:
        new = args.new or Path(scratch)
        try:
            for folder in (new, args.findings):
                folder.mkdir(parents=True, exist_ok=True)
            report = fuzz(
                target,
                [new, target.corpus],
                runs=args.runs,
                seed=args.seed or 0,
                findings=args.findings,
                say=progress.say,
            )
        except FuzzerMissingError as error:
            raise UsageError(str(error)) from error
        except OSError as error:
            raise UsageError(f"cannot fuzz: {error}") from error
    return _tell(target, report)


def _tell(target: Target, report: Report) -> int:
    from conformance.console import make_console
    from conformance.fuzz.session import BROKEN_OFF

    console = make_console()
    if report.finding or (report.ended and report.ended != BROKEN_OFF):
        for line in report.output:
            console.print(line)
        console.print(f"found: {report.finding or report.ended}", style="red")
        if report.finding:
            console.print(f'again: conformance fuzz {target.name} --replay "{report.finding}"')
    rate = report.executed / report.seconds if report.seconds else 0.0
    console.print(
        f"{target.name}: {report.executed} executions, {report.accepted} accepted, "
        f"in {report.seconds:.0f} s ({rate:.0f} a second){', ' + report.ended if report.ended else ''}"
    )
    if report.finding or (report.ended and report.ended != BROKEN_OFF):
        return exit_codes.FAILURES
    if report.ended:
        return exit_codes.BROKEN_OFF
    return exit_codes.OK if report.executed else exit_codes.NOTHING_RAN
