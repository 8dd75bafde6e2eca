"""`conformance bench`: how fast the engine is, beside the oracle, a native yardstick, and other libraries."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError

if TYPE_CHECKING:
    import argparse

    from rich.console import Console

    from conformance.bench.report import Report
    from conformance.bench.settings import Settings

HELP: Final = "measure the engine beside the oracle, the native yardstick and other libraries"
EXAMPLES: Final = (
    "conformance bench --quick",
    "conformance bench --native --peers --json bench.json --plots docs/bench",
    "conformance bench --only native --seed 7",
    "conformance bench --only scaling --plots plots/",
    "conformance bench --only messages",
)
_METHOD: Final = """\
Implementations take turns in one process, each round at new random queries, no two of them the same (who
works in Python is asked a sample of them); answers are compared before times are believed; the median of the
rounds' ratios is reported, with quartiles. Ctrl-C keeps what there is.

Exit codes: 0 all was measured, 1 answers differ where they must not, 2 usage, 4 nothing was measured,
5 the results could not be written, 130 Ctrl-C broke it off.
"""
_PIPED_WIDTH: Final = 170
"""Columns of the table where no terminal says how wide it is."""
_FIXTURES: Final = "RETAIL_FIXTURES"
"""Environment variable that names the folder of real cells."""
_SEED_BITS: Final = 32


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    options = parser.add_argument_group("what is measured", _METHOD)
    options.add_argument("--quick", action="store_true", help="less of everything: about a minute")
    options.add_argument(
        "--native", action="store_true", help="compile the C++ yardstick and measure it, too"
    )
    options.add_argument("--peers", action="store_true", help="measure fcl, coal and trimesh (extra `peers`)")
    options.add_argument(
        "--only",
        action="append",
        default=[],
        metavar="SECTION",
        help="oracle, native, noise, plans, threads, peers, precision, scaling or messages (repeatable)",
    )
    options.add_argument("--seed", type=int, metavar="N", help="of all random points (default: a new one)")
    options.add_argument("--fixtures", type=Path, metavar="DIR", help="folder of real cells (Holtburg)")
    options.add_argument("--json", type=Path, metavar="FILE", help="also write the result as JSON")
    options.add_argument(
        "--page",
        type=Path,
        metavar="FILE",
        help="also put the numbers into a Markdown page, between its marks",
    )
    options.add_argument(
        "--worst", type=Path, metavar="DIR", help="keep the move that is farthest from exact as a case"
    )
    options.add_argument("--plots", type=Path, metavar="DIR", help="also draw it (extra `bench`)")


def run(args: argparse.Namespace) -> int:
    """Measure, print, and return the exit code."""
    from conformance.bench.report import Report
    from conformance.console import make_console

    settings = _settings(args)
    _check_outputs(args)
    report = Report(settings.seed)
    console = make_console()
    if not console.is_terminal:
        console.width = _PIPED_WIDTH
    whole = _measure(settings, report, console)
    _write(args, report, console)
    if report.failures:
        return exit_codes.FAILURES
    if not whole:
        return exit_codes.BROKEN_OFF
    return exit_codes.NOTHING_RAN if report.empty else exit_codes.OK


def _settings(args: argparse.Namespace) -> Settings:
    from conformance.bench.settings import SECTIONS, full, quick

    for section in args.only:
        if section not in SECTIONS:
            raise UsageError(f"no section {section!r}; there are {', '.join(SECTIONS)}")
    asked = {"native": args.native, "peers": args.peers}
    wanted = tuple(args.only) or tuple(section for section in SECTIONS if asked.get(section, True))
    seed = int.from_bytes(os.urandom(_SEED_BITS // 8), "big") if args.seed is None else args.seed
    if seed < 0:
        raise UsageError(f"a seed is not negative: {seed}")
    return (quick if args.quick else full)(seed, wanted, _fixtures(args.fixtures))


def _fixtures(given: Path | None) -> Path | None:
    """Return the folder of real cells, if one is named."""
    named = os.environ.get(_FIXTURES)
    folder = given or (Path(named) if named else None)
    if folder is not None and not folder.is_dir():
        raise UsageError(f"no such folder: {folder}")
    return folder


def _check_outputs(args: argparse.Namespace) -> None:
    """Find out before a long run what could not be written after it."""
    from conformance.bench.page import PageError, split_page
    from conformance.bench.plots import NoPlotsError, import_matplotlib

    try:
        if args.page is not None:
            split_page(args.page)
        if args.plots is not None:
            import_matplotlib()
    except OSError as error:
        raise UsageError(f"cannot read {args.page}: {error}") from error
    except (NoPlotsError, PageError) as error:
        raise UsageError(str(error)) from error


def _measure(settings: Settings, report: Report, console: Console) -> bool:
    """Measure and print; tell whether all was measured that was asked for."""
    from conformance.bench.benchmark import measure
    from conformance.bench.tables import show
    from conformance.console import Progress
    from conformance.scenes.importers.dump_json import DumpError

    whole = True
    try:
        with Progress() as progress:
            measure(settings, report, progress.say)
    except KeyboardInterrupt:
        whole = False
        report.omit("everything after that", "the run was broken off")
    except DumpError as error:
        raise UsageError(str(error)) from error
    show(console, report)
    return whole


def _write(args: argparse.Namespace, report: Report, console: Console) -> None:
    from conformance.bench.page import PageError, write_page
    from conformance.bench.plots import NoPlotsError, write_plots
    from conformance.bench.precision import write_worst
    from conformance.files import write_text

    try:
        if args.json is not None:
            write_text(args.json, report.to_json())
        if args.page is not None:
            write_page(args.page, report, _command(args))
        for worst in report.worst if args.worst is not None else ():
            console.print(f"kept: {write_worst(args.worst, worst, report.seed)}")
        if args.plots is not None:
            for path in write_plots(report, args.plots):
                console.print(f"drawn: {path}")
    except (NoPlotsError, PageError) as error:
        raise UsageError(str(error)) from error


def _command(args: argparse.Namespace) -> str:
    """Return what makes the same measurements, without the seed."""
    flags = [f"--{name}" for name in ("quick", "native", "peers") if getattr(args, name)]
    only = [f"--only {section}" for section in args.only]
    return " ".join(["conformance bench", *flags, *only])
