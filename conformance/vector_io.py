"""Vector files as queries with expected answers."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from conformance.effort import check_effort
from conformance.fields import FieldError, UnknownOperationError, normalise
from conformance.inputs import geometry_names, read_inputs
from conformance.json_lines import lines_of
from conformance.query import Query
from conformance.vector_errors import (
    DuplicateIdError,
    MalformedRecordError,
    MissingGeometryError,
    VectorError,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path
    from typing import BinaryIO

    from conformance.query import Fields
    from conformance.scenes.model import Geometry
    from conformance.vector_library import Library

_NO_WORLDS: Final[Mapping[str, Any]] = MappingProxyType({})


@dataclass(frozen=True, slots=True, eq=False)
class VectorRecord:
    """One line of a vector file.

    Attributes
    ----------
    id : str
        The record's id, unique in its file.
    query : Query
        What to ask; its label is the id.
    expected : Fields
        Retail's answer.
    uncertain : str or None
        Why the answer is only advisory, or None where it is exact.
    line : int
        Line in the file, from 1.
    """

    id: str
    query: Query
    expected: Fields
    uncertain: str | None
    line: int


def read_vectors(path: Path, library: Library) -> Iterator[VectorRecord | VectorError]:
    """Yield every record of a file, or the located error that its line is; the rest goes on.

    Parameters
    ----------
    path : Path
        A JSON-lines file.
    library : Library
        The geometry and worlds that its records name: normally ``Library(path.parent)``.

    Raises
    ------
    OSError
        If the file cannot be read at all.
    """
    with path.open("rb") as stream:
        yield from records_of(stream, path, library)


def records_of(stream: BinaryIO, path: Path, library: Library) -> Iterator[VectorRecord | VectorError]:
    """Yield the records of an open file, which errors call `path`; see `read_vectors`."""
    seen: set[str] = set()
    for item in lines_of(stream, path):
        if isinstance(item, VectorError):
            yield item
            continue
        line, record = item
        try:
            yield _read_record(record, line, library, seen)
        except _RecordError as error:
            record_id = record.get("id")
            named = record_id if isinstance(record_id, str) else None
            yield error.located(str(error), file=path, line=line, record_id=named)


def query_from_record(
    record: Mapping[str, Any],
    geometries: Mapping[str, Geometry],
    *,
    worlds: Mapping[str, Any] = _NO_WORLDS,
    label: str = "",
) -> Query:
    """Read the operation and inputs of a record; its `expect` block, if any, is left alone.

    Parameters
    ----------
    record : Mapping
        The record, floats not yet rounded.
    geometries : Mapping of str to Geometry
        Where the geometry that it names is found.
    worlds : Mapping of str to Mapping
        Where its world is found; the query's `world` input is the world itself.
    label : str
        What messages call the query.

    Raises
    ------
    UnknownOperationError, FieldError
        For an operation or input that is not as FORMAT.md says, or asks for years of work.
    KeyError
        With the name of a geometry or world that is not there.
    """
    op = record.get("op")
    if not isinstance(op, str):
        raise FieldError("op", repr(op), "the name of an operation")
    inputs = read_inputs(op, record)
    if isinstance(inputs.get("world"), str):
        inputs["world"] = worlds[inputs["world"]]
    check_effort(inputs)
    named = {name: geometries[name] for name in geometry_names(inputs)}
    return Query(op=op, inputs=inputs, geometries=named, label=label)


class _RecordError(ValueError):
    def __init__(self, message: str, located: type[VectorError]) -> None:
        super().__init__(message)
        self.located = located


def _read_record(record: Mapping[str, Any], line: int, library: Library, seen: set[str]) -> VectorRecord:
    record_id = record.get("id")
    if not isinstance(record_id, str) or not record_id:
        raise _RecordError(f"id: found {record_id!r}, expected some text", MalformedRecordError)
    if record_id in seen:
        raise _RecordError(f"{record_id!r} is there twice", DuplicateIdError)
    seen.add(record_id)
    try:
        query = query_from_record(record, library.geometries, worlds=library.worlds, label=record_id)
        expected = normalise(query.op, record.get("expect", {}))
    except KeyError as error:
        message = f"{error.args[0]!r} is not in the shared files of {library.folder}"
        raise _RecordError(message, MissingGeometryError) from None
    except (UnknownOperationError, FieldError) as error:
        raise _RecordError(str(error), MalformedRecordError) from None
    return VectorRecord(record_id, query, expected, _doubt(record), line)


def _doubt(record: Mapping[str, Any]) -> str | None:
    """Return why a record is only advisory, or None."""
    reason = record.get("uncertain")
    if reason is not None and not isinstance(reason, str):
        raise _RecordError(f"uncertain: found {reason!r}, expected a reason as text", MalformedRecordError)
    return reason
