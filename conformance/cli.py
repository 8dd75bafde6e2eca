"""The command line: `conformance COMMAND`, each command a module of `conformance.commands`."""

from __future__ import annotations

import argparse
import os
import sys
from importlib import metadata
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands import (
    bench,
    bugs,
    coverage,
    deviations,
    errors,
    explain,
    export,
    fmt,
    fuzz,
    gate,
    lint,
    list_cases,
    mutants,
    new,
    report,
    serve,
    show,
    smoke,
    soak,
    stress,
    trace,
    trace_log,
    verify,
)
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
    "fmt": fmt,
    "list": list_cases,
    "new": new,
    "bugs": bugs,
    "deviations": deviations,
    "gate": gate,
    "coverage": coverage,
    "mutants": mutants,
    "explain": explain,
    "trace": trace,
    "trace-log": trace_log,
    "bench": bench,
    "show": show,
    "report": report,
    "errors": errors,
    "fuzz": fuzz,
    "stress": stress,
    "soak": soak,
    "serve": serve,
    "smoke": smoke,
}
_DESCRIPTION: Final = """\
Is a re-implementation of Asheron's Call movement and collision the same as retail?

The cases themselves run under pytest:
  pytest conformance                     every case, engine against oracle
  pytest conformance --candidate SPEC    another candidate
  pytest my-case.yaml                    a file of your own
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return the exit code.

    0 all is well, 1 something differs or is wrong, 2 the command line is wrong, 3 the candidate gives no
    answers (`gate`), 4 nothing was compared, 5 the results could not be written, 130 Ctrl-C ended the run.
    """
    tolerate_unprintable()
    parser = _make_parser()
    args, unknown = parser.parse_known_args(argv)
    if unknown:
        args.refuse(f"unrecognized arguments: {' '.join(unknown)}")
    try:
        code: int = _COMMANDS[args.command].run(args)
        sys.stdout.flush()
    except UsageError as error:
        return _give_up(args.command, str(error), exit_codes.USAGE)
    except KeyboardInterrupt:
        return _give_up(args.command, "broken off", exit_codes.BROKEN_OFF)
    except BrokenPipeError:  # who reads has seen enough: `conformance list | head`
        _silence_closed_pipe()
        return exit_codes.CANNOT_WRITE
    except OSError as error:
        _silence_closed_pipe()
        reason = f"cannot write {error.filename}: {error.strerror}" if error.filename else str(error)
        return _give_up(args.command, reason, exit_codes.CANNOT_WRITE)
    return code


def _give_up(command: str, reason: str, code: int) -> int:
    sys.stderr.write(f"conformance {command}: {reason}\n")
    return code


def _silence_closed_pipe() -> None:
    """Keep Python from trying again, at its end, to write what could not be written."""
    try:
        sys.stdout.flush()
    except OSError:
        sys.stdout = open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123, SIM115 - until the process ends


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
        subparser.set_defaults(refuse=subparser.error)
        command.configure(subparser)
    return parser


def _version() -> str:
    try:
        return metadata.version(_DISTRIBUTION)
    except metadata.PackageNotFoundError:
        return "(not installed)"


if __name__ == "__main__":
    sys.exit(main())
