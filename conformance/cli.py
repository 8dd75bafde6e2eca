"""The command line: `conformance COMMAND`, each command a module of `conformance.commands`."""

from __future__ import annotations

import argparse
import sys
from importlib import metadata
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands import bench, bugs, coverage, errors, export, lint, show, trace, trace_log, verify
from conformance.commands.options import UsageError
from conformance.console import tolerate_unprintable

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

_DISTRIBUTION: Final = "retail-conformance"
_COMMANDS: Final[dict[str, ModuleType]] = {
    "verify": verify,
    "export": export,
    "lint": lint,
    "bugs": bugs,
    "coverage": coverage,
    "trace": trace,
    "trace-log": trace_log,
    "bench": bench,
    "show": show,
    "errors": errors,
}
_DESCRIPTION: Final = """\
Is a re-implementation of Asheron's Call movement and collision the same as retail?

The cases themselves run under pytest:
  pytest --pyargs conformance                     every case, engine against oracle
  pytest --pyargs conformance --candidate SPEC    another candidate
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return the exit code.

    0 all is well, 1 something differs or is wrong, 2 the command line is wrong, 4 nothing was compared.
    """
    tolerate_unprintable()
    parser = _make_parser()
    args = parser.parse_args(argv)
    try:
        code: int = _COMMANDS[args.command].run(args)
    except UsageError as error:
        sys.stderr.write(f"conformance {args.command}: {error}\n")
        return exit_codes.USAGE
    return code


def _make_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="conformance", description=_DESCRIPTION, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--version", action="version", version=f"conformance {_version()}")
    subparsers = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, command in _COMMANDS.items():
        examples = "\n".join(f"  {line}" for line in command.EXAMPLES)
        subparser = subparsers.add_parser(
            name,
            help=command.HELP,
            description=f"{command.HELP[0].upper()}{command.HELP[1:]}.",
            epilog=f"examples:\n{examples}",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        command.configure(subparser)
    return parser


def _version() -> str:
    try:
        return metadata.version(_DISTRIBUTION)
    except metadata.PackageNotFoundError:
        return "(not installed)"


if __name__ == "__main__":
    sys.exit(main())
