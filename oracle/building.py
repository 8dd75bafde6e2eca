"""CBuildingObj: the shell of a building, and the way into its rooms."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from oracle.enums import CONTACT_OI, TransitionState
from oracle.physics_object import PhysicsObj
from oracle.physics_state import STATIC_PS
from oracle.trace import building, traced

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.cell_array import CellArray
    from oracle.env_cell import EnvCell
    from oracle.physics_part import PartArray, PhysicsPart
    from oracle.position import Position
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition
    from oracle.world import World

UNSCALED = 1.0
"""Buildings are never scaled; nothing of their own scale is read (09 3.7)."""


class BldPortal(NamedTuple):
    """A portal of a building (CBldPortal, 09 2.1).

    Attributes
    ----------
    other_cell_id : int
        The interior cell behind it.
    other_portal_id : int
        Which of that cell's portals leads back; negative is none.
    """

    other_cell_id: int
    other_portal_id: int

    def get_other_cell(self, world: World) -> EnvCell | None:
        """Return the cell behind the portal, if it is loaded.

        retail: CBldPortal::GetOtherCell 0x0053BC30, 09 2.
        """
        return world.cells.get(self.other_cell_id)


class BuildingObj(PhysicsObj):
    """A building.

    Attributes
    ----------
    portals : tuple of BldPortal
        The ways in.
    """

    __slots__ = ("portals",)

    def __init__(
        self, position: Position, part_array: PartArray | None, portals: Sequence[BldPortal], world: World
    ) -> None:
        super().__init__(0, STATIC_PS, position, scale=UNSCALED, part_array=part_array, world=world)
        self.portals = tuple(portals)

    @traced(building)
    def find_building_collisions(self, transition: Transition) -> TransitionState:
        """Test the path against the building's first part, whoever moves.

        retail: CBuildingObj::find_building_collisions 0x006B5300, 09 3.7.
        """
        path = transition.sphere_path
        # 09 3.7.1
        if self.part_array is None:
            return TransitionState.OK
        # 09 3.7.2
        path.bldg_check = 1
        # 09 3.7.3
        part = self.part_array.parts[0]
        r = TransitionState.OK if part is None else part.find_obj_collisions(transition)
        # 09 3.7.4
        path.bldg_check = 0
        # 09 3.7.5
        if r != TransitionState.OK and not transition.object_info.state & CONTACT_OI:
            transition.collision_info.collided_with_environment = 1
        # 09 3.7.6
        return r

    def find_building_transit_cells(
        self,
        p: Position,
        num_sphere: int,
        spheres: Sequence[Sphere],
        array: CellArray,
        path: SpherePath | None,
    ) -> None:
        """Add the loaded cells behind the portals that the spheres (block coordinates of `p`) reach.

        retail: CBuildingObj::find_building_transit_cells 0x006B5230, 09 6.3.
        """
        for portal in self.portals:
            other = portal.get_other_cell(self.world)
            if other is not None:
                other.check_building_transit(portal.other_portal_id, p, num_sphere, spheres, array, path)

    def find_building_transit_cells_of_parts(
        self, parts: Sequence[PhysicsPart | None], array: CellArray
    ) -> None:
        """Add the loaded cells behind the portals that an object's parts reach.

        retail: CBuildingObj::find_building_transit_cells 0x006B52A0, 09 6.3.
        """
        for portal in self.portals:
            other = portal.get_other_cell(self.world)
            if other is not None:
                other.check_building_transit_of_parts(portal.other_portal_id, parts, array)
