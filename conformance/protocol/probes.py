"""Queries whose answers are known: a few of the shipped ground truth for each operation of an engine."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance.protocol.features import undeclared
from conformance.vector_io import VectorRecord, read_vectors
from conformance.vector_library import GEOMETRY_FILES, WORLD_FILE, Library

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.protocol.messages import Capabilities

VECTORS: Final = Path(__file__).parents[1] / "vectors"
MOST_PROBES: Final = 4
"""Queries of each operation; their answers differ from each other."""


def find_probes(
    capabilities: Capabilities, say: Callable[[str], None], folder: Path
) -> Mapping[str, list[VectorRecord]]:
    """Find queries that an engine says it can answer.

    Parameters
    ----------
    capabilities : Capabilities
        What the engine says.
    say : callable
        Is told which file is read.
    folder : Path
        Where the vector files are.

    Returns
    -------
    Mapping of str to list of VectorRecord
        By operation; empty for one that the files do not ask.
    """
    found: dict[str, list[VectorRecord]] = defaultdict(list)
    library = Library(folder)
    for path in sorted(folder.glob("*.jsonl")):
        if path.name in {*GEOMETRY_FILES, WORLD_FILE}:
            continue
        say(f"reading {path.name}")
        for record in read_vectors(path, library):
            if isinstance(record, VectorRecord) and _is_new(record, found, capabilities):
                found[record.query.op].append(record)
    return found


def _is_new(
    record: VectorRecord, found: Mapping[str, list[VectorRecord]], capabilities: Capabilities
) -> bool:
    known = found.get(record.query.op, ())
    return (
        len(known) < MOST_PROBES
        and record.uncertain is None
        and undeclared(record.query, set(capabilities.ops), set(capabilities.features)) is None
        and all(record.expected != other.expected for other in known)
    )
