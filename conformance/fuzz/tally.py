"""How many inputs a worker was given and accepted: a file that worker and watcher share.

A worker that is killed says nothing any more, and libFuzzer ends its process without Python's help. What is
written into shared memory is there however it ended.
"""

from __future__ import annotations

import mmap
import struct
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pathlib import Path

_COUNTS: Final = struct.Struct("<QQ")
"""Executions, and how many of them were accepted."""


class Tally:
    """The counts of one worker.

    Parameters
    ----------
    path : Path
        The file, made by `new_tally`.
    """

    def __init__(self, path: Path) -> None:
        with path.open("r+b") as file:
            self._memory: Final = mmap.mmap(file.fileno(), _COUNTS.size)
        self._executed, self._accepted = _COUNTS.unpack(self._memory)

    def count(self, *, accepted: bool) -> None:
        """Count an execution that has come to its end."""
        self._executed += 1
        self._accepted += accepted
        _COUNTS.pack_into(self._memory, 0, self._executed, self._accepted)


def new_tally(path: Path) -> None:
    """Write the file of a worker that was given nothing yet."""
    path.write_bytes(_COUNTS.pack(0, 0))


def read_tally(path: Path) -> tuple[int, int]:
    """Return how many inputs the worker was given so far, and how many it accepted."""
    executed, accepted = _COUNTS.unpack(path.read_bytes())
    return executed, accepted
