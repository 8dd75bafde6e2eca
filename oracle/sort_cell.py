"""CSortCell: a cell that may hold a building."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.enums import TransitionState
from oracle.obj_cell import ObjCell

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.building import BuildingObj
    from oracle.cell_array import CellArray
    from oracle.physics_part import PhysicsPart
    from oracle.position import Position
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition


class SortCell(ObjCell):
    """A cell with room for one building.

    Attributes
    ----------
    building : BuildingObj or None
        The building whose origin is in the cell.
    """

    def __init__(self, cell_id: int, pos: Position) -> None:
        super().__init__(cell_id, pos)
        self.building: BuildingObj | None = None

    def add_building(self, building: BuildingObj) -> None:
        """Take a building, unless there is one already.

        retail: CSortCell::add_building 0x00534030, 09 3.6.
        """
        if self.building is None:
            self.building = building

    def find_collisions(self, transition: Transition) -> TransitionState:
        """Test the path against the building.

        retail: CSortCell::find_collisions 0x005340A0, 09 3.6.
        """
        if self.building is None:
            return TransitionState.OK
        return self.building.find_building_collisions(transition)

    def find_transit_cells(
        self,
        p: Position,
        num_sphere: int,
        spheres: Sequence[Sphere],
        array: CellArray,
        path: SpherePath | None,
    ) -> None:
        """Add the building's cells that the spheres reach (CSortCell::find_transit_cells, 09 6.3)."""
        if self.building is not None:
            self.building.find_building_transit_cells(p, num_sphere, spheres, array, path)

    def find_transit_cells_of_parts(self, parts: Sequence[PhysicsPart | None], array: CellArray) -> None:
        """Add the building's cells that the parts reach (CSortCell::find_transit_cells, 09 6.3)."""
        if self.building is not None:
            self.building.find_building_transit_cells_of_parts(parts, array)
