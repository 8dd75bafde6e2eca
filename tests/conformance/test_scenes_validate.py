"""Bad scenes are refused with a path, what was found, and what was expected."""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path

import pytest

import conformance
from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.errors import SceneError, join_path
from conformance.scenes.model import Cell, Geometry, Leaf, Node, Polygon, Pose, Scene, Static
from conformance.scenes.primitives import box, room
from conformance.scenes.validate import (
    check_geometry,
    check_pose,
    check_rotation,
    check_scene,
    check_shape,
    check_tree,
    geometry_errors,
    shape_errors,
)

SQUARE = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0))
POSE = Pose(0xA9B40151, (0.0, 0.0, 94.0))
ROOM = build("room", room(size=(4.0, 4.0, 3.0)), style=TreeStyle.FRONT, kind="room")
LEAF = Leaf(0, False, (0.0, 0.0, 0.0, 1.0), (0,))
VECTORS = Path(conformance.__file__).parent / "vectors"


def bent(height: float) -> tuple[tuple[float, float, float], ...]:
    """Return the square with its last corner lifted."""
    return (*SQUARE[:3], (0.0, 1.0, height))


@pytest.mark.parametrize(
    ("corners", "found"),
    [
        (SQUARE[:2], "2 corners"),
        (((0.5, 0.5, 0.0),) * 256, "256 corners"),
        ((*SQUARE[:3], (0.0, math.nan, 0.0)), "(0, nan, 0)"),
        ((*SQUARE[:3], (0.0, math.inf, 0.0)), "(0, inf, 0)"),
        ((*SQUARE[:3], (0.0, 2e6, 0.0)), "(0, 2000000, 0)"),
        ((*SQUARE, SQUARE[0]), "corners 0 and 4 both at (0, 0, 0)"),
        ((SQUARE[0], SQUARE[1], SQUARE[1], SQUARE[2]), "corners 1 and 2 both at (1, 0, 0)"),
        (((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0)), "an area of 0 square metres"),
        (bent(0.1), "off the polygon's plane"),
        (
            (SQUARE[0], SQUARE[1], (0.2, 0.2, 0.0), SQUARE[3]),
            "outside the edge from corner 2 to corner 3",
        ),
        ((SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]), "an area of 0 square metres"),
    ],
)
def test_bad_polygons(corners: tuple[tuple[float, float, float], ...], found: str) -> None:
    """Each way that a polygon can be bad is named, with the number."""
    with pytest.raises(SceneError) as raised:
        check_shape([SQUARE, corners], "cells[0].geometry")
    assert raised.value.path.startswith("cells[0].geometry.polygons[1]")
    assert found in raised.value.found


def test_a_star_is_not_convex() -> None:
    """Five corners in star order turn the same way at each, and are still refused."""
    ring = [(math.cos(2.0 * math.pi * k / 5), math.sin(2.0 * math.pi * k / 5), 0.0) for k in range(5)]
    check_shape([ring], "")
    with pytest.raises(SceneError, match="convex"):
        check_shape([[ring[2 * k % 5] for k in range(5)]], "")


@pytest.mark.parametrize(("height", "errors"), [(0.00079, 0), (0.00081, 1)])
def test_both_sides_of_the_planarity_limit(height: float, errors: int) -> None:
    """A square's corner lifted by h is h / 4 off the mean plane; the limit is EPS, 0.0002 m."""
    assert len(list(shape_errors([bent(height)], ""))) == errors


def test_all_errors_of_a_shape_are_listed() -> None:
    """One bad polygon does not hide the next."""
    paths = [error.path for error in shape_errors([SQUARE[:2], SQUARE, SQUARE[:1]], "")]
    assert paths == ["polygons[0]", "polygons[2]"]


@pytest.mark.parametrize(
    ("rotation", "good"),
    [
        ((1.0, 0.0, 0.0, 0.0), True),
        ((0.0, 0.0, 0.0, -1.0), True),
        ((1.00049, 0.0, 0.0, 0.0), True),
        ((1.00051, 0.0, 0.0, 0.0), False),
        ((0.99949, 0.0, 0.0, 0.0), False),
        ((0.0, 0.0, 0.0, 0.0), False),
        ((math.nan, 0.0, 0.0, 0.0), False),
    ],
)
def test_rotations_as_retail_accepts_them(rotation: tuple[float, float, float, float], good: bool) -> None:
    """The squared length may be off 1 by EPS * 5 = 0.001 (01, 4.3)."""
    if good:
        check_rotation(rotation, "rotation")
        return
    with pytest.raises(SceneError, match="squared length"):
        check_rotation(rotation, "rotation")


@pytest.mark.parametrize(
    ("pose", "path"),
    [
        (dataclasses.replace(POSE, cell=0), "pose.cell"),
        (dataclasses.replace(POSE, cell=1 << 32), "pose.cell"),
        (dataclasses.replace(POSE, origin=(0.0, math.inf, 0.0)), "pose.origin"),
        (dataclasses.replace(POSE, rotation=(2.0, 0.0, 0.0, 0.0)), "pose.rotation"),
    ],
)
def test_bad_poses(pose: Pose, path: str) -> None:
    """Each part of a pose is checked."""
    check_pose(POSE, "pose")
    with pytest.raises(SceneError) as raised:
        check_pose(pose, "pose")
    assert raised.value.path == path


def node(positive: object, negative: object) -> Node:
    """Return a node over a polygon, with whatever children."""
    return Node((0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0), (0,), positive, negative)  # type: ignore[arg-type]


EMPTY = Leaf(1, False, (0.0, 0.0, 0.0, 0.0), ())
GOOD = node(LEAF, EMPTY)


@pytest.mark.parametrize(
    ("tree", "path", "found"),
    [
        (node(LEAF, None), "bsp.neg", "None"),
        (node(None, LEAF), "bsp.pos", "None"),
        (node(LEAF, LEAF), "bsp.neg", "a node that the tree already has"),
        (node(EMPTY, dataclasses.replace(EMPTY, index=2)), "bsp", "polygon 0 in no leaf"),
        (node(LEAF, dataclasses.replace(EMPTY, index=0)), "bsp.neg", "leaf index 0 twice"),
        (node(LEAF, dataclasses.replace(EMPTY, index=-1)), "bsp.neg.leaf", "-1"),
        (node(LEAF, dataclasses.replace(EMPTY, polygons=(1,))), "bsp.neg.polys[0]", "1"),
        (node(LEAF, dataclasses.replace(EMPTY, polygons=(-1,))), "bsp.neg.polys[0]", "-1"),
        (
            dataclasses.replace(node(LEAF, EMPTY), plane=(0.0, 0.0, 1.1, 0.0)),
            "bsp.plane",
            "a normal of length 1.1",
        ),
        (
            dataclasses.replace(node(LEAF, EMPTY), plane=(0.0, 0.0, 1.0, math.nan)),
            "bsp.plane",
            "(0, 0, 1, nan)",
        ),
        (dataclasses.replace(LEAF, sphere=(0.0, 0.0, 0.0, -1.0)), "bsp.sphere", "radius -1"),
        (dataclasses.replace(LEAF, sphere=(0.0, 0.0, math.inf, 1.0)), "bsp.sphere", "(0, 0, inf, 1)"),
    ],
)
def test_bad_trees(tree: Node | Leaf, path: str, found: str) -> None:
    """Retail follows child pointers without looking, so the structure is checked first."""
    check_tree(GOOD, 1, "bsp")
    with pytest.raises(SceneError) as raised:
        check_tree(tree, 1, "bsp")
    assert (raised.value.path, raised.value.found) == (path, found)


def test_cycles_end() -> None:
    """A tree that comes back to its root is refused, not walked for ever."""
    root = node(LEAF, EMPTY)
    object.__setattr__(root, "negative", root)
    with pytest.raises(SceneError, match="already has"):
        check_tree(root, 1, "bsp")


@pytest.mark.parametrize(
    ("change", "path"),
    [
        ({"vertices": (*ROOM.vertices[:-1], (0.0, math.nan, 0.0))}, "room.vertices[7]"),
        ({"polygons": (*ROOM.polygons[:-1], Polygon((0, 1, 8)))}, "room.polygons[5]"),
        ({"polygons": (*ROOM.polygons[:-1], Polygon((0, 1, -1)))}, "room.polygons[5]"),
        (
            {"polygons": (*ROOM.polygons[:-1], Polygon((0, 4, 5), 3))},
            "room.polygons[5].sides",
        ),
        ({"polygons": ROOM.polygons[:-1]}, "room.bsp.pos.pos.pos.pos.pos.polys[0]"),
        ({"tree": None}, "room.bsp"),
        ({"cell_planes": ((0.0, 0.0, 2.0, 0.0),)}, "room.cell_bsp[0]"),
    ],
)
def test_bad_geometries(change: dict[str, object], path: str) -> None:
    """Each part of a geometry is checked."""
    check_geometry(ROOM, "room")
    fields = {field.name: getattr(ROOM, field.name) for field in dataclasses.fields(Geometry)}
    first = next(geometry_errors(Geometry(**{**fields, **change}), "room"))
    assert first.path == path


def test_scenes_name_the_cell() -> None:
    """Errors say which cell and which static object they are in; a shared geometry is reported once."""
    bad = dataclasses.replace(POSE, rotation=(2.0, 0.0, 0.0, 0.0))
    replace = dataclasses.replace
    thing = build("box", box(size=(1.0, 1.0, 1.0)), style=TreeStyle.BOTH, kind="box")
    good = Cell(1, POSE, ROOM, (Static(thing, POSE),))
    check_scene(Scene((good,)))
    cases = {
        "cells": Scene(()),
        "cells[1].id": Scene((good, good)),
        "cells[0].pose.rotation": Scene((replace(good, pose=bad),)),
        "cells[0].statics[0].pose.rotation": Scene(
            (dataclasses.replace(good, statics=(Static(thing, bad),)),)
        ),
        "cells[0].statics[0].scale": Scene((replace(good, statics=(Static(thing, POSE, 0.0),)),)),
    }
    for path, scene in cases.items():
        with pytest.raises(SceneError) as raised:
            check_scene(scene)
        assert raised.value.path == path


def test_shipped_geometries_are_valid() -> None:
    """Every geometry of the ground-truth vectors passes."""
    lines = [
        line
        for name in ("geometries.jsonl", "geometries2.jsonl")
        for line in (VECTORS / name).read_text(encoding="utf-8").splitlines()
    ]
    assert len(lines) > 100
    for line in lines:
        geometry = Geometry.from_record(json.loads(line))
        assert not list(geometry_errors(geometry, geometry.name))


def test_error_paths_are_joined() -> None:
    """A dot goes between names and not before an index."""
    assert join_path("a", "b") == "a.b"
    assert join_path("a", "[0].b") == "a[0].b"
    assert join_path("", "b") == "b"
    assert join_path("a", "") == "a"
    assert SceneError("b", "1", "2").under("a").path == "a.b"
    assert str(SceneError("b", "1", "2")) == "b: found 1, expected 2"
