"""Cells compiled: environment cells, then the land cells of each block, then buildings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.cells import Portal
from engine.compiling.terrain import (
    MAX_BLOCK,
    block_heights,
    block_terrain,
    cell_positions,
    triangles,
    water_of,
)
from engine.constants import FIRST_INDOOR
from engine.errors import WorldError
from engine.float32 import float32_array
from engine.kernels.land_defs import adjust_to_outside
from engine.kernels.polygon import polygon_make_plane
from engine.pose import position_row, position_rows

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from engine.cells import Cell
    from engine.compiling.objects import Parts
    from engine.compiling.storage import Storage
    from engine.kernels.types import Array, Ints
    from engine.landscape import Building, LandBlock
    from engine.objects import Obstacle


class CellNumbers:
    """The ids of all cells, and their indices.

    Attributes
    ----------
    ids : tuple of int
        Environment cells, then the land cells of each block.
    unloaded : set of int
        Ids that a portal leads to, but that are not in the world.
    """

    def __init__(self, cells: Sequence[Cell], blocks: Sequence[LandBlock]) -> None:
        indoors = [cell.id for cell in cells]
        _check_ids(indoors)
        _check_blocks([block.id for block in blocks])
        land = [(block.id << 16) + k + 1 for block in blocks for k in range(int(at.LAND_CELLS))]
        self.ids: Final = (*indoors, *land)
        self.unloaded: Final[set[int]] = set()
        self._index: Final = {cell_id: i for i, cell_id in enumerate(self.ids)}

    def index(self, cell_id: int) -> int:
        """Return a cell's index, or `NO_CELL`."""
        return self._index.get(cell_id, int(at.NO_CELL))

    def behind_portal(self, cell_id: int) -> int:
        """Return a cell's index, or minus its id if it is not in the world (`PORTAL_CELL`)."""
        index = self.index(cell_id)
        if index != at.NO_CELL:
            return index
        self.unloaded.add(cell_id)
        return -cell_id

    def keys(self) -> dict[int, int]:
        """Return what the table of ids holds: each environment cell, and each block's first land cell."""
        return {
            cell_id if cell_id & 0xFFFF >= FIRST_INDOOR else cell_id - 1: index
            for index, cell_id in enumerate(self.ids)
            if cell_id & 0xFFFF >= FIRST_INDOOR or cell_id & 0xFFFF == 1
        }


def _check_ids(ids: Sequence[int]) -> None:
    seen: set[int] = set()
    for index, cell_id in enumerate(ids):
        if (cell_id & 0xFFFF) < FIRST_INDOOR:
            raise WorldError(f"cell {index}", f"{cell_id:#x} is not the id of an indoor cell")
        if cell_id in seen:
            raise WorldError(f"cell {index}", f"id {cell_id:#010x} is used twice")
        seen.add(cell_id)


def _check_blocks(ids: Sequence[int]) -> None:
    seen: set[int] = set()
    for index, block in enumerate(ids):
        if not (0 <= block >> 8 <= MAX_BLOCK and block & 0xFF <= MAX_BLOCK):
            raise WorldError(f"landblock {index}", f"{block:#x} is not the id of a landblock")
        if block in seen:
            raise WorldError(f"landblock {index}", f"id {block:#06x} is used twice")
        seen.add(block)


class ObjectLists:
    """The objects of each cell: what is listed anywhere, and where.

    Attributes
    ----------
    obstacles : list of Obstacle
        Each once, in order of first mention.
    where : list of str
        That first mention, for error messages.
    cells : list of list of int
        Of each cell the indices of its objects, in order.
    """

    def __init__(self, lists: Iterator[tuple[str, Sequence[Obstacle]]]) -> None:
        self.obstacles: Final[list[Obstacle]] = []
        self.where: Final[list[str]] = []
        self._index: dict[int, int] = {}
        self.cells: Final = [
            [self._number(thing, f"{where}, object {i}") for i, thing in enumerate(things)]
            for where, things in lists
        ]

    def _number(self, thing: Obstacle, where: str) -> int:
        index = self._index.setdefault(id(thing), len(self.obstacles))
        if index == len(self.obstacles):
            self.obstacles.append(thing)
            self.where.append(where)
        return index

    def write(self, storage: Storage) -> Ints:
        """Write the lists; return of each cell where its list begins, and how long it is.

        What has a parent is skipped by retail in every list (09, 3.2), and so is not written.
        """
        lists = [[k for k in cell if not self.obstacles[k].has_parent] for cell in self.cells]
        lengths = np.array([len(listed) for listed in lists], dtype=np.int64)
        first = storage.add_ints([k for listed in lists for k in listed])
        return np.column_stack((first + np.cumsum(lengths) - lengths, lengths))


def write_cells(
    storage: Storage,
    numbers: CellNumbers,
    lists: Ints,
    restrictions: Ints,
    cells: Sequence[Cell],
    blocks: Sequence[LandBlock],
    houses: Mapping[int, int],
) -> dict[int, int]:
    """Write the records of all cells; return what the header says of them.

    `lists`: of each cell its object list; `restrictions`: where of each the record of what restricts it
    begins; `houses`: the building of each land cell that has one.
    """
    names = [f"cell {cell.id:#010x}, pose" for cell in cells]
    indoors = np.empty((len(cells), at.CELL_FLOATS), dtype=np.float64)
    indoors[:, : at.POSITION_SIZE] = position_rows([cell.pose for cell in cells], names)
    indoors[:, at.CELL_ID] = numbers.ids[: len(cells)]
    floats = [indoors, *(cell_positions(block.id) for block in blocks)]
    ints = np.zeros((len(numbers.ids), at.CELL_INTS), dtype=np.int64)
    ints[:, at.CELL_OBJECTS : at.CELL_OBJECT_COUNT + 1] = lists
    ints[:, at.CELL_RESTRICTION] = restrictions
    ints[: len(cells), at.CELL_TREE : at.CELL_RESTRICTION] = np.array(
        [_cell_ints(storage, numbers, cell) for cell in cells], dtype=np.int64
    ).reshape(len(cells), at.CELL_RESTRICTION - at.CELL_TREE)
    ints[len(cells) :, at.LAND_BUILDING] = at.NO_BUILDING
    for index, house in houses.items():
        ints[index, at.LAND_BUILDING] = house
    for k, block in enumerate(blocks):
        first = len(cells) + k * int(at.LAND_CELLS)
        _write_ground(storage, ints[first : first + int(at.LAND_CELLS)], block)
    return {
        int(at.WORLD_CELLS): len(cells),
        int(at.WORLD_ALL_CELLS): len(numbers.ids),
        int(at.WORLD_CELL_FLOATS): storage.add_floats(np.concatenate(floats).ravel()),
        int(at.WORLD_CELL_INTS): storage.add_ints(ints.ravel()),
    }


def _cell_ints(storage: Storage, numbers: CellNumbers, cell: Cell) -> list[int]:
    where = f"cell {cell.id:#010x}"
    portals, count = 0, int(at.NO_PORTALS)
    if cell.portals is not None:
        records = [
            _portal_ints(storage, numbers, portal, f"{where}, portal {i}")
            for i, portal in enumerate(cell.portals)
        ]
        portals, count = storage.add_ints([n for record in records for n in record]), len(records)
    stab = storage.add_ints(cell.stab)
    tree, planes = storage.root_of(cell.shape), storage.planes_of(cell.shape)
    return [tree, *planes, portals, count, stab, len(cell.stab)]


def _portal_ints(storage: Storage, numbers: CellNumbers, given: Portal | int, where: str) -> list[int]:
    portal = given if isinstance(given, Portal) else Portal(given)
    other = int(at.EXTERIOR) if portal.other is None else numbers.behind_portal(portal.other)
    if portal.polygon is not None:
        return [other, portal.side, storage.add_floats(_plane(portal.polygon, where))]
    if other < 0:
        behind = "outside" if portal.other is None else f"to {portal.other:#010x}, which is not in the world"
        raise WorldError(where, f"leads {behind}: its polygon is needed")
    return [other, portal.side, 0]


def _plane(polygon: Sequence[Sequence[float]], where: str) -> Array:
    """Return the plane of a portal's polygon, in the cell's frame."""
    corners = float32_array(polygon, (-1, 3), f"{where}, polygon", WorldError)
    record = np.zeros(at.POLYGON_CORNERS + at.CORNER_SIZE * len(corners), dtype=np.float64)
    record[at.POLYGON_COUNT] = len(corners)
    record[at.POLYGON_CORNERS :].reshape(-1, at.CORNER_SIZE)[:, : at.VECTOR_SIZE] = corners
    polygon_make_plane(record, 0)
    if not np.isfinite(record[: at.PLANE_SIZE]).all():
        raise WorldError(f"{where}, polygon", "has no area, and so no plane")
    return record[: at.PLANE_SIZE]


def _write_ground(storage: Storage, ints: Ints, block: LandBlock) -> None:
    """Write a block's triangles, and into its 64 cells' records where they are and what is water."""
    where = f"landblock {block.id:#06x}"
    first = storage.add_floats(triangles(block.id, block_heights(block.heights, where)).ravel())
    water = water_of(block_terrain(block.terrain, where))
    ints[:, at.LAND_TERRAIN] = first + 2 * at.TERRAIN_POLYGON * np.arange(at.LAND_CELLS)
    ints[:, at.LAND_WATER] = water.cells.ravel()
    ints[:, at.LAND_BLOCK_WATER] = water.block
    ints[:, at.LAND_WET_CORNERS] = water.corners.ravel()


def write_buildings(
    storage: Storage, parts: Parts, numbers: CellNumbers, buildings: Sequence[Building]
) -> tuple[dict[int, int], dict[int, int]]:
    """Write buildings; return what the header says of them, and the building of each cell that has one.

    retail: CLandBlock::init_buildings 0x0052FD80, CSortCell::add_building 0x00534030, 09 3.6-7
    """
    records: list[list[int]] = []
    houses: dict[int, int] = {}
    for index, building in enumerate(buildings):
        where = f"building {index}"
        position = position_row(building.pose, f"{where}, pose")
        adjust_to_outside(position, 0)
        cell = numbers.index(int(position[0]))
        if cell != at.NO_CELL and building.block in (None, int(position[0]) >> 16):
            houses.setdefault(cell, index)
        records.append(_building_ints(storage, parts, numbers, building, where))
    return {int(at.WORLD_BUILDINGS): storage.add_ints([n for record in records for n in record])}, houses


def _building_ints(
    storage: Storage, parts: Parts, numbers: CellNumbers, building: Building, where: str
) -> list[int]:
    part = int(at.NO_PART)
    if building.shape is not None:
        part = parts.add(storage.root_of(building.shape), building.pose, 1.0, where)
    portals = [
        n for portal in building.portals for n in (numbers.behind_portal(portal.other), portal.other_portal)
    ]
    return [part, storage.add_ints(portals), len(building.portals)]
