"""Which of a cell and those around it a point is in (09, 7)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine import layout as at
from engine.checks import whole
from engine.constants import FIRST_INDOOR
from engine.errors import QueryError
from engine.float32 import float32_array
from engine.kernels.cell_list import point_in_cell
from engine.world import CHECK_WORLD

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from engine.world import World


_CHECK_CELL: Final = whole()


def find_visible_child_cell(
    world: World, cell: int, point: Sequence[float], *, search_stabs: bool
) -> int | None:
    """Return the id of the environment cell that a point is in: a given one or one near it.

    Parameters
    ----------
    world : World
    cell : int
        Id of an environment cell of the world, which is asked first.
    point : sequence of float
        x, y, z in metres, in the cell's block.
    search_stabs : bool
        Whether to go on with the cells that are visible from it, or with those behind its portals.

    Returns
    -------
    int or None
        None if no cell of them contains the point.

    Raises
    ------
    QueryError
        If there is no such cell, or the point is not finite.

    Notes
    -----
    retail: CEnvCell::find_visible_child_cell 0x0052DC50, 09 7
    """
    CHECK_WORLD(world, "world", QueryError)
    _CHECK_CELL(cell, "cell", QueryError)
    index = world.cell_index(cell)
    if index == at.NO_CELL or cell & 0xFFFF < FIRST_INDOOR:
        raise QueryError("cell", f"{cell:#010x} is not an environment cell of the world")
    x, y, z = float32_array(point, (int(at.VECTOR_SIZE),), "point", QueryError).tolist()
    around = _visible_from(world, index) if search_stabs else _behind_portals(world, index)
    for other in (index, *around):
        if point_in_cell(*world.arrays, other, x, y, z):
            return world.cell_ids[other]
    return None


def _visible_from(world: World, index: int) -> Iterator[int]:
    """Yield the cells on a cell's stab list that are in the world, in order."""
    ints = world.ints
    record = int(ints[at.WORLD_CELL_INTS] + at.CELL_INTS * index)
    first, count = ints[record + at.CELL_STAB : record + at.CELL_STAB_COUNT + 1]
    for cell_id in ints[first : first + count].tolist():
        if cell_id & 0xFFFF >= FIRST_INDOOR and world.cell_index(cell_id) != at.NO_CELL:
            yield world.cell_index(cell_id)


def _behind_portals(world: World, index: int) -> Iterator[int]:
    """Yield the cells behind a cell's portals that are in the world, in order."""
    ints = world.ints
    record = int(ints[at.WORLD_CELL_INTS] + at.CELL_INTS * index)
    first, count = ints[record + at.CELL_PORTALS : record + at.CELL_PORTAL_COUNT + 1]
    behind = ints[first + at.PORTAL_CELL : first + at.PORTAL_INTS * max(count, 0) : at.PORTAL_INTS]
    yield from (cell for cell in behind.tolist() if cell >= 0)
