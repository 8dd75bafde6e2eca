"""Help for tests that ask `faux_engine.py`, and engines of this package, over the protocol."""

from __future__ import annotations

import sys
from pathlib import Path

from conformance.candidates.command_candidate import CommandCandidate
from conformance.protocol.process import command_line
from conformance.query import Query, Result

ENGINE = Path(__file__).with_name("faux_engine.py")
ROOT = Path(__file__).parents[2]
EAST = tuple(range(1, 7))
"""How many blocks each of the queries goes east."""
SECONDS = 20.0
"""Long enough for a machine that does much else."""


def command_of(*words: object) -> str:
    """Return words as one command line of this platform."""
    return command_line([str(word) for word in words])


def faux_command(mode: str, *at: int) -> str:
    """Return the command of the faux engine in a mode."""
    return command_of(sys.executable, "-I", "-S", ENGINE, mode, *at)


def serve_command(*options: str) -> str:
    """Return the command of this package's own engines."""
    program = (
        f"import sys; sys.path.insert(0, {str(ROOT)!r}); from conformance.cli import main; sys.exit(main())"
    )
    return command_of(sys.executable, "-c", program, "serve", *options)


def faux(mode: str, *at: int, read_timeout: float = SECONDS) -> CommandCandidate:
    """Return the faux engine as a candidate."""
    return CommandCandidate(faux_command(mode, *at), read_timeout=read_timeout)


def queries() -> list[Query]:
    """Return queries that differ in their answers; the first has the sequence number 1."""
    return [
        Query(
            "block_offset", {"from_cell": 0x01010001, "to_cell": 0x01010001 + (east << 24)}, label=f"q{east}"
        )
        for east in EAST
    ]


def right(query: Query) -> Result:
    """Return the right answer to one of the queries."""
    return Result({"v": [192.0 * int(query.label[1:]), 0.0, 0.0]})
