"""Obstacles and their parts compiled: one record each, however many cells list it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.constants import (
    HAS_PHYSICS_BSP,
    WEENIE_CREATURE,
    WEENIE_IMPENETRABLE,
    WEENIE_PK,
    WEENIE_PKLITE,
    WEENIE_PLAYER,
    WEENIE_PRESENT,
)
from engine.errors import WorldError
from engine.float32 import float32_array
from engine.pose import position_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.compiling.storage import Storage
    from engine.kernels.types import Array
    from engine.objects import Obstacle, Weenie
    from engine.pose import Pose

_WEENIE_BITS: Final = {
    "creature": WEENIE_CREATURE,
    "player": WEENIE_PLAYER,
    "pk": WEENIE_PK,
    "pklite": WEENIE_PKLITE,
    "impenetrable": WEENIE_IMPENETRABLE,
}


class Parts:
    """The parts of a world, in the order in which they are added."""

    def __init__(self) -> None:
        self._poses: list[Pose] = []
        self._scales: list[float] = []
        self._roots: list[int] = []
        self._where: list[str] = []

    def __len__(self) -> int:
        return len(self._roots)

    def add(self, root: int, pose: Pose, scale: float, where: str) -> int:
        """Append a part; return its index."""
        self._poses.append(pose)
        self._scales.append(scale)
        self._roots.append(root)
        self._where.append(where)
        return len(self._roots) - 1

    def write(self, storage: Storage) -> dict[int, int]:
        """Write the records; return what the header says of them."""
        floats = _placed(self._poses, self._scales, self._where)
        return {
            int(at.WORLD_PART_FLOATS): storage.add_floats(floats.ravel()),
            int(at.WORLD_PART_INTS): storage.add_ints(self._roots),
        }


def write_objects(
    storage: Storage, parts: Parts, obstacles: Sequence[Obstacle], where: Sequence[str]
) -> dict[int, int]:
    """Write the records of all obstacles; return what the header says of them.

    `where` names each for error messages.
    """
    floats = _placed([thing.pose for thing in obstacles], [thing.scale for thing in obstacles], where)
    ints = [_object_ints(storage, parts, thing, name) for thing, name in zip(obstacles, where, strict=True)]
    return {
        int(at.WORLD_OBJECT_FLOATS): storage.add_floats(floats.ravel()),
        int(at.WORLD_OBJECT_INTS): storage.add_ints(np.array(ints, dtype=np.int64).ravel()),
    }


def _placed(poses: Sequence[Pose], scales: Sequence[float], where: Sequence[str]) -> Array:
    """Return position and scale of each: an object's record and a part's begin so."""
    floats = np.empty((len(poses), at.OBJECT_FLOATS), dtype=np.float64)
    floats[:, : at.POSITION_SIZE] = position_rows(poses, [f"{name}, pose" for name in where])
    floats[:, at.OBJECT_SCALE] = _scales(scales, where)
    return floats


def _scales(scales: Sequence[float], where: Sequence[str]) -> Array:
    for scale, name in zip(scales, where, strict=True):
        stored = float32_array([scale], (1,), f"{name}, scale", WorldError) if scale != 1.0 else None
        if stored is not None and not stored[0] > 0.0:
            raise WorldError(f"{name}, scale", f"{scale} is not greater than 0")
    return np.asarray(scales, dtype=np.float32).astype(np.float64)


def _object_ints(storage: Storage, parts: Parts, thing: Obstacle, where: str) -> list[int]:
    return [thing.id, thing.state, _weenie_bits(thing.weenie), *_family(storage, parts, thing, where)]


def _weenie_bits(weenie: Weenie | None) -> int:
    if weenie is None:
        return 0
    return int(WEENIE_PRESENT) + sum(int(b) for name, b in _WEENIE_BITS.items() if getattr(weenie, name))


def _family(storage: Storage, parts: Parts, thing: Obstacle, where: str) -> tuple[int, int, int]:
    """Choose the shapes that are tested (08, 3.8); return family, first record and count."""
    if not thing.has_part_array:
        return int(at.FAMILY_NONE), 0, 0
    if thing.state & HAS_PHYSICS_BSP:
        return int(at.FAMILY_PARTS), len(parts), _add_parts(storage, parts, thing, where)
    for family, name, size in (
        (at.FAMILY_CYLSPHERES, "cylspheres", at.CYLSPHERE_SIZE),
        (at.FAMILY_SPHERES, "spheres", at.SPHERE_SIZE),
    ):
        shapes = getattr(thing, name)
        if len(shapes):
            values = _shape_records(shapes, int(size), f"{where}, {name}")
            return int(family), storage.add_floats(values.ravel()), len(values)
    return int(at.FAMILY_NONE), 0, 0


def _shape_records(shapes: Sequence[Sequence[float]], size: int, where: str) -> Array:
    """Return cylspheres or spheres as float32 numbers; none may have a negative radius or height."""
    values = float32_array(shapes, (-1, size), where, WorldError)
    for index, column in np.argwhere(values[:, at.RADIUS :] < 0.0):
        measure = "radius" if column == 0 else "height"
        raise WorldError(f"{where}, {index}", f"a {measure} of {values[index, at.RADIUS + column]}")
    return values


def _add_parts(storage: Storage, parts: Parts, thing: Obstacle, where: str) -> int:
    """Append an object's parts that can be collided with; return how many."""
    count = 0
    for index, part in enumerate(thing.parts):
        if part.shape is None or not part.has_physics:
            continue
        pose = thing.pose if part.pose is None else part.pose
        scale = thing.scale if part.scale is None else part.scale
        name = where if part.pose is None and part.scale is None else f"{where}, part {index}"
        parts.add(storage.root_of(part.shape), pose, scale, name)
        count += 1
    return count
