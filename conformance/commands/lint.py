"""`conformance lint`: every mistake in case files, with file, line and column."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError

if TYPE_CHECKING:
    import argparse

HELP: Final = "check case files and point at every mistake"
EXAMPLES: Final = ("conformance lint", "conformance lint my-cases/ramp.yaml")


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "paths", nargs="*", type=Path, metavar="PATH", help="files or folders (default: the built-in cases)"
    )


def run(args: argparse.Namespace) -> int:
    """Print every problem and return the exit code: 1 if there is any."""
    from conformance.console import make_console
    from conformance.lint import lint
    from conformance.loader import NoCasesError

    console = make_console()
    try:
        problems = lint(args.paths)
    except NoCasesError as error:
        raise UsageError(str(error)) from error
    for problem in problems:
        console.print(f"{problem}\n", style="red")
    console.print(f"{len(problems)} problem{'' if len(problems) == 1 else 's'}")
    return exit_codes.FAILURES if problems else exit_codes.OK
