"""Questions to a BSP tree, asked of its root (``bsp.jsonl``), by the oracle; all in geometry space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.candidates.oracle_ops.values import point_or_null, sphere, vector, xyz
from oracle.arithmetic import f32
from oracle.ref import Ref
from oracle.sphere_path import SpherePath

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.candidates.oracle_ops.geometry import OracleGeometry
    from conformance.query import Fields, Query
    from oracle.bsp_node import BSPNode
    from oracle.bsp_tree import BSPTree
    from oracle.polygon import Polygon
    from oracle.vector import Vector3


def _geometry(query: Query) -> OracleGeometry:
    return oracle_geometry(query.geometries[query.inputs["geometry"]])


def _root(query: Query) -> BSPNode:
    return _geometry(query).tree.root_node


def _cell_tree(query: Query) -> BSPTree:
    tree = _geometry(query).cell_tree
    if tree is None:
        raise ValueError(f"geometry {query.inputs['geometry']!r} has no cell BSP")
    return tree


def _id_or_null(polygon: Ref[Polygon | None]) -> int | None:
    return None if polygon.value is None else polygon.value.poly_id


def _point_intersects_solid(query: Query) -> Fields:
    return {"r": _root(query).point_intersects_solid(vector(query.inputs["point"]))}


def _sphere_intersects_poly(query: Query) -> Fields:
    polygon: Ref[Polygon | None] = Ref(None)
    contact: Ref[Vector3 | None] = Ref(None)
    r = _root(query).sphere_intersects_poly(
        sphere(query.inputs["sphere"]), vector(query.inputs["movement"]), polygon, contact
    )
    return {"r": r, "poly": _id_or_null(polygon), "contact": point_or_null(contact)}


def _sphere_intersects_solid(query: Query) -> Fields:
    ball = sphere(query.inputs["sphere"])
    return {"r": _root(query).sphere_intersects_solid(ball, query.inputs["center_check"])}


def _hits_walkable(query: Query) -> Fields:
    path = SpherePath()
    path.walkable_allowance = f32(query.inputs["walkable_allowance"])
    ball, up = sphere(query.inputs["sphere"]), vector(query.inputs["up"])
    return {"r": _root(query).hits_walkable(path, ball, up)}


def _find_walkable(query: Query) -> Fields:
    path = SpherePath()
    path.walkable_allowance = f32(query.inputs["walkable_allowance"])
    path.walk_interp = f32(query.inputs["walk_interp"])
    valid = sphere(query.inputs["sphere"])
    polygon: Ref[Polygon | None] = Ref(None)
    changed = Ref(0)
    movement, up = vector(query.inputs["movement"]), vector(query.inputs["up"])
    _root(query).find_walkable(path, valid, polygon, movement, up, changed)
    return {
        "changed": changed.value,
        "poly": _id_or_null(polygon),
        "center": xyz(valid.center),
        "walk_interp": path.walk_interp,
    }


def _sphere_intersects_solid_poly(query: Query) -> Fields:
    center_solid = Ref(int(query.inputs["center_solid"]))
    polygon: Ref[Polygon | None] = Ref(None)
    r = _root(query).sphere_intersects_solid_poly(
        sphere(query.inputs["sphere"]),
        f32(query.inputs["radius"]),
        center_solid,
        polygon,
        query.inputs["center_check"],
    )
    return {"r": r, "center_solid": center_solid.value, "poly": _id_or_null(polygon)}


def _adjust_to_plane(query: Query) -> Fields:
    geometry = _geometry(query)
    check, curr = sphere(query.inputs["sphere"]), vector(query.inputs["curr"])
    hit_poly = geometry.polygons[int(query.inputs["poly"])]
    r = geometry.tree.adjust_to_plane(check, curr, hit_poly, Ref(None))
    return {"r": r, "center": xyz(check.center)}


def _point_inside_cell(query: Query) -> Fields:
    return {"r": _cell_tree(query).point_inside_cell_bsp(vector(query.inputs["point"]))}


def _sphere_intersects_cell(query: Query) -> Fields:
    return {"r": int(_cell_tree(query).sphere_intersects_cell_bsp(sphere(query.inputs["sphere"])))}


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
