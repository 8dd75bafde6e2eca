"""Vector files: exact numbers, located errors, and writing what reads back."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import pytest
from shipped_cases import shipped_cases
from shipped_vectors import VECTORS, library, one_of_each, records

from conformance.compare import differences
from conformance.fields import FieldError, UnknownOperationError
from conformance.floats import bits32
from conformance.inputs import geometry_names, read_inputs
from conformance.vector_errors import (
    DuplicateIdError,
    MalformedLineError,
    MalformedRecordError,
    MissingGeometryError,
    VectorError,
)
from conformance.vector_export import UnsuitablePlaceError, geometry_record, write_vectors
from conformance.vector_io import VectorRecord, query_from_record, read_vectors
from conformance.vector_library import Library

if TYPE_CHECKING:
    from pathlib import Path

GOOD = {"id": "a", "op": "block_offset", "from_cell": 1, "to_cell": 2, "expect": {"v": [0, 0, 0]}}
PLANE = {
    "id": "p",
    "op": "polygon_make_plane",
    "geometry": "room_01",
    "poly": 0,
    "expect": {"plane": [0, 0, 1, 0]},
}


def write(path: Path, *lines: object) -> Path:
    """Write lines to a file: bytes as they are, everything else as JSON."""
    raw = (line if isinstance(line, bytes) else json.dumps(line).encode() for line in lines)
    path.write_bytes(b"\n".join(raw) + b"\n")
    return path


def read(path: Path) -> list[VectorRecord | VectorError]:
    """Read a vector file with the shared files beside it."""
    return list(read_vectors(path, Library(path.parent)))


def test_a_shipped_record() -> None:
    """A record becomes a query with float32 inputs, its geometry, and the expected answer."""
    first = records(VECTORS / "find_collisions.jsonl")[0]
    assert (first.id, first.line, first.uncertain) == ("fc_00000", 1, None)
    assert first.query.op == "find_collisions"
    assert first.query.label == "fc_00000"
    assert "expect" not in first.query.inputs
    assert "tag" not in first.query.inputs
    assert first.query.inputs["mover"]["spheres"] == [[0.0, 0.0, 0.0, 0.47999998927116394]]
    assert list(first.query.geometries) == ["seed_tri"]
    assert first.query.geometries["seed_tri"].tree.sphere[3] == 14.142287254333496
    assert first.expected["walkable_allowance"] == 0.6641741394996643


def test_uncertain_records_are_marked() -> None:
    """A record that could not be restored with certainty says why."""
    reasons = {record.uncertain for record in records(VECTORS / "bsp.jsonl")}
    assert reasons == {None, "perfect_clip_search"}


def test_worlds_stand_in_for_their_names() -> None:
    """The query of a world carries the world, and the geometry that it uses."""
    first = records(VECTORS / "world_transition.jsonl")[0]
    world = first.query.inputs["world"]
    assert world is library().worlds[world["name"]]
    assert set(geometry_names(world)) <= set(first.query.geometries)


def test_numbers_of_inputs() -> None:
    """Floats are rounded, also where a whole number is given; times stay float64, ids stay ints."""
    inputs = read_inputs(
        "set_velocity",
        {
            "body": {"velocity": [0.1, 1, "inf"], "state": 1},
            "v": [1, 2, 3],
            "update_time": 0.1,
            "cur_time": 1,
        },
    )
    assert bits32(inputs["body"]["velocity"][0]) == 0x3DCCCCCD
    assert inputs["body"]["velocity"][1:] == [1.0, math.inf]
    assert all(isinstance(part, float) for part in inputs["v"])
    assert inputs["update_time"] == 0.1
    assert isinstance(inputs["cur_time"], float)
    assert isinstance(inputs["body"]["state"], int)


@pytest.mark.parametrize(
    ("change", "path", "found"),
    [
        ({"from_cell": None}, "to_cell", "nothing"),
        ({"to_cell": 1, "from_sell": 2}, "from_sell", "an unknown input"),
        ({"to_cell": 1.5}, "to_cell", "1.5 (float)"),
    ],
)
def test_wrong_inputs(change: dict[str, Any], path: str, found: str) -> None:
    """An input that is missing, unknown or of another kind is refused with its path."""
    with pytest.raises(FieldError) as caught:
        read_inputs("block_offset", {"from_cell": 1, **change})
    assert (caught.value.path, caught.value.found) == (path, found)


NOTHING = {"landblocks": [], "cells": [], "buildings": [], "objects": [], "shadow": {}}


@pytest.mark.parametrize(
    ("change", "path", "found"),
    [
        ({"shadow": {"0xA9B40031": []}}, "world.shadow", "the key '0xA9B40031'"),
        ({"shadow": {"4294967296": []}}, "world.shadow", "the key '4294967296'"),
        ({"shadow": {"1": 7}}, "world.shadow.1", "the number 7"),
        ({"shadow": []}, "world.shadow", "a list of 0"),
    ],
    ids=["hexadecimal", "33 bits", "no list", "no block"],
)
def test_wrong_shadow_lists(change: dict[str, Any], path: str, found: str) -> None:
    """The keys of a world's shadow lists are ids of cells, as JSON's keys are texts in decimal."""
    asked = {"cell": 1, "point": [0, 0, 0]}
    with pytest.raises(FieldError) as caught:
        read_inputs("point_in_cell", {"world": {**NOTHING, **change}, **asked})
    assert (caught.value.path, caught.value.found) == (path, found)


@pytest.mark.parametrize("key", NOTHING)
def test_a_world_that_lacks_something(key: str) -> None:
    """It may do without a name, which it is given, and without nothing else."""
    asked = {"cell": 1, "point": [0, 0, 0]}
    rest = {other: value for other, value in NOTHING.items() if other != key}
    with pytest.raises(FieldError, match=f"world.{key}: found nothing"):
        read_inputs("point_in_cell", {"world": rest, **asked})
    assert read_inputs("point_in_cell", {"world": NOTHING, **asked})["world"] == {"name": "world", **NOTHING}


def test_an_unknown_input_hints_at_the_nearest() -> None:
    """A mistyped input names the one that was meant."""
    with pytest.raises(FieldError, match="perhaps 'from_cell'"):
        read_inputs("block_offset", {"from_cell": 1, "to_cell": 2, "fromm_cell": 2})
    with pytest.raises(FieldError, match="an unknown input, expected perhaps 'from_cell'"):
        read_inputs("block_offset", {"to_cell": 2, "fromm_cell": 2})


def test_a_query_needs_an_operation() -> None:
    """No op, or one that does not exist."""
    with pytest.raises(FieldError, match="the name of an operation"):
        query_from_record({}, {})
    with pytest.raises(UnknownOperationError, match="did you mean 'walk'"):
        query_from_record({"op": "wakl"}, {})


@pytest.mark.parametrize(
    ("line", "kind", "column", "message"),
    [
        (b'{"id": "x", }', MalformedLineError, 13, "not JSON: Expecting property name"),
        (b'{"id": "x"', MalformedLineError, 11, "not JSON: Expecting ',' delimiter"),
        (b'{"id": "\xff"}', MalformedLineError, 9, "not UTF-8: invalid start byte"),
        (b'{"id": NaN}', MalformedLineError, 1, 'found NaN, which is not JSON, expected the string "nan"'),
        (
            b'{"id": "x", "v": [{"a": 1, "a": 2}]}',
            MalformedLineError,
            1,
            "found the key 'a' twice in an object",
        ),
        (b"[1]", MalformedLineError, 1, "found a list, expected an object"),
        (b"[" * 100_000, MalformedLineError, 1, "not JSON"),
        ({**GOOD, "id": 3}, MalformedRecordError, 1, "id: found 3, expected some text"),
        ({**GOOD, "id": "x", "op": "blok_offset"}, MalformedRecordError, 1, "did you mean 'block_offset'"),
        ({"id": "x", "op": "block_offset"}, MalformedRecordError, 1, "from_cell: found nothing"),
        (
            {**GOOD, "id": "x", "expect": {"v": [0, 0]}},
            MalformedRecordError,
            1,
            "v: found [0, 0] (list), expected 3 numbers",
        ),
        ({**GOOD, "id": "x", "expect": {}}, MalformedRecordError, 1, "v: found nothing, expected a value"),
        ({**PLANE, "geometry": "rum"}, MissingGeometryError, 1, "'rum' is not in the shared files of"),
    ],
)
def test_a_bad_line_is_located_and_the_rest_goes_on(
    tmp_path: Path, line: object, kind: type[VectorError], column: int, message: str
) -> None:
    """Each mistake is reported at its line and column; the records around it are still read."""
    path = write(tmp_path / "v.jsonl", GOOD, line, {**GOOD, "id": "b"})
    before, error, after = read(path)
    assert isinstance(before, VectorRecord)
    assert isinstance(after, VectorRecord)
    assert after.line == 3
    assert type(error) is kind
    assert (error.line, error.column) == (2, column)
    assert str(error).startswith(f"{path}:2:{column}: ")
    assert message in error.message


def test_an_id_may_not_repeat(tmp_path: Path) -> None:
    """The second of two records of one id is an error; ids are how failures are named."""
    first, second = read(write(tmp_path / "v.jsonl", GOOD, GOOD))
    assert isinstance(first, VectorRecord)
    assert isinstance(second, DuplicateIdError)
    assert (second.line, second.record_id) == (2, "a")


def test_blank_lines_are_not_records(tmp_path: Path) -> None:
    """An empty line, as editors leave at the end, is nothing."""
    (record,) = read(write(tmp_path / "v.jsonl", b"", GOOD, b"  "))
    assert isinstance(record, VectorRecord)
    assert record.line == 2


def test_a_broken_shared_file(tmp_path: Path) -> None:
    """A bad geometry is reported once where it stands; records that need it miss it, others do not."""
    write(
        tmp_path / "geometries.jsonl",
        b"{",
        {"kind": "nameless"},
        {"name": "no-tree", "vertices": [], "polygons": []},
        geometry_record(library().geometries["room_01"]),
        geometry_record(library().geometries["room_01"]),
    )
    shared = Library(tmp_path)
    assert len(shared.geometries) == 1
    assert [(type(error), error.line) for error in shared.errors] == [
        (MalformedLineError, 1),
        (MalformedRecordError, 2),
        (MalformedRecordError, 3),
        (DuplicateIdError, 5),
    ]


def test_writing_reads_back(tmp_path: Path) -> None:
    """Every kind of shipped record survives being written and read, bit for bit."""
    written = one_of_each()
    assert len(written) > 120
    path = tmp_path / "new" / "out.jsonl"
    assert write_vectors(path, [(r.id, r.query, r.expected) for r in written]) == len(written)
    again = read(path)
    assert [r.id for r in again if isinstance(r, VectorRecord)] == [r.id for r in written]
    for old, new in zip(written, again, strict=True):
        assert isinstance(new, VectorRecord)
        op = old.query.op
        assert differences(old.expected, new.expected, op=op, zero_signs="distinct") == []
        assert _without_names(old.query.inputs) == _without_names(new.query.inputs)
        shapes = [[g.to_record() for g in r.query.geometries.values()] for r in (old, new)]
        assert _without_names(shapes[0]) == _without_names(shapes[1])


def test_writing_twice_adds_no_geometry(tmp_path: Path) -> None:
    """Geometry is named by what it holds: the same again is not written again, and names stay."""
    record = records(VECTORS / "find_collisions.jsonl")[0]
    for name in ("one.jsonl", "two.jsonl"):
        write_vectors(tmp_path / name, [(record.id, record.query, record.expected)])
    lines = (tmp_path / "geometries.jsonl").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 1
    assert (tmp_path / "one.jsonl").read_bytes() == (tmp_path / "two.jsonl").read_bytes()
    (again,) = read(tmp_path / "one.jsonl")
    assert isinstance(again, VectorRecord)
    write_vectors(tmp_path / "three.jsonl", [(again.id, again.query, again.expected)])
    assert (tmp_path / "three.jsonl").read_bytes() == (tmp_path / "one.jsonl").read_bytes()


def test_writing_twice_adds_no_world(tmp_path: Path) -> None:
    """A world, too, is named by what it holds; what it is made of is written beside it."""
    record = records(VECTORS / "world_transition.jsonl")[0]
    for name in ("one.jsonl", "two.jsonl"):
        write_vectors(tmp_path / name, [(record.id, record.query, record.expected)])
    (line,) = (tmp_path / "worlds.jsonl").read_text(encoding="utf-8").splitlines()
    name = json.loads(line)["name"]
    assert name.startswith(record.query.inputs["world"]["name"] + "-")
    assert (tmp_path / "one.jsonl").read_bytes() == (tmp_path / "two.jsonl").read_bytes()
    (again,) = read(tmp_path / "one.jsonl")
    assert isinstance(again, VectorRecord)
    assert again.query.inputs["world"]["name"] == name
    write_vectors(tmp_path / "three.jsonl", [(again.id, again.query, again.expected)])
    assert (tmp_path / "three.jsonl").read_bytes() == (tmp_path / "one.jsonl").read_bytes()
    assert len((tmp_path / "worlds.jsonl").read_text(encoding="utf-8").splitlines()) == 1


def test_every_built_in_query_is_written(tmp_path: Path) -> None:
    """Also one whose world has no name: it is called a world, and told from others by what it holds."""
    queries = [query for case in shipped_cases().values() for query in case.queries]
    expected = {record.query.op: record.expected for record in one_of_each()}
    asked = [
        (f"q{number}", query, expected[query.op])
        for number, query in enumerate(queries)
        if query.op in expected
    ]
    assert write_vectors(tmp_path / "all.jsonl", asked) > 1000
    names = {json.loads(line)["name"] for line in (tmp_path / "worlds.jsonl").read_text("utf-8").splitlines()}
    assert len([name for name in names if name.startswith("world-")]) > 1


def test_writing_beside_a_broken_geometry_file(tmp_path: Path) -> None:
    """What cannot be read is not added to."""
    write(tmp_path / "geometries.jsonl", b"{")
    record = records(VECTORS / "find_collisions.jsonl")[0]
    with pytest.raises(MalformedLineError):
        write_vectors(tmp_path / "out.jsonl", [(record.id, record.query, record.expected)])
    assert not (tmp_path / "out.jsonl").exists()


def test_what_is_no_file_is_refused_before_anything_is_asked(tmp_path: Path) -> None:
    """A folder or a device has no room for shared files beside it."""
    never = (pytest.fail("the queries were asked") for _ in range(1))
    folder = tmp_path / "folder.jsonl"
    folder.mkdir()
    with pytest.raises(UnsuitablePlaceError, match=r"^found .*folder\.jsonl, which is not a file, expected"):
        write_vectors(folder, never)
    assert list(tmp_path.iterdir()) == [folder]


def test_a_last_line_without_an_end_is_added_to_nevertheless(tmp_path: Path) -> None:
    """Two records never share a line."""
    first, second = records(VECTORS / "find_collisions.jsonl")[:2], records(VECTORS / "polygon.jsonl")[:1]
    write_vectors(tmp_path / "one.jsonl", [(r.id, r.query, r.expected) for r in first])
    shared = tmp_path / "geometries.jsonl"
    shared.write_bytes(shared.read_bytes().rstrip(b"\n"))
    write_vectors(tmp_path / "two.jsonl", [(r.id, r.query, r.expected) for r in second])
    assert read(tmp_path / "two.jsonl")


def test_numbers_are_written_short(tmp_path: Path) -> None:
    """A float32 is written as its shortest decimal, not as the float64 that holds it."""
    record = records(VECTORS / "find_collisions.jsonl")[0]
    write_vectors(tmp_path / "out.jsonl", [(record.id, record.query, record.expected)])
    text = (tmp_path / "out.jsonl").read_text(encoding="utf-8")
    assert '"spheres":[[0.0,0.0,0.0,0.48]]' in text
    assert '"walkable_allowance":0.66417414' in text


def test_not_finite_numbers_are_written_as_words(tmp_path: Path) -> None:
    """NaN and infinity survive as strings, in float32 and float64 fields."""
    query = query_from_record(
        {"op": "snap_to_plane", "plane": [0, 0, "nan", "-inf"], "v": ["inf", 0, -0.0]}, {}
    )
    write_vectors(tmp_path / "out.jsonl", [("x", query, {"v": [math.nan, math.inf, -0.0]})])
    (again,) = read(tmp_path / "out.jsonl")
    assert isinstance(again, VectorRecord)
    assert math.isnan(again.expected["v"][0])
    assert again.expected["v"][1] == math.inf
    assert math.copysign(1.0, again.expected["v"][2]) == -1.0
    assert again.query.inputs["plane"][3] == -math.inf


def _without_names(value: Any) -> Any:
    """Copy a record without the names that writing changes; tuples and lists are alike."""
    if isinstance(value, dict):
        return {k: _without_names(v) for k, v in value.items() if k not in {"name", "geometry"}}
    if isinstance(value, list | tuple):
        return [_without_names(item) for item in value]
    return value
