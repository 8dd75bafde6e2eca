"""Questions to a single polygon (``polygon.jsonl``), by the oracle; all in geometry space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.candidates.oracle_ops.values import (
    nxyzd,
    point_or_null,
    ray_of,
    sphere,
    untouched,
    vector,
    xyz,
)
from oracle.arithmetic import f32
from oracle.enums import Sidedness
from oracle.ref import Ref
from oracle.sphere_path import SpherePath
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from oracle.polygon import Polygon


def _polygon(query: Query) -> Polygon:
    geometry = oracle_geometry(query.geometries[query.inputs["geometry"]])
    return geometry.polygons[int(query.inputs["poly"])]


def _make_plane(query: Query) -> Fields:
    return {"plane": nxyzd(_polygon(query).plane)}


def _point_in_polygon(query: Query) -> Fields:
    return {"r": _polygon(query).point_in_polygon(vector(query.inputs["point"]))}


def _point_in_poly2d(query: Query) -> Fields:
    side = Sidedness(query.inputs["side"])
    return {"r": _polygon(query).point_in_poly2D(vector(query.inputs["point"]), side)}


def _hits_sphere_fast(query: Query) -> Fields:
    contact: Ref[Vector3 | None] = Ref(None)
    r = _polygon(query).polygon_hits_sphere(sphere(query.inputs["sphere"]), contact)
    return {"r": r, "contact": point_or_null(contact)}


def _hits_sphere_slow(query: Query) -> Fields:
    contact: Ref[Vector3 | None] = Ref(None)
    r = _polygon(query).polygon_hits_sphere_slow_but_sure(sphere(query.inputs["sphere"]), contact)
    return {"r": r, "contact": point_or_null(contact)}


def _pos_hits_sphere(query: Query) -> Fields:
    contact: Ref[Vector3 | None] = Ref(None)
    struck: Ref[Polygon | None] = Ref(None)
    r = _polygon(query).pos_hits_sphere(
        sphere(query.inputs["sphere"]), vector(query.inputs["movement"]), contact, struck
    )
    return {"r": r, "struck": int(struck.value is not None), "contact": point_or_null(contact)}


def _walkable_hits_sphere(query: Query) -> Fields:
    path = SpherePath()
    path.walkable_allowance = f32(query.inputs["walkable_allowance"])
    ball, up = sphere(query.inputs["sphere"]), vector(query.inputs["up"])
    return {"r": _polygon(query).walkable_hits_sphere(path, ball, up)}


def _check_walkable(query: Query) -> Fields:
    ball, up = sphere(query.inputs["sphere"]), vector(query.inputs["up"])
    return {"r": _polygon(query).check_walkable(ball, up)}


def _check_small_walkable(query: Query) -> Fields:
    ball, up = sphere(query.inputs["sphere"]), vector(query.inputs["up"])
    return {"r": _polygon(query).check_small_walkable(ball, up)}


def _find_crossed_edge(query: Query) -> Fields:
    normal = Vector3()
    ball, up = sphere(query.inputs["sphere"]), vector(query.inputs["up"])
    r = _polygon(query).find_crossed_edge(ball, up, normal)
    return {"r": r, "normal": xyz(normal) if r else None}


def _adjust_sphere_to_plane(query: Query) -> Fields:
    path = SpherePath()
    path.walk_interp = f32(query.inputs["walk_interp"])
    valid = sphere(query.inputs["sphere"])
    r = _polygon(query).adjust_sphere_to_plane(path, valid, vector(query.inputs["movement"]))
    return {"r": r, "center": xyz(valid.center), "walk_interp": path.walk_interp}


def _adjust_sphere_to_poly(query: Query) -> Fields:
    check, curr = sphere(query.inputs["sphere"]), vector(query.inputs["curr"])
    return {"t": _polygon(query).adjust_sphere_to_poly(check, curr, vector(query.inputs["movement"]))}


def _adjust_to_placement_poly(query: Query) -> Fields:
    struck, other = sphere(query.inputs["sphere"]), sphere(query.inputs["other"])
    radius = f32(query.inputs["radius"])
    _polygon(query).adjust_to_placement_poly(
        struck, other, radius, query.inputs["center_solid"], query.inputs["solid_check"]
    )
    return {"center": xyz(struck.center), "other_center": xyz(other.center)}


def _hits_ray(query: Query) -> Fields:
    time = untouched()
    r = _polygon(query).polygon_hits_ray(ray_of(query.inputs), time)
    return {"r": r, "time": time.value}


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "polygon_make_plane": _make_plane,
    "polygon_point_in_polygon": _point_in_polygon,
    "polygon_point_in_poly2D": _point_in_poly2d,
    "polygon_hits_sphere_fast": _hits_sphere_fast,
    "polygon_hits_sphere_slow": _hits_sphere_slow,
    "polygon_pos_hits_sphere": _pos_hits_sphere,
    "polygon_walkable_hits_sphere": _walkable_hits_sphere,
    "polygon_check_walkable": _check_walkable,
    "polygon_check_small_walkable": _check_small_walkable,
    "polygon_find_crossed_edge": _find_crossed_edge,
    "polygon_adjust_sphere_to_plane": _adjust_sphere_to_plane,
    "polygon_adjust_sphere_to_poly": _adjust_sphere_to_poly,
    "polygon_adjust_to_placement_poly": _adjust_to_placement_poly,
    "polygon_hits_ray": _hits_ray,
}
"""Operation name to function."""
