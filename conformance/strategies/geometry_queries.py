"""Queries of single polygons and BSP trees, in the geometry's own frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.inputs import FORMAT_OPS, REQUIRED
from conformance.strategies.contact import draw_aim
from conformance.strategies.movers import ALLOWANCES
from conformance.strategies.numbers import DIRECTIONS, FLAGS, NEARLY, along, anywhere, grid, vectors
from conformance.strategies.scenes import GEOMETRIES, WITH_CELL_PLANES
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from conformance.query import Query
    from conformance.scenes.model import Vec3
    from conformance.strategies.contact import Aim

POLYGON_OPS: Final = tuple(op for op in FORMAT_OPS if op.startswith("polygon_"))
BSP_OPS: Final = tuple(op for op in FORMAT_OPS if op.startswith("bsp_"))

_CELL_OPS: Final = frozenset({"bsp_point_inside_cell", "bsp_sphere_intersects_cell"})
_RADII: Final = st.just(0.48) | grid(0.0625, 1.0)
_UPS: Final = st.just((0.0, 0.0, 1.0)) | DIRECTIONS
_UNIT_INTERVAL: Final = st.just(1.0) | anywhere(0.0, 1.0)
_WAYS: Final = st.sampled_from(("into", "down", "aslant", "any"))
_NOWHERE: Final = (0.0, 0.0, 0.0)


@st.composite
def geometry_queries(draw: st.DrawFn, op: str) -> Query:
    """Generate queries of one polygon or BSP operation, aimed at a polygon."""
    geometry = draw(WITH_CELL_PLANES if op in _CELL_OPS else GEOMETRIES)
    radius = draw(_RADII)
    aim = draw_aim(draw, geometry, radius, floors="walkable" in op)
    inputs = {key: _draw_input(draw, key, op, aim, radius) for key in REQUIRED[op] if key != "geometry"}
    return query_from_record({"op": op, "geometry": geometry.name, **inputs}, {geometry.name: geometry})


def _draw_input(draw: st.DrawFn, key: str, op: str, aim: Aim, radius: float) -> Any:
    match key:
        case "poly":
            return aim.polygon
        case "sphere":
            return [*aim.center, radius]
        case "other":
            return [*along(aim.center, draw(vectors(1.5)), 1.0), radius]
        case "point":
            return _draw_point(draw, op, aim)
        case "movement":
            return _draw_movement(draw, aim, radius)
        case "curr":
            return along(aim.center, _draw_movement(draw, aim, radius), -1.0)
        case "radius":
            return radius * (1 + draw(FLAGS))
        case "up":
            return draw(_UPS)
        case "walkable_allowance":
            return aim.normal[2] + draw(NEARLY) if draw(FLAGS) else draw(ALLOWANCES)
        case "walk_interp":
            return draw(_UNIT_INTERVAL)
        case "side" | "center_check" | "center_solid" | "solid_check":
            return draw(FLAGS)
        case _:
            raise NotImplementedError(f"input {key!r} of {op}")


def _draw_point(draw: st.DrawFn, op: str, aim: Aim) -> Vec3:
    """Draw a point: on the polygon's plane for the tests inside a polygon, off it for the tree's."""
    on_plane = along(aim.center, aim.normal, -aim.distance)
    point = on_plane if op.startswith("polygon_") else aim.center
    return along(point, draw(vectors(0.5)), 1.0) if draw(FLAGS) else point


def _draw_movement(draw: st.DrawFn, aim: Aim, radius: float) -> Vec3:
    """Draw a movement: into the polygon, almost along its normal, down, anywhere; half began clear of it."""
    length = draw(_UNIT_INTERVAL) + draw(FLAGS) * max(radius - aim.distance, 0.0)
    match draw(_WAYS):
        case "into":
            return along(_NOWHERE, aim.normal, -length)
        case "aslant":
            return along(draw(vectors(1.0)), aim.normal, draw(NEARLY))
        case "down":
            return (0.0, 0.0, -length)
        case _:
            return draw(vectors(1.0))
