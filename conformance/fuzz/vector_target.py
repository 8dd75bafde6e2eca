"""The target `vectors`: a vector file with the shared files beside it, from bytes to queries and answers."""

from __future__ import annotations

import json
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance.fields import normalise
from conformance.fuzz.finding import require
from conformance.vector_errors import VectorError
from conformance.vector_export import short_fields, short_inputs
from conformance.vector_io import query_from_record, records_of
from conformance.vector_library import GEOMETRY_FILES, WORLD_FILE, Library

if TYPE_CHECKING:
    from conformance.vector_io import VectorRecord

SEPARATOR: Final = b"\n--\n"
"""Between the records, the geometries and the worlds."""
FOLDER: Final = Path("fuzz")
_MOST_PARTS: Final = 3


def run(data: bytes) -> bool:
    """Read a vector file; return whether it holds a record.

    Raises
    ------
    FindingError
        A record that reads otherwise when it is written and read again, or an error without a place.
    """
    records, *shared = data.split(SEPARATOR, _MOST_PARTS - 1)
    names = (GEOMETRY_FILES[0], WORLD_FILE)
    library = Library(FOLDER, dict(zip(names, shared, strict=False)))
    read = list(records_of(BytesIO(records), FOLDER / "records.jsonl", library))
    for item in (*read, *library.errors):
        if isinstance(item, VectorError):
            require(item.message and item.line >= 1 and item.column >= 1, f"an error without a place: {item}")
        else:
            _write_and_read(item, library)
    return any(not isinstance(item, VectorError) for item in read)


def _write_and_read(record: VectorRecord, library: Library) -> None:
    """Check that what was read can be written, and then reads the same: no number lost or changed."""
    query = record.query
    inputs = json.loads(json.dumps(short_inputs(query.inputs), allow_nan=False))
    again = query_from_record({"op": query.op, **inputs}, library.geometries)
    require(repr(again.inputs) == repr(dict(query.inputs)), f"inputs read again as {again.inputs!r}")
    written = json.loads(json.dumps(short_fields(query.op, record.expected), allow_nan=False))
    expected = normalise(query.op, written)
    require(repr(expected) == repr(record.expected), f"expect read again as {expected!r}")
