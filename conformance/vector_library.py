"""Geometry and worlds that the vector files of a folder share."""

from __future__ import annotations

from functools import cached_property
from io import BytesIO
from typing import TYPE_CHECKING, Any, Final

from conformance.inputs import read_block
from conformance.json_lines import lines_of
from conformance.scenes.records import geometry_from_record
from conformance.vector_errors import DuplicateIdError, MalformedRecordError, VectorError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from pathlib import Path
    from typing import BinaryIO

    from conformance.scenes.model import Geometry

GEOMETRY_FILES: Final = ("geometries.jsonl", "geometries2.jsonl")
WORLD_FILE: Final = "worlds.jsonl"


class Library:
    """The shared records of one folder, read when first asked for.

    Parameters
    ----------
    folder : Path
        Where the files are.
    contents : mapping of str to bytes, optional
        What the shared files hold, by name; then the folder is not looked into.

    Attributes
    ----------
    folder : Path
        Where the files are. A file that is not there holds nothing.
    errors : list of VectorError
        The lines that could not be read so far; records that need them report a missing geometry.
    """

    def __init__(self, folder: Path, contents: Mapping[str, bytes] | None = None) -> None:
        self.folder = folder
        self._contents = contents
        self.errors: list[VectorError] = []

    @cached_property
    def geometries(self) -> Mapping[str, Geometry]:
        """Every geometry by its name."""
        found: dict[str, Geometry] = {}
        for name in GEOMETRY_FILES:
            self._read(name, found, lambda record: geometry_from_record(record, str(record["name"])))
        return found

    @cached_property
    def worlds(self) -> Mapping[str, dict[str, Any]]:
        """Every world's record by its name, numbers exact."""
        found: dict[str, dict[str, Any]] = {}
        self._read(WORLD_FILE, found, read_block)
        return found

    def _read(self, file: str, found: dict[str, Any], make: Callable[[dict[str, Any]], Any]) -> None:
        path = self.folder / file
        stream = self._open(path)
        if stream is None:
            return
        with stream:
            for line, record in self._named(stream, path, found):
                try:
                    found[record["name"]] = make(record)
                except ValueError as error:
                    self.errors.append(MalformedRecordError(str(error), file=path, line=line))

    def _open(self, path: Path) -> BinaryIO | None:
        if self._contents is not None:
            raw = self._contents.get(path.name)
            return None if raw is None else BytesIO(raw)
        return path.open("rb") if path.is_file() else None

    def _named(
        self, stream: BinaryIO, path: Path, found: Mapping[str, Any]
    ) -> Iterator[tuple[int, dict[str, Any]]]:
        for item in lines_of(stream, path):
            if isinstance(item, VectorError):
                self.errors.append(item)
                continue
            line, record = item
            name = record.get("name")
            if not isinstance(name, str):
                self.errors.append(MalformedRecordError("found no name", file=path, line=line))
            elif name in found:
                self.errors.append(
                    DuplicateIdError(f"{name!r} is there twice", file=path, line=line, record_id=name)
                )
            else:
                yield item
