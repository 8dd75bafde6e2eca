"""`conformance smoke`: what is wrong with an engine's bridge."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError
from conformance.option_types import positive

if TYPE_CHECKING:
    from rich.console import Console

    from conformance.protocol.smoke import Finding

HELP: Final = "try an engine's side of protocol v1 step by step, and tell its author what is wrong"
EXAMPLES: Final = (
    "conformance smoke ./my-engine --flag",
    'conformance smoke "dotnet run --project Bridge"',
    "conformance smoke --read-timeout 5 conformance serve --candidate oracle",
)
_PREFIX: Final = "cmd:"
_SECONDS: Final = 10.0
_INDENT: Final = "\n             "


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "--read-timeout",
        type=positive("seconds"),
        default=_SECONDS,
        metavar="SECONDS",
        help="within which the engine must reply (default: %(default)s)",
    )
    parser.add_argument(
        "command_line",
        nargs=argparse.REMAINDER,
        metavar="CMD",
        help="program and arguments of the engine; everything from here on belongs to it",
    )


def run(args: argparse.Namespace) -> int:
    """Print what each step has shown and return the exit code: 1 if anything is wrong."""
    from conformance.console import Progress, make_console
    from conformance.protocol.process import command_line
    from conformance.protocol.smoke import Mark, examine

    command = _command(args.command_line)
    console = make_console()
    wrong = 0
    with Progress() as progress:
        for finding in examine(command, args.read_timeout, progress.say):
            _print(console, finding)
            wrong += finding.mark is Mark.WRONG
    if wrong:
        console.print(f"{wrong} wrong; the contract is in docs/plugging-in-an-engine.md", style="red")
        return exit_codes.FAILURES
    candidate = command_line([f"{_PREFIX}{command}"])
    console.print(f"the bridge works: pytest conformance --candidate {candidate}", style="green")
    return exit_codes.OK


def _command(words: list[str]) -> str:
    """Return the command as one text; a single word may be a whole command already."""
    from conformance.protocol.process import command_line

    if not words:
        raise UsageError("found no command, expected the engine's, as in `conformance smoke ./my-engine`")
    if len(words) == 1:
        return words[0].removeprefix(_PREFIX)
    return command_line(words)


def _print(console: Console, finding: Finding) -> None:
    from conformance.protocol.smoke import Mark

    style = {Mark.OK: None, Mark.WRONG: "red", Mark.NOTE: "yellow"}[finding.mark]
    text = f"{finding.mark.value:<6} {finding.step}: {finding.said}"
    if finding.expected:
        text += f"{_INDENT}expected: {finding.expected}"
    console.print(text, style=style)
