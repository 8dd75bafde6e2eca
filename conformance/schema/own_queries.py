"""The queries that no vector file has: whole functions of retail that movement offers its callers."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema

from conformance.schema.frames import PlaceModel, PoseModel
from conformance.schema.geometry_queries import PolygonQuery
from conformance.schema.movement_queries import MoverQuery
from conformance.schema.mover import SeedModel
from conformance.schema.query_base import Needs, QueryModel
from conformance.schema.values import (
    CellId,
    Flag,
    InsertType,
    Number,
    Plane,
    Quaternion,
    Strictly,
    Vec3,
    named_bits,
)
from conformance.schema.walk_queries import BodyModel
from conformance.schema.world import ObjectId
from conformance.schema.world_queries import SceneQuery

PLACEMENT_FLAGS = {"slide": 0x10, "do_not_load_cells": 0x20}
"""Bits of SetPosition's flags by name (06 10)."""


class CombineQuery(QueryModel):
    """Express a frame in another: `b` in `a`."""

    op: Literal["frame_combine", "frame_combine_aframe"]
    a: PoseModel
    b: PoseModel


class CombineScaledQuery(QueryModel):
    """Express an animation's frame in another, its origin scaled."""

    op: Literal["frame_combine_scaled"]
    a: PoseModel
    b: PoseModel
    scales: Vec3


class InterpolateOriginQuery(QueryModel):
    """Go part of the way from one origin to another."""

    op: Literal["frame_interpolate_origin"]
    a: PoseModel
    b: PoseModel
    t: Number


class GetHeadingQuery(QueryModel):
    """The heading of a rotation, degrees."""

    op: Literal["frame_get_heading"]
    rotation: Quaternion


class SetHeadingQuery(QueryModel):
    """Turn to a heading."""

    op: Literal["frame_set_heading"]
    rotation: Quaternion
    degrees: Number


class SetVectorHeadingQuery(QueryModel):
    """Turn local y to a direction."""

    op: Literal["frame_set_vector_heading"]
    rotation: Quaternion
    v: Vec3


class OriginsQuery(QueryModel):
    """One origin in another's block, or how far apart they are."""

    op: Literal["position_localtoglobal_origin", "position_distance"]
    to: PoseModel
    from_: PoseModel = Field(alias="from")


class OffsetPointQuery(QueryModel):
    """The way from an origin to a point that is local to another position."""

    op: Literal["position_get_offset_point"]
    from_: PoseModel = Field(alias="from")
    to: PoseModel
    point: Vec3


class OutsideCellQuery(QueryModel):
    """The land cell under or above a position."""

    op: Literal["position_get_outside_cell_id"]
    position: PoseModel


class PlaneHeightQuery(QueryModel):
    """Put a point onto a plane by its z."""

    op: Literal["plane_set_height"]
    plane: Plane
    v: Vec3


class PlaneRayQuery(QueryModel):
    """Where a ray meets a plane."""

    op: Literal["plane_ray"]
    plane: Plane
    point: Vec3
    direction: Vec3


class PolygonRayQuery(PolygonQuery):
    """Whether a ray meets a polygon, in geometry space."""

    op: Literal["polygon_hits_ray"]
    point: Vec3
    direction: Vec3


class WithinBlockQuery(QueryModel):
    """Whether a sphere stays clear of its block's edges."""

    op: Literal["landdefs_within_block"]
    point: Vec3
    radius: Number


class HeightTableQuery(QueryModel):
    """Fill the table of vertex heights."""

    op: Literal["landdefs_set_height_table"]
    values: Annotated[list[Number], Field(min_length=256, max_length=256)] = Field(description="Metres.")


class CountStepsQuery(MoverQuery):
    """Cut a way into sub-steps."""

    op: Literal["calc_num_steps"]
    from_: PoseModel | None = Field(alias="from", description="null for a placement.")
    to: PoseModel


class CheckPosQuery(MoverQuery):
    """Put the spheres and their lowest point at a position."""

    op: Literal["set_check_pos"]
    from_: PoseModel = Field(alias="from")
    to: PoseModel


class TransitionalPositionQuery(MoverQuery):
    """One find_transitional_position, whatever the insert type."""

    needs: ClassVar[Needs] = "scene"
    op: Literal["find_transitional_position"]
    from_: PoseModel = Field(alias="from")
    to: PoseModel
    seed: SeedModel = SeedModel()
    insert_type: InsertType
    placement_allows_sliding: Flag = 1


class EntryQuery(MoverQuery):
    """Ask a cell whether the mover, which is at a position, may enter."""

    needs: ClassVar[Needs] = "scene"
    op: Literal["check_entry_restrictions"]
    cell: CellId
    position: PlaceModel


class VisibleChildQuery(SceneQuery):
    """Find the cell that a point is in: this one, one that is visible from it, or a neighbour."""

    op: Literal["find_visible_child_cell"]
    cell: CellId
    point: Vec3
    search_stabs: Flag


class RegistrationCallModel(Strictly):
    """An object that comes to the cells that it reaches, or leaves those that it is in."""

    object: ObjectId
    call: Literal["enter", "leave"]


class RegistrationQuery(SceneQuery):
    """Register the scene's objects, none of which is registered at first, and take them out again."""

    op: Literal["registration"]
    calls: Annotated[list[RegistrationCallModel], Field(min_length=1)]


class PlaceBodyQuery(SceneQuery):
    """Put a body somewhere: SetPosition."""

    op: Literal["place_body"]
    body: BodyModel
    start: PoseModel = Field(description="Where it was before.")
    to: PoseModel
    flags: Annotated[
        int,
        BeforeValidator(named_bits(PLACEMENT_FLAGS)),
        WithJsonSchema({"type": "array", "items": {"enum": list(PLACEMENT_FLAGS)}}),
    ]
    cell: CellId | None = Field(description="The cell that 'to' is in, adjusted; null for none.")
