"""Queries on land are shifted by whole landblocks: every id and nothing else."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shipped_vectors import VECTORS, records

from conformance.query import Query
from conformance.scenes.block_shifts import (
    has_land,
    room_to_shift,
    shift_inputs,
    shifted_block,
    shifted_id,
)
from conformance.scenes.poses import moved_queries, shift_query
from conformance.scenes.random_poses import seeded_shifts

if TYPE_CHECKING:
    from conformance.vector_io import VectorRecord

FILES = ("terrain.jsonl", "cells.jsonl", "world_transition.jsonl", "world_walk.jsonl")
BYTES = st.integers(0, 255)
POSE = {"cell": 0xA9B40011, "origin": [1.0, 2.0, 3.0], "rotation": [1.0, 0.0, 0.0, 0.0]}


def land_records() -> dict[str, VectorRecord]:
    """Return the first shipped record of each operation in a world."""
    found: dict[str, VectorRecord] = {}
    for name in FILES:
        for record in records(VECTORS / name):
            if "world" in record.query.inputs:
                found.setdefault(record.query.op, record)
    assert len(found) == 11
    return found


@given(BYTES, BYTES, st.integers(0, 0xFFFF), st.integers(-254, 254), st.integers(-254, 254))
def test_a_shift_can_be_undone(x: int, y: int, low: int, east: int, north: int) -> None:
    """Every id comes back, those that are no landblock's included; the low word stays."""
    cell = x << 24 | y << 16 | low
    there = shifted_id(cell, (east, north))
    assert there & 0xFFFF == low or cell == 0
    assert shifted_id(there, (-east, -north)) == cell or there == 0


def test_known_shifts() -> None:
    """East is the high byte, north the low one; no cell stays none."""
    assert shifted_block(0xA9B4, (1, 0)) == 0xAAB4
    assert shifted_block(0xA9B4, (0, -1)) == 0xA9B3
    assert shifted_id(0xA9B40151, (-0xA9, 2)) == 0x00B60151
    assert shifted_id(0, (3, 4)) == 0


@pytest.mark.parametrize("record", land_records().values(), ids=lambda record: record.query.op)
def test_a_shifted_query_has_no_old_id(record: VectorRecord) -> None:
    """The original stays as it is; the shifted one is another, and shifted back it is the original."""
    inputs = record.query.inputs
    before = copy.deepcopy(inputs)
    (low_x, _), (low_y, _) = room_to_shift(inputs)
    moved = shift_inputs(inputs, (low_x, low_y))
    assert inputs == before
    assert {block["block"] for block in moved["world"]["landblocks"]} == {0, 1, 256, 257}
    assert shift_inputs(moved, (-low_x, -low_y)) == before


def test_what_is_shifted_in_a_world() -> None:
    """Cells, portals, lists, buildings, objects, seeds and shadow lists; ids of objects and points stay."""
    world: dict[str, Any] = {
        "name": "w",
        "landblocks": [{"block": 0xA9B4, "heights": [94.0] * 81}],
        "cells": [
            {
                "id": 0xA9B40100,
                "pose": POSE,
                "geometry": "g",
                "portals": [{"other": 0xA9B40101, "side": 0}, {"other": None, "side": 1}],
                "stab": [0xA9B40101],
            }
        ],
        "buildings": [{"pose": POSE, "geometry": "b", "portals": [{"other": 0xA9B40100, "other_portal": 1}]}],
        "objects": [{"id": 0xA9B40100, "pose": POSE, "parts": [{"geometry": "p", "pose": POSE}]}],
        "shadow": {str(0xA9B40011): [0xA9B40100]},
    }
    seed = {"contact": {"plane": [0.0, 0.0, 1.0, 0.0], "cell": 0xA9B40011, "is_water": 0}}
    inputs = {
        "world": world,
        "seed": seed,
        "array": [0xA9B40100],
        "from": None,
        "to": POSE,
        "mover": {"id": 5},
    }
    moved = shift_inputs(inputs, (1, 0))
    cell, building = moved["world"]["cells"][0], moved["world"]["buildings"][0]
    thing = moved["world"]["objects"][0]
    assert (cell["id"], cell["pose"]["cell"], cell["stab"]) == (0xAAB40100, 0xAAB40011, [0xAAB40101])
    assert [portal["other"] for portal in cell["portals"]] == [0xAAB40101, None]
    assert building["portals"] == [{"other": 0xAAB40100, "other_portal": 1}]
    assert (thing["id"], thing["parts"][0]["pose"]["cell"]) == (0xA9B40100, 0xAAB40011)
    assert moved["world"]["shadow"] == {str(0xAAB40011): [0xA9B40100]}
    assert moved["world"]["landblocks"][0]["block"] == 0xAAB4
    assert moved["seed"]["contact"]["cell"] == 0xAAB40011
    assert (moved["array"], moved["from"], moved["mover"]) == ([0xAAB40100], None, {"id": 5})
    assert moved["to"] == {**POSE, "cell": 0xAAB40011}


def test_land_is_a_landblock_or_a_building() -> None:
    """Cells alone are not tied to the land."""
    assert not has_land({})
    assert not has_land({"world": {"landblocks": [], "buildings": [], "cells": [{}]}})
    assert has_land({"world": {"landblocks": [{}], "buildings": []}})
    assert has_land({"world": {"landblocks": [], "buildings": [{}]}})


@given(st.integers(0, 1000), st.integers(-200, 0), st.integers(0, 200))
def test_seeded_shifts_stay_on_the_map(seed: int, low: int, high: int) -> None:
    """They stay in their room, begin alike, and go to both corners."""
    room = ((low, high), (-high, -low))
    shifts = seeded_shifts(8, seed, room)
    assert shifts[:3] == seeded_shifts(3, seed, room)
    assert all(low <= east <= high and -high <= north <= -low for east, north in shifts)
    assert {(high, -low), (low, -high)} <= set(shifts)


def test_a_query_says_how_it_was_shifted() -> None:
    """The label has the landblocks; operations about ids have no other place."""
    record = land_records()["point_in_cell"]
    shifted = shift_query(record.query, (1, -2))
    assert shifted.label == f"{record.id} shifted by 1 landblocks east, -2 north"
    assert len(moved_queries(record.query, 3, 7)) == 3
    assert moved_queries(Query("landdefs_gid_to_lcoord", {"cell": 1}), 3, 7) == []
