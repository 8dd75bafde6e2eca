"""CObjCell: a cell with objects in it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Final, TypeAlias

from oracle.enums import IS_PLAYER, InsertType, TransitionState, WaterType
from oracle.land_defs import FIRST_INTERIOR_CELL

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from oracle.cell_array import CellArray
    from oracle.land_block_struct import LandBlockStruct
    from oracle.physics_object import PhysicsObj
    from oracle.physics_part import PhysicsPart
    from oracle.position import Position
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition
    from oracle.vector import Vector3
    from oracle.weenie import Weenie

    Restriction: TypeAlias = Callable[[Weenie], bool | None]

DEEP_WATER: Final = 0.8999999761581421
"""Water depth in a cell that is all water, float32 of 0.9; metres (10 6.4)."""
SHALLOW_WATER: Final = 0.1
"""Water depth in a cell with some water that has no block, a double; metres (10 6.4)."""


class ObjCell(ABC):
    """A cell.

    Attributes
    ----------
    id : int
        Cell id.
    pos : Position
        Pose of the cell's own space.
    shadow_object_list : list of PhysicsObj
        The objects registered here, in the order they are tested.
    stab_list : tuple of int
        Ids of the cells visible from here.
    restriction : callable or None
        Whether a mover's game object may enter, or None where what restricts the cell is not there;
        no callable lets everyone in (09 3.1, the named hook).
    water_type : WaterType
        How much of the cell is water; only land cells have any.
    block : LandBlockStruct or None
        The landblock that a land cell belongs to.
    """

    def __init__(self, cell_id: int, pos: Position) -> None:
        self.id = cell_id
        self.pos = pos
        self.shadow_object_list: list[PhysicsObj] = []
        self.stab_list: tuple[int, ...] = ()
        self.restriction: Restriction | None = None
        self.water_type = WaterType.NOT_WATER
        self.block: LandBlockStruct | None = None

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.id:#010x})"

    @property
    def is_interior(self) -> bool:
        """Whether the low word of the id is that of an interior cell."""
        return (self.id & 0xFFFF) >= FIRST_INTERIOR_CELL

    @abstractmethod
    def find_collisions(self, transition: Transition) -> TransitionState:
        """Test the path against everything in the cell."""

    @abstractmethod
    def point_in_cell(self, point: Vector3) -> int:
        """Tell whether the cell contains a point of its block's coordinates."""

    @abstractmethod
    def find_transit_cells(
        self,
        p: Position,
        num_sphere: int,
        spheres: Sequence[Sphere],
        array: CellArray,
        path: SpherePath | None,
    ) -> None:
        """Add the neighbours that the spheres reach (landblock coordinates of `p`)."""

    @abstractmethod
    def find_transit_cells_of_parts(self, parts: Sequence[PhysicsPart | None], array: CellArray) -> None:
        """Add the neighbours that an object's parts reach."""

    def check_entry_restrictions(self, transition: Transition) -> TransitionState:
        """Refuse movers that may not enter.

        Retail looks the restriction object up by id; here the cell holds the question itself.

        retail: CObjCell::check_entry_restrictions 0x0052B6D0, 09 3.1.
        """
        # 09 3.1.1
        mover = transition.object_info.object
        if mover is None:
            return TransitionState.COLLIDED
        # 09 3.1.2
        weenie = mover.weenie_obj
        if weenie is None or weenie.can_bypass_move_restrictions or self.restriction is None:
            return TransitionState.OK
        if transition.object_info.state & IS_PLAYER:
            admitted = self.restriction(weenie)
            if not admitted:
                if admitted is not None:
                    self.handle_move_restriction(transition)
                return TransitionState.COLLIDED
        # 09 3.1.3
        return TransitionState.OK

    def handle_move_restriction(self, transition: Transition) -> int:
        """Respond to a refused entry; only land cells do something about it (09 3.1)."""
        return 0

    def find_obj_collisions(self, transition: Transition) -> TransitionState:
        """Test the path against the objects registered here until one is in the way.

        retail: CObjCell::find_obj_collisions 0x0052B750, 09 3.2.
        """
        # 09 3.2.1
        if transition.sphere_path.insert_type == InsertType.INITIAL_PLACEMENT:
            return TransitionState.OK
        # 09 3.2.2
        mover = transition.object_info.object
        for physobj in self.shadow_object_list:
            if physobj.parent is not None or _same_object(physobj, mover):
                continue
            r = physobj.find_obj_collisions(transition)
            if r != TransitionState.OK:
                return r
        # 09 3.2.3
        return TransitionState.OK

    def get_block_water_type(self) -> WaterType:
        """Return how much of the cell's landblock is water.

        retail: CObjCell::get_block_water_type 0x0052AD90, 10 6.3.
        """
        return WaterType.NOT_WATER if self.block is None else self.block.water_type

    def get_water_depth(self, point: Vector3) -> float:
        """Return the depth of the water at a point (block coordinates), metres, in a register.

        retail: CObjCell::get_water_depth 0x0052B8A0, 10 6.4.
        """
        if self.water_type == WaterType.ENTIRELY_WATER:
            return DEEP_WATER
        if self.water_type == WaterType.PARTIALLY_WATER:
            return SHALLOW_WATER if self.block is None else self.block.calc_water_depth(self.id, point)
        return 0.0

    def add_shadow_object(self, physobj: PhysicsObj) -> None:
        """Register an object, to be tested after those that are here already.

        retail: CObjCell::add_shadow_object 0x0052B280, 08 9.5.
        """
        self.shadow_object_list.append(physobj)

    def remove_shadow_object(self, physobj: PhysicsObj) -> None:
        """Forget an object; the last one takes its place in the order.

        retail: CObjCell::remove_shadow_object 0x0052B2D0, 08 9.5.
        """
        found = next((i for i, other in enumerate(self.shadow_object_list) if other is physobj), None)
        if found is not None:
            last = self.shadow_object_list.pop()
            if last is not physobj:
                self.shadow_object_list[found] = last


def _same_object(physobj: PhysicsObj, mover: PhysicsObj | None) -> bool:
    """Tell whether an obstacle is the mover: by identity, as in retail, or by its id, unless it has none."""
    return mover is not None and (physobj is mover or 0 != physobj.id == mover.id)
