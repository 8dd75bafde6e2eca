"""Lines that an engine writes: whole, in order, however they come, and not waited for too long."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from conformance.protocol import incoming
from conformance.protocol.incoming import Incoming, ReadTimeoutError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

SECONDS = 20.0
"""Longer than any of this takes."""


class Piped:
    """A pipe with somebody who reads its lines."""

    def __init__(self) -> None:
        source, self.sink = os.pipe()
        self.incoming = Incoming(os.fdopen(source, "rb", buffering=0))

    def write(self, *pieces: bytes) -> None:
        """Write pieces one by one."""
        for piece in pieces:
            os.write(self.sink, piece)

    def end(self) -> None:
        """Close the writing end."""
        os.close(self.sink)
        self.sink = -1

    def close(self) -> None:
        """End everything."""
        if self.sink >= 0:
            self.end()
        self.incoming.close(SECONDS)


@pytest.fixture
def piped() -> Iterator[Piped]:
    """Return a pipe; nothing of it is left afterwards."""
    made = Piped()
    yield made
    made.close()


@given(st.lists(st.binary(max_size=20).map(lambda raw: raw.replace(b"\n", b".")), max_size=8), st.data())
def test_lines_come_as_they_were_written(lines: Sequence[bytes], data: st.DataObject) -> None:
    """Wherever the pieces are cut; CR and what else may look like a line end is part of a line."""
    text = b"".join(line + b"\n" for line in lines)
    cuts = sorted(data.draw(st.lists(st.integers(0, len(text)), max_size=4)))
    made = Piped()
    made.write(*(text[a:b] for a, b in zip([0, *cuts], [*cuts, len(text)], strict=True) if a < b))
    made.end()
    assert [made.incoming.next_line(SECONDS) for _ in lines] == [line + b"\n" for line in lines]
    assert made.incoming.next_line(SECONDS) == b""
    made.close()


def test_the_end_stays_the_end(piped: Piped) -> None:
    """What has no line end is told as it is, once; then there is nothing, as often as one asks."""
    piped.write(b"whole\nhalf")
    piped.end()
    told = [piped.incoming.next_line(SECONDS) for _ in range(4)]
    assert told == [b"whole\n", b"half", b"", b""]


def test_half_a_line_is_not_a_line_in_time(piped: Piped) -> None:
    """It is not lost either: the rest may come later."""
    piped.write(b'{"seq":')
    with pytest.raises(ReadTimeoutError):
        piped.incoming.next_line(0.05)
    piped.write(b"1}\n")
    assert piped.incoming.next_line(SECONDS) == b'{"seq":1}\n'


def test_a_line_without_end_is_not_collected_for_ever(piped: Piped, monkeypatch: pytest.MonkeyPatch) -> None:
    """As soon as it is too long to be a reply it is handed out."""
    monkeypatch.setattr(incoming, "MOST_BYTES", 100)
    piped.write(b"x" * 101)
    assert piped.incoming.next_line(SECONDS) == b"x" * 101


def test_who_writes_too_much_must_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    """What was not fetched is bounded, and closing throws it away."""
    monkeypatch.setattr(incoming, "_MOST_WAITING", 2)
    monkeypatch.setattr(incoming, "_CHUNK", 8)
    made = Piped()
    made.write(b"1234567\n" * 100)
    assert made.incoming.next_line(SECONDS) == b"1234567\n"
    assert made.incoming._chunks.qsize() <= 2
    made.close()
    assert not made.incoming._thread.is_alive()


def test_who_holds_the_pipe_open_is_not_waited_for(piped: Piped) -> None:
    """A program that an engine has started may outlive it, and have its stdout."""
    piped.incoming.close(0.05)
    assert piped.incoming._thread.is_alive()
    piped.end()
    piped.incoming._thread.join(SECONDS)
    assert not piped.incoming._thread.is_alive()
