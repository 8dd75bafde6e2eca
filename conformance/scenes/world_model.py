"""The neutral model of a world: landblocks, interior cells with portals, buildings, objects, shadow lists.

Plain data like `conformance.scenes.model`; `World.to_record` writes the WORLD block of ``vectors/FORMAT.md``
that candidates are given.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.scenes.model import Geometry, Pose, SphereData, Vec3

SIDE_VERTICES: Final = 9
"""Height points along a landblock's edge (10 1.)."""
VERTEX_COUNT: Final = SIDE_VERTICES * SIDE_VERTICES
FIRST_INTERIOR: Final = 0x100
"""Low words from here on are interior cells (09)."""
LOW_WORD: Final = 0xFFFF


def is_interior(cell_id: int) -> bool:
    """Tell whether an id is that of an interior cell."""
    return cell_id & LOW_WORD >= FIRST_INTERIOR


@dataclass(frozen=True, slots=True)
class LandBlock:
    """A loaded landblock.

    Attributes
    ----------
    block : int
        16-bit block id, x * 256 + y.
    heights : tuple of float
        z of the 81 vertices in metres; index 9 * i + j with i from west to east and j from south to north.
    terrain : tuple of int
        The 81 terrain words in the same order, or none: all 0.
    """

    block: int
    heights: tuple[float, ...]
    terrain: tuple[int, ...] = ()

    def to_record(self) -> dict[str, Any]:
        """Write one of a world's landblocks."""
        record: dict[str, Any] = {"block": self.block, "heights": list(self.heights)}
        if self.terrain:
            record["terrain"] = list(self.terrain)
        return record


@dataclass(frozen=True, slots=True)
class Portal:
    """A portal of an interior cell (retail: CCellPortal, 09 2.1).

    Attributes
    ----------
    other : int or None
        The cell it leads to, loaded or not; None: outdoors.
    side : int
        0: the cell is on the side that the polygon faces, 1: behind it.
    polygon : tuple of Vec3
        Corner points in cell space, metres.
    other_portal : int
        The index of the portal that leads back; for an exterior one the building's.
    """

    other: int | None
    side: int
    polygon: tuple[Vec3, ...]
    other_portal: int

    def to_record(self) -> dict[str, Any]:
        """Write one of a cell's portals."""
        return {
            "other": self.other,
            "side": self.side,
            "polygon": [list(corner) for corner in self.polygon],
            "other_portal": self.other_portal,
        }


@dataclass(frozen=True, slots=True)
class InteriorCell:
    """A loaded interior cell of a world; `stab` are the cells seen from it, in order."""

    id: int
    pose: Pose
    geometry: Geometry
    portals: tuple[Portal, ...] = ()
    stab: tuple[int, ...] = ()

    def to_record(self) -> dict[str, Any]:
        """Write one of a world's cells."""
        return {
            "id": self.id,
            "pose": self.pose.to_record(),
            "geometry": self.geometry.name,
            "portals": [portal.to_record() for portal in self.portals],
            "stab": list(self.stab),
        }


@dataclass(frozen=True, slots=True)
class Building:
    """A building: its shell, and the cells that its doors lead to.

    Attributes
    ----------
    pose : Pose
        Where its shell stands; the land cell that holds its origin holds the building.
    geometry : Geometry
        The shell, part 0.
    portals : tuple of (int, int)
        The cell behind each door, and the index of the portal in that cell.
    """

    pose: Pose
    geometry: Geometry
    portals: tuple[tuple[int, int], ...] = ()

    def to_record(self) -> dict[str, Any]:
        """Write one of a world's buildings."""
        return {
            "pose": self.pose.to_record(),
            "geometry": self.geometry.name,
            "portals": [{"other": cell, "other_portal": portal} for cell, portal in self.portals],
        }


@dataclass(frozen=True, slots=True)
class Part:
    """A part of an object; pose and scale are the object's where they are None."""

    geometry: Geometry | None
    pose: Pose | None = None
    scale: float | None = None

    def to_record(self) -> dict[str, Any]:
        """Write one of an object's parts."""
        record: dict[str, Any] = {"geometry": None if self.geometry is None else self.geometry.name}
        if self.pose is not None:
            record["pose"] = self.pose.to_record()
        if self.scale is not None:
            record["scale"] = self.scale
        return record


@dataclass(frozen=True, slots=True)
class WorldObject:
    """An object that movers collide with (08).

    Attributes
    ----------
    id : int
        Its own; a mover with the same id passes it.
    pose : Pose
        The cell of the pose is the object's own cell.
    scale : float
        Of spheres and cylinders.
    state : int
        Bits of PhysicsState.
    weenie : tuple of str or None
        Flags of its weenie by name; None: it has none.
    parts : tuple of Part
        BSP shapes.
    cylspheres : tuple of (float, float, float, float, float)
        Low point, radius, height; object space, unscaled metres.
    spheres : tuple of SphereData
        Object space, unscaled metres.
    parent : bool
        It hangs on another object.
    part_array : bool
        False: it has no part array, so it collides with nothing.
    """

    id: int
    pose: Pose
    scale: float = 1.0
    state: int = 0
    weenie: tuple[str, ...] | None = None
    parts: tuple[Part, ...] = ()
    cylspheres: tuple[tuple[float, float, float, float, float], ...] = ()
    spheres: tuple[SphereData, ...] = ()
    parent: bool = False
    part_array: bool = True

    def to_record(self) -> dict[str, Any]:
        """Write the OBJECT block of a vector record."""
        record: dict[str, Any] = {
            "id": self.id,
            "pose": self.pose.to_record(),
            "scale": self.scale,
            "state": self.state,
        }
        if self.weenie is not None:
            record["weenie"] = dict.fromkeys(self.weenie, 1)
        if self.parts:
            record["parts"] = [part.to_record() for part in self.parts]
        for key in ("cylspheres", "spheres"):
            if shapes := getattr(self, key):
                record[key] = [list(shape) for shape in shapes]
        if self.parent:
            record["parent"] = 1
        if not self.part_array:
            record["no_part_array"] = 1
        return record


@dataclass(frozen=True, slots=True)
class World:
    """What a query of part 2 runs in.

    Attributes
    ----------
    name : str
        For messages.
    landblocks, cells, buildings, objects : tuple
        Everything that is loaded.
    shadow : mapping of int to tuple of int
        The ids of the objects registered in a cell, land cells included, in the order of testing.
    """

    name: str
    landblocks: tuple[LandBlock, ...] = ()
    cells: tuple[InteriorCell, ...] = ()
    buildings: tuple[Building, ...] = ()
    objects: tuple[WorldObject, ...] = ()
    shadow: Mapping[int, tuple[int, ...]] = field(default_factory=lambda: MappingProxyType({}))

    def to_record(self) -> dict[str, Any]:
        """Write the WORLD block; the keys of `shadow` are texts, as JSON's are."""
        return {
            "kind": "world",
            "name": self.name,
            "landblocks": [block.to_record() for block in self.landblocks],
            "cells": [cell.to_record() for cell in self.cells],
            "buildings": [building.to_record() for building in self.buildings],
            "objects": [thing.to_record() for thing in self.objects],
            "shadow": {str(cell): list(ids) for cell, ids in self.shadow.items()},
        }

    def geometries(self) -> Iterator[Geometry]:
        """Yield every geometry once, in order of first use."""
        seen: set[int] = set()
        for geometry in self._every_geometry():
            if geometry is not None and id(geometry) not in seen:
                seen.add(id(geometry))
                yield geometry

    def _every_geometry(self) -> Iterator[Geometry | None]:
        yield from (cell.geometry for cell in self.cells)
        yield from (building.geometry for building in self.buildings)
        yield from (part.geometry for thing in self.objects for part in thing.parts)
