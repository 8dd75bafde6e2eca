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

    from conformance.scenes.model import Geometry, Pose, Vec3
    from conformance.scenes.object_model import WorldObject

SIDE_CELLS: Final = 8
"""Land cells along the edge of a landblock at full detail (10 1.)."""
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
    side_cell_count : int
        Cells along an edge: 8, or less for a block far from the viewer, which nobody collides with.
    """

    block: int
    heights: tuple[float, ...]
    terrain: tuple[int, ...] = ()
    side_cell_count: int = SIDE_CELLS

    def to_record(self) -> dict[str, Any]:
        """Write one of a world's landblocks."""
        record: dict[str, Any] = {"block": self.block, "heights": list(self.heights)}
        if self.terrain:
            record["terrain"] = list(self.terrain)
        if self.side_cell_count != SIDE_CELLS:
            record["side_cell_count"] = self.side_cell_count
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
    """A loaded interior cell of a world.

    Attributes
    ----------
    stab : tuple of int
        The cells seen from it, in order.
    portal_array : bool
        False: retail's missing array, with which no point is in the cell (09 4.1).
    """

    id: int
    pose: Pose
    geometry: Geometry
    portals: tuple[Portal, ...] = ()
    stab: tuple[int, ...] = ()
    portal_array: bool = True

    def to_record(self) -> dict[str, Any]:
        """Write one of a world's cells."""
        return {
            "id": self.id,
            "pose": self.pose.to_record(),
            "geometry": self.geometry.name,
            "portals": [portal.to_record() for portal in self.portals] if self.portal_array else None,
            "stab": list(self.stab),
        }


@dataclass(frozen=True, slots=True)
class Building:
    """A building: its shell, and the cells that its doors lead to.

    Attributes
    ----------
    pose : Pose
        Where its shell stands; the land cell that holds its origin holds the building.
    geometry : Geometry or None
        The shell, part 0; None: it has no part array.
    portals : tuple of (int, int)
        The cell behind each door, and the index of the portal in that cell.
    block : int or None
        The landblock whose file lists it; None: the one that its origin is in. In another one retail finds
        no land cell for it and drops it (09 3.7).
    """

    pose: Pose
    geometry: Geometry | None
    portals: tuple[tuple[int, int], ...] = ()
    block: int | None = None

    def to_record(self) -> dict[str, Any]:
        """Write one of a world's buildings."""
        record: dict[str, Any] = {
            "pose": self.pose.to_record(),
            "geometry": None if self.geometry is None else self.geometry.name,
            "portals": [{"other": cell, "other_portal": portal} for cell, portal in self.portals],
        }
        if self.block is not None:
            record["block"] = self.block
        return record


@dataclass(frozen=True, slots=True)
class Restriction:
    """Who may enter a cell (09 3.1).

    Attributes
    ----------
    admits : tuple of int
        The ids of those players who may.
    known : bool
        False: the restriction object, or its game object, is not there, and no player may.
    """

    admits: tuple[int, ...] = ()
    known: bool = True

    def to_record(self) -> dict[str, Any]:
        """Write one of a world's restrictions."""
        return {"object": int(self.known), "admits": list(self.admits)}


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
    restrictions : mapping of int to Restriction
        The cells that not everyone may enter, land cells included.
    """

    name: str
    landblocks: tuple[LandBlock, ...] = ()
    cells: tuple[InteriorCell, ...] = ()
    buildings: tuple[Building, ...] = ()
    objects: tuple[WorldObject, ...] = ()
    shadow: Mapping[int, tuple[int, ...]] = field(default_factory=lambda: MappingProxyType({}))
    restrictions: Mapping[int, Restriction] = field(default_factory=lambda: MappingProxyType({}))

    def to_record(self) -> dict[str, Any]:
        """Write the WORLD block; the keys of `shadow` and `restrictions` are texts, as JSON's are."""
        record: dict[str, Any] = {
            "kind": "world",
            "name": self.name,
            "landblocks": [block.to_record() for block in self.landblocks],
            "cells": [cell.to_record() for cell in self.cells],
            "buildings": [building.to_record() for building in self.buildings],
            "objects": [thing.to_record() for thing in self.objects],
            "shadow": {str(cell): list(ids) for cell, ids in self.shadow.items()},
        }
        if self.restrictions:
            record["restrictions"] = {str(cell): one.to_record() for cell, one in self.restrictions.items()}
        return record

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
