"""Writing vector files: queries and their answers, in the format that `vector_io` reads."""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from conformance.files import write_bytes, write_text
from conformance.floats import shortest32
from conformance.inputs import is_float64_input
from conformance.outputs import OUTPUTS
from conformance.shapes import Block, Kind, Listing, Nullable, Scalar
from conformance.vector_library import GEOMETRY_FILES, WORLD_FILE, Library

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from pathlib import Path

    from conformance.query import Fields, Query
    from conformance.scenes.model import Geometry
    from conformance.shapes import Shape

_DIGEST_DIGITS: Final = 8
"""Hexadecimal digits of a geometry's or a world's digest in its name: enough for thousands of them."""
_SEPARATORS: Final = (",", ":")


class UnsuitablePlaceError(ValueError):
    """Something that is no file, where a file and others beside it are to be written."""

    def __init__(self, path: Path) -> None:
        beside = " and ".join([GEOMETRY_FILES[0], WORLD_FILE])
        super().__init__(
            f"found {path}, which is not a file, expected a file to write, in a folder for {beside}, too"
        )


def write_vectors(path: Path, records: Iterable[tuple[str, Query, Fields]]) -> int:
    """Write records and, beside them, the geometry and the worlds they use.

    Geometry and worlds are named by what they hold (their own name and a digest), so that writing the same
    scene again changes nothing and different scenes never share a name. What is there already stays.

    Parameters
    ----------
    path : Path
        The file to write; ``geometries.jsonl`` and ``worlds.jsonl`` are written or added to in its folder.
    records : iterable of (str, Query, Fields)
        Id, query and retail's answer.

    Returns
    -------
    int
        How many records were written.

    Raises
    ------
    UnsuitablePlaceError
        If `path` is there and is not a file; at once, as the next one.
    VectorError
        If the folder already has a shared file that cannot be read.
    OSError
        If something cannot be written.
    """
    known_geometries, known_worlds = _names_beside(path)
    shared = _Shared({}, {})
    lines = [_record(record_id, query, fields, shared) for record_id, query, fields in records]
    new = [geometry for name, geometry in shared.geometries.items() if name not in known_geometries]
    worlds = [world for name, world in shared.worlds.items() if name not in known_worlds]
    _add_lines(path.parent / GEOMETRY_FILES[0], new)
    if worlds:
        _add_lines(path.parent / WORLD_FILE, worlds)
    write_text(path, _text_of(lines))
    return len(lines)


def _names_beside(path: Path) -> tuple[set[str], set[str]]:
    """Return the geometries and worlds that a file's folder has already, before anything long is begun."""
    if path.exists() and not path.is_file():
        raise UnsuitablePlaceError(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    library = Library(path.parent)
    names = set(library.geometries), set(library.worlds)
    if library.errors:
        raise library.errors[0]
    return names


def geometry_record(geometry: Geometry) -> dict[str, Any]:
    """Write a geometry under its content name: numbers short, the name ending in a digest of the rest."""
    return _named(short_geometry(geometry))


def _named(record: dict[str, Any]) -> dict[str, Any]:
    """Return a record whose name ends in a digest of the rest."""
    rest = {key: value for key, value in record.items() if key != "name"}
    content = json.dumps(rest, separators=_SEPARATORS, sort_keys=True).encode("utf-8")
    digest = hashlib.sha256(content).hexdigest()[:_DIGEST_DIGITS]
    base = record["name"]
    return {**record, "name": base if base.endswith(f"-{digest}") else f"{base}-{digest}"}


def short_geometry(geometry: Geometry) -> dict[str, Any]:
    """Write a geometry under its own name, numbers short."""
    record: dict[str, Any] = short_inputs(geometry.to_record())
    return record


def short_inputs(value: Any, key: str = "") -> Any:
    """Copy inputs so that each float32 prints as its shortest decimal; NaN and infinity become strings."""
    if isinstance(value, float):
        return _printable(value if is_float64_input(key) else shortest32(value))
    if isinstance(value, dict):
        return {inner: short_inputs(item, inner) for inner, item in value.items()}
    if isinstance(value, list | tuple):
        return [short_inputs(item, key) for item in value]
    return value


def short_fields(op: str, fields: Fields) -> Fields:
    """Copy an answer so that each number prints as its shortest decimal; float64 fields stay whole."""
    short: Fields = _short(OUTPUTS[op], fields)
    return short


@dataclass(frozen=True, slots=True)
class _Shared:
    """The shared records that the records of a file name, by name."""

    geometries: dict[str, dict[str, Any]]
    worlds: dict[str, dict[str, Any]]


def _record(record_id: str, query: Query, fields: Fields, shared: _Shared) -> dict[str, Any]:
    names = {}
    for name, geometry in query.geometries.items():
        written = geometry_record(geometry)
        names[name] = written["name"]
        shared.geometries[written["name"]] = written
    inputs = _renamed(short_inputs(query.inputs), names)
    if "world" in inputs:
        world = _named(inputs["world"])
        shared.worlds[world["name"]] = world
        inputs["world"] = world["name"]
    return {"id": record_id, "op": query.op, **inputs, "expect": short_fields(query.op, fields)}


def _renamed(inputs: Any, names: Mapping[str, str]) -> Any:
    if isinstance(inputs, dict):
        return {
            key: names[value] if key == "geometry" and value is not None else _renamed(value, names)
            for key, value in inputs.items()
        }
    if isinstance(inputs, list):
        return [_renamed(item, names) for item in inputs]
    return inputs


def _short(shape: Shape, value: Any) -> Any:
    match shape:
        case Scalar(Kind.FLOAT64):
            return _printable(value)
        case Nullable(inner) if value is not None:
            return _short(inner, value)
        case Listing(item):
            return [_short(item, v) for v in value]
        case Block(fields):
            return {key: _short(fields[key], item) for key, item in value.items()}
        case _:
            return short_inputs(value)


def _printable(value: float) -> float | str:
    return value if math.isfinite(value) else str(value)


def _add_lines(path: Path, records: Sequence[Mapping[str, Any]]) -> None:
    """Add to a shared file; it is replaced whole, so that a full disk leaves no half of a record in it."""
    before = path.read_bytes() if path.exists() else b""
    if before and not before.endswith(b"\n"):
        before += b"\n"
    write_bytes(path, before + _text_of(records).encode())


def _text_of(records: Sequence[Mapping[str, Any]]) -> str:
    return "".join(
        json.dumps(record, separators=_SEPARATORS, ensure_ascii=False) + "\n" for record in records
    )
