"""Rigid motions of the input blocks of FORMAT.md, each by its key."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from conformance.scenes.model import Pose
from conformance.scenes.rigid import move_direction, move_plane, move_point, move_pose, move_rotation

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from conformance.scenes.rigid import Transform

Record: TypeAlias = "Mapping[str, Any]"
Move: TypeAlias = "Callable[[Any, Transform], Any]"


def move_inputs(inputs: Record, transform: Transform) -> dict[str, Any]:
    """Return inputs moved rigidly, as a new mapping.

    Parameters
    ----------
    inputs : mapping
        The input blocks of an operation; not changed.
    transform : Transform
        In the landblock's frame.

    Returns
    -------
    dict
        Poses of cells and objects, start and end, seeded planes and normals are moved; mover, path flags,
        scales, ids and geometry stay. A portal's polygon is in its cell's space, so it stays as well.
    """
    return _parts(inputs, MOVED, transform)


def _parts(block: Record, parts: Mapping[str, Move], transform: Transform) -> dict[str, Any]:
    """Move those parts of a block that are there."""
    moved = {key: move(block[key], transform) for key, move in parts.items() if block.get(key) is not None}
    return {**block, **moved}


def _each(parts: Mapping[str, Move]) -> Move:
    """Return what moves these parts of every block of a list."""
    return lambda blocks, transform: [_parts(block, parts, transform) for block in blocks]


def _block(parts: Mapping[str, Move]) -> Move:
    """Return what moves these parts of a block."""
    return lambda block, transform: _parts(block, parts, transform)


def _pose(record: Record, transform: Transform) -> dict[str, Any]:
    return move_pose(transform, Pose.from_record(record)).to_record()


def _direction(vector: Sequence[float], transform: Transform) -> list[float]:
    x, y, z = vector
    return list(move_direction(transform, (x, y, z)))


def _point(point: Sequence[float], transform: Transform) -> list[float]:
    x, y, z = point
    return list(move_point(transform, (x, y, z)))


def _plane(plane: Sequence[float], transform: Transform) -> list[float]:
    x, y, z, d = plane
    return list(move_plane(transform, (x, y, z, d)))


def _spheres(spheres: Sequence[Sequence[float]], transform: Transform) -> list[list[float]]:
    return [[*_point(sphere[:3], transform), sphere[3]] for sphere in spheres]


def _rotation(rotation: Sequence[float], transform: Transform) -> list[float]:
    w, x, y, z = rotation
    return list(move_rotation(transform, (w, x, y, z)))


def _cell(cell: Any, transform: Transform) -> Any:
    """Move a cell that is given whole; one that is named has no place of its own."""
    return _parts(cell, _PLACED, transform) if isinstance(cell, dict) else cell


_SEEDED: Final[Mapping[str, Move]] = MappingProxyType({"plane": _plane})
_SEED: Final[Mapping[str, Move]] = MappingProxyType(
    {"contact": _block(_SEEDED), "last_known": _block(_SEEDED), "sliding": _direction}
)
_PLACED: Final[Mapping[str, Move]] = MappingProxyType(
    {"pose": _pose, "statics": _each({"pose": _pose}), "parts": _each({"pose": _pose})}
)
"""A cell with its statics, or an object with its parts."""
_TICK: Final[Mapping[str, Move]] = MappingProxyType(
    {"move": _direction, "rotation": _rotation, "set_velocity": _direction, "omega": _direction}
)
"""What of a tick has a direction in the landblock; a local velocity is in the body's own frame."""
_BODY: Final[Mapping[str, Move]] = MappingProxyType(
    {
        "position": _pose,
        "velocity": _direction,
        "omega": _direction,
        "contact_plane": _plane,
        "sliding_normal": _direction,
    }
)
"""What of a body moves; its acceleration stays, as gravity does."""
_WORLD: Final[Mapping[str, Move]] = MappingProxyType({"cells": _each(_PLACED), "objects": _each(_PLACED)})
"""A world without land; what is registered where stays."""

MOVED: Final[Mapping[str, Move]] = MappingProxyType(
    {
        "pose": _pose,
        "from": _pose,
        "to": _pose,
        "start": _pose,
        "position": _pose,
        "cells": _each(_PLACED),
        "world": _block(_WORLD),
        "cell": _cell,
        "object": _block(_PLACED),
        "objects": _each(_PLACED),
        "body": _block(_BODY),
        "seed": _block(_SEED),
        "ticks": _each(_TICK),
        "normal": _direction,
        "offset": _direction,
        "plane": _plane,
        "point": _point,
        "spheres": _spheres,
    }
)
"""How each input block moves, by its key; what is not here does not."""
