"""`conformance lint`: every mistake in case files, with file, line and column."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError

if TYPE_CHECKING:
    import argparse

HELP: Final = "check case files, and deviation files, and point at every mistake"
EXAMPLES: Final = (
    "conformance lint",
    "conformance lint my-cases/ramp.yaml",
    "conformance lint --deviations my-deviations.yaml",
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "paths", nargs="*", type=Path, metavar="PATH", help="files or folders (default: the built-in cases)"
    )
    parser.add_argument(
        "--deviations",
        action="append",
        default=[],
        type=Path,
        metavar="FILE",
        help="also a deviation file, which must be about these cases (repeatable; without PATH and FILE: the "
        "suite's own)",
    )


def run(args: argparse.Namespace) -> int:
    """Print every problem and return the exit code: 1 if there is any."""
    from conformance.console import make_console
    from conformance.lint import lint, own_deviations
    from conformance.loader import NoCasesError

    console = make_console()
    try:
        given = args.deviations or ([] if args.paths else own_deviations())
        problems = lint(args.paths, deviations=given)
    except NoCasesError as error:
        raise UsageError(str(error)) from error
    except OSError as error:
        raise UsageError(f"cannot read {error.filename}: {error.strerror}") from error
    for problem in problems:
        console.print(f"{problem}\n", style="red")
    console.print(f"{len(problems)} problem{'' if len(problems) == 1 else 's'}")
    return exit_codes.FAILURES if problems else exit_codes.OK
