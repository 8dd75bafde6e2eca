"""Frames, positions, planes and vectors (``math.jsonl``), by the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_ops.values import (
    frame,
    matrix,
    nxyzd,
    plane,
    position,
    quaternion,
    vector,
    xyz,
)
from oracle.arithmetic import f32
from oracle.frame import Frame
from oracle.land_defs import get_block_offset
from oracle.plane import Plane

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from oracle.position import Position
    from oracle.vector import Vector3


def _frame_cache(query: Query) -> Fields:
    return {"m": matrix(frame(query.inputs["rotation"]))}


def _frame_set_rotate(query: Query) -> Fields:
    result = Frame()
    w, x, y, z = query.inputs["rotation"]
    result.set_rotate(f32(w), f32(x), f32(y), f32(z))
    return {"q": quaternion(result), "m": matrix(result)}


def _of_frame(method: Callable[[Frame, Vector3], Vector3]) -> Callable[[Query], Fields]:
    def operation(query: Query) -> Fields:
        pose = position(query.inputs["pose"])
        return {"v": xyz(method(pose.frame, vector(query.inputs["point"])))}

    return operation


def _of_position(method: Callable[[Position, Vector3], Vector3]) -> Callable[[Query], Fields]:
    def operation(query: Query) -> Fields:
        return {"v": xyz(method(position(query.inputs["pose"]), vector(query.inputs["point"])))}

    return operation


def _between_positions(
    method: Callable[[Position, Position, Vector3], Vector3],
) -> Callable[[Query], Fields]:
    def operation(query: Query) -> Fields:
        to, from_ = position(query.inputs["to"]), position(query.inputs["from"])
        return {"v": xyz(method(to, from_, vector(query.inputs["point"])))}

    return operation


def _position_get_offset(query: Query) -> Fields:
    to, from_ = position(query.inputs["to"]), position(query.inputs["from"])
    return {"v": xyz(from_.get_offset(to))}


def _block_offset(query: Query) -> Fields:
    return {"v": xyz(get_block_offset(int(query.inputs["from_cell"]), int(query.inputs["to_cell"])))}


def _plane_localtoglobal(query: Query) -> Fields:
    to, from_ = position(query.inputs["to"]), position(query.inputs["from"])
    return {"plane": nxyzd(Plane.localtoglobal(to, from_, plane(query.inputs["plane"])))}


def _normalize_check_small(query: Query) -> Fields:
    v = vector(query.inputs["v"])
    small = v.normalize_check_small()
    return {"small": small, "v": xyz(v)}


def _interpolate_rotation(query: Query) -> Fields:
    result = Frame()
    result.interpolate_rotation(
        frame(query.inputs["from"]), frame(query.inputs["to"]), f32(query.inputs["t"])
    )
    return {"q": quaternion(result)}


def _snap_to_plane(query: Query) -> Fields:
    v = vector(query.inputs["v"])
    plane(query.inputs["plane"]).snap_to_plane(v)
    return {"v": xyz(v)}


def _frame_is_equal(query: Query) -> Fields:
    a, b = position(query.inputs["a"]), position(query.inputs["b"])
    return {"r": int(a.frame.is_equal(b.frame))}


# The methods are looked up at the call, so that a candidate may replace one for a while.
OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "frame_cache": _frame_cache,
    "frame_set_rotate": _frame_set_rotate,
    "frame_localtoglobal": _of_frame(lambda f, v: f.localtoglobal(v)),
    "frame_globaltolocal": _of_frame(lambda f, v: f.globaltolocal(v)),
    "frame_localtoglobalvec": _of_frame(lambda f, v: f.localtoglobalvec(v)),
    "frame_globaltolocalvec": _of_frame(lambda f, v: f.globaltolocalvec(v)),
    "frame_is_equal": _frame_is_equal,
    "position_localtoglobal": _between_positions(lambda to, from_, v: to.localtoglobal(from_, v)),
    "position_localtolocal": _between_positions(lambda to, from_, v: to.localtolocal(from_, v)),
    "position_localtoglobalvec": _of_position(lambda pos, v: pos.localtoglobalvec(v)),
    "position_globaltolocalvec": _of_position(lambda pos, v: pos.globaltolocalvec(v)),
    "position_get_offset": _position_get_offset,
    "block_offset": _block_offset,
    "plane_localtoglobal": _plane_localtoglobal,
    "normalize_check_small": _normalize_check_small,
    "interpolate_rotation": _interpolate_rotation,
    "snap_to_plane": _snap_to_plane,
}
"""Operation name to function."""
