"""Writing files whole: what was there before stays until all that is new has reached the disk."""

from __future__ import annotations

import errno
import os
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Final

UNWRITABLE: Final = "backslashreplace"
"""What becomes of characters that UTF-8 lacks."""


def write_text(path: Path, text: str) -> None:
    """Write a text file, in UTF-8 with line feeds, as `write_bytes` does.

    What is no character, as a byte of a file's name that is not UTF-8, is written as JSON escapes it.
    """
    write_bytes(path, text.encode("utf-8", UNWRITABLE))


def check_writable(path: Path) -> None:
    """Find out whether `write_bytes` will be able to write a file, before the work that is for it is done.

    Its folder is made, and the file left as it is.

    Raises
    ------
    OSError
        It cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    if path.is_file() or not path.exists():
        try:
            tempfile.TemporaryFile(dir=path.resolve().parent).close()
        except OSError as error:
            raise OSError(error.errno, error.strerror, str(path)) from error


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file; its folder is made if it is not there.

    On a full disk, or when the process is killed, the old file stays as it was and no half of a new one is
    left under its name.

    Parameters
    ----------
    path : Path
        Where to; a device or a pipe is written to directly.
    content : bytes
        All of it.

    Raises
    ------
    OSError
        It cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.exists() and not path.is_file():
        path.write_bytes(content)
        return
    place = path.resolve()  # of a link, what it leads to is replaced
    handle, name = tempfile.mkstemp(prefix=f".{place.name}.", dir=place.parent)
    scratch = Path(name)
    try:
        with open(handle, "wb") as stream:  # noqa: PTH123 - a handle
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        scratch.chmod(place.stat().st_mode & 0o777 if place.exists() else 0o666 & ~_umask())
        scratch.replace(place)
    except BaseException:
        with suppress(OSError):
            scratch.unlink()
        raise


def _umask() -> int:
    """Return the mask of new files, which can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
