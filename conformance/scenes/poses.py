"""Queries moved rigidly: the same scene, somewhere else in the landblock.

A moved query is a new query: its numbers are rounded to float32, and world z keeps being up, so a
tilted scene asks something else than a level one. What must stay is that two engines agree.
"""

from __future__ import annotations

import dataclasses
import random
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from conformance.scenes.algebra import ORIGIN, round_point
from conformance.scenes.model import Pose
from conformance.scenes.rigid import (
    IDENTITY,
    Transform,
    move_direction,
    move_plane,
    move_point,
    move_pose,
    move_rotation,
)
from conformance.scenes.rotations import round_quaternion
from oracle.constants import BLOCK_EDGE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from conformance.query import Query
    from conformance.scenes.model import Quaternion, Vec3

__all__ = [
    "IDENTITY",
    "MOVABLE_OPS",
    "Transform",
    "move_direction",
    "move_plane",
    "move_point",
    "move_pose",
    "move_rotation",
    "seeded_poses",
    "transform_inputs",
    "transform_query",
]

NEAR: Final = 200.0
"""Largest ordinary translation along an axis, metres: a landblock and a bit."""
BLOCKS: Final = 10
"""Largest block-scale translation, landblocks: up to 2 km float32 still resolves retail's EPS."""
HALF_ROOT: Final = 0.7071067690849304
"""Square root of one half, float32: cosine and sine of half a quarter turn."""

MOVABLE_OPS: Final = frozenset(
    {
        "adjust_offset",
        "body_walk",
        "cache_localspace_sphere",
        "cliff_slide",
        "find_collisions",
        "slide_sphere",
        "transition",
        "walk",
    }
)
"""Operations that happen somewhere in a landblock; the others are in their own frame."""


def transform_query(query: Query, transform: Transform) -> Query:
    """Return a query moved rigidly; its label says how.

    Raises
    ------
    ValueError
        The operation is not one of `MOVABLE_OPS`.
    """
    inputs = transform_inputs(query.op, query.inputs, transform)
    label = f"{query.label} {transform.label}".lstrip()
    return dataclasses.replace(query, inputs=inputs, label=label)


def transform_inputs(op: str, inputs: Mapping[str, Any], transform: Transform) -> dict[str, Any]:
    """Return the inputs of a query moved rigidly, as a new mapping.

    Parameters
    ----------
    op : str
        One of `MOVABLE_OPS`.
    inputs : mapping
        The input blocks of FORMAT.md; not changed.
    transform : Transform
        In the landblock's frame.

    Returns
    -------
    dict
        Poses of cells and statics, start and end, seeded planes and normals are moved; mover, path
        flags, scales and geometry stay. Geometry is shared by name and lives in its own frame.

    Raises
    ------
    ValueError
        The operation has no place in a landblock.
    """
    if op not in MOVABLE_OPS:
        raise ValueError(f"{op} has no pose to move; only {', '.join(sorted(MOVABLE_OPS))} have")
    return {
        key: _MOVED[key](value, transform) if key in _MOVED and value is not None else value
        for key, value in inputs.items()
    }


def _pose(record: Mapping[str, Any], transform: Transform) -> dict[str, Any]:
    return move_pose(transform, Pose.from_record(record)).to_record()


def _direction(vector: Sequence[float], transform: Transform) -> list[float]:
    x, y, z = vector
    return list(move_direction(transform, (x, y, z)))


def _plane(plane: Sequence[float], transform: Transform) -> list[float]:
    x, y, z, d = plane
    return list(move_plane(transform, (x, y, z, d)))


def _rotation_of(rotation: Sequence[float], transform: Transform) -> list[float]:
    w, x, y, z = rotation
    return list(move_rotation(transform, (w, x, y, z)))


def _seed(seed: Mapping[str, Any], transform: Transform) -> dict[str, Any]:
    moved = dict(seed)
    for name in ("contact", "last_known"):
        if seed.get(name) is not None:
            moved[name] = {**seed[name], "plane": _plane(seed[name]["plane"], transform)}
    if seed.get("sliding") is not None:
        moved["sliding"] = _direction(seed["sliding"], transform)
    return moved


def _cells(cells: Sequence[Mapping[str, Any]], transform: Transform) -> list[dict[str, Any]]:
    return [_placed(cell, transform) for cell in cells]


def _placed(record: Mapping[str, Any], transform: Transform) -> dict[str, Any]:
    """Move a cell with its statics, or a static."""
    moved = {**record, "pose": _pose(record["pose"], transform)}
    if "statics" in record:
        moved["statics"] = [_placed(static, transform) for static in record["statics"]]
    return moved


def _body(body: Mapping[str, Any], transform: Transform) -> dict[str, Any]:
    """Move a body; its acceleration stays, as gravity does."""
    return _parts(body, _BODY_PARTS, transform)


def _ticks(ticks: Sequence[Mapping[str, Any]], transform: Transform) -> list[dict[str, Any]]:
    return [_parts(tick, _TICK_PARTS, transform) for tick in ticks]


def _parts(
    block: Mapping[str, Any], parts: Mapping[str, Callable[[Any, Transform], Any]], transform: Transform
) -> dict[str, Any]:
    """Move those parts of a block that are there."""
    moved = {key: move(block[key], transform) for key, move in parts.items() if block.get(key) is not None}
    return {**block, **moved}


_TICK_PARTS: Final[Mapping[str, Callable[[Any, Transform], Any]]] = MappingProxyType(
    {"move": _direction, "rotation": _rotation_of, "set_velocity": _direction, "omega": _direction}
)
"""What of a tick has a direction in the landblock; a local velocity is in the body's own frame."""
_BODY_PARTS: Final[Mapping[str, Callable[[Any, Transform], Any]]] = MappingProxyType(
    {
        "position": _pose,
        "velocity": _direction,
        "omega": _direction,
        "contact_plane": _plane,
        "sliding_normal": _direction,
    }
)

_MOVED: Final[Mapping[str, Callable[[Any, Transform], Any]]] = MappingProxyType(
    {
        "pose": _pose,
        "from": _pose,
        "to": _pose,
        "start": _pose,
        "cells": _cells,
        "body": _body,
        "seed": _seed,
        "ticks": _ticks,
        "normal": _direction,
        "offset": _direction,
        "plane": _plane,
    }
)
"""How each input block moves, by its key; what is not here does not."""


def seeded_poses(count: int, seed: int) -> list[Transform]:
    """Return motions that take turns in kind: the same for a seed on every platform.

    Rotations go identity, yaw, quarter turn, any; translations go up to `NEAR`, none, whole landblocks.

    Parameters
    ----------
    count : int
        How many; more of the same seed begin with the same.
    seed : int
        Any whole number.
    """
    # Only random() and arithmetic that IEEE 754 fixes: no library function may differ between platforms.
    numbers = random.Random(seed)  # noqa: S311
    poses = []
    for i in range(count):
        rotation = _rotation(i % 4, numbers)
        poses.append(Transform(rotation, _translation((i + i // 4) % 3, numbers)))
    return poses


def _rotation(kind: int, numbers: random.Random) -> Quaternion:
    if kind == 0:
        return IDENTITY.rotation
    if kind == 1:
        w, z = _unit(2, numbers)
        return round_quaternion((w, 0.0, 0.0, z))
    if kind == 2:
        return _quarter_turn(numbers)
    return round_quaternion(_unit(4, numbers))


def _quarter_turn(numbers: random.Random) -> Quaternion:
    """Return a turn by 90, 180 or 270 degrees about one of the axes."""
    axis = int(3 * numbers.random())
    turns = ((HALF_ROOT, HALF_ROOT), (0.0, 1.0), (HALF_ROOT, -HALF_ROOT))
    w, part = turns[int(3 * numbers.random())]
    x, y, z = (part if k == axis else 0.0 for k in range(3))
    return (w, x, y, z)


def _translation(kind: int, numbers: random.Random) -> Vec3:
    if kind == 0:
        return round_point(NEAR * part for part in _signed(3, numbers))
    if kind == 1:
        return ORIGIN
    x, y = (BLOCK_EDGE * round(BLOCKS * part) for part in _signed(2, numbers))
    return (x, y, 0.0)


def _signed(dimensions: int, numbers: random.Random) -> Iterator[float]:
    """Yield numbers between -1 and 1."""
    for _ in range(dimensions):
        yield 2.0 * numbers.random() - 1.0


def _unit(dimensions: int, numbers: random.Random) -> list[float]:
    """Return a direction, evenly distributed: a point of the unit ball, not yet of length 1."""
    while True:
        point = list(_signed(dimensions, numbers))
        if 0.0 < sum(part * part for part in point) <= 1.0:
            return point
