"""Help for tests that use the shipped vector files."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import conformance
from conformance.vector_io import VectorRecord, read_vectors
from conformance.vector_library import GEOMETRY_FILES, WORLD_FILE, Library

VECTORS = Path(conformance.__file__).parent / "vectors"
FILES = tuple(
    sorted(path for path in VECTORS.glob("*.jsonl") if path.name not in {*GEOMETRY_FILES, WORLD_FILE})
)
assert len(FILES) == 19, f"vector files are missing from {VECTORS}"


@cache
def library() -> Library:
    """Return the shipped geometry, read once."""
    return Library(VECTORS)


@cache
def records(path: Path) -> tuple[VectorRecord, ...]:
    """Return every record of a shipped file, none of which may be malformed."""
    found = tuple(read_vectors(path, library()))
    good = tuple(item for item in found if isinstance(item, VectorRecord))
    assert good
    assert len(good) == len(found)
    return good


@cache
def one_of_each() -> tuple[VectorRecord, ...]:
    """Return the first shipped record of each operation and outcome."""
    first: dict[tuple[object, ...], VectorRecord] = {}
    for path in FILES:
        for record in records(path):
            expected = record.expected
            outcome = tuple(str(expected.get(key)) for key in ("result", "r", "dispatch", "poly", "changed"))
            present = tuple(key for key, value in expected.items() if value is not None)
            first.setdefault((record.query.op, outcome, present), record)
    assert len(first) > 150
    return tuple(first.values())
