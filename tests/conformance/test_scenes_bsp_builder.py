"""The builder makes the trees that are expected of known shapes."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from brute_force import EPS, leaf_at, listed_near

import conformance
from conformance.scenes.bsp_builder import TreeStyle, build, build_tree
from conformance.scenes.errors import SceneError
from conformance.scenes.model import Geometry, Leaf, Node, walk_tree
from conformance.scenes.polygons import Shape, flip, place
from conformance.scenes.primitives import box, floor, room
from conformance.scenes.validate import check_geometry

VECTORS = Path(conformance.__file__).parent / "vectors"
FLOOR_TRIANGLE = [((-10.0, -10.0, 0.0), (10.0, -10.0, 0.0), (0.0, 10.0, 0.0))]
MANY = 5000


def leaves(geometry: Geometry) -> list[Leaf]:
    """Return the leaves in order."""
    return [node for node in walk_tree(geometry.tree) if isinstance(node, Leaf)]


def ball(rings: int, sectors: int) -> Shape:
    """Return a ball of flat facets that face outwards: every polygon is in front of no other."""

    def at(ring: int, sector: int) -> tuple[float, float, float]:
        lat, lon = math.pi * ring / rings, 2.0 * math.pi * sector / sectors
        return (5 * math.sin(lat) * math.cos(lon), 5 * math.sin(lat) * math.sin(lon), 5 * math.cos(lat))

    shape: Shape = []
    for i in range(1, rings - 1):
        for j in range(sectors):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            shape += [(a, b, c), (a, c, d)]
    return shape


@pytest.mark.parametrize(
    ("style", "name"), [(TreeStyle.BEHIND, "seed_tri"), (TreeStyle.FRONT, "seed_tri_front")]
)
def test_floor_triangle_as_in_the_vectors(style: TreeStyle, name: str) -> None:
    """The tree of the single floor triangle is the one in the ground truth, but for the spheres' slack."""
    lines = (VECTORS / "geometries.jsonl").read_text(encoding="utf-8").splitlines()
    expected = next(record for record in map(json.loads, lines) if record["name"] == name)
    built = build(name, FLOOR_TRIANGLE, style=style, kind="seed").to_record()
    assert {key: built[key] for key in ("vertices", "polygons")} == {
        key: expected[key] for key in ("vertices", "polygons")
    }
    for side in ("pos", "neg"):
        for key in ("leaf", "solid", "polys"):
            assert built["bsp"][side][key] == expected["bsp"][side][key]
    assert built["bsp"]["plane"] == expected["bsp"]["plane"]
    # The tightest float32 radius that holds corners at sqrt(200) m.
    assert built["bsp"]["sphere"] == [0.0, 0.0, 0.0, 14.142136573791504]


@pytest.mark.parametrize(
    ("style", "empty", "solid"),
    [(TreeStyle.FRONT, 6, 0), (TreeStyle.BEHIND, 0, 1), (TreeStyle.BOTH, 6, 1)],
)
def test_styles_list_a_rooms_faces(style: TreeStyle, empty: int, solid: int) -> None:
    """The inside of a room lists all faces or none, each solid leaf behind a face lists it or not."""
    geometry = build("room", room(size=(4.0, 4.0, 3.0)), style=style, kind="room")
    inside = leaf_at(geometry.tree, (0.0, 0.0, 1.0))
    assert (inside.solid, len(inside.polygons)) == (False, empty)
    behind = [leaf for leaf in leaves(geometry) if leaf is not inside]
    assert len(behind) == 6
    assert all(leaf.solid and len(leaf.polygons) >= solid for leaf in behind)
    assert all(bool(leaf.polygons) == bool(solid) for leaf in behind)


def test_leaves_list_polygons_by_rising_id() -> None:
    """The first hit in a leaf wins, so the order is fixed: the author's."""
    geometry = build("room", room(size=(4.0, 4.0, 3.0)), style=TreeStyle.FRONT, kind="room")
    assert leaf_at(geometry.tree, (0.0, 0.0, 1.0)).polygons == (0, 1, 2, 3, 4, 5)


def test_spanning_polygons_are_in_several_leaves() -> None:
    """A floor that runs under a wall is listed on both sides of it."""
    wall = [((0.0, -1.0, 0.0), (0.0, 1.0, 0.0), (0.0, 1.0, 2.0), (0.0, -1.0, 2.0))]
    geometry = build("both", wall + floor(size=(4.0, 4.0)), style=TreeStyle.FRONT, kind="test")
    for x in (-1.0, 1.0):
        assert 1 in leaf_at(geometry.tree, (x, 0.0, 0.5)).polygons


def test_coplanar_polygons_share_a_node() -> None:
    """All tiles of a floor are on the root's plane, and in the one leaf above it."""
    geometry = build("tiles", floor(size=(4.0, 4.0), tiles=(2, 2)), style=TreeStyle.FRONT, kind="test")
    assert isinstance(geometry.tree, Node)
    assert geometry.tree.polygons == (0, 1, 2, 3)
    assert leaf_at(geometry.tree, (0.0, 0.0, 1.0)).polygons == (0, 1, 2, 3)


def test_faces_back_to_back_do_not_hollow_out_the_ground() -> None:
    """A box on a floor: its bottom faces down from the floor's plane, and below is solid all the same."""
    shape = box(size=(1.0, 1.0, 1.0)) + room(size=(4.0, 4.0, 3.0))
    geometry = build("box", shape, style=TreeStyle.FRONT, kind="test")
    answers = {z: leaf_at(geometry.tree, (0.1, 0.2, z)).solid for z in (-0.5, 0.5, 1.5, 3.5)}
    assert answers == {-0.5: True, 0.5: True, 1.5: False, 3.5: True}


def test_two_sided_sheet_in_a_room_is_not_solid() -> None:
    """Front and back of a thin board cancel: the room around it stays empty."""
    board = place(floor(size=(1.0, 1.0)), (0.0, 0.0, 1.0), 0.0)
    geometry = build(
        "board", room(size=(4.0, 4.0, 3.0)) + board + flip(board), style=TreeStyle.FRONT, kind="test"
    )
    assert [leaf_at(geometry.tree, (0.1, 0.2, z)).solid for z in (0.5, 1.5)] == [False, False]


def test_stacked_boxes_are_solid() -> None:
    """Faces that touch inside of solid matter cancel: what is around them decides."""
    shape = box(size=(1.0, 1.0, 1.0)) + place(box(size=(1.0, 1.0, 1.0)), (0.0, 0.0, 1.0), 0.0)
    geometry = build("tower", shape, style=TreeStyle.BEHIND, kind="test")
    assert [leaf_at(geometry.tree, (0.1, 0.2, z)).solid for z in (0.5, 1.5, 2.5)] == [True, True, False]


def test_no_polygons_make_one_empty_leaf() -> None:
    """A geometry without polygons is a tree without planes."""
    assert build_tree((), (), TreeStyle.FRONT) == Leaf(0, False, (0.0, 0.0, 0.0, 0.0), ())


def test_bad_polygons_are_refused() -> None:
    """The builder checks what it is given, as rounded to float32."""
    sliver = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1e-12, 0.0))
    with pytest.raises(SceneError) as raised:
        build("sliver", [*FLOOR_TRIANGLE, sliver], style=TreeStyle.FRONT, kind="test")
    assert raised.value.path == "polygons[1]"


@pytest.mark.parametrize(
    "shape", [ball(52, 50), floor(size=(100.0, 100.0), tiles=(71, 71))], ids=["ball", "tiles"]
)
def test_thousands_of_polygons(shape: Shape) -> None:
    """A tree of five thousand polygons is built without recursion and is valid."""
    assert len(shape) >= MANY
    check_geometry(build("many", shape, style=TreeStyle.FRONT, kind="test"), "many")


def test_a_ball_does_not_become_a_list() -> None:
    """Axis-parallel planes keep the tree of a convex hull far shallower than it has polygons."""
    geometry = build("ball", ball(20, 20), style=TreeStyle.BEHIND, kind="test")
    depth = {id(geometry.tree): 1}
    for node in walk_tree(geometry.tree):
        if isinstance(node, Node):
            depth[id(node.positive)] = depth[id(node.negative)] = depth[id(node)] + 1
    assert max(depth.values()) < len(geometry.polygons) / 8
    assert leaf_at(geometry.tree, (0.0, 0.0, 0.0)).solid


@pytest.mark.parametrize("style", list(TreeStyle))
@pytest.mark.parametrize("offset", [0.0005, 0.002, 0.005])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_layers_a_hair_apart_are_not_one_plane(style: TreeStyle, offset: float, side: float) -> None:
    """A sphere that touches the nearer of two floors by half its distance to the other finds it."""
    shape = floor(size=(2.0, 2.0)) + place(floor(size=(2.0, 2.0)), (0.0, 0.0, side * offset), 0.0)
    geometry = build("layers", shape, style=style, kind="test")
    radius = 0.5
    center = (0.0, 0.0, side * (offset + radius - EPS - offset / 2))
    assert 1 in listed_near(geometry, center, radius)
