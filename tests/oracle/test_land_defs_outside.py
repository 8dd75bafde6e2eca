"""LandDefs, from points to land cells: the shipped vectors of the ported functions, and the snap."""

from __future__ import annotations

import json
from typing import Any

import pytest
from oracle_worlds import vec, xyz
from shipped_vectors import VECTORS

from oracle import land_defs
from oracle.arithmetic import f32
from oracle.constants import EPS

BLOCK = 0xA9B40000


def shipped(op: str) -> list[dict[str, Any]]:
    """Return the shipped records of an operation."""
    lines = (VECTORS / "terrain.jsonl").read_text(encoding="utf-8").splitlines()
    found = [record for record in map(json.loads, lines) if record["op"] == op]
    assert found
    return found


def ids(record: dict[str, Any]) -> str:
    """Return a record's id."""
    return str(record["id"])


@pytest.mark.parametrize("record", shipped("landdefs_blockid_to_lcoord"), ids=ids)
def test_blockid_to_lcoord(record: dict[str, Any]) -> None:
    """10 2.1."""
    ok, x, y = land_defs.blockid_to_lcoord(record["cell"])
    assert ok == record["expect"]["r"]
    assert record["cell"] == 0 or (x, y) == (record["expect"]["x"], record["expect"]["y"])


@pytest.mark.parametrize("record", shipped("landdefs_lcoord_to_gid"), ids=ids)
def test_lcoord_to_gid(record: dict[str, Any]) -> None:
    """10 2.5."""
    assert land_defs.lcoord_to_gid(record["x"], record["y"]) == record["expect"]["id"]


@pytest.mark.parametrize("record", shipped("landdefs_get_outside_lcoord"), ids=ids)
def test_get_outside_lcoord(record: dict[str, Any]) -> None:
    """10 2.7."""
    ok, x, y = land_defs.get_outside_lcoord(record["cell"], vec(*record["point"]))
    assert ok == record["expect"]["r"]
    assert not ok or (x, y) == (record["expect"]["x"], record["expect"]["y"])


@pytest.mark.parametrize("record", shipped("landdefs_adjust_to_outside"), ids=ids)
def test_adjust_to_outside(record: dict[str, Any]) -> None:
    """10 2.8."""
    point = vec(*record["point"])
    assert land_defs.adjust_to_outside(record["cell"], point) == (
        record["expect"]["r"],
        record["expect"]["cell"],
    )
    assert xyz(point) == tuple(f32(float(c)) for c in record["expect"]["point"])


def test_a_point_next_to_the_block_origin_snaps() -> None:
    """10 2.8: strictly within EPS of the block's edge a coordinate becomes zero, at EPS it does not."""
    point = vec(-0.0001, -EPS, 5.0)
    assert land_defs.adjust_to_outside(BLOCK | 1, point) == (1, 0xA9B30008)
    assert xyz(point) == (0.0, f32(192.0 - EPS), 5.0)


def test_an_id_that_names_no_cell_has_no_land() -> None:
    """10 2.7, 2.8: the point is not even snapped."""
    point = vec(-0.0001, 0.0, 0.0)
    assert land_defs.adjust_to_outside(BLOCK, point) == (0, 0)
    assert point.x == f32(-0.0001)
    assert land_defs.get_outside_lcoord(BLOCK, point) == (0, 0, 0)
