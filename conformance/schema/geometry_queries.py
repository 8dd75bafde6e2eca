"""The queries about one polygon or one tree, all in the geometry's own space; keys as in FORMAT.md."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from conformance.schema.query_base import Needs, QueryModel
from conformance.schema.values import Count, Flag, Number, Sphere, Vec3


class GeometryQuery(QueryModel):
    """An op on the scene's geometry, all in geometry space."""

    needs: ClassVar[Needs] = "geometry"


class PolygonQuery(GeometryQuery):
    """An op on one polygon, by its index."""

    poly: Count


class MakePlaneQuery(PolygonQuery):
    """Compute a polygon's plane."""

    op: Literal["polygon_make_plane"]


class PointInPolygonQuery(PolygonQuery):
    """Test a point against all edges."""

    op: Literal["polygon_point_in_polygon"]
    point: Vec3


class PointInPoly2DQuery(PolygonQuery):
    """Test a point against all edges, seen from above."""

    op: Literal["polygon_point_in_poly2D"]
    point: Vec3
    side: Literal[0, 1] = Field(description="0 positive, 1 negative.")


class HitsSphereQuery(PolygonQuery):
    """Test a sphere against a polygon."""

    op: Literal["polygon_hits_sphere_fast", "polygon_hits_sphere_slow"]
    sphere: Sphere


class PosHitsSphereQuery(PolygonQuery):
    """Test a moving sphere against a one-sided polygon."""

    op: Literal["polygon_pos_hits_sphere"]
    sphere: Sphere
    movement: Vec3


class WalkableHitsSphereQuery(PolygonQuery):
    """Test a sphere against a polygon that is flat enough."""

    op: Literal["polygon_walkable_hits_sphere"]
    sphere: Sphere
    up: Vec3
    walkable_allowance: Number


class UprightQuery(PolygonQuery):
    """Test the sphere's foot along `up` on a polygon."""

    op: Literal["polygon_check_walkable", "polygon_check_small_walkable", "polygon_find_crossed_edge"]
    sphere: Sphere
    up: Vec3


class AdjustToPlaneQuery(PolygonQuery):
    """Move a sphere back onto a polygon's plane."""

    op: Literal["polygon_adjust_sphere_to_plane"]
    sphere: Sphere
    movement: Vec3
    walk_interp: Number


class AdjustToPolyQuery(PolygonQuery):
    """Find when a sphere touches a polygon's plane."""

    op: Literal["polygon_adjust_sphere_to_poly"]
    sphere: Sphere
    curr: Vec3
    movement: Vec3


class PlacementPolyQuery(PolygonQuery):
    """Push two spheres off a polygon's plane."""

    op: Literal["polygon_adjust_to_placement_poly"]
    sphere: Sphere
    other: Sphere
    radius: Number
    center_solid: Flag
    solid_check: Flag


class BspPointQuery(GeometryQuery):
    """Ask where a point is."""

    op: Literal["bsp_point_intersects_solid", "bsp_point_inside_cell"]
    point: Vec3


class BspIntersectsPolyQuery(GeometryQuery):
    """Find the first polygon that a moving sphere hits."""

    op: Literal["bsp_sphere_intersects_poly"]
    sphere: Sphere
    movement: Vec3


class BspIntersectsSolidQuery(GeometryQuery):
    """Test a sphere against solid matter."""

    op: Literal["bsp_sphere_intersects_solid"]
    sphere: Sphere
    center_check: Flag


class BspHitsWalkableQuery(GeometryQuery):
    """Test a sphere against walkables near its foot."""

    op: Literal["bsp_hits_walkable"]
    sphere: Sphere
    up: Vec3
    walkable_allowance: Number


class BspFindWalkableQuery(GeometryQuery):
    """Move a sphere back onto the walkables it went through."""

    op: Literal["bsp_find_walkable"]
    sphere: Sphere
    movement: Vec3
    up: Vec3
    walkable_allowance: Number
    walk_interp: Number


class BspSolidPolyQuery(GeometryQuery):
    """Find the polygon to be pushed off when placed in solid matter."""

    op: Literal["bsp_sphere_intersects_solid_poly"]
    sphere: Sphere
    radius: Number
    center_check: Flag
    center_solid: Flag


class BspAdjustToPlaneQuery(GeometryQuery):
    """Search the last free place before a polygon."""

    op: Literal["bsp_adjust_to_plane"]
    sphere: Sphere
    curr: Vec3
    poly: Count


class BspCellSphereQuery(GeometryQuery):
    """Ask how much of a sphere is inside the cell."""

    op: Literal["bsp_sphere_intersects_cell"]
    sphere: Sphere
