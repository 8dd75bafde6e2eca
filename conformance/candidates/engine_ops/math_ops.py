"""Frames, positions and planes (``math.jsonl``), by the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.engine_ops.values import floats, frame, numbers, position, vector
from engine import layout as at
from engine.kernels import frame as frames
from engine.kernels import plane as planes
from engine.kernels import position as positions
from engine.kernels.land_defs import outside_cell
from engine.kernels.vector import normalize_check_small

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from engine.kernels.types import Array, Vector

_BLOCK_Z: Final = 0.0
"""z of every block offset."""


def _matrix(row: Array) -> list[float]:
    return floats(row[at.MATRIX : at.MATRIX + 9])


def _quaternion(row: Array) -> list[float]:
    return floats(row[at.QUATERNION : at.QUATERNION + at.QUATERNION_SIZE])


def _frame_cache(query: Query) -> Fields:
    return {"m": _matrix(frame(query.inputs["rotation"]))}


def _frame_set_rotate(query: Query) -> Fields:
    row = frame((1.0, 0.0, 0.0, 0.0))
    frames.frame_set_rotate(row, 0, *(float(c) for c in query.inputs["rotation"]))
    return {"q": _quaternion(row), "m": _matrix(row)}


def _with_pose(kernel: Callable[..., Vector]) -> Callable[[Query], Fields]:
    def operation(query: Query) -> Fields:
        return {"v": list(kernel(position(query.inputs["pose"]), 0, *vector(query.inputs["point"])))}

    return operation


def _position_localtoglobal(query: Query) -> Fields:
    to, start = query.inputs["to"], position(query.inputs["from"])
    return {
        "v": list(
            positions.position_localtoglobal(float(to["cell"]), start, 0, *vector(query.inputs["point"]))
        )
    }


def _position_localtolocal(query: Query) -> Fields:
    to, start = position(query.inputs["to"]), position(query.inputs["from"])
    return {"v": list(positions.position_localtolocal(to, 0, start, 0, *vector(query.inputs["point"])))}


def _position_get_offset(query: Query) -> Fields:
    start, to = position(query.inputs["from"]), position(query.inputs["to"])
    return {"v": list(positions.position_get_offset(start, 0, to, 0))}


def _block_offset(query: Query) -> Fields:
    x, y = positions.block_offset(float(query.inputs["from_cell"]), float(query.inputs["to_cell"]))
    return {"v": [x, y, _BLOCK_Z]}


def _plane_localtoglobal(query: Query) -> Fields:
    to, start = query.inputs["to"], position(query.inputs["from"])
    plane = numbers(query.inputs["plane"])
    return {"plane": list(planes.plane_localtoglobal(float(to["cell"]), start, 0, plane, 0))}


def _normalize_check_small(query: Query) -> Fields:
    small, *v = normalize_check_small(*vector(query.inputs["v"]))
    return {"small": int(small), "v": v}


def _interpolate_rotation(query: Query) -> Fields:
    rows = numbers([*frame(query.inputs["from"]), *frame(query.inputs["to"])])
    row = frame((1.0, 0.0, 0.0, 0.0))
    frames.frame_interpolate_rotation(row, 0, rows, 0, at.POSITION_SIZE, float(query.inputs["t"]))
    return {"q": _quaternion(row)}


def _snap_to_plane(query: Query) -> Fields:
    x, y, z = vector(query.inputs["v"])
    return {"v": [x, y, planes.snap_to_plane(numbers(query.inputs["plane"]), 0, x, y, z)]}


def _frame_set_heading(query: Query) -> Fields:
    row = frame(query.inputs["rotation"])
    frames.frame_set_heading(row, 0, float(query.inputs["degrees"]))
    return {"q": _quaternion(row)}


def _frame_set_vector_heading(query: Query) -> Fields:
    row = frame(query.inputs["rotation"])
    frames.frame_set_vector_heading(row, 0, *vector(query.inputs["v"]))
    return {"q": _quaternion(row)}


def _position_get_outside_cell_id(query: Query) -> Fields:
    position = query.inputs["position"]
    x, y, _ = vector(position["origin"])
    cell_id, _, _ = outside_cell(position["cell"], x, y)
    return {"cell": int(cell_id)}


def _frame_is_equal(query: Query) -> Fields:
    a, b = position(query.inputs["a"]), position(query.inputs["b"])
    return {"r": int(frames.frame_is_equal(a, 0, b, 0))}


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "frame_cache": _frame_cache,
    "frame_set_rotate": _frame_set_rotate,
    "frame_localtoglobal": _with_pose(frames.frame_localtoglobal),
    "frame_globaltolocal": _with_pose(frames.frame_globaltolocal),
    "frame_localtoglobalvec": _with_pose(frames.frame_localtoglobalvec),
    "frame_globaltolocalvec": _with_pose(frames.frame_globaltolocalvec),
    "frame_is_equal": _frame_is_equal,
    "frame_set_heading": _frame_set_heading,
    "frame_set_vector_heading": _frame_set_vector_heading,
    "position_localtoglobal": _position_localtoglobal,
    "position_localtolocal": _position_localtolocal,
    "position_localtoglobalvec": _with_pose(positions.position_localtoglobalvec),
    "position_globaltolocalvec": _with_pose(positions.position_globaltolocalvec),
    "position_get_offset": _position_get_offset,
    "position_get_outside_cell_id": _position_get_outside_cell_id,
    "block_offset": _block_offset,
    "plane_localtoglobal": _plane_localtoglobal,
    "normalize_check_small": _normalize_check_small,
    "interpolate_rotation": _interpolate_rotation,
    "snap_to_plane": _snap_to_plane,
}
"""Operation name to function."""
