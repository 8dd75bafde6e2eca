"""Terminal output: plain text when piped, colour where a terminal wants it (NO_COLOR is respected)."""

from __future__ import annotations

import errno
import math
import os
import sys
import time
from typing import TYPE_CHECKING, Final, NoReturn, Self

from rich.console import Console

from conformance.files import UNWRITABLE

if TYPE_CHECKING:
    from types import TracebackType

    from rich.status import Status

_SILENT_SECONDS: Final = 2.0
"""A run shorter than this shows no progress."""


class _Console(Console):
    """A console whose reader may have gone away."""

    def on_broken_pipe(self) -> NoReturn:
        """Leave it to the command: rich would end the process with the exit code of a failure."""
        raise BrokenPipeError(errno.EPIPE, os.strerror(errno.EPIPE))


def make_console(*, stderr: bool = False) -> Console:
    """Return a console that prints text as it is: no markup, no wrapping, no guessed colours."""
    return _Console(stderr=stderr, highlight=False, markup=False, emoji=False, soft_wrap=True)


class Progress:
    """A line on the terminal's stderr that says what a long run is doing.

    Parameters
    ----------
    console : Console or None
        Where to say it; None: stderr.
    plain_seconds : float
        Where there is no terminal, a line is printed as often as this; by default never.
    """

    def __init__(self, console: Console | None = None, *, plain_seconds: float = math.inf) -> None:
        self._console = console or make_console(stderr=True)
        self._started = time.monotonic()
        self._status: Status | None = None
        self._plain_seconds = plain_seconds
        self._printed = self._started

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._status is not None:
            self._status.stop()

    def say(self, text: str) -> None:
        """Show `text` in place of what was shown before, once the run has become long."""
        now = time.monotonic()
        if not self._console.is_terminal:
            if now - self._printed >= self._plain_seconds:
                self._printed = now
                self._console.print(text)
            return
        if now - self._started < _SILENT_SECONDS:
            return
        if self._status is None:
            self._status = self._console.status(text)
            self._status.start()
        else:
            self._status.update(text)


def print_document(text: str) -> None:
    """Print what is for a file or another program: in UTF-8 with line feeds, on any system.

    Behind ``>`` Windows would write it in the console's old encoding, in which no reader here expects it.
    What is no character, as a byte of a file's name that is not UTF-8, is written as JSON escapes it.
    """
    stream = getattr(sys.stdout, "buffer", None)
    if stream is None or sys.stdout.isatty():
        sys.stdout.write(text)
        return
    sys.stdout.flush()
    rest = memoryview(text.encode("utf-8", UNWRITABLE))
    while rest:  # `python -u` has no buffer there, and such a stream may take less than it is given.
        rest = rest[stream.write(rest) :]
    stream.flush()


def tolerate_unprintable() -> None:
    """Let characters that the terminal's encoding lacks print as ``?`` instead of ending the run."""
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors="replace")
