"""Laws of names: what things are called, and what is not there for anybody, changes no bit of an answer.

They hold for every query, without a condition on its numbers: nothing that they change is computed with.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.laws.law import Law, unlike
from conformance.scenes.block_shifts import shift_inputs, shifted_id
from conformance.scenes.model import Leaf, Node, Polygon
from conformance.strategies.collisions import DISPATCHES, find_collisions, transitions

if TYPE_CHECKING:
    from conformance.laws.law import Ask
    from conformance.query import Fields, Query
    from conformance.scenes.model import Geometry, Tree

SHIFT: Final = (1, -1)
"""Landblocks to the east and to the north."""
FAR: Final = float(1 << 23)
"""Metres from the root's sphere to the plane of an added node. An initial placement doubles the mover's
radius up to twenty times (03, PI-2…7); a ball over the plane would be asked about in another order."""
LONELY_CELL: Final = 0x7FFF
"""Low word of the id of a cell that no portal leads to."""
_CALLS: Final = st.one_of([find_collisions(dispatch) for dispatch in DISPATCHES])
_CELLS: Final = ("check_cell", "curr_cell")
_POSES: Final = ("check", "curr")
_PLANES: Final = ("contact_plane", "last_known_contact_plane")


def another_landblock(query: Query, ask: Ask) -> str:
    """Another landblock: the same scene under ids of another block.

    Condition: everything is in one landblock and no land is loaded. Coordinates count from their block's
    corner, and a block's place enters only as the offset between two blocks (LandDefs::get_block_offset),
    which is zero. So every number stays, and every cell id is shifted.
    """
    moved = replace(query, inputs=_shifted(query.inputs))
    return unlike(query.op, _with_shifted_cells(ask(query)), ask(moved), "in another landblock")


def _shifted(inputs: Any) -> dict[str, Any]:
    shifted = shift_inputs(inputs, SHIFT)
    for cell in shifted.get("cells", ()):
        if "statics" in cell:
            cell["statics"] = [shift_inputs(static, SHIFT) for static in cell["statics"]]
    return shifted


def _with_shifted_cells(fields: Fields) -> Fields:
    carried = dict(fields)
    for name in _CELLS:
        carried[name] = shifted_id(fields[name], SHIFT)
    for name in _POSES:
        carried[name] = {**fields[name], "cell": shifted_id(fields[name]["cell"], SHIFT)}
    for name in _PLANES:
        plane = fields[name]
        if "cell_id" in plane:
            carried[name] = {**plane, "cell_id": shifted_id(plane["cell_id"], SHIFT)}
    return carried


def renumbered(query: Query, ask: Ask) -> str:
    """Renumbered: polygons and vertices are numbered from the end.

    Condition: none; the leaves list the same polygons in the same order. Retail finds polygons by a leaf's
    list and corners by a polygon's, and never compares two numbers. So only the number of the walkable
    polygon changes, to its new one.
    """
    other = replace(query, geometries={name: _reversed(shape) for name, shape in query.geometries.items()})
    fields = ask(query)
    return unlike(query.op, _with_new_number(fields, query), ask(other), "with other numbers")


def _reversed(shape: Geometry) -> Geometry:
    last, last_vertex = len(shape.polygons) - 1, len(shape.vertices) - 1
    polygons = [
        Polygon(tuple(last_vertex - index for index in polygon.vertices), polygon.sides)
        for polygon in reversed(shape.polygons)
    ]
    tree = _with_numbers(shape.tree, last)
    return replace(shape, vertices=shape.vertices[::-1], polygons=tuple(polygons), tree=tree)


def _with_numbers(tree: Tree, last: int) -> Tree:
    numbers = tuple(last - polygon for polygon in tree.polygons)
    if isinstance(tree, Leaf):
        return replace(tree, polygons=numbers)
    sides = (_with_numbers(side, last) for side in (tree.positive, tree.negative))
    return Node(tree.plane, tree.sphere, numbers, *sides)


def _with_new_number(fields: Fields, query: Query) -> Fields:
    if fields.get("walkable") is None:
        return fields
    name = fields.get("walkable_geometry") or query.inputs["geometry"]
    shape = query.geometries[name]
    return {**fields, "walkable": len(shape.polygons) - 1 - fields["walkable"]}


def refined(query: Query, ask: Ask) -> str:
    """Refined: a node above the root, with everything before its plane and an empty leaf behind.

    Condition: the node's sphere is the root's, and its plane is farther below than any ball reaches. What
    the sphere does not stop then goes to the root alone, as before. Were the plane nearer, the leaf would be
    asked too: it holds no polygon and reports none, but an initial placement, whose balls grow, also goes by
    what the last node said of their middle.
    """
    other = replace(query, geometries={name: _below(shape) for name, shape in query.geometries.items()})
    return unlike(query.op, ask(query), ask(other), "with a refined tree")


def _below(shape: Geometry) -> Geometry:
    root = shape.tree
    bottom = root.sphere[2] - root.sphere[3] - FAR
    empty = Leaf(_free_index(root), solid=False, sphere=root.sphere, polygons=())
    return replace(shape, tree=Node((0.0, 0.0, 1.0, -bottom), root.sphere, (), root, empty))


def _free_index(tree: Tree) -> int:
    if isinstance(tree, Leaf):
        return tree.index + 1
    return max(_free_index(tree.positive), _free_index(tree.negative))


def lonely_cell(query: Query, ask: Ask) -> str:
    """Lonely cell: a further cell, over the first one, that no portal leads to.

    Condition: it has another id, and it is listed by no cell. A mover's cells are found by way of portals
    from the one that it is in (CObjCell::find_cell_list), so that cell is never looked at.
    """
    first = query.inputs["cells"][0]
    lonely = {**first, "id": first["id"] & ~0xFFFF | LONELY_CELL}
    other = replace(query, inputs={**query.inputs, "cells": [*query.inputs["cells"], lonely]})
    return unlike(query.op, ask(query), ask(other), "beside a cell that nobody can reach")


LAWS: Final = (
    Law("another landblock", _CALLS | transitions(), another_landblock),
    Law("renumbered", _CALLS | transitions(), renumbered),
    Law("refined tree", _CALLS | transitions(), refined),
    Law("lonely cell", transitions(), lonely_cell),
)
