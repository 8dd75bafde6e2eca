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
    ray_of,
    untouched,
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


def _frame_combine(query: Query) -> Fields:
    a, b = position(query.inputs["a"]).frame, position(query.inputs["b"]).frame
    result = Frame()
    result.combine(a, b)
    return _combined(result)


def _frame_combine_aframe(query: Query) -> Fields:
    a, b = position(query.inputs["a"]).frame, position(query.inputs["b"]).frame
    result = Frame()
    result.combine_aframe(a, b)
    return _combined(result)


def _frame_combine_scaled(query: Query) -> Fields:
    a, b = position(query.inputs["a"]).frame, position(query.inputs["b"]).frame
    result = Frame()
    result.combine_scaled(a, b, vector(query.inputs["scales"]))
    return _combined(result)


def _combined(result: Frame) -> Fields:
    return {"origin": xyz(result.origin), "q": quaternion(result)}


def _frame_interpolate_origin(query: Query) -> Fields:
    a, b = position(query.inputs["a"]).frame, position(query.inputs["b"]).frame
    result = Frame()
    result.interpolate_origin(a, b, f32(query.inputs["t"]))
    return {"v": xyz(result.origin)}


def _frame_get_heading(query: Query) -> Fields:
    return {"heading": frame(query.inputs["rotation"]).get_heading()}


def _frame_set_heading(query: Query) -> Fields:
    result = frame(query.inputs["rotation"])
    result.set_heading(f32(query.inputs["degrees"]))
    return {"q": quaternion(result)}


def _frame_set_vector_heading(query: Query) -> Fields:
    result = frame(query.inputs["rotation"])
    result.set_vector_heading(vector(query.inputs["v"]))
    return {"q": quaternion(result)}


def _position_localtoglobal_origin(query: Query) -> Fields:
    to, from_ = position(query.inputs["to"]), position(query.inputs["from"])
    return {"v": xyz(to.localtoglobal_origin(from_))}


def _position_get_offset_point(query: Query) -> Fields:
    to, from_ = position(query.inputs["to"]), position(query.inputs["from"])
    return {"v": xyz(from_.get_offset_point(to, vector(query.inputs["point"])))}


def _position_distance(query: Query) -> Fields:
    to, from_ = position(query.inputs["to"]), position(query.inputs["from"])
    return {"distance": from_.distance(to)}


def _position_get_outside_cell_id(query: Query) -> Fields:
    return {"cell": position(query.inputs["position"]).get_outside_cell_id()}


def _plane_set_height(query: Query) -> Fields:
    v = vector(query.inputs["v"])
    r = plane(query.inputs["plane"]).set_height(v)
    return {"r": r, "v": xyz(v)}


def _plane_ray(query: Query) -> Fields:
    ray, time = ray_of(query.inputs), untouched()
    r = plane(query.inputs["plane"]).compute_time_of_intersection(ray, time)
    return {"r": r, "time": time.value}


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
    "frame_combine": _frame_combine,
    "frame_combine_aframe": _frame_combine_aframe,
    "frame_combine_scaled": _frame_combine_scaled,
    "frame_interpolate_origin": _frame_interpolate_origin,
    "frame_get_heading": _frame_get_heading,
    "frame_set_heading": _frame_set_heading,
    "frame_set_vector_heading": _frame_set_vector_heading,
    "position_localtoglobal_origin": _position_localtoglobal_origin,
    "position_get_offset_point": _position_get_offset_point,
    "position_distance": _position_distance,
    "position_get_outside_cell_id": _position_get_outside_cell_id,
    "plane_set_height": _plane_set_height,
    "plane_ray": _plane_ray,
}
"""Operation name to function."""
