"""Queries are moved rigidly: everything with a place or a direction, and nothing else."""

from __future__ import annotations

import copy
import itertools
import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from own_queries import own_queries

import conformance
from conformance.floats import is_float32
from conformance.outputs import OUTPUTS
from conformance.own_operations import OWN_OUTPUTS
from conformance.query import Query
from conformance.scenes.algebra import dot, length, subtract
from conformance.scenes.model import Pose
from conformance.scenes.poses import (
    IDENTITY,
    MOVABLE_OPS,
    NOT_MOVABLE,
    Transform,
    move_direction,
    move_plane,
    move_point,
    move_pose,
    seeded_poses,
    transform_inputs,
    transform_query,
)
from conformance.scenes.rotations import rotate, rows_from_quaternion
from conformance.scenes.validate import check_rotation
from conformance.vector_library import Library

VECTORS = Path(conformance.__file__).parent / "vectors"
NOT_INPUTS = {"id", "op", "tag", "expect", "uncertain"}
HALF_ROOT = 0.7071067690849304
TURN = Transform((HALF_ROOT, 0.0, 0.0, HALF_ROOT), (10.0, 20.0, 30.0))
"""A quarter turn about z, then a move."""
MILLIMETRE = 1e-3
"""Ten float32 roundings of coordinates up to 2 km."""

PINNED = [
    Transform(
        (1.0, 0.0, 0.0, 0.0),
        (49.16067886352539, 96.71479797363281, 118.07742309570312),
    ),
    Transform(
        (-0.07730674743652344, 0.0, 0.0, 0.9970073699951172),
        (0.0, 0.0, 0.0),
    ),
    Transform(
        (0.7071067690849304, 0.0, -0.7071067690849304, 0.0),
        (-1536.0, -192.0, 0.0),
    ),
    Transform(
        (0.4024181365966797, -0.36661431193351746, -0.4298013150691986, 0.7203640937805176),
        (-7.701925277709961, -73.68275451660156, -7.512645721435547),
    ),
]

COORDINATES = st.floats(-200.0, 200.0, width=32)
POINTS = st.tuples(COORDINATES, COORDINATES, COORDINATES)
POSES = st.integers(0, 10_000).map(lambda seed: seeded_poses(12, seed)[seed % 12])


def record_of(op: str) -> dict[str, Any]:
    """Return the first shipped or built-in inputs of an operation, their world whole but without land."""
    if op in OWN_OUTPUTS:
        inputs = dict(own_queries()[op].inputs)
        if "world" not in inputs:
            return inputs
        return inputs | {"world": {**inputs["world"], "landblocks": [], "buildings": []}}
    library = Library(VECTORS)
    for path in sorted(VECTORS.glob("*.jsonl")):
        for line in path.read_text(encoding="utf-8").splitlines():
            record = json.loads(line)
            if record.get("op") == op:
                inputs = {key: value for key, value in record.items() if key not in NOT_INPUTS}
                if "world" in inputs:
                    inputs["world"] = {**library.worlds[inputs["world"]], "landblocks": [], "buildings": []}
                return inputs
    raise AssertionError(op)


def test_known_motion() -> None:
    """A quarter turn and a move, by hand."""
    assert move_point(TURN, (1.0, 2.0, 3.0)) == (8.0, 21.0, 33.0)
    assert move_direction(TURN, (1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0), abs=1e-7)
    assert move_plane(TURN, (0.0, 0.0, 1.0, -94.0)) == (0.0, 0.0, 1.0, -124.0)
    pose = move_pose(TURN, Pose(7, (1.0, 2.0, 3.0), TURN.rotation))
    assert (pose.cell, pose.origin) == (7, (8.0, 21.0, 33.0))
    assert pose.rotation == pytest.approx((0.0, 0.0, 0.0, 1.0), abs=1e-7)


@given(POINTS)
def test_identity_changes_nothing(point: tuple[float, float, float]) -> None:
    """The identity keeps every bit of a float32 point."""
    assert move_point(IDENTITY, point) == point
    assert move_direction(IDENTITY, point) == point


@given(POSES, POINTS, POINTS)
def test_distances_stay(
    transform: Transform, a: tuple[float, float, float], b: tuple[float, float, float]
) -> None:
    """Two points stay as far apart as they were, and become float32."""
    moved_a, moved_b = move_point(transform, a), move_point(transform, b)
    assert all(is_float32(part) for part in (*moved_a, *moved_b))
    assert length(subtract(moved_a, moved_b)) == pytest.approx(length(subtract(a, b)), abs=MILLIMETRE)


@given(POSES, POINTS, st.tuples(COORDINATES, COORDINATES, COORDINATES).filter(lambda v: length(v) > 1.0))
def test_points_stay_as_far_from_planes(
    transform: Transform, point: tuple[float, float, float], normal: tuple[float, float, float]
) -> None:
    """A plane moves with the points on both sides of it."""
    x, y, z = (part / length(normal) for part in normal)
    plane = (x, y, z, 5.0)
    moved = move_plane(transform, plane)
    before = dot(plane[:3], point) + plane[3]
    assert dot(moved[:3], move_point(transform, point)) + moved[3] == pytest.approx(before, abs=MILLIMETRE)


@given(POSES, POINTS, POINTS)
def test_poses_carry_what_is_in_them(
    transform: Transform, origin: tuple[float, float, float], local: tuple[float, float, float]
) -> None:
    """A point fixed in a pose goes where the moved pose has it."""
    pose = Pose(1, origin, (0.5, 0.5, -0.5, 0.5))

    def placed(at: Pose) -> list[float]:
        return [
            a + b for a, b in zip(rotate(rows_from_quaternion(at.rotation), local), at.origin, strict=True)
        ]

    x, y, z = placed(pose)
    assert placed(move_pose(transform, pose)) == pytest.approx(
        move_point(transform, (x, y, z)), abs=MILLIMETRE
    )


def test_seeded_poses_are_the_same_everywhere() -> None:
    """The first motions of a seed, bit for bit: changing them would change every varied case."""
    assert seeded_poses(4, 5) == PINNED
    assert seeded_poses(2, 5) == PINNED[:2]
    assert seeded_poses(4, 6) != PINNED


@pytest.mark.parametrize("seed", [0, 1, -1, 2**70])
def test_seeded_poses_have_all_kinds(seed: int) -> None:
    """Twelve motions combine four kinds of rotation with three of translation, all valid float32."""
    poses = seeded_poses(12, seed)
    kinds = set()
    for pose in poses:
        assert all(is_float32(part) for part in (*pose.rotation, *pose.translation))
        check_rotation(pose.rotation, "rotation")
        kinds.add((rotation_kind(pose.rotation), translation_kind(pose.translation)))
    assert kinds == set(itertools.product(["none", "yaw", "quarter", "any"], ["none", "near", "blocks"]))


def rotation_kind(rotation: tuple[float, float, float, float]) -> str:
    """Name a rotation's kind."""
    if rotation == IDENTITY.rotation:
        return "none"
    if sum(part == 0.0 for part in rotation) >= 2 and {abs(part) for part in rotation} <= {
        0.0,
        1.0,
        0.7071067690849304,
    }:
        return "quarter"
    return "yaw" if rotation[1] == rotation[2] == 0.0 else "any"


def translation_kind(translation: tuple[float, float, float]) -> str:
    """Name a translation's kind."""
    if not any(translation):
        return "none"
    if all(part % 192.0 == 0.0 for part in translation):
        return "blocks"
    assert all(abs(part) <= 200.0 for part in translation)
    return "near"


@pytest.mark.parametrize("op", sorted(MOVABLE_OPS))
def test_every_movable_operation_moves(op: str) -> None:
    """The inputs keep their keys and change; the original does not; the identity gives them back."""
    inputs = record_of(op)
    before = copy.deepcopy(inputs)
    moved = transform_inputs(op, inputs, TURN)
    assert inputs == before
    assert moved.keys() == inputs.keys()
    assert moved != inputs
    for key in ("mover", "path", "scale", "geometry", "as", "begin_cell", "placement_allows_sliding"):
        assert moved.get(key) == inputs.get(key)


def test_every_operation_moves_or_has_a_reason_not_to() -> None:
    """What has no other poses is listed, and why; nothing is both."""
    assert set(NOT_MOVABLE) | MOVABLE_OPS == set(OUTPUTS)
    assert not set(NOT_MOVABLE) & MOVABLE_OPS
    assert len(MOVABLE_OPS) >= 20
    assert all(NOT_MOVABLE.values())


def test_worlds_move_with_their_objects() -> None:
    """Cells, objects and parts with a pose of their own move; portals are in cell space, lists are ids."""
    pose = {"cell": 1, "origin": [1.0, 2.0, 3.0], "rotation": [1.0, 0.0, 0.0, 0.0]}
    portal = {"other": None, "side": 0, "polygon": [[1.0, 2.0, 3.0]], "other_portal": 0}
    thing = {"id": 9, "pose": pose, "spheres": [[1.0, 2.0, 3.0, 0.5]]}
    thing["parts"] = [{"geometry": "p", "pose": pose}, {"geometry": None}]
    world = {
        "name": "w",
        "landblocks": [],
        "cells": [{"id": 257, "pose": pose, "geometry": "g", "portals": [portal], "stab": [258]}],
        "buildings": [],
        "objects": [thing],
        "shadow": {"257": [9]},
    }
    inputs = {"world": world, "position": pose, "spheres": [[1.0, 2.0, 3.0, 0.5]], "cell": 257}
    moved = transform_inputs("find_transit_cells", inputs, TURN)
    assert moved["position"]["origin"] == [8.0, 21.0, 33.0]
    assert moved["spheres"] == [[8.0, 21.0, 33.0, 0.5]]
    (cell,), (thing_moved,) = moved["world"]["cells"], moved["world"]["objects"]
    assert cell["pose"]["origin"] == thing_moved["pose"]["origin"] == [8.0, 21.0, 33.0]
    assert thing_moved["parts"][0]["pose"]["origin"] == [8.0, 21.0, 33.0]
    assert thing_moved["parts"][1] == {"geometry": None}
    assert thing_moved["spheres"] == [[1.0, 2.0, 3.0, 0.5]]
    assert (cell["portals"], moved["world"]["shadow"], moved["cell"]) == ([portal], {"257": [9]}, 257)


def test_land_does_not_turn() -> None:
    """A world with land, or with a building that stands on some, is refused: it moves by landblocks only."""
    for key in ("landblocks", "buildings"):
        world = {"landblocks": [], "buildings": [], key: [{}]}
        with pytest.raises(ValueError, match="whole landblocks only"):
            transform_inputs("world_walk", {"world": world}, TURN)


def test_find_collisions_blocks() -> None:
    """Pose, start, end and seed move; seeded cells, water flags and path stay."""
    pose = {"cell": 1, "origin": [1.0, 2.0, 3.0], "rotation": [1.0, 0.0, 0.0, 0.0]}
    plane = {"plane": [0.0, 0.0, 1.0, -3.0], "cell": 1, "is_water": 0}
    inputs = {
        "pose": pose,
        "from": None,
        "to": pose,
        "seed": {
            "contact": plane,
            "last_known": plane,
            "sliding": [0.0, 0.0, 2.0],
            "frames_stationary_fall": 1,
        },
        "path": {"step_down": 1},
    }
    moved_plane = {"plane": [0.0, 0.0, 1.0, -33.0], "cell": 1, "is_water": 0}
    moved = transform_inputs("find_collisions", inputs, TURN)
    assert moved["pose"]["origin"] == moved["to"]["origin"] == [8.0, 21.0, 33.0]
    assert moved["pose"]["cell"] == 1
    assert moved["from"] is None
    assert moved["seed"] == {
        "contact": moved_plane,
        "last_known": moved_plane,
        "sliding": [0.0, 0.0, 2.0],
        "frames_stationary_fall": 1,
    }
    assert moved["path"] == {"step_down": 1}


def test_cells_move_with_their_statics() -> None:
    """Cells and the static objects in them move together; names, scales and portals stay."""
    pose = {"cell": 1, "origin": [1.0, 2.0, 3.0], "rotation": [1.0, 0.0, 0.0, 0.0]}
    static = {"geometry": "g", "pose": pose, "scale": 2.0, "state": 1}
    cells = [{"id": 1, "pose": pose, "geometry": "g", "portals": [2], "statics": [static]}]
    (moved,) = transform_inputs("transition", {"cells": cells}, TURN)["cells"]
    assert moved["pose"]["origin"] == moved["statics"][0]["pose"]["origin"] == [8.0, 21.0, 33.0]
    assert (moved["portals"], moved["statics"][0]["scale"]) == ([2], 2.0)


def test_walks_turn_their_moves() -> None:
    """A tick's move is a direction, its rotation is one; a tick without rotation gets none."""
    ticks = [
        {"move": [1.0, 0.0, 0.0]},
        {"move": [0.0, 0.0, 1.0], "rotation": [1.0, 0.0, 0.0, 0.0], "contact_ok": 0},
    ]
    first, second = transform_inputs("walk", {"ticks": ticks}, TURN)["ticks"]
    assert first == {"move": pytest.approx([0.0, 1.0, 0.0], abs=1e-7)}
    assert second == {"move": [0.0, 0.0, 1.0], "rotation": list(TURN.rotation), "contact_ok": 0}


def test_bodies_move_and_gravity_stays() -> None:
    """A body's place, velocity, plane and inputs turn; its own frame and the acceleration do not."""
    pose = {"cell": 1, "origin": [1.0, 2.0, 3.0], "rotation": [1.0, 0.0, 0.0, 0.0]}
    body = {
        "position": pose,
        "velocity": [1.0, 0.0, 0.0],
        "acceleration": [0.0, 0.0, -9.8],
        "contact_plane": [0.0, 0.0, 1.0, -3.0],
        "friction": 0.5,
    }
    ticks = [{"q": 0.1, "set_velocity": [1.0, 0.0, 0.0]}, {"q": 0.2, "set_local_velocity": [1.0, 0.0, 0.0]}]
    moved = transform_inputs("body_walk", {"body": body, "ticks": ticks}, TURN)
    assert moved["body"]["position"]["origin"] == [8.0, 21.0, 33.0]
    assert moved["body"]["velocity"] == pytest.approx([0.0, 1.0, 0.0], abs=1e-7)
    assert moved["body"]["contact_plane"] == [0.0, 0.0, 1.0, -33.0]
    assert (moved["body"]["acceleration"], moved["body"]["friction"]) == ([0.0, 0.0, -9.8], 0.5)
    assert moved["ticks"][0] == {"q": 0.1, "set_velocity": pytest.approx([0.0, 1.0, 0.0], abs=1e-7)}
    assert moved["ticks"][1] == ticks[1]


def test_queries_say_how_they_were_moved() -> None:
    """The label of a moved query has the numbers that make the motion again."""
    query = Query("slide_sphere", {"normal": [0.0, 0.0, 1.0]}, label="case-1")
    assert transform_query(query, TURN).label == (
        "case-1 turned [0.707106769, 0, 0, 0.707106769] moved [10, 20, 30]"
    )


def test_operations_without_a_place_are_refused() -> None:
    """A polygon test is in the geometry's own frame: there is nothing to move."""
    with pytest.raises(
        ValueError, match="polygon_make_plane has no pose to move: in the frame of its geometry"
    ):
        transform_inputs("polygon_make_plane", {"geometry": "g", "poly": 0}, TURN)
