"""What retail keeps in global variables: the loaded cells, the clocks and the player."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.clock import Clock
from oracle.land_defs import FIRST_INTERIOR_CELL
from oracle.landscape import Landscape

if TYPE_CHECKING:
    from oracle.env_cell import EnvCell
    from oracle.obj_cell import ObjCell
    from oracle.physics_object import PhysicsObj


class World:
    """Interior cells by id, the landscape, and what ticks share.

    Attributes
    ----------
    cells : dict of int to EnvCell
        The loaded interior cells.
    landscape : Landscape
        The loaded landblocks; none at first.
    clock : Clock
        The time, for all objects of the world.
    player : PhysicsObj or None
        The player's own object; None before there is one.
    maintainer_active : int
        Whether the object maintainer runs: then objects far from the player are deactivated (06 QT-2).
    """

    __slots__ = ("cells", "clock", "landscape", "maintainer_active", "player")

    def __init__(self) -> None:
        self.cells: dict[int, EnvCell] = {}
        self.landscape = Landscape({})
        self.clock = Clock()
        self.player: PhysicsObj | None = None
        self.maintainer_active = 0

    def add_cell(self, cell: EnvCell) -> None:
        """Load an interior cell; land cells come with their landblocks."""
        self.cells[cell.id] = cell

    def get_visible(self, cell_id: int) -> ObjCell | None:
        """Return the cell with this id if it is loaded; never loads.

        retail: CObjCell::GetVisible 0x0052AD40, 09 2.
        """
        if (cell_id & 0xFFFF) < FIRST_INTERIOR_CELL:
            return self.landscape.get_landcell(cell_id)
        return self.cells.get(cell_id)
