"""Lines that are sent to an engine: all of them, in order, and nobody waits for one who does not read."""

from __future__ import annotations

import os

from hypothesis import given, settings
from hypothesis import strategies as st

from conformance.protocol.outgoing import Outgoing

SECONDS = 20.0
"""Longer than any of this takes."""
MUCH = 1 << 20
"""More bytes than a pipe takes, on any system."""


def read_all(source: int) -> bytes:
    """Read a pipe to its end, and close it."""
    with os.fdopen(source, "rb") as pipe:
        return pipe.read()


def pair() -> tuple[Outgoing, int]:
    """Return who sends, and the end at which it arrives."""
    source, sink = os.pipe()
    return Outgoing(os.fdopen(sink, "wb")), source


@settings(max_examples=20)
@given(st.lists(st.sampled_from([b"a\n", b"b" * 4096, b"c" * MUCH]), max_size=5))
def test_all_arrives_in_order(parts: list[bytes]) -> None:
    """However much is sent at once, and whoever writes it."""
    outgoing, source = pair()
    for part in parts:
        outgoing.send(part)
    outgoing.end()
    assert read_all(source) == b"".join(parts)
    outgoing.join(SECONDS)


def test_nobody_waits_for_one_who_does_not_read() -> None:
    """Sending returns at once, and so does what follows."""
    outgoing, source = pair()
    outgoing.send(b"x" * MUCH)
    outgoing.send(b"y")
    outgoing.end()
    assert read_all(source) == b"x" * MUCH + b"y"


def test_who_is_gone_is_no_error_here() -> None:
    """The reader of its replies says so, with the exit status."""
    outgoing, source = pair()
    os.close(source)
    outgoing.send(b"hello\n")
    outgoing.send(b"x" * MUCH)
    outgoing.end()
    outgoing.join(SECONDS)
    assert outgoing._pipe.closed
    outgoing.send(b"more\n")
