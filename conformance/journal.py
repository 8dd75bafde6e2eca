"""Journals of long runs: JSON lines that are only ever added to, so that a run that was ended goes on.

A run may be killed, or its disk be full, while it writes a line: that line then has no end, and is left out.
"""

from __future__ import annotations

import json
from io import BytesIO
from typing import TYPE_CHECKING, Any

from conformance.json_lines import lines_of
from conformance.vector_errors import VectorError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from io import FileIO
    from pathlib import Path
    from typing import Self


class JournalError(Exception):
    """A file that is to be gone on with is not a journal of this kind; says where, and what is expected."""


def read_journal(path: Path) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield the number and the object of every whole line.

    Raises
    ------
    JournalError
        A line is no JSON object.
    OSError
        The file cannot be read.
    """
    for item in lines_of(BytesIO(_whole_lines(path.read_bytes())), path):
        if isinstance(item, VectorError):
            raise JournalError(f"not a journal: {item}")
        yield item


class JournalWriter:
    """Adds lines to a journal; each has left this process before the next thing is done.

    Parameters
    ----------
    path : Path
        The file; its folder is made if it is not there.
    anew : bool
        Whether to begin an empty file. Otherwise what it holds is kept, but for a line without its end.

    Raises
    ------
    OSError
        It cannot be written.
    """

    def __init__(self, path: Path, *, anew: bool) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        # Unbuffered: of what could not be written, nothing is left for `close` to try again.
        self._file: FileIO = path.open("wb" if anew else "ab", buffering=0)
        if not anew:
            self._file.truncate(len(_whole_lines(path.read_bytes())))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_ended_by: object) -> None:
        self.close()

    def close(self) -> None:
        """End; nothing is left to be written."""
        self._file.close()

    def write(self, record: Mapping[str, Any]) -> None:
        """Add one line."""
        text = json.dumps(record, ensure_ascii=False)
        left = text.encode("utf-8", "replace") + b"\n"  # an engine may have said half a character
        while left:  # a disk that is nearly full takes a part
            left = left[self._file.write(left) :]


def _whole_lines(raw: bytes) -> bytes:
    return raw[: raw.rfind(b"\n") + 1]
