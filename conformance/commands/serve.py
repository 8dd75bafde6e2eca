"""`conformance serve`: answer the protocol on stdin and stdout with a candidate of this package."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import add_candidate_option, candidate_from

if TYPE_CHECKING:
    import argparse
    from typing import BinaryIO

HELP: Final = "answer protocol v1 on stdin and stdout: the other end of --candidate cmd:..."
EXAMPLES: Final = (
    'pytest conformance --candidate "cmd:conformance serve"',
    'conformance verify conformance/vectors/bsp.jsonl --candidate "cmd:conformance serve --candidate oracle"',
    "conformance smoke conformance serve --floats hex",
    "conformance serve --schema > protocol.schema.json",
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_candidate_option(parser, default="engine")
    parser.add_argument(
        "--floats",
        choices=("decimal", "hex"),
        default="decimal",
        help="write floats as short decimals or as their bits (default: %(default)s)",
    )
    parser.add_argument(
        "--schema", action="store_true", help="only print the JSON Schema of what is said and answered"
    )


def run(args: argparse.Namespace) -> int:
    """Answer until a message says stop, or stdin ends."""
    from conformance.console import print_document
    from conformance.protocol.json_schema import published_schema
    from conformance.protocol.server import Server

    if args.schema:
        print_document(published_schema())
        return exit_codes.OK
    server = Server(candidate_from(args), args.floats)
    with _take_stdout() as replies:
        server.serve(sys.stdin.buffer, replies)
    return exit_codes.OK


def _take_stdout() -> BinaryIO:
    """Keep stdout for replies: whatever else is printed, by this process or below it, is log."""
    replies = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    return replies
