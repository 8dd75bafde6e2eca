"""The oracle's operations: geometry is built once and forgotten with its source; outputs are plain."""

from __future__ import annotations

import gc
import json
import weakref
from pathlib import Path
from typing import Any

import pytest

from conformance.candidates.oracle_ops import bsp_ops, math_ops, object_ops, polygon_ops
from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.inputs import read_inputs
from conformance.own_operations import OWN_OUTPUTS
from conformance.query import Query
from conformance.scenes.model import Geometry, Leaf, Node, Polygon, Tree
from conformance.vector_library import Library

FAMILIES = {**math_ops.OPS, **polygon_ops.OPS, **bsp_ops.OPS, **object_ops.OPS}
OPS = {op: answer for op, answer in FAMILIES.items() if op not in OWN_OUTPUTS}
VECTORS = Path(__file__).parents[2] / "conformance" / "vectors"
FILES = ("math", "polygon", "bsp", "boundary_math", "boundary_polygon", "boundary_bsp", "sphere", "objects")
LIBRARY = Library(VECTORS)
DEEP = 20_000
"""More levels than the interpreter allows calls."""


def triangle(tree: Tree | None = None, planes: tuple[tuple[float, ...], ...] | None = None) -> Geometry:
    """Return a floor triangle, by default in a single leaf."""
    return Geometry(
        name="triangle",
        vertices=((-10.0, -10.0, 0.0), (10.0, -10.0, 0.0), (0.0, 10.0, 0.0)),
        polygons=(Polygon((0, 1, 2)), Polygon((0, 2, 1), 2)),
        tree=tree or Leaf(3, solid=True, sphere=(0.0, 0.0, 0.0, 15.0), polygons=(1, 0)),
        cell_planes=planes,  # type: ignore[arg-type]
    )


def first_records() -> dict[str, dict[str, Any]]:
    """Return the first vector record of each operation of these modules."""
    found: dict[str, dict[str, Any]] = {}
    for name in FILES:
        for line in (VECTORS / f"{name}.jsonl").read_text(encoding="utf-8").splitlines():
            record = json.loads(line)
            found.setdefault(record["op"], record)
    return {op: record for op, record in found.items() if op in OPS}


def test_every_operation_has_a_record() -> None:
    """The vectors know each operation, so the next test is not empty."""
    assert set(first_records()) == set(OPS)
    assert len(OPS) == 42


@pytest.mark.parametrize("op", sorted(OPS))
def test_outputs_have_the_record_s_fields_and_plain_numbers(op: str) -> None:
    """Exactly the fields of ``expect``; floats, ints, lists and null, nothing of the oracle's own."""
    record = first_records()[op]
    fields = OPS[op](Query(op, read_inputs(op, record), LIBRARY.geometries))
    assert set(fields) == set(record["expect"])
    assert plain(fields)


def plain(value: object) -> bool:
    """Tell whether a value is made of JSON's own types, exactly."""
    if isinstance(value, dict):
        return all(plain(item) for item in value.values())
    if isinstance(value, list):
        return all(plain(item) for item in value)
    return value is None or type(value) in {int, float, str}


def test_a_geometry_is_built_once() -> None:
    """The same object gives the same polygons; an equal one its own."""
    geometry = triangle()
    assert oracle_geometry(geometry) is oracle_geometry(geometry)
    assert oracle_geometry(triangle()) is not oracle_geometry(geometry)


def test_a_geometry_is_forgotten_with_its_source() -> None:
    """The cache does not keep the source alive."""
    geometry = triangle()
    oracle_geometry(geometry)
    source = weakref.ref(geometry)
    del geometry
    gc.collect()
    assert source() is None


def test_polygons_keep_their_index_order_and_sides() -> None:
    """A leaf lists polygons in its own order; ids are indices."""
    built = oracle_geometry(triangle())
    assert [polygon.poly_id for polygon in built.polygons] == [0, 1]
    assert [polygon.sides_type for polygon in built.polygons] == [0, 2]
    leaf = built.tree.root_node
    assert [polygon.poly_id for polygon in leaf.in_polys] == [1, 0]  # type: ignore[attr-defined]
    assert (leaf.leaf_index, leaf.solid) == (3, 1)  # type: ignore[attr-defined]


def test_children_keep_their_sides() -> None:
    """The positive child is the positive child."""
    sphere = (0.0, 0.0, 0.0, 15.0)
    front, back = (
        Leaf(0, solid=False, sphere=sphere, polygons=()),
        Leaf(1, solid=True, sphere=sphere, polygons=(0,)),
    )
    root = oracle_geometry(triangle(Node((0.0, 0.0, 1.0, 0.0), sphere, (0,), front, back))).tree.root_node
    positive, negative = root.children()
    assert (positive.leaf_index, negative.leaf_index) == (0, 1)  # type: ignore[attr-defined]


def test_a_deep_tree_is_built_without_recursion() -> None:
    """A chain deeper than the interpreter's stack."""
    sphere = (0.0, 0.0, 0.0, 15.0)
    tree: Tree = Leaf(0, solid=False, sphere=sphere, polygons=())
    other = Leaf(1, solid=True, sphere=sphere, polygons=(0,))
    for _ in range(DEEP):
        tree = Node((0.0, 0.0, 1.0, 0.0), sphere, (0,), tree, other)
    node, depth = oracle_geometry(triangle(tree)).tree.root_node, 0
    while node.pos_node is not None:
        node, depth = node.pos_node, depth + 1
    assert depth == DEEP


def test_cell_planes_are_chained_outermost_first() -> None:
    """Each plane is the positive child of the one before it."""
    planes = ((0.0, 0.0, 1.0, 1.0), (1.0, 0.0, 0.0, 2.0))
    tree = oracle_geometry(triangle(planes=planes)).cell_tree
    assert tree is not None
    assert tree.root_node.splitting_plane.d == 1.0
    assert tree.root_node.pos_node is not None
    assert tree.root_node.pos_node.splitting_plane.d == 2.0
    assert tree.root_node.pos_node.pos_node is None


def test_a_geometry_without_a_cell_tree_says_so() -> None:
    """Asking for one is an error that names the geometry."""
    query = Query("bsp_point_inside_cell", {"geometry": "g", "point": [0, 0, 0]}, {"g": triangle()})
    with pytest.raises(ValueError, match="geometry 'g' has no cell BSP"):
        OPS[query.op](query)
