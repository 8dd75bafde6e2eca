"""Input that nobody means well with: refused with a place, in bounded time, and nothing else is lost."""

from __future__ import annotations

import json
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest

from conformance import json_lines, yaml_source
from conformance.effort import MAX_STEPS, MAX_TICKS, check_effort
from conformance.fields import FieldError
from conformance.inputs import read_inputs
from conformance.json_lines import lines_of
from conformance.loader import load_file
from conformance.vector_errors import VectorError
from conformance.vector_io import VectorRecord, records_of
from conformance.vector_library import GEOMETRY_FILES, Library
from conformance.yaml_source import YamlError, parse

GOOD = {"id": "a", "op": "block_offset", "from_cell": 1, "to_cell": 2, "expect": {"v": [0, 0, 0]}}
POSE = {"cell": 0xA9B40151, "origin": [0, 0, 0], "rotation": [1, 0, 0, 0]}
MOVER = {
    "spheres": [[0, 0, 0, 0.5]],
    "scale": 1,
    "state": 0,
    "step_up_height": 0,
    "step_down_height": 0,
}
CASE = """\
id: hostile
title: A case
why: Something is wrong with it.
retail: [BSPTREE::step_sphere_down SD-9]
"""


def records(raw: bytes) -> list[VectorRecord | VectorError]:
    """Read a vector file from memory, beside which nothing is."""
    return list(records_of(BytesIO(raw), Path("v.jsonl"), Library(Path(), {})))


def nested(depth: int) -> bytes:
    """Return a record whose cells are nested lists."""
    cells = b"[" * depth + b"]" * depth
    others = b'"mover": 0, "from": 0, "to": 0, "begin_cell": 1, "seed": 0'
    return b'{"id": "b", "op": "transition", "cells": %s, %s}' % (cells, others)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (b'{"id": "b", "id": "c"}', "the key 'id' twice"),
        (b'{"id": "\\ud800"}', "half a character, U+D800"),
        (b'{"x": 1e999}', "1e999 is beyond any float"),
        (b'{"x": ' + b"9" * 5000 + b"}", "not JSON"),
        (b"[" * 100_000, "nested too deeply"),
        (b"\xff\xfe{\x00}\x00", "UTF-16"),
        (b"\x00{}", "Expecting value"),
        (nested(100), "expected a block"),
        (json.dumps({**GOOD, "id": ""}).encode(), "expected some text"),
        (json.dumps({**GOOD, "id": "b", "uncertain": [1]}).encode(), "expected a reason as text"),
        (json.dumps({**GOOD, "id": "b", "from_cell": 10**30}).encode(), "a whole number of 32 bits"),
        (json.dumps({**GOOD, "id": "b", "from_cell": "x"}).encode(), "expected a whole number"),
        (json.dumps({**GOOD, "id": "b", "expect": {"v": [1e39, 0, 0]}}).encode(), "fits in a float32"),
    ],
    ids=lambda value: None if isinstance(value, bytes) else value,
)
def test_a_hostile_line_is_refused_and_the_next_is_read(line: bytes, said: str) -> None:
    """The error names the line; the record behind it is there."""
    bad, good = records(line + b"\n" + json.dumps(GOOD).encode())
    assert isinstance(bad, VectorError)
    assert (bad.line, said in bad.message) == (1, True), bad.message
    assert isinstance(good, VectorRecord)


def test_a_byte_order_mark_is_no_mistake() -> None:
    """Some editors write one before the first line."""
    (read,) = records(b"\xef\xbb\xbf" + json.dumps(GOOD).encode())
    assert isinstance(read, VectorRecord)


def test_a_line_without_end_is_not_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is longer than any record is passed over piece by piece."""
    monkeypatch.setattr(json_lines, "MAX_LINE_BYTES", 100)
    bad, good = lines_of(BytesIO(b"x" * 1000 + b"\n{}\n"), Path("v.jsonl"))
    assert isinstance(bad, VectorError)
    assert "longer than 100 bytes" in bad.message
    assert good == (2, {})


def test_a_shared_file_may_be_in_memory() -> None:
    """A library of given contents does not look into a folder."""
    library = Library(Path("nowhere"), {GEOMETRY_FILES[0]: b"[]\n"})
    assert library.geometries == {}
    (error,) = library.errors
    assert str(error) == f"{Path('nowhere') / GEOMETRY_FILES[0]}:1:1: found a list, expected an object"


@pytest.mark.parametrize(
    ("change", "path"),
    [
        ({"to": {**POSE, "origin": [0, 0]}}, "to.origin"),
        ({"to": {**POSE, "origin": [[0], 0, 0]}}, "to.origin[0]"),
        ({"to": {**POSE, "cell": {}}}, "to.cell"),
        ({"to": {"cell": 1}}, "to.origin"),
        ({"mover": []}, "mover"),
        ({"mover": {**MOVER, "spheres": 3}}, "mover.spheres"),
        ({"mover": {**MOVER, "spheres": [[0, 0, 0]]}}, "mover.spheres[0]"),
        ({"mover": {**MOVER, "scale": None}}, "mover.scale"),
        ({"mover": {**MOVER, "scale": [1]}}, "mover.scale"),
        ({"cells": {}}, "cells"),
        ({"cells": [3]}, "cells[0]"),
        ({"cells": [{"geometry": 3}]}, "cells[0].geometry"),
        ({"seed": {"contact": {"plane": [0, 0, 1, 0]}}}, "seed.contact.cell"),
    ],
)
def test_inputs_of_another_shape(change: dict[str, Any], path: str) -> None:
    """The error names the way to what does not fit."""
    record = {"cells": [], "mover": MOVER, "from": POSE, "to": POSE, "begin_cell": 1, "seed": {}, **change}
    with pytest.raises(FieldError) as caught:
        check_effort(read_inputs("transition", record))
    assert caught.value.path == path


def test_more_work_than_anybody_has_time_for() -> None:
    """A move of too many steps, a walk of too many ticks and a speck that is put down are refused."""
    far = {**POSE, "origin": [MAX_STEPS * 0.5 + 1.0, 0.0, 0.0]}
    with pytest.raises(FieldError, match="at most 200000 radii"):
        check_effort({"mover": MOVER, "from": POSE, "to": far})
    near = {**POSE, "origin": [MAX_STEPS * 0.5, 0.0, 0.0]}
    check_effort({"mover": MOVER, "from": POSE, "to": near})
    elsewhere = {**POSE, "cell": 0xFEFE0151}
    dust = {**MOVER, "spheres": [[0.0, 0.0, 0.0, 0.01]]}
    with pytest.raises(FieldError, match=r"^to: "):
        check_effort({"mover": dust, "from": POSE, "to": elsewhere})
    with pytest.raises(FieldError, match=r"^ticks: "):
        check_effort({"ticks": [{}] * (MAX_TICKS + 1)})
    with pytest.raises(FieldError, match=r"^ticks\[1\].move: "):
        check_effort({"mover": MOVER, "ticks": [{}, {"move": [1e6, 0.0, 0.0]}]})
    with pytest.raises(FieldError, match=r"^ticks\[0\].q: "):
        check_effort({"body": MOVER, "ticks": [{"q": 1e6}]})
    with pytest.raises(FieldError, match=r"^mover.spheres: "):
        check_effort({"mover": {**MOVER, "spheres": [[0.0, 0.0, 0.0, 1e-5]]}, "from": None, "to": POSE})


@pytest.mark.parametrize(("radius", "scale"), [(0.0, 1.0), (-0.0, 1.0), (-0.5, 1.0), (1e-30, 1e-30)], ids=str)
@pytest.mark.parametrize("name", ["mover", "body"])
def test_nobody_moves_without_a_radius(name: str, radius: float, scale: float) -> None:
    """Its way is divided by it, as a float32, into steps; the second sphere may be as it likes."""
    spheres = [[0.0, 0.0, 0.0, radius], [0.0, 0.0, 1.0, 0.5]]
    with pytest.raises(FieldError, match="a radius greater than 0") as caught:
        check_effort({name: {**MOVER, "spheres": spheres, "scale": scale}, "from": POSE, "to": POSE})
    assert caught.value.path == f"{name}.spheres"
    check_effort({name: {**MOVER, "spheres": spheres[::-1], "scale": 1.0}, "from": POSE, "to": POSE})
    check_effort({name: {**MOVER, "spheres": []}})


STANDING = """\
scene:
  cells:
    - id: 0xA9B40151
      pose: {origin: [0, 0, 0], yaw: 0}
      geometry: {tree: both, shapes: [floor: {size: [4, 4]}]}
"""


@pytest.mark.parametrize(
    ("asked", "line"),
    [
        (
            """\
mover: {state: [],
        spheres: [[0, 0, 0, 0]]}
query: {op: transition, from: {cell: 0xA9B40151, origin: [0, 0, 1], yaw: 0},
        to: {cell: 0xA9B40151, origin: [1, 0, 1], yaw: 0}, begin_cell: 0xA9B40151}
""",
            11,
        ),
        (
            """\
query: {op: body_walk, start: {cell: 0xA9B40151, origin: [0, 0, 1], yaw: 0}, quantum: 0.1,
        ticks: [{still: 1}],
        body: {spheres: [[0, 0, 0, -1]], state: [], transient_state: []}}
""",
            12,
        ),
    ],
    ids=["mover", "body"],
)
def test_a_case_about_such_a_mover_is_located(tmp_path: Path, asked: str, line: int) -> None:
    """At its spheres, with what was found and what is expected."""
    path = tmp_path / "speck.yaml"
    path.write_text(CASE + STANDING + asked, encoding="utf-8")
    (problem,) = load_file(path).problems
    assert problem.location.line == line
    assert problem.path.endswith("spheres")
    assert problem.found.startswith("a first sphere of radius ")
    assert problem.expected == "a radius greater than 0"


@pytest.mark.parametrize(
    ("raw", "said"),
    [
        (b"[" * 100_000, "more than 256 nested levels"),
        (b"{a: " * 100_000, "more than 256 nested levels"),
        (b"- " * 100_000, "more than 256 nested levels"),
        (b'a: "' + b"x" * 300_000, "syntax error"),
        (b"a: [*b" + b",1" * 300_001 + b"]", "more than 300000 values"),
        (b"#" * ((1 << 24) + 1), "more than 16777216 bytes"),
        (b"a: 1\r\rb: \x07", "the control character U+0007"),
    ],
    ids=("flow", "mapping", "block", "scalar", "values", "bytes", "control"),
)
def test_yaml_that_ends_the_reading(raw: bytes, said: str) -> None:
    """What is too deep, too long or not text is refused as a whole, at its place."""
    with pytest.raises(YamlError) as caught:
        parse(raw, "f.yaml")
    assert said in caught.value.problem.found


@pytest.mark.parametrize(
    ("raw", "said"),
    [
        (b"? " * 10_000 + b"a", "a list, mapping or alias as a key"),
        (b"a: 0x" + b"f" * 5000, "a number of 5000 hexadecimal digits"),
        (b'a: "\\0"', "the control character U+0000"),
        (b'"\\0": 1', "the control character U+0000"),
        (b"a: !!python/object/apply:os.system [exit]", "the tag"),
    ],
    ids=("keys", "hexadecimal", "escape", "key", "code"),
)
def test_yaml_whose_values_are_refused(raw: bytes, said: str) -> None:
    """The reading goes on; the value is not what the file says."""
    document = parse(raw, "f.yaml")
    assert said in document.refusals[0][1].found


def test_a_long_text_is_not_read_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    """The slow parser, which words syntax errors, is left out for a long text; the place is the same."""
    monkeypatch.setattr(yaml_source, "MAX_REWORDED", 0)
    with pytest.raises(YamlError) as caught:
        parse(b"a: 1\nb: [", "f.yaml")
    assert caught.value.problem.location.line in {2, 3}


@pytest.mark.parametrize(
    ("rest", "found", "line"),
    [
        ("query:\n  op: {a: 1}\n", "a mapping with the keys 'a'", 6),
        ("scene: {geometry: {tree: both, shapes: [{floor: }]}}\nquery: {op: x}\n", "nothing (null)", 5),
        ("vary: {poses: 1000000}\nquery: {op: block_offset, from_cell: 1, to_cell: 2}\n", "the number", 5),
        ("tags: null\nquery: {op: block_offset, from_cell: 1, to_cell: 2}\n", "nothing (null)", 5),
    ],
    ids=("op", "primitive", "poses", "null"),
)
def test_cases_that_once_ended_a_run(tmp_path: Path, rest: str, found: str, line: int) -> None:
    """What fuzzing has found is told like any other mistake."""
    file = tmp_path / "case.yaml"
    file.write_text(CASE + rest, encoding="utf-8")
    loaded = load_file(file)
    assert any(p.found.startswith(found) and p.location.line == line for p in loaded.problems), (
        loaded.problems
    )
