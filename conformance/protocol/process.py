"""An engine's process: lines to its stdin and from its stdout, its log, and its end.

Pipes are read and written by threads, on every platform the same, so that an engine that does not read, does
not write, or writes too much can neither stop the suite nor fill its memory.
"""

from __future__ import annotations

import contextlib
import os
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import weakref
from pathlib import Path
from typing import IO, TYPE_CHECKING, Final, cast

from conformance.protocol.incoming import Incoming
from conformance.protocol.outgoing import Outgoing

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

_LOG_BYTES: Final = 1 << 14
"""How much of the end of an engine's stderr is kept."""
_LOG_CHUNK: Final = 1 << 12
_EXIT_SECONDS: Final = 2.0
"""How long a process that was killed, and the threads that served it, may take to end."""
_TASKKILL: Final = "taskkill"


class CommandError(ValueError):
    """A command line that is empty, or whose quotation marks do not match."""


class ProcessStartError(Exception):
    """The engine's program cannot be run."""


class EngineProcess:
    """A running engine.

    Parameters
    ----------
    command : str
        Program and arguments, as one would type them; no shell is involved.

    Raises
    ------
    CommandError, ProcessStartError
    """

    def __init__(self, command: str) -> None:
        self._process = _spawn(command)
        self._unsent: list[bytes] = []
        self._log = bytearray()
        self._logger = _thread(_read_log, self._process.stderr, self._log)
        self._incoming = Incoming(cast("IO[bytes]", self._process.stdout))
        self._outgoing = Outgoing(cast("IO[bytes]", self._process.stdin))
        self._finalizer = weakref.finalize(self, _kill_tree, self._process)

    def send(self, line: bytes) -> None:
        """Write a line, some time; if the engine is gone, its end is noticed by `receive`."""
        self._unsent.append(line)

    def flush(self) -> None:
        """Write what was sent: many lines at once, as each write wakes a thread and the engine."""
        if self._unsent:
            self._outgoing.send(b"".join(self._unsent))
            self._unsent.clear()

    def receive(self, seconds: float) -> bytes:
        """Return the next line that the engine writes, or nothing if it has ended.

        Raises
        ------
        ReadTimeoutError
            If it writes none in time.
        """
        self.flush()
        return self._incoming.next_line(seconds)

    def close_input(self) -> None:
        """Let the engine see the end of its stdin, after what was sent."""
        self.flush()
        self._outgoing.end()

    def wait(self, seconds: float) -> int | None:
        """Return the exit status, or None if the engine runs on."""
        try:
            return self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            return None

    def kill(self) -> None:
        """End the engine and whatever it has started, and the threads that served it."""
        self._finalizer()
        self._outgoing.end()
        self._incoming.close(_EXIT_SECONDS)
        self._outgoing.join(_EXIT_SECONDS)
        self._logger.join(_EXIT_SECONDS)

    def log(self) -> str:
        """Return the end of what the engine has written to stderr."""
        if self._process.poll() is not None:
            self._logger.join(_EXIT_SECONDS)
        return bytes(self._log).decode("utf-8", errors="replace").replace("\r\n", "\n").rstrip("\n")


def split_command(command: str) -> list[str] | str:
    """Return what starts a command: its words, or on Windows the command itself, whose program splits it.

    Raises
    ------
    CommandError
    """
    if not command.strip():
        raise CommandError("found no command, expected a program, as in cmd:./my-engine")
    try:
        return command if sys.platform == "win32" else shlex.split(command)
    except ValueError as error:
        raise CommandError(f"{command!r}: {error}") from None


def check_program(command: str) -> None:
    """Raise `CommandError` if a command cannot be read, or names no program that can be run here."""
    words = split_command(command)
    names = _programs(words) if isinstance(words, str) else words[:1]
    if not any(shutil.which(name, path=_search_path()) for name in names):
        raise CommandError(f"found no program {names[0]!r} that can be run, in the command {command!r}")


def _programs(command: str) -> list[str]:
    """Return what a command's program may be called on Windows, which tries how far a bare name goes."""
    if command.startswith('"'):
        return [command[1:].partition('"')[0]]
    words = command.split(" ")
    return [" ".join(words[:n]) for n in range(1, len(words) + 1)]


def _search_path() -> str | None:
    """Return where programs are searched for, if not only on the path: Windows begins beside who asks."""
    beside = str(Path(sys.executable).parent)
    path = os.environ.get("PATH", os.defpath)
    return os.pathsep.join((beside, path)) if sys.platform == "win32" else None


def command_line(words: Sequence[str]) -> str:
    """Return words as one command, as `split_command` takes it on this platform."""
    return subprocess.list2cmdline(words) if sys.platform == "win32" else shlex.join(words)


def describe_exit(status: int | None) -> str:
    """Say how a process has ended."""
    if status is None:
        return "closed its stdout and runs on"
    if status < 0:
        with contextlib.suppress(ValueError):
            return f"was ended by {signal.Signals(-status).name}"
    shown = f"{status}" if status < 256 else f"0x{status:08X}"  # Windows: an NTSTATUS
    return f"ended with exit status {shown}"


def _spawn(command: str) -> subprocess.Popen[bytes]:
    words = split_command(command)
    flags = 0
    if sys.platform == "win32":
        flags = subprocess.CREATE_NEW_PROCESS_GROUP
    try:
        return subprocess.Popen(  # noqa: S603 - the user names the engine that is to be run
            words,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=sys.platform != "win32",  # a group of its own, which can be ended as one
            creationflags=flags,
        )
    except OSError as error:
        raise ProcessStartError(f"cannot run {command!r}: {error.strerror or error}") from error


def _thread(serve: Callable[..., None], *arguments: object) -> threading.Thread:
    thread = threading.Thread(target=serve, args=arguments, daemon=True)
    thread.start()
    return thread


def _read_log(stderr: IO[bytes], log: bytearray) -> None:
    with stderr:
        while chunk := os.read(stderr.fileno(), _LOG_CHUNK):
            log += chunk
            del log[:-_LOG_BYTES]


def _kill_tree(process: subprocess.Popen[bytes]) -> None:
    """End a process and its children; also at the end of the suite, however that comes."""
    if process.returncode is not None:
        return  # its number may be another's by now
    if sys.platform == "win32":
        subprocess.run(  # noqa: S603 - a number
            [_TASKKILL, "/T", "/F", "/PID", str(process.pid)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            check=False,
        )
    else:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(_EXIT_SECONDS)
