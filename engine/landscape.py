"""Landblocks and the buildings on them, given as plain data (09, 3.7; 10)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from engine.checks import LARGEST_INDEX, optional, record, sequence, several, whole
from engine.geometry import Shape
from engine.pose import Pose, check_pose

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True, slots=True, eq=False)
class LandBlock:
    """The ground of a landblock: 64 land cells, each an edge of 24 metres.

    Attributes
    ----------
    id : int
        The high 16 bits of its cells' ids: 256 * x + y, both at most 254.
    heights : sequence of 81 floats
        Metres; vertex 9 * i + j is the i-th from the west, j-th from the south.
    terrain : sequence of 81 int, or None
        Terrain words of the same vertices: bits 2 to 6 are the terrain type, 16 to 20 of which are water.
        None: all 0.
    side_cell_count : int
        Land cells along an edge: 8. A block that is loaded with less detail (4, 2 or 1) is as one that is not
        loaded (10, 4).
    """

    id: int
    heights: Sequence[float]
    terrain: Sequence[int] | None = None
    side_cell_count: int = 8


@dataclass(frozen=True, slots=True)
class BuildingPortal:
    """A way into a building.

    Attributes
    ----------
    other : int
        Id of the cell behind it, which need not be in the world.
    other_portal : int
        Index of the portal in that cell; negative for none, which leads nowhere.
    """

    other: int
    other_portal: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Building:
    """The outside of a house, in the land cell under its origin.

    Retail drops a building that is in no land cell of the block that lists it, and any but the first in a
    cell.

    Attributes
    ----------
    pose : Pose
        Where it is, in its landblock.
    shape : Shape or None
        Geometry of its part 0, the only one that is collided with.
    portals : sequence of BuildingPortal
        In the order in which they are looked at.
    block : int or None
        The high 16 bits of the ids of the block that lists it; None: of the one under its origin.
    """

    pose: Pose
    shape: Shape | None
    portals: Sequence[BuildingPortal] = ()
    block: int | None = None


CHECK_BLOCK: Final = record(
    LandBlock, id=whole(), heights=sequence, terrain=optional(several(whole())), side_cell_count=whole()
)
CHECK_BUILDING: Final = record(
    Building,
    pose=check_pose,
    shape=optional(record(Shape)),
    portals=several(
        record(BuildingPortal, other=whole(1), other_portal=whole(-LARGEST_INDEX, LARGEST_INDEX))
    ),
    block=optional(whole()),
)
