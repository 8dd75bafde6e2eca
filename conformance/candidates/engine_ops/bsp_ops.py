"""Questions to a BSP tree, asked of its root (``bsp.jsonl``), by the engine; all in geometry space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.engine_ops.values import ball, floats, vector
from conformance.candidates.engine_ops.world_cache import engine_shape, sole_world
from engine import layout as at
from engine.kernels.bsp_cell import point_inside_cell_bsp, sphere_intersects_cell_bsp
from engine.kernels.bsp_poly import (
    point_intersects_solid,
    sphere_intersects_poly,
    sphere_intersects_solid,
    sphere_intersects_solid_poly,
)
from engine.kernels.bsp_search import adjust_to_plane
from engine.kernels.bsp_walkable import find_walkable, hits_walkable

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from engine.kernels.types import Array, Ints

_UNWRITTEN: Final = 1e300
"""Stands in an output point before a call; no float32 has this value."""


class _Tree:
    """A geometry's arrays, its root and a row of state."""

    def __init__(self, query: Query) -> None:
        self.world: Final = sole_world(query.geometries[query.inputs["geometry"]])
        self.row: Final[Array] = self.world.new_row()

    @property
    def arguments(self) -> tuple[Array, Ints, Array, int]:
        """The first arguments of a walk through the tree."""
        return self.world.floats, self.world.ints, self.row, self.world.tree_of(0)

    def polygon_id(self, polygon: int) -> int | None:
        """Return the id of the polygon whose record lies at an offset."""
        return None if polygon == at.NO_POLYGON else int(self.world.floats[polygon + at.POLYGON_ID])


def _point_intersects_solid(query: Query) -> Fields:
    wf, wi, _, root = _Tree(query).arguments
    return {"r": int(point_intersects_solid(wf, wi, root, *vector(query.inputs["point"])))}


def _sphere_intersects_poly(query: Query) -> Fields:
    tree = _Tree(query)
    contact = slice(at.CONTACT_POINT, at.CONTACT_POINT + at.VECTOR_SIZE)
    tree.row[contact] = _UNWRITTEN
    struck, polygon = sphere_intersects_poly(
        *tree.arguments, ball(query.inputs["sphere"]), vector(query.inputs["movement"]), at.NO_POLYGON
    )
    point = floats(tree.row[contact])
    return {
        "r": int(struck),
        "poly": tree.polygon_id(polygon),
        "contact": None if point[0] == _UNWRITTEN else point,
    }


def _sphere_intersects_solid(query: Query) -> Fields:
    center_check = int(query.inputs["center_check"])
    r = sphere_intersects_solid(*_Tree(query).arguments, ball(query.inputs["sphere"]), center_check)
    return {"r": int(r)}


def _hits_walkable(query: Query) -> Fields:
    tree = _Tree(query)
    tree.row[at.WALKABLE_ALLOWANCE] = query.inputs["walkable_allowance"]
    r = hits_walkable(*tree.arguments, ball(query.inputs["sphere"]), vector(query.inputs["up"]))
    return {"r": int(r)}


def _find_walkable(query: Query) -> Fields:
    inputs = query.inputs
    tree = _Tree(query)
    tree.row[at.WALKABLE_ALLOWANCE] = inputs["walkable_allowance"]
    tree.row[at.WALK_INTERP] = inputs["walk_interp"]
    polygon, center = find_walkable(
        *tree.arguments, ball(inputs["sphere"]), vector(inputs["movement"]), vector(inputs["up"])
    )
    return {
        "changed": int(polygon != at.NO_POLYGON),
        "poly": tree.polygon_id(polygon),
        "center": list(center),
        "walk_interp": float(tree.row[at.WALK_INTERP]),
    }


def _sphere_intersects_solid_poly(query: Query) -> Fields:
    inputs = query.inputs
    tree = _Tree(query)
    r, center_solid, polygon = sphere_intersects_solid_poly(
        *tree.arguments,
        ball(inputs["sphere"]),
        float(inputs["radius"]),
        int(inputs["center_solid"]),
        at.NO_POLYGON,
        int(inputs["center_check"]),
    )
    return {"r": r, "center_solid": center_solid, "poly": tree.polygon_id(polygon)}


def _adjust_to_plane(query: Query) -> Fields:
    inputs = query.inputs
    tree = _Tree(query)
    polygon = tree.world.polygon(0, int(inputs["poly"]))
    found, center = adjust_to_plane(*tree.arguments, ball(inputs["sphere"]), vector(inputs["curr"]), polygon)
    return {"r": int(found), "center": list(center)}


def _cell_planes(query: Query) -> tuple[Array, int, int]:
    """Return a geometry's containment planes: array, offset of the first, how many."""
    planes = engine_shape(query.geometries[query.inputs["geometry"]]).cell_planes
    if planes is None:
        raise ValueError(f"geometry {query.inputs['geometry']!r} has no cell BSP")
    return planes.ravel(), 0, len(planes)


def _point_inside_cell(query: Query) -> Fields:
    return {"r": int(point_inside_cell_bsp(*_cell_planes(query), *vector(query.inputs["point"])))}


def _sphere_intersects_cell(query: Query) -> Fields:
    return {"r": sphere_intersects_cell_bsp(*_cell_planes(query), *ball(query.inputs["sphere"]))}


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "bsp_point_intersects_solid": _point_intersects_solid,
    "bsp_sphere_intersects_poly": _sphere_intersects_poly,
    "bsp_sphere_intersects_solid": _sphere_intersects_solid,
    "bsp_hits_walkable": _hits_walkable,
    "bsp_find_walkable": _find_walkable,
    "bsp_sphere_intersects_solid_poly": _sphere_intersects_solid_poly,
    "bsp_adjust_to_plane": _adjust_to_plane,
    "bsp_point_inside_cell": _point_inside_cell,
    "bsp_sphere_intersects_cell": _sphere_intersects_cell,
}
"""Operation name to function."""
