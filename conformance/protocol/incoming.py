"""The lines that an engine writes, taken from its pipe by a thread."""

from __future__ import annotations

import contextlib
import os
import queue
import threading
import time
from collections import deque
from typing import IO, Final

from conformance.protocol.messages import MOST_BYTES

_CHUNK: Final = 1 << 16
"""Most bytes that are taken from the pipe at once: many lines then cost one hand-over."""
_MOST_WAITING: Final = 16
"""Chunks that wait to be split into lines; an engine that writes more has to wait itself."""
_PAUSE: Final = 0.01
"""Seconds after which it is looked again whether there is room, or whether the thread has ended."""


class ReadTimeoutError(Exception):
    """The engine has not written a line in time.

    Attributes
    ----------
    begun : bytes
        What it has written of one.
    """

    def __init__(self, begun: bytes) -> None:
        self.begun = begun
        super().__init__(f"no whole line in time, {len(begun)} bytes of one")


class Incoming:
    """Reads lines ahead, so that nobody has to wait for an engine longer than he wants.

    Parameters
    ----------
    pipe : file
        Is read, and closed at its end, by a thread of its own.
    """

    def __init__(self, pipe: IO[bytes]) -> None:
        self._chunks: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._lines: deque[bytes] = deque()
        self._begun = bytearray()  # a line whose end has not come yet
        self._ended = False
        self._thread = threading.Thread(target=_read, args=(pipe, self._chunks), daemon=True)
        self._thread.start()

    def next_line(self, seconds: float) -> bytes:
        """Return the next line with its end, or nothing if there is none any more.

        What stands after the last line end, and the beginning of a line that is too long to be a reply, are
        returned as lines without an end.

        Raises
        ------
        ReadTimeoutError
            If the line is not whole in time.
        """
        if self._lines:
            return self._lines.popleft()
        deadline = time.monotonic() + seconds
        while not (self._lines or self._ended or len(self._begun) > MOST_BYTES):
            self._take(deadline - time.monotonic())
        return self._lines.popleft() if self._lines else self._taken_out()

    def close(self, seconds: float) -> None:
        """Let the thread end, which takes the pipe's other end to be closed, and what is in it to be read.

        A program that has left its engine's group may hold that end open for ever: it is not waited for any
        longer than so many seconds.
        """
        deadline = time.monotonic() + seconds
        while self._thread.is_alive() and time.monotonic() < deadline:
            with contextlib.suppress(queue.Empty):
                self._chunks.get_nowait()
            self._thread.join(_PAUSE)

    def _take(self, seconds: float) -> None:
        try:
            chunk = self._chunks.get(timeout=max(seconds, 0.0))
        except queue.Empty:
            raise ReadTimeoutError(bytes(self._begun)) from None
        self._ended = not chunk
        self._begun += chunk
        if b"\n" in chunk:
            *whole, rest = bytes(self._begun).split(b"\n")
            self._lines.extend([line + b"\n" for line in whole])
            self._begun[:] = rest

    def _taken_out(self) -> bytes:
        line = bytes(self._begun)
        self._begun.clear()
        return line


def _read(pipe: IO[bytes], chunks: queue.SimpleQueue[bytes]) -> None:
    with pipe:
        while chunk := os.read(pipe.fileno(), _CHUNK):
            chunks.put(chunk)
            while chunks.qsize() >= _MOST_WAITING:
                time.sleep(_PAUSE)
    chunks.put(b"")
