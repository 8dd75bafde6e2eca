"""World: cells, landblocks, buildings and obstacles, compiled once into flat arrays."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.cells import CHECK_CELL, CHECK_RESTRICTION
from engine.checks import keyed, optional, record, several
from engine.compiling.balls import write_plates
from engine.compiling.bounds import write_bounds
from engine.compiling.cell_trees import CellTree, cell_trees
from engine.compiling.cells import CellNumbers, ObjectLists, write_buildings, write_cells
from engine.compiling.ids import id_table
from engine.compiling.near import queries_expected_to_pay, with_what_is_near
from engine.compiling.objects import Parts, write_objects
from engine.compiling.restrictions import write_restrictions
from engine.compiling.slopes import write_slopes
from engine.compiling.storage import Storage
from engine.compiling.terrain import DETAILS, SIDE
from engine.errors import WorldError
from engine.landscape import CHECK_BLOCK, CHECK_BUILDING
from engine.memory import aligned
from engine.objects import CHECK_OBSTACLE
from engine.plan import NO_PLAN, Plan, Stage
from engine.shadows import register

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from engine.cells import Cell, Restriction
    from engine.geometry import Shape
    from engine.kernels.types import Array, Ints
    from engine.landscape import Building, LandBlock
    from engine.objects import Obstacle

_MAX_OUTSIDE: Final = 9 * 10
"""Most land cells that are listed at once: nine about each of the ten balls of an object (09, 5.4)."""

_LOOKING_UP: Final = Stage.FLIGHT | Stage.WALKS
"""Shortcuts that look up what is near."""

_CHECKS: Final = {
    "cells": several(CHECK_CELL),
    "landblocks": several(CHECK_BLOCK),
    "buildings": several(CHECK_BUILDING),
    "shadows": optional(keyed(several(CHECK_OBSTACLE))),
    "objects": several(CHECK_OBSTACLE),
    "restrictions": optional(keyed(CHECK_RESTRICTION)),
}
"""What a world is given, in the order of its parameters."""


class World:
    """What movers collide with; built once, read by any number of queries.

    Parameters
    ----------
    cells : sequence of Cell
        Environment cells with different ids.
    landblocks : sequence of LandBlock
        With different ids. Without cells and landblocks the world is empty, and nobody can be in it.
    buildings : sequence of Building
    shadows : mapping of int to sequences of Obstacle, optional
        The objects in a cell, environment or land, by its id; they follow those of `Cell.objects`. An
        obstacle that reaches into several cells is listed in each.
    objects : sequence of Obstacle, optional
        What is not listed yet, in the order in which it enters the world: it is registered in the cells
        that it reaches, as retail does (`engine.shadows`), after all that is listed.
    restrictions : mapping of int to Restriction, optional
        Who may enter a cell, environment or land, by its id; the others are open to everyone.

    Attributes
    ----------
    cell_ids : tuple of int
        A cell's index here is its index in the engine: environment cells as given, then the 64 land
        cells of each block.
    objects : tuple of Obstacle
        Each once, in order of first mention; its index here is its index in the engine.
    shapes : tuple of Shape
        Every geometry once, in order of first use.

    Raises
    ------
    WorldError, PoseError
        Naming the cell, block, building or object, and what is wrong with it.
    """

    def __init__(
        self,
        cells: Sequence[Cell] = (),
        landblocks: Sequence[LandBlock] = (),
        buildings: Sequence[Building] = (),
        shadows: Mapping[int, Sequence[Obstacle]] | None = None,
        objects: Sequence[Obstacle] = (),
        restrictions: Mapping[int, Restriction] | None = None,
    ) -> None:
        for given, (name, check) in zip(
            (cells, landblocks, buildings, shadows, objects, restrictions), _CHECKS.items(), strict=True
        ):
            check(given, name, WorldError)
        blocks = _in_full_detail(landblocks)
        numbers = CellNumbers(cells, blocks)
        found = register(World(cells, landblocks, buildings), objects) if objects else {}
        lists = ObjectLists(_object_lists(numbers, cells, shadows or {}, found))
        self.cell_ids: Final = numbers.ids
        self.objects: Final = tuple(lists.obstacles)
        self.shapes: Final = tuple(_unique_shapes(cells, buildings, lists.obstacles))
        self._numbers: Final = numbers
        storage, parts = Storage(self.shapes), Parts()
        header, houses = write_buildings(storage, parts, numbers, buildings)
        header |= write_objects(storage, parts, lists.obstacles, lists.where)
        header |= parts.write(storage)
        restricted = write_restrictions(storage, numbers, restrictions or {})
        listed = lists.write(storage)
        header |= write_cells(storage, numbers, listed, restricted, cells, blocks, houses)
        header |= _write_ids(storage, numbers.keys())
        header[int(at.WORLD_OBJECTS)] = self.num_objects
        header |= self._rows(len(cells) + len(numbers.unloaded))
        counts = len(lists.obstacles), len(buildings)
        header |= write_bounds(storage, header, cells, numbers.ids, listed, counts)
        header |= write_plates(storage, header)
        header[int(at.WORLD_CLEARANCES)] = storage.add_ints([int(at.NO_CLEARANCE)] * len(cells))
        self._arrays = storage.finish(header)
        roots = {storage.root_of(shape): shape for shape in self.shapes}
        write_slopes(*self._arrays, roots, len(parts))
        self._polygons: Final = storage.polygons
        self._spare_rows: Final[list[Array]] = []
        # In a list, from which one thread takes it.
        self._unprepared: Final[list[list[CellTree]]] = [cell_trees(storage, cells)]
        self._asked = 0
        self._enough = queries_expected_to_pay(self._unprepared[0])

    @property
    def arrays(self) -> tuple[Array, Ints]:
        """The compiled arrays (`engine.layout`), floats and integers. Not to be changed.

        `prepare` replaces both: who needs both takes them at once, and may go on with them.
        """
        return self._arrays

    @property
    def floats(self) -> Array:
        """The first of `arrays`."""
        return self._arrays[0]

    @property
    def ints(self) -> Ints:
        """The second of `arrays`."""
        return self._arrays[1]

    @property
    def num_objects(self) -> int:
        """Number of obstacles."""
        return len(self.objects)

    def cell_index(self, cell_id: int) -> int:
        """Return a cell's index, or `NO_CELL` (-1) for the id of none."""
        return self._numbers.index(cell_id)

    def tree_of(self, cell: int) -> int:
        """Return the root node of an environment cell's tree; `NO_TREE` (0) if it has none."""
        if cell >= self.ints[at.WORLD_CELLS]:
            return int(at.NO_TREE)
        return int(self._ints_of(cell)[at.CELL_TREE])

    def objects_of(self, cell: int) -> tuple[int, ...]:
        """Return the indices of the obstacles that are tested in a cell, in order."""
        first, count = self._ints_of(cell)[at.CELL_OBJECTS : at.CELL_OBJECT_COUNT + 1]
        return tuple(int(thing) for thing in self.ints[first : first + count])

    def has_parts(self, thing: int) -> bool:
        """Say whether an obstacle, by its index, is collided with by its parts, and has any."""
        ints = self.ints[self.ints[at.WORLD_OBJECT_INTS] + at.OBJECT_INTS * thing :]
        return bool(ints[at.OBJECT_FAMILY] == at.FAMILY_PARTS and ints[at.OBJECT_COUNT] > 0)

    def shape_count(self, thing: int) -> int:
        """Return how many shapes an obstacle, by its index, is collided with by."""
        ints = self.ints[self.ints[at.WORLD_OBJECT_INTS] + at.OBJECT_INTS * thing :]
        return int(ints[at.OBJECT_COUNT])

    def polygon(self, shape: int, polygon: int) -> int:
        """Return where the record of a shape's polygon begins in `floats`."""
        return self._polygons[shape] + int(self.shapes[shape].polygon_offsets[polygon])

    def prepare(self) -> None:
        """Make what shortcuts look up instead of walking for it, ahead of the queries that it is made for.

        A world does so by itself, once, when enough has been asked of it (`engine.compiling.near`), and the
        call that asks for it then waits. Of a world of which little is asked, it is never made. It changes no
        answer, and takes 0.13 to 0.3 milliseconds for each polygon of environment cells.

        If another thread is at it, nothing is done: what is asked meanwhile is answered without.
        """
        try:
            trees = self._unprepared.pop()
        except IndexError:
            return
        enough, self._enough = self._enough, math.inf
        try:
            self._arrays = with_what_is_near(*self._arrays, trees)
        except BaseException:
            self._enough = enough
            self._unprepared.append(trees)
            raise

    def arrays_for(self, count: int, plan: Plan) -> tuple[Array, Ints]:
        """Return `arrays` for so many more queries; it is prepared before, if they are enough by now."""
        self._asked += count
        if self._asked >= self._enough and plan.skip & _LOOKING_UP:
            self.prepare()
        return self._arrays

    def new_row(self, trace_capacity: int = 0, plan: Plan = NO_PLAN) -> Array:
        """Return a row of state for queries in this world, with room for a trace.

        With a trace no shortcut is taken: it tells of every call of a tree that retail makes. The lists
        behind the state are not cleared: each has a count, and nothing beyond it is read.
        """
        row: Array = aligned(int(self.ints[at.WORLD_ROW]) + trace_capacity, np.float64)
        row[: at.STATE_SIZE] = 0.0
        row[at.TRACE_CAPACITY] = trace_capacity
        row[at.PLAN] = 0 if trace_capacity else plan.skip
        return row

    def take_row(self, plan: Plan = NO_PLAN) -> Array:
        """Return a row of state as `new_row` does, one that was given back if there is any.

        To make one takes as long as dozens of queries. A row has one user at a time: it is on the list or
        taken from it, and the list lets no two threads take the same.
        """
        try:
            row = self._spare_rows.pop()
        except IndexError:
            return self.new_row(plan=plan)
        row[: at.STATE_SIZE] = 0.0
        row[at.PLAN] = plan.skip
        return row

    def give_back(self, row: Array) -> None:
        """Keep a row that nobody uses any more for whoever needs the next, in whatever thread."""
        self._spare_rows.append(row)

    def touched(self, row: Array) -> list[int]:
        """Return the indices of the obstacles that a query's row says were touched, in order."""
        first = int(self.ints[at.WORLD_TOUCHED])
        return [int(thing) for thing in row[first : first + int(row[at.NUM_COLLIDE_OBJECT])]]

    def _ints_of(self, cell: int) -> Ints:
        return self.ints[self.ints[at.WORLD_CELL_INTS] + at.CELL_INTS * cell :]

    def _rows(self, num_listed: int) -> dict[int, int]:
        """Say where in a row the stack and the lists lie.

        A traversal leaves at most one node on the stack for each level of the tree; every cell and
        every object is listed at most once, and of the land only what is about the mover.
        """
        depth = max((shape.depth for shape in self.shapes), default=0)
        cell_list = int(at.STATE_SIZE) + depth
        touched = cell_list + num_listed + _MAX_OUTSIDE
        return {
            int(at.WORLD_STACK): int(at.STATE_SIZE),
            int(at.WORLD_CELL_LIST): cell_list,
            int(at.WORLD_TOUCHED): touched,
            int(at.WORLD_ROW): touched + self.num_objects,
        }

    def __repr__(self) -> str:
        return f"<World: {len(self.cell_ids)} cells, {self.num_objects} objects, {len(self.shapes)} shapes>"


def _in_full_detail(blocks: Sequence[LandBlock]) -> list[LandBlock]:
    """Return the blocks that are not as if they were not loaded.

    retail: LScape::get_landblock 0x00505E40, 10 3 and 4.1
    """
    for block in blocks:
        if block.side_cell_count not in DETAILS:
            where = f"landblock {block.id:#06x}, side_cell_count"
            raise WorldError(where, f"{block.side_cell_count} is none of {DETAILS}")
    return [block for block in blocks if block.side_cell_count == SIDE]


def _write_ids(storage: Storage, keys: Mapping[int, int]) -> dict[int, int]:
    table = id_table(keys)
    return {int(at.WORLD_IDS): storage.add_ints(table), int(at.WORLD_IDS_MASK): len(table) // 2 - 1}


def _object_lists(
    numbers: CellNumbers,
    cells: Sequence[Cell],
    shadows: Mapping[int, Sequence[Obstacle]],
    found: Mapping[int, Sequence[Obstacle]],
) -> Iterator[tuple[str, Sequence[Obstacle]]]:
    """Yield the name of each cell, and what is in it."""
    for cell_id in shadows:
        if numbers.index(cell_id) == at.NO_CELL:
            raise WorldError(f"shadows, {cell_id:#010x}", "is not a cell of the world")
    for index, cell_id in enumerate(numbers.ids):
        own = cells[index].objects if index < len(cells) else ()
        yield f"cell {cell_id:#010x}", (*own, *shadows.get(cell_id, ()), *found.get(cell_id, ()))


def _unique_shapes(
    cells: Sequence[Cell], buildings: Sequence[Building], obstacles: Sequence[Obstacle]
) -> Iterator[Shape]:
    """Yield every geometry that may be collided with once, in order of first mention."""
    seen: set[int] = set()
    mentioned = (
        *(cell.shape for cell in cells),
        *(building.shape for building in buildings),
        *(part.shape for thing in obstacles for part in thing.parts if part.has_physics),
    )
    for shape in mentioned:
        if shape is not None and id(shape) not in seen:
            seen.add(id(shape))
            yield shape


CHECK_WORLD: Final = record(World)
"""What every question asks first of the world that it is about."""
