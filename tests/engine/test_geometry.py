"""Shapes: flattened in traversal order, refused where they are wrong, with the place named."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from engine_scenes import floor_and_wall, triangle

from engine import GeometryError, Leaf, Node, Shape
from engine.layout import KIND_LEAF, KIND_NODE, KIND_SOLID_LEAF, POLYGON_COUNT

BOUNDS = (0.0, 0.0, 0.0, 10.0)
CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]


def test_a_polygon_record_begins_with_its_plane() -> None:
    """The plane comes from the vertices, with retail's roundings."""
    shape = triangle(z=0.25)
    assert list(shape.polygon_floats[:6]) == [0.0, 0.0, 1.0, -0.25, 3.0, 0.0]


def test_nodes_are_numbered_in_traversal_order() -> None:
    """A node, its positive subtree, its negative subtree; leaves point into one list."""
    deep = Node((0, 1, 0, 0), BOUNDS, Leaf(BOUNDS, (1, 0), solid=True), Leaf(BOUNDS))
    tree = Node((1, 0, 0, 0), BOUNDS, deep, Leaf(BOUNDS, (0,)))
    shape = Shape(CORNERS, [(0, 1, 2), (0, 2, 1)], tree)
    assert shape.node_ints[:, :3].tolist() == [
        [KIND_NODE, 1, 4],
        [KIND_NODE, 2, 3],
        [KIND_SOLID_LEAF, 0, 2],
        [KIND_LEAF, 2, 0],
        [KIND_LEAF, 2, 1],
    ]
    assert shape.leaf_polygons.tolist() == [1, 0, 0]
    assert shape.depth == 3


def test_a_tree_of_any_depth_is_flattened() -> None:
    """Nothing recurses: ten thousand levels are as good as ten."""
    tree: Any = Leaf(BOUNDS, (0,))
    for _ in range(10_000):
        tree = Node((1, 0, 0, 0), BOUNDS, tree, Leaf(BOUNDS))
    assert Shape(CORNERS, [(0, 1, 2)], tree).depth == 10_001


def test_numbers_are_rounded_to_float32() -> None:
    """What is stored is what retail would have read."""
    shape = Shape([(0.1, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], Leaf((0.1, 0, 0, 1), (0,)))
    assert shape.node_floats[0, 4] == np.float32(0.1)
    assert shape.polygon_floats[8] == np.float32(0.1)


@pytest.mark.parametrize(("polygon", "count"), [((0, 1, 1), 3), ((0, 1), 2), ((0,), 1), ((), 0)])
def test_degenerate_polygons_are_kept(polygon: tuple[int, ...], count: int) -> None:
    """Without an area, or with fewer than three vertices, the plane is NaN, as in retail."""
    shape = Shape(CORNERS, [polygon], Leaf(BOUNDS, (0,)))
    assert shape.polygon_floats[POLYGON_COUNT] == count
    assert np.isnan(shape.polygon_floats[:4]).all()


def twice_used() -> Node:
    """Return a tree in which a node is both children of the root."""
    inner = Node((1, 0, 0, 0), BOUNDS, Leaf(BOUNDS, (0,)), Leaf(BOUNDS))
    return Node((1, 0, 0, 0), BOUNDS, inner, inner)


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"vertices": [(0, 0, np.nan)]}, "shape, vertices: nan at (0, 2) is not a finite float32"),
    ({"vertices": [(0, 0, 1e39)]}, "shape, vertices: 1e+39 at (0, 2) is not a finite float32"),
    ({"vertices": [(0, 0)]}, "shape, vertices: shape (1, 2) where ('n', 3) is needed"),
    ({"vertices": "abc"}, "shape, vertices: not an array of numbers"),
    ({"polygons": [(0, 1, 3)]}, "shape, polygon 0: vertex 3 does not exist (3 vertices)"),
    ({"polygons": [(0, 1, -1)]}, "shape, polygon 0: vertex -1 does not exist (3 vertices)"),
    ({"polygons": [(0, 1, 2)] * 2}, "shape, polygon 1: in no leaf, so nothing can touch it"),
    ({"tree": Leaf(BOUNDS, (1,))}, "shape, node 0: polygon 1 does not exist (1 polygons)"),
    ({"tree": Leaf((0, 0, 0), (0,))}, "shape, node 0, sphere: shape (3,) where (4,) is needed"),
    (
        {"tree": Node((1, 0, 0, np.inf), BOUNDS, Leaf(BOUNDS, (0,)), Leaf(BOUNDS))},
        "shape, node 0, plane: inf at (3,) is not a finite float32",
    ),
    (
        {"tree": Node((1, 0, 0, 0), BOUNDS, Leaf(BOUNDS, (0,)), None)},  # type: ignore[arg-type]
        "shape, node 2 (negative child of node 0): not a Node or Leaf but None: every node has both children",
    ),
    (
        {"tree": twice_used()},
        "shape, node 4 (negative child of node 0): the node is its own ancestor, or used twice",
    ),
    ({"cell_planes": [(0, 0, 1)]}, "shape, cell planes: shape (1, 3) where ('n', 4) is needed"),
]


@pytest.mark.parametrize(("changed", "message"), WRONG)
def test_wrong_geometry_is_refused(changed: dict[str, Any], message: str) -> None:
    """The error says where, and the offending value."""
    parts = {"vertices": CORNERS, "polygons": [(0, 1, 2)], "tree": Leaf(BOUNDS, (0,)), **changed}
    with pytest.raises(GeometryError) as caught:
        Shape(parts["vertices"], parts["polygons"], parts["tree"], parts.get("cell_planes"))
    assert str(caught.value).startswith(message)
    assert caught.value.where == str(caught.value).partition(": ")[0]


def test_a_shape_tells_its_size() -> None:
    """Its repr names it and counts polygons and nodes."""
    assert repr(floor_and_wall()) == "<Shape 'corner': 2 polygons, 3 nodes>"
