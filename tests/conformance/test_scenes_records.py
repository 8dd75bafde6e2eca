"""Geometry records from outside are read back as they were, or refused with the place."""

from __future__ import annotations

import copy
from typing import Any

import pytest

from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.cell_planes import box_planes
from conformance.scenes.errors import SceneError
from conformance.scenes.polygons import place
from conformance.scenes.primitives import ramp, room
from conformance.scenes.records import geometry_from_record

GEOMETRY = build(
    "hall",
    room(size=(4.0, 4.0, 3.0)) + place(ramp(width=1.0, run=2.0, degrees=30.0), (0.0, 0.0, 0.0), 33.0),
    style=TreeStyle.BOTH,
    kind="test",
    cell_planes=box_planes((-2.0, -2.0, 0.0), (2.0, 2.0, 3.0)),
)


def test_records_make_the_round_trip() -> None:
    """Written and read, every number is the same."""
    record = GEOMETRY.to_record()
    assert geometry_from_record(record, "").to_record() == record


def test_numbers_are_rounded_to_float32() -> None:
    """A decimal in a file means the float32 nearest to it."""
    record = {**GEOMETRY.to_record(), "cell_bsp": [[1, 0, 0, 0.1]]}
    assert geometry_from_record(record, "").cell_planes == ((1.0, 0.0, 0.0, 0.10000000149011612),)


def changed(path: tuple[Any, ...], value: object) -> dict[str, Any]:
    """Return the record with one value replaced, or removed."""
    record = copy.deepcopy(GEOMETRY.to_record())
    target: Any = record
    for step in path[:-1]:
        target = target[step]
    if value is REMOVED:
        del target[path[-1]]
    else:
        target[path[-1]] = value
    return record


REMOVED = object()


@pytest.mark.parametrize(
    ("path", "value", "expected"),
    [
        (("name",), REMOVED, "g: found no 'name', expected the key 'name'"),
        (("name",), 7, "g.name: found int 7, expected a text"),
        (("vertices",), "x", "g.vertices: found str 'x', expected a list"),
        (("vertices", 2), [0.0, 1.0], "g.vertices[2]: found 2 numbers, expected 3 numbers"),
        (("vertices", 2, 0), "0", "g.vertices[2][0]: found str '0', expected a number"),
        (("vertices", 2, 0), True, "g.vertices[2][0]: found bool True, expected a number"),
        (("polygons", 1), [0, 1, 2], "g.polygons[1]: found list [0, 1, 2], expected a mapping"),
        (("polygons", 1, "v", 0), 0.0, "g.polygons[1].v[0]: found float 0.0, expected a whole number"),
        (("polygons", 1, "v", 0), 99, "g.polygons[1]: found vertex 99, expected a vertex index below 12"),
        (("bsp", "pos"), REMOVED, "g.bsp: found no 'pos', expected the key 'pos'"),
        (("bsp", "neg"), None, "g.bsp.neg: found NoneType None, expected a mapping"),
        (("bsp", "neg", "sphere"), REMOVED, "g.bsp.neg: found no 'sphere', expected the key 'sphere'"),
        (("bsp", "plane", 3), "d", "g.bsp.plane[3]: found str 'd', expected a number"),
        (("cell_bsp", 0), [1], "g.cell_bsp[0]: found 1 numbers, expected 4 numbers"),
        (("kind",), 1, "g.kind: found int 1, expected a text"),
    ],
)
def test_bad_records(path: tuple[Any, ...], value: object, expected: str) -> None:
    """Missing keys and wrong types are named with their path."""
    with pytest.raises(SceneError) as raised:
        geometry_from_record(changed(path, value), "g")
    assert str(raised.value) == expected


def test_a_node_used_twice_is_refused() -> None:
    """A record whose tree shares a node (as aliases in YAML can) is not a tree."""
    record = GEOMETRY.to_record()
    record["bsp"]["neg"] = record["bsp"]["pos"]
    with pytest.raises(SceneError, match="already has"):
        geometry_from_record(record, "g")


def test_a_record_is_a_mapping() -> None:
    """Anything else is refused, not crashed on."""
    with pytest.raises(SceneError) as raised:
        geometry_from_record([1], "g")
    assert str(raised.value) == "g: found list [1], expected a mapping"
