"""The lines that are sent to an engine: as many as its pipe takes at once, the rest by a thread."""

from __future__ import annotations

import contextlib
import os
import queue
import selectors
import sys
import threading
from typing import IO


class Outgoing:
    """Sends lines to an engine that need not read them.

    A thread could write everything; but it would wait until the interpreter lets it, milliseconds after the
    engine could have begun. So it writes only what is left, where a pipe can be asked to take what it has
    room for. On Windows it cannot.

    Parameters
    ----------
    pipe : file
        Is closed by the thread.
    """

    def __init__(self, pipe: IO[bytes]) -> None:
        self._pipe = pipe
        self._left: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._given = 0
        self._written = 0
        if sys.platform != "win32":
            os.set_blocking(pipe.fileno(), False)
        self._thread = threading.Thread(target=self._write_rest, daemon=True)
        self._thread.start()

    def send(self, lines: bytes) -> None:
        """Write lines, some time; that the engine is gone is for its reader to notice."""
        if sys.platform != "win32" and self._given == self._written:
            lines = lines[_write_some(self._pipe, lines) :]
        if lines:
            self._given += 1
            self._left.put(lines)

    def end(self) -> None:
        """Close the pipe, after what was sent."""
        self._left.put(None)

    def join(self, seconds: float) -> None:
        """Wait until it is closed, but not longer than some seconds."""
        self._thread.join(seconds)

    def _write_rest(self) -> None:
        with contextlib.suppress(OSError), self._pipe:
            while (lines := self._left.get()) is not None:
                _write_all(self._pipe, lines)
                self._written += 1


def _write_some(pipe: IO[bytes], lines: bytes) -> int:
    """Return how many bytes there was room for."""
    try:
        return os.write(pipe.fileno(), lines)
    except BlockingIOError:
        return 0
    except (OSError, ValueError):  # a broken pipe, or one that the thread has closed
        return len(lines)


def _write_all(pipe: IO[bytes], lines: bytes) -> None:
    with selectors.DefaultSelector() as room:
        if sys.platform != "win32":  # where pipes cannot be waited for, writing waits
            room.register(pipe, selectors.EVENT_WRITE)
        while lines:
            if sys.platform != "win32":
                room.select()
            lines = lines[os.write(pipe.fileno(), lines) :]
