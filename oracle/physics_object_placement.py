"""CPhysicsObj, placement: put an object into a cell, without a path that leads there.

The functions here are methods of `oracle.physics_object.PhysicsObj`.
"""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Final

from oracle.constants import PLACEMENT_SLACK
from oracle.errors import NotPortedError

if TYPE_CHECKING:
    from oracle.obj_cell import ObjCell
    from oracle.physics_object import PhysicsObj
    from oracle.position import Position
    from oracle.transition import Transition

SLIDE: Final = 0x10
"""The object may end somewhere near (06 SP-5)."""
DO_NOT_LOAD_CELLS: Final = 0x20
"""Only cells that are visible from the first one count (06 SP-4)."""
SCATTERED: Final = 0x100 | 0x200
"""Random positions are tried: SCATTER and RANDOMSCATTER (06 10)."""


class SetPositionError(IntEnum):
    """What came of a placement (SetPositionError, 06 10)."""

    OK = 0
    NO_VALID_POSITION = 2
    NO_CELL = 3
    COLLIDED = 4


def set_position(self: PhysicsObj, p: Position, flags: int, cell: ObjCell | None) -> SetPositionError:
    """Place the object at a position, or near it.

    Parameters
    ----------
    p : Position
        Where. Takes the origin that the object ended at, if the object may not slide.
    flags : int
        `SLIDE` and `DO_NOT_LOAD_CELLS`.
    cell : ObjCell or None
        The cell that the position is in, adjusted as AdjustPosition does (06 SP-2), which no document
        specifies; None if there is none.

    Raises
    ------
    NotPortedError
        For random positions.

    Notes
    -----
    retail: CPhysicsObj::SetPosition 0x005160C0, 06 10.
    """
    if flags & SCATTERED:
        raise NotPortedError("placements at random positions (06 10)")
    made = self.make_transition()
    made.init_object(self, 0)
    self.give_spheres(made)
    return self.place(p, flags, cell, made)


def place(
    self: PhysicsObj, p: Position, flags: int, cell: ObjCell | None, made: Transition
) -> SetPositionError:
    """Run a placement and take over where it ended.

    retail: CPhysicsObj::SetPositionInternal(Position) 0x00515BD0, 06 SP-3…7.
    """
    # SP-3
    if cell is None:
        self.become_lost(p)
        return SetPositionError.OK
    # SP-4
    made.cell_array.do_not_load_cells = int(bool(flags & DO_NOT_LOAD_CELLS))
    # SP-5
    ok = _check_position(p, flags, cell, made)
    # SP-6
    if not ok:
        collided = self.handle_all_collisions(made.collision_info, 0, 0)
        return SetPositionError.COLLIDED if collided else SetPositionError.NO_VALID_POSITION
    # SP-7
    if made.sphere_path.curr_cell is None:
        return SetPositionError.NO_CELL
    self.set_position_internal(made)
    return SetPositionError.OK


def _check_position(p: Position, flags: int, cell: ObjCell, made: Transition) -> bool:
    """Tell whether there is room: CPhysicsObj::CheckPositionInternal (06 SP-5)."""
    sp = made.sphere_path
    made.init_path(cell, None, p)
    if not flags & SLIDE:
        sp.placement_allows_sliding = 0
    if not made.find_valid_position():
        return False
    if flags & SLIDE:
        return True
    wanted, found = p.frame.origin, sp.curr_pos.frame.origin
    near = found.x - wanted.x < PLACEMENT_SLACK and found.y - wanted.y < PLACEMENT_SLACK
    if not near or sp.curr_pos.objcell_id != cell.id:
        return False
    wanted.assign(found)
    return True
