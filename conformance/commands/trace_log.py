"""`conformance trace-log`: what the writes in an engine's log say."""

from __future__ import annotations

import argparse
import codecs
import io
import math
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError

if TYPE_CHECKING:
    from typing import TextIO

    from conformance.trace_log import LogReport, Rule

HELP: Final = "count the writes in an engine's log by caller and plane, and find the suspect ones"
EXAMPLES: Final = (
    "conformance trace-log client.log",
    "conformance trace-log client.log --radius 0.48 --step-height 1.5",
)
_RULE: Final = """\
With ' foot=(x,y,z)' at the end of a line, a plane is suspect if it is further from that point than
radius + step height. Without, if its D differs by more than that from the plane before it and both
normals are nearly the same (cosine at least 0.999); the plane before it is what the line says is
replaced or, if that is none, the last one written to the same field. A plane with an infinity or a NaN
is always suspect. A suspect write need not be wrong: look at it.

Lines that do not begin with a tag are ignored; lines that do and cannot be read are mistakes.
Exit codes: 0 no suspect write, 1 suspect writes or mistakes, 2 usage, 4 no trace line found.
"""
_RADIUS: Final = 0.48
"""Radius of a player's sphere, metres."""
_STEP_HEIGHT: Final = 1.5
"""Largest step of a player, metres, down or up."""
_UTF16_MARKS: Final = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a log of any length, UTF-8 or UTF-16")
    rule = parser.add_argument_group("suspect writes", _RULE)
    rule.add_argument(
        "--radius", type=_metres, default=_RADIUS, metavar="M", help="of the mover (default: %(default)s)"
    )
    rule.add_argument(
        "--step-height",
        type=_metres,
        default=_STEP_HEIGHT,
        metavar="M",
        help="of the mover (default: %(default)s)",
    )


def run(args: argparse.Namespace) -> int:
    """Print what the log holds and return the exit code."""
    from conformance.console import make_console
    from conformance.report.traces import log_lines
    from conformance.trace_log import Rule

    rule = Rule(args.radius, args.step_height)
    report = _read(args.file, rule)
    console = make_console()
    for line in log_lines(str(args.file), report, rule):
        console.print(line)
    if report.malformed or report.suspect:
        return exit_codes.FAILURES
    if not report.writes:
        console.print("no trace line was found", style="yellow")
        return exit_codes.NOTHING_RAN
    return exit_codes.OK


def _metres(text: str) -> float:
    number = float(text)
    if not (number >= 0.0 and math.isfinite(number)):
        raise argparse.ArgumentTypeError(f"{text} is not a length in metres")
    return number


def _read(path: Path, rule: Rule) -> LogReport:
    from conformance.trace_log import bounded_lines, read_log

    try:
        with _open(path) as stream:
            return read_log(bounded_lines(stream), rule)
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror or error}") from error


def _open(path: Path) -> TextIO:
    """Open a log, once: it may be a pipe. What PowerShell redirects to a file is UTF-16."""
    stream = path.open("rb")
    encoding = "utf-16" if stream.peek(2)[:2] in _UTF16_MARKS else "utf-8-sig"
    return io.TextIOWrapper(stream, encoding=encoding, errors="replace")
