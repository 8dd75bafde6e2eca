"""Houses on their ground: a plan at a pose, as cells, a building, and the land levelled under it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from conformance.scenes.algebra import round_point, subtract
from conformance.scenes.planes import plane_of, signed_distance
from conformance.scenes.rotations import yaw_quaternion
from conformance.strategies.poses import to_world
from conformance.strategies.worlds.land import CELL, global_vertex
from conformance.strategies.worlds.plans import plans

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.scenes.model import Geometry, Vec3
    from conformance.strategies.worlds.plans import Door, Plan

_FIRST_ROOM: Final = 0x100
_ROOMS_PER_HOUSE: Final = 0x10
_WHOLE_BLOCK: Final = 0xFFFF
"""Low word of the id that a building's position has."""
_SILL: Final = 0.125
"""How far the ground lies below a floor, metres: one steps up into a house."""
_HALF: Final = 9.0
"""No house reaches further from its origin, metres."""


@dataclass(frozen=True, slots=True)
class Ground:
    """Where a house is built.

    Attributes
    ----------
    plan : str
        Which house.
    block : int
        Which of the site's landblocks, column by column.
    origin : (float, float)
        In that landblock, metres.
    yaw : float
        Degrees.
    height : float or None
        Of its ground floor, metres; None for the land's.
    missing : tuple of int
        Rooms that are not loaded.
    """

    plan: str
    block: int
    origin: tuple[float, float]
    yaw: float = 0.0
    height: float | None = None
    missing: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class House:
    """A house that stands.

    Attributes
    ----------
    plan : Plan
        What it is like.
    missing : tuple of int
        Rooms that are not loaded.
    pose : Mapping
        POSE block of its origin.
    first : int
        Id of its first room.
    level : Mapping of (int, int) to float
        The ground around it, by global vertex, metres.
    """

    plan: Plan
    missing: tuple[int, ...]
    pose: Mapping[str, Any]
    first: int
    level: Mapping[tuple[int, int], float]

    @property
    def building(self) -> dict[str, Any] | None:
        """The building of a world record; None for what is underground."""
        if self.plan.shell is None:
            return None
        portals = [
            {"other": self.first + door.room, "other_portal": self._portals(door.room).index(door)}
            for door in self.plan.doors
            if door.other is None
        ]
        return {"pose": self.pose, "geometry": self.plan.shell.name, "portals": portals}

    def cells(self, *, short_stab: bool) -> list[dict[str, Any]]:
        """Return the cells of a world record: the rooms that are loaded."""
        rooms = range(len(self.plan.rooms))
        return [self._cell(k, short_stab=short_stab) for k in rooms if k not in self.missing]

    def geometries(self) -> Iterator[Geometry]:
        """Yield the geometry of rooms and shell."""
        for k, room in enumerate(self.plan.rooms):
            if k not in self.missing:
                yield room.geometry
        if self.plan.shell is not None:
            yield self.plan.shell

    def _cell(self, k: int, *, short_stab: bool) -> dict[str, Any]:
        room = self.plan.rooms[k]
        cell = self.first + k
        origin = round_point(to_world(self.pose, room.at, 1.0))
        next_door = [_across(door, k) for door in self._portals(k)]
        others = [other for other in range(len(self.plan.rooms)) if other != k]
        return {
            "id": cell,
            "pose": {"cell": cell, "origin": origin, "rotation": self.pose["rotation"]},
            "geometry": room.geometry.name,
            "portals": [self._portal(k, door) for door in self._portals(k)],
            "stab": [self.first + other for other in others if not short_stab or other in next_door],
        }

    def _portals(self, room: int) -> list[Door]:
        return [door for door in self.plan.doors if room in {door.room, door.other}]

    def _portal(self, k: int, door: Door) -> dict[str, Any]:
        """Write one of the two sides of a door: its polygon goes the same way round in both rooms."""
        room = self.plan.rooms[k]
        polygon = [subtract(corner, room.at) for corner in door.corners]
        other = _across(door, k)
        return {
            "other": None if other is None else self.first + other,
            "side": _side(polygon, room.geometry),
            "polygon": polygon,
            "other_portal": 0 if other is None else self._portals(other).index(door),
        }


def put_up(ground: Ground, block: int, number: int, height: float) -> House:
    """Build a house on a landblock.

    Parameters
    ----------
    ground : Ground
        What, and where in the block.
    block : int
        The landblock's 16-bit id.
    number : int
        How many houses the site had before.
    height : float
        Of the land there, metres; counts if the ground names none.
    """
    z = height if ground.height is None else ground.height
    x, y = ground.origin
    first = (block << 16) + _FIRST_ROOM + _ROOMS_PER_HOUSE * number
    pose = {"cell": block << 16 | _WHOLE_BLOCK, "origin": (x, y, z), "rotation": yaw_quaternion(ground.yaw)}
    level = {} if ground.height is not None else _levelled(block, x, y, z - _SILL)
    return House(plans()[ground.plan], ground.missing, pose, first, level)


def _levelled(block: int, x: float, y: float, z: float) -> dict[tuple[int, int], float]:
    """Return a height for each vertex of the land cells that a house may stand on."""
    columns, rows = (range(math.floor((v - _HALF) / CELL), math.ceil((v + _HALF) / CELL) + 1) for v in (x, y))
    return {global_vertex(block, i, j): z for i in columns for j in rows}


def _across(door: Door, room: int) -> int | None:
    return door.other if room == door.room else door.room


def _side(polygon: list[Vec3], geometry: Geometry) -> int:
    """Return the portal side of a door: 0 if the room is in front of its polygon (09 2.1)."""
    if geometry.cell_planes is None:
        raise ValueError(f"{geometry.name} has no inside")
    x, y, z = (0.5 * (min(values) + max(values)) for values in zip(*geometry.vertices, strict=True))
    return int(signed_distance(plane_of(polygon), (x, y, z)) < 0.0)
