"""What can be wrong with a vector file: typed, and located by file, line and column."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path


class VectorError(ValueError):
    """One line of a vector file that cannot be used; the other lines can.

    Attributes
    ----------
    file : Path
        The file.
    line, column : int
        Where, from 1.
    record_id : str or None
        The record's id, if it could be read.
    """

    def __init__(
        self, message: str, *, file: Path, line: int, column: int = 1, record_id: str | None = None
    ) -> None:
        self.message = message
        self.file = file
        self.line = line
        self.column = column
        self.record_id = record_id
        super().__init__(f"{file}:{line}:{column}: {message}")


class MalformedLineError(VectorError):
    """A line that is not UTF-8, not JSON, or not a JSON object."""


class MalformedRecordError(VectorError):
    """A record with an unknown operation, or an input or expected field that does not fit it."""


class MissingGeometryError(VectorError):
    """A record that names a geometry or world which no file beside it has."""


class DuplicateIdError(VectorError):
    """Two records, geometries or worlds of the same name."""
