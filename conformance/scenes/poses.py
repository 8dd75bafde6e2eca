"""Queries moved: the same scene, somewhere else in the landblock or on the map.

A moved query is a new query: its numbers are rounded to float32, and world z keeps being up, so a
tilted scene asks something else than a level one. What must stay is that two engines agree.

Where there is no land a query moves rigidly, however it is turned. A world with land moves by whole
landblocks only: its heights stand on a grid that points north.
"""

from __future__ import annotations

import dataclasses
import functools
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from conformance.outputs import OUTPUTS
from conformance.scenes.block_shifts import has_land, room_to_shift, shift_inputs
from conformance.scenes.random_poses import seeded_poses, seeded_shifts
from conformance.scenes.rigid import (
    IDENTITY,
    Transform,
    move_direction,
    move_plane,
    move_point,
    move_pose,
    move_rotation,
)
from conformance.scenes.rigid_inputs import move_inputs

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.query import Query
    from conformance.scenes.random_poses import Shift

__all__ = [
    "IDENTITY",
    "MOVABLE_OPS",
    "NOT_MOVABLE",
    "Transform",
    "move_direction",
    "move_plane",
    "move_point",
    "move_pose",
    "move_rotation",
    "moved_queries",
    "seeded_poses",
    "seeded_shifts",
    "shift_query",
    "transform_inputs",
    "transform_query",
]

_OWN_FRAME: Final = "in the frame of its geometry or of nothing: no place to move from"
_TWO_PLACES: Final = "about two frames given whole: moved together they ask the same"
_IDS: Final = "about ids and map coordinates themselves"
_ONE_BODY: Final = "a body alone, whose tick reads no scene"

NOT_MOVABLE: Final[Mapping[str, str]] = MappingProxyType(
    {
        **{op: _OWN_FRAME for op in OUTPUTS if op.startswith(("polygon_", "bsp_"))},
        **dict.fromkeys(
            (
                "find_time_of_collision",
                "frame_cache",
                "frame_get_heading",
                "frame_set_heading",
                "frame_set_rotate",
                "frame_set_vector_heading",
                "interpolate_rotation",
                "normalize_check_small",
                "plane_ray",
                "plane_set_height",
                "snap_to_plane",
            ),
            _OWN_FRAME,
        ),
        **{op: _TWO_PLACES for op in OUTPUTS if op.startswith(("frame_local", "frame_global", "position_"))},
        **dict.fromkeys(
            ("calc_num_steps", "frame_interpolate_origin", "frame_is_equal", "plane_localtoglobal"),
            _TWO_PLACES,
        ),
        **{op: _TWO_PLACES for op in OUTPUTS if op.startswith("frame_combine")},
        **{op: _IDS for op in OUTPUTS if op.startswith("landdefs_")},
        **dict.fromkeys(("block_offset", "terrain_block", "terrain_split"), _IDS),
        **dict.fromkeys(
            (
                "calc_acceleration",
                "calc_friction",
                "clear_transient_states",
                "handle_all_collisions",
                "seed",
                "set_elasticity",
                "set_local_velocity",
                "set_on_walkable",
                "set_position",
                "set_velocity",
                "update_object_gates",
                "update_physics",
                "update_position",
            ),
            _ONE_BODY,
        ),
    }
)
"""Why an operation has no other poses."""
MOVABLE_OPS: Final = frozenset(OUTPUTS) - frozenset(NOT_MOVABLE)
"""Operations that happen somewhere in a scene."""


def moved_queries(query: Query, count: int, seed: int) -> list[Query]:
    """Return a query in other places: turned and moved, or on land shifted by whole landblocks.

    Parameters
    ----------
    query : Query
        Of one of `MOVABLE_OPS`, or of another operation, which has none.
    count : int
        How many.
    seed : int
        Of the motions.
    """
    if query.op not in MOVABLE_OPS:
        return []
    if has_land(query.inputs):
        shifts = seeded_shifts(count, seed, room_to_shift(query.inputs))
        return [shift_query(query, shift) for shift in shifts]
    return [transform_query(query, transform) for transform in _poses(count, seed)]


def transform_query(query: Query, transform: Transform) -> Query:
    """Return a query moved rigidly; its label says how.

    Raises
    ------
    ValueError
        The operation is not one of `MOVABLE_OPS`, or its world has land.
    """
    inputs = transform_inputs(query.op, query.inputs, transform)
    label = f"{query.label} {transform.label}".lstrip()
    return dataclasses.replace(query, inputs=inputs, label=label)


def transform_inputs(op: str, inputs: Mapping[str, Any], transform: Transform) -> dict[str, Any]:
    """Return the inputs of a query moved rigidly, as a new mapping; see `move_inputs`.

    Raises
    ------
    ValueError
        The operation has no place in a landblock, or its world has land.
    """
    if op not in MOVABLE_OPS:
        raise ValueError(f"{op} has no pose to move: {NOT_MOVABLE.get(op, 'unknown operation')}")
    if has_land(inputs):
        raise ValueError("a world with land moves by whole landblocks only: shift_query")
    return move_inputs(inputs, transform)


def shift_query(query: Query, shift: Shift) -> Query:
    """Return a query shifted by whole landblocks, east and north; its label says by how many."""
    label = f"{query.label} shifted by {shift[0]} landblocks east, {shift[1]} north".lstrip()
    return dataclasses.replace(query, inputs=shift_inputs(query.inputs, shift), label=label)


@functools.cache
def _poses(count: int, seed: int) -> list[Transform]:
    return seeded_poses(count, seed)
