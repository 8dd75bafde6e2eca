"""Questions to one polygon (``polygon.jsonl``), by the engine; all in geometry space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.engine_ops.values import ball, floats, point_or_null, vector
from conformance.candidates.engine_ops.world_cache import engine_shape
from engine import layout as at
from engine.kernels import polygon as polygons
from engine.kernels import polygon_adjust, polygon_support
from engine.kernels.bsp_placement import pushed
from engine.kernels.polygon_edges import BEYOND, HIT

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from engine.kernels.types import Array


def _polygon(query: Query) -> tuple[Array, int]:
    """Return the array and the offset of the polygon that is asked."""
    shape = engine_shape(query.geometries[query.inputs["geometry"]])
    return shape.polygon_floats, int(shape.polygon_offsets[int(query.inputs["poly"])])


def _make_plane(query: Query) -> Fields:
    wf, p = _polygon(query)
    return {"plane": floats(wf[p : p + at.PLANE_SIZE])}


def _point_in_polygon(query: Query) -> Fields:
    return {"r": int(polygons.polygon_point_in_polygon(*_polygon(query), *vector(query.inputs["point"])))}


def _point_in_poly2d(query: Query) -> Fields:
    x, y, _ = vector(query.inputs["point"])
    side = int(query.inputs["side"])
    return {"r": int(polygons.polygon_point_in_poly2d(*_polygon(query), x, y, side))}


def _hits_sphere(kernel: Callable[..., Any]) -> Callable[[Query], Fields]:
    def operation(query: Query) -> Fields:
        code, *contact = kernel(*_polygon(query), ball(query.inputs["sphere"]))
        reached = code != BEYOND
        return {"r": int(code == HIT), "contact": point_or_null(*contact, valid=reached)}

    return operation


def _pos_hits_sphere(query: Query) -> Fields:
    wf, p = _polygon(query)
    code, *contact = polygons.polygon_hits_sphere_slow_but_sure(wf, p, ball(query.inputs["sphere"]))
    hit = code == HIT
    against = not polygons.polygon_moved_along(wf, p, vector(query.inputs["movement"]))
    return {
        "r": int(hit and against),
        "struck": int(hit),
        "contact": point_or_null(*contact, valid=code != BEYOND),
    }


def _walkable_hits_sphere(query: Query) -> Fields:
    inputs = query.inputs
    r = polygons.polygon_walkable_hits_sphere(
        *_polygon(query), ball(inputs["sphere"]), vector(inputs["up"]), float(inputs["walkable_allowance"])
    )
    return {"r": int(r)}


def _supports(kernel: Callable[..., bool]) -> Callable[[Query], Fields]:
    def operation(query: Query) -> Fields:
        r = kernel(*_polygon(query), ball(query.inputs["sphere"]), vector(query.inputs["up"]))
        return {"r": int(r)}

    return operation


def _find_crossed_edge(query: Query) -> Fields:
    center, up = vector(query.inputs["sphere"][:3]), vector(query.inputs["up"])
    found, *normal = polygon_support.polygon_find_crossed_edge(*_polygon(query), center, up)
    return {"r": int(found), "normal": point_or_null(*normal, valid=found)}


def _adjust_sphere_to_plane(query: Query) -> Fields:
    inputs = query.inputs
    moved, (*center, _), interp = polygon_adjust.polygon_adjust_sphere_to_plane(
        *_polygon(query), ball(inputs["sphere"]), vector(inputs["movement"]), float(inputs["walk_interp"])
    )
    return {"r": int(moved), "center": center, "walk_interp": interp}


def _adjust_sphere_to_poly(query: Query) -> Fields:
    inputs = query.inputs
    t = polygon_adjust.polygon_adjust_sphere_to_poly(
        *_polygon(query), float(inputs["sphere"][3]), vector(inputs["curr"]), vector(inputs["movement"])
    )
    return {"t": t}


def _adjust_to_placement_poly(query: Query) -> Fields:
    inputs = query.inputs
    center, other = vector(inputs["sphere"][:3]), vector(inputs["other"][:3])
    push = polygon_adjust.polygon_placement_push(
        *_polygon(query),
        *center,
        float(inputs["radius"]),
        int(inputs["center_solid"]),
        int(inputs["solid_check"]),
    )
    return {"center": list(pushed(*center, *push)), "other_center": list(pushed(*other, *push))}


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "polygon_make_plane": _make_plane,
    "polygon_point_in_polygon": _point_in_polygon,
    "polygon_point_in_poly2D": _point_in_poly2d,
    "polygon_hits_sphere_fast": _hits_sphere(polygons.polygon_hits_sphere),
    "polygon_hits_sphere_slow": _hits_sphere(polygons.polygon_hits_sphere_slow_but_sure),
    "polygon_pos_hits_sphere": _pos_hits_sphere,
    "polygon_walkable_hits_sphere": _walkable_hits_sphere,
    "polygon_check_walkable": _supports(polygon_support.polygon_check_walkable),
    "polygon_check_small_walkable": _supports(polygon_support.polygon_check_small_walkable),
    "polygon_find_crossed_edge": _find_crossed_edge,
    "polygon_adjust_sphere_to_plane": _adjust_sphere_to_plane,
    "polygon_adjust_sphere_to_poly": _adjust_sphere_to_poly,
    "polygon_adjust_to_placement_poly": _adjust_to_placement_poly,
}
"""Operation name to function."""
