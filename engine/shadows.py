"""Which objects are found in which cells, while objects come, move and go (08, 9)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine import layout as at
from engine.constants import PARTICLE_EMITTER, STATIC
from engine.registration import Registrar

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from engine.objects import Obstacle
    from engine.world import World


class ShadowLists:
    """The objects of each cell, in the order in which retail tests them.

    Parameters
    ----------
    world : World
        Its cells, landblocks and buildings; its own objects do not matter.
    objects : sequence of Obstacle
        Who may come; nobody is there at first.
    attached : mapping of int to sequence of int, optional
        What hangs on an object, which is registered where the object is: indices in `objects`.

    Raises
    ------
    WorldError, PoseError
        Naming the object, or the portal, that keeps it from being registered.
    """

    def __init__(
        self,
        world: World,
        objects: Sequence[Obstacle],
        attached: Mapping[int, Sequence[int]] | None = None,
    ) -> None:
        self._world: Final = world
        self._objects: Final = objects
        self._attached: Final = attached or {}
        self._registrar: Final = Registrar(world, objects)
        self._lists: Final[dict[int, list[int]]] = {}
        self._cells: Final[list[list[int]]] = [[] for _ in objects]

    def enter(self, index: int) -> None:
        """Register an object in the cells that it reaches, behind all others; it leaves its old cells first.

        retail: CPhysicsObj::calc_cross_cells_static 0x00515160, calc_cross_cells 0x00515230, 08 9.1-2
        """
        static = bool(self._objects[index].state & STATIC)
        reached = [cell for cell in self._registrar.cells_reached(index, static=static) if cell >= 0]
        self.leave(index)
        self._add(index, reached)

    def leave(self, index: int) -> None:
        """Take an object out of its cells; in each the last object takes its place.

        retail: CObjCell::remove_shadow_object 0x0052B2D0, 08 9.5
        """
        for cell in self._cells[index]:
            things = self._lists[cell]
            place = things.index(index)
            last = things.pop()
            if place < len(things):
                things[place] = last
        self._cells[index].clear()
        for child in self._attached.get(index, ()):
            self.leave(child)

    def by_cell(self) -> dict[int, list[Obstacle]]:
        """Return the objects of each cell that has any, by its id, as `World` takes them."""
        return {
            self._world.cell_ids[cell]: [self._objects[thing] for thing in things]
            for cell, things in self._lists.items()
            if things
        }

    def _add(self, index: int, reached: Sequence[int]) -> None:
        """Append an object, and what hangs on it, to the lists of cells; an emitter only to that of its own.

        retail: CPhysicsObj::add_shadows_to_cells 0x00514AE0, 08 9.4
        """
        thing = self._objects[index]
        own = self._world.cell_index(thing.pose.cell)
        emitted = [] if own == at.NO_CELL else [own]
        cells = emitted if thing.state & PARTICLE_EMITTER else reached
        for cell in cells:
            self._lists.setdefault(cell, []).append(index)
        self._cells[index].extend(cells)
        for child in self._attached.get(index, ()):
            self._add(child, reached)


def register(world: World, objects: Sequence[Obstacle]) -> dict[int, list[Obstacle]]:
    """Return which objects are found in each cell, by its id, as `World` takes them.

    Parameters
    ----------
    world : World
        The cells, landblocks and buildings.
    objects : sequence of Obstacle
        In the order in which they enter the world, which is that of each cell's list.

    Raises
    ------
    WorldError, PoseError
        Naming the object, and what is wrong with it.
    """
    lists = ShadowLists(world, objects)
    for index in range(len(objects)):
        lists.enter(index)
    return lists.by_cell()
