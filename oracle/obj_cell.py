"""CObjCell: a cell with objects in it, and the lists of cells that spheres reach."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, TypeAlias

from oracle.arithmetic import f32
from oracle.enums import IS_PLAYER, InsertType, TransitionState
from oracle.errors import NotPortedError
from oracle.land_defs import get_block_offset
from oracle.sphere_path import FIRST_INTERIOR_CELL
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from oracle.cell_array import CellArray
    from oracle.physics_object import PhysicsObj
    from oracle.position import Position
    from oracle.ref import Ref
    from oracle.sphere import Sphere
    from oracle.sphere_path import SpherePath
    from oracle.transition import Transition
    from oracle.weenie import Weenie
    from oracle.world import World

    Restriction: TypeAlias = Callable[[Weenie], bool]


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
        Whether a mover's game object may enter; None lets everyone in (09 3.1, the named hook).
    """

    def __init__(self, cell_id: int, pos: Position) -> None:
        self.id = cell_id
        self.pos = pos
        self.shadow_object_list: list[PhysicsObj] = []
        self.stab_list: tuple[int, ...] = ()
        self.restriction: Restriction | None = None

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
        self, p: Position, num_sphere: int, spheres: Sequence[Sphere], array: CellArray
    ) -> None:
        """Add the neighbours that the spheres reach (landblock coordinates of `p`)."""

    def check_entry_restrictions(self, transition: Transition) -> TransitionState:
        """Refuse movers that may not enter.

        Retail looks the restriction object up by id; here the cell holds the question itself.

        retail: CObjCell::check_entry_restrictions 0x0052B6D0, 09 3.1.
        """
        mover = transition.object_info.object
        if mover is None:
            return TransitionState.COLLIDED
        weenie = mover.weenie_obj
        if weenie is None or weenie.can_bypass_move_restrictions or self.restriction is None:
            return TransitionState.OK
        if transition.object_info.state & IS_PLAYER and not self.restriction(weenie):
            return TransitionState.COLLIDED
        return TransitionState.OK

    def find_obj_collisions(self, transition: Transition) -> TransitionState:
        """Test the path against the objects registered here until one is in the way.

        retail: CObjCell::find_obj_collisions 0x0052B750, 09 3.2.
        """
        # 09 3.2.1
        if transition.sphere_path.insert_type == InsertType.INITIAL_PLACEMENT:
            return TransitionState.OK
        # 09 3.2.2
        for physobj in self.shadow_object_list:
            if physobj.parent is not None or physobj is transition.object_info.object:
                continue
            r = physobj.find_obj_collisions(transition)
            if r != TransitionState.OK:
                return r
        # 09 3.2.3
        return TransitionState.OK


def find_cell_list(
    world: World,
    p: Position,
    num_sphere: int,
    spheres: Sequence[Sphere],
    array: CellArray,
    curr_cell: Ref[ObjCell | None] | None,
    path: SpherePath | None,
) -> None:
    """List the cells that spheres reach, and find the one that contains sphere 0.

    Parameters
    ----------
    world : World
        The loaded cells.
    p : Position
        Where the search starts; the spheres are in its landblock's coordinates, metres.
    num_sphere : int
        How many of `spheres` count.
    array : CellArray
        Filled anew.
    curr_cell : Ref or None
        Takes the containing cell or None; left alone if the starting cell is not loaded or there are
        no spheres.
    path : SpherePath or None
        Is told that an interior cell was reached.

    Raises
    ------
    NotPortedError
        The search starts outdoors.

    Notes
    -----
    retail: CObjCell::find_cell_list 0x0052B4E0, 09 5.1.
    """
    # 09 5.1.1
    array.cells.clear()
    array.added_outside = 0
    # 09 5.1.2
    start = world.get_visible(p.objcell_id)
    # 09 5.1.3
    interior = (p.objcell_id & 0xFFFF) >= FIRST_INTERIOR_CELL
    if not interior:
        raise NotPortedError("a search of cells that starts outdoors (09 6.4)")
    if path is not None:
        path.hits_interior_cell = 1
    array.add_cell(p.objcell_id, start)
    # 09 5.1.4
    if start is None or num_sphere == 0:
        return
    # 09 5.1.5
    i = 0
    while i < array.num_cells:
        cell = array.cells[i].cell
        if cell is not None:
            cell.find_transit_cells(p, num_sphere, spheres, array)
        i += 1
    # 09 5.1.6
    if curr_cell is not None:
        curr_cell.value = _containing_cell(p, spheres[0].center, array, path)
    # 09 5.1.7
    if array.do_not_load_cells:
        _prune(array, start)


def _containing_cell(
    p: Position, center: Vector3, array: CellArray, path: SpherePath | None
) -> ObjCell | None:
    """Return the first interior cell that contains the point, else the last outdoor one (09 5.1.6)."""
    found: ObjCell | None = None
    for entry in array.cells:
        cell = entry.cell
        if cell is None:
            continue
        off = get_block_offset(p.objcell_id, cell.id)
        lp = Vector3(f32(center.x - off.x), f32(center.y - off.y), f32(center.z - off.z))
        if cell.point_in_cell(lp):
            found = cell
            if cell.is_interior:
                if path is not None:
                    path.hits_interior_cell = 1
                break
    return found


def _prune(array: CellArray, start: ObjCell) -> None:
    """Keep only the starting cell and what is visible from it (09 5.1.7)."""
    i = 0
    while i < array.num_cells:
        cell_id = array.cells[i].cell_id
        if cell_id == start.id or cell_id in start.stab_list:
            i += 1
        else:
            array.remove_cell(i)


def find_cell_list_for_path(
    world: World, array: CellArray, curr_cell: Ref[ObjCell | None] | None, path: SpherePath
) -> None:
    """List the cells that the check position's spheres reach.

    retail: CObjCell::find_cell_list(array, check_cell, path) 0x0052B960, 09 5.2.
    """
    find_cell_list(world, path.check_pos, path.num_sphere, path.global_sphere, array, curr_cell, path)
