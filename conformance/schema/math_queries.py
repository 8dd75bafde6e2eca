"""The queries about frames, positions and planes; keys as in FORMAT.md."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from conformance.schema.frames import PoseModel
from conformance.schema.query_base import QueryModel
from conformance.schema.values import CellId, Number, Plane, Quaternion, Vec3


class RotationQuery(QueryModel):
    """Make a matrix of a quaternion, as it is or normalised."""

    op: Literal["frame_cache", "frame_set_rotate"]
    rotation: Quaternion


class PoseQuery(QueryModel):
    """Take a point or direction through a pose."""

    op: Literal[
        "frame_localtoglobal",
        "frame_globaltolocal",
        "frame_localtoglobalvec",
        "frame_globaltolocalvec",
        "position_localtoglobalvec",
        "position_globaltolocalvec",
    ]
    pose: PoseModel
    point: Vec3


class PositionsQuery(QueryModel):
    """Take a point from one position's space to another's."""

    op: Literal["position_localtoglobal", "position_localtolocal"]
    to: PoseModel
    from_: PoseModel = Field(alias="from")
    point: Vec3


class OffsetQuery(QueryModel):
    """Subtract two positions."""

    op: Literal["position_get_offset"]
    to: PoseModel
    from_: PoseModel = Field(alias="from")


class BlockOffsetQuery(QueryModel):
    """Offset between the landblocks of two cells."""

    op: Literal["block_offset"]
    from_cell: CellId
    to_cell: CellId


class PlaneToGlobalQuery(QueryModel):
    """Take a plane to block coordinates."""

    op: Literal["plane_localtoglobal"]
    to: PoseModel
    from_: PoseModel = Field(alias="from")
    plane: Plane


class NormalizeQuery(QueryModel):
    """Normalise a vector that may be too small."""

    op: Literal["normalize_check_small"]
    v: Vec3


class InterpolateQuery(QueryModel):
    """Turn part of the way from one rotation to another."""

    op: Literal["interpolate_rotation"]
    from_: Quaternion = Field(alias="from")
    to: Quaternion
    t: Number


class SnapQuery(QueryModel):
    """Lay an offset into a plane by its z."""

    op: Literal["snap_to_plane"]
    plane: Plane
    v: Vec3


class FrameEqualQuery(QueryModel):
    """Compare two frames."""

    op: Literal["frame_is_equal"]
    a: PoseModel
    b: PoseModel
