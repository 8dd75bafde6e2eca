"""Lists of cells, transit and containment (``cells.jsonl``), by the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from conformance.candidates.engine_ops.not_askable import NotAskableError
from conformance.candidates.engine_ops.obstacles import obstacle
from conformance.candidates.engine_ops.rows import query_row
from conformance.candidates.engine_ops.running import run
from conformance.candidates.engine_ops.state_block import normal_or_null
from conformance.candidates.engine_ops.values import vector
from conformance.candidates.engine_ops.worlds import engine_world
from engine import layout as at
from engine.constants import STATE_NAMES
from engine.kernels import cell_list, outside, transit
from engine.kernels.program import MEET
from engine.object_call import Target
from engine.registration import Registrar
from engine.visible import find_visible_child_cell

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from conformance.query import Fields, Query
    from engine.kernels.types import Array
    from engine.world import World


class CellLister:
    """A row of state that lists cells, and the spheres and the position of a query.

    Attributes
    ----------
    world : World
    row : ndarray
        Its list is empty at first.
    home : tuple of float
        Cell id, x and y of the position.
    spheres : tuple of (ndarray, int, int)
        Where the spheres are: array, offset of the first, number.
    """

    def __init__(self, query: Query) -> None:
        inputs = query.inputs
        self.world: Final = engine_world(inputs["world"], query.geometries)
        self.row: Final = self.world.new_row()
        position = inputs["position"]
        x, y, _ = vector(position["origin"])
        self.home: Final = (float(position["cell"]), x, y)
        numbers = np.array(inputs["spheres"], dtype=np.float64)
        self.spheres: Final[tuple[Array, int, int]] = (numbers.ravel(), 0, len(numbers))

    def add(self, cell_id: int) -> None:
        """Put a cell on the list that a call finds there."""
        first, count = int(self.world.ints[at.WORLD_CELL_LIST]), int(self.row[at.NUM_CELLS])
        index = self.world.cell_index(cell_id)
        self.row[first + count] = -cell_id if index == at.NO_CELL else index
        self.row[at.NUM_CELLS] = count + 1

    def listed(self) -> Fields:
        """Write the list: each id, and whether the cell is in the world."""
        first, count = int(self.world.ints[at.WORLD_CELL_LIST]), int(self.row[at.NUM_CELLS])
        entries = [int(entry) for entry in self.row[first : first + count]]
        return {
            "cells": named(self.world, entries),
            "added_outside": int(self.row[at.ADDED_OUTSIDE]),
        }

    def transited(self) -> Fields:
        """Write the list, and whether an environment cell was reached from outside."""
        return self.listed() | {"hits_interior_cell": int(self.row[at.HITS_INTERIOR_CELL])}


def named(world: World, entries: Iterable[int]) -> list[list[int]]:
    """Write the entries of a list of cells: each id, and whether the cell is in the world."""
    return [[world.cell_ids[e], 1] if e >= 0 else [-e, 0] for e in entries]


def index_of(world: World, inputs: Mapping[str, Any]) -> int:
    """Return the index of the cell that a query is about; the world must have it."""
    index = world.cell_index(inputs["cell"])
    if index == at.NO_CELL:
        raise ValueError(f"the world has no cell {inputs['cell']:#010x}")
    return index


def _find_cell_list(query: Query) -> Fields:
    if query.inputs.get("without_path", 0):
        raise NotAskableError("a list of cells that no path asks for")
    lister = CellLister(query)
    lister.row[at.DO_NOT_LOAD_CELLS] = query.inputs.get("do_not_load", 0)
    world = lister.world
    found = cell_list.find_cell_list(
        world.floats, world.ints, lister.row, int(at.NO_CELL), *lister.home, *lister.spheres
    )
    new: int | str | None = None
    if found == cell_list.UNTOUCHED:
        new = "untouched"
    elif found != at.NO_CELL:
        new = world.cell_ids[found]
    return {"new_cell": new, **lister.transited()}


def _find_transit_cells(query: Query) -> Fields:
    lister = CellLister(query)
    for cell_id in query.inputs.get("array", ()):
        lister.add(cell_id)
    world = lister.world
    transit.find_transit_cells(
        world.floats,
        world.ints,
        lister.row,
        index_of(world, query.inputs),
        *lister.home,
        *lister.spheres,
    )
    return lister.transited()


def _check_building_transit(query: Query) -> Fields:
    lister = CellLister(query)
    world, portal = lister.world, int(query.inputs["portal_id"])
    transit.check_building_transit(
        world.floats, world.ints, lister.row, index_of(world, query.inputs), portal, *lister.spheres
    )
    return lister.transited()


def _add_all_outside_cells(query: Query) -> Fields:
    lister = CellLister(query)
    outside.add_all_outside_cells(lister.world.ints, lister.row, *lister.home, *lister.spheres)
    return lister.listed()


def _point_in_cell(query: Query) -> Fields:
    world = engine_world(query.inputs["world"], query.geometries)
    cell, point = index_of(world, query.inputs), vector(query.inputs["point"])
    return {"r": int(cell_list.point_in_cell(world.floats, world.ints, cell, *point))}


def _find_visible_child_cell(query: Query) -> Fields:
    inputs = query.inputs
    world, search_stabs = engine_world(inputs["world"], query.geometries), bool(inputs["search_stabs"])
    return {
        "cell": find_visible_child_cell(world, inputs["cell"], inputs["point"], search_stabs=search_stabs)
    }


def _check_entry_restrictions(query: Query) -> Fields:
    inputs = query.inputs
    if inputs["mover"] is None:
        raise NotAskableError("a transition without a mover")
    world, where = engine_world(inputs["world"], query.geometries), inputs["position"]
    row = query_row({"mover": inputs["mover"], "from": where, "to": where}, index_of(world, inputs))
    row["target_kind"] = Target.ENTRY
    result, _ = run(MEET, world, row)
    return {
        "result": STATE_NAMES[int(result["result"])],
        "collision_normal": normal_or_null(result, "collision_normal"),
    }


def _cross_cells(query: Query) -> Fields:
    inputs = query.inputs
    world = engine_world(inputs["world"], query.geometries)
    block = {**inputs["object"], "sorting_sphere": inputs.get("sorting_sphere")}
    registrar = Registrar(world, [obstacle(block, query.geometries)])
    reached = registrar.cells_reached(0, static=bool(inputs["static"]))
    return {"cells": named(world, reached), "added_outside": int(registrar.added_outside)}


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "find_cell_list": _find_cell_list,
    "find_transit_cells": _find_transit_cells,
    "check_building_transit": _check_building_transit,
    "add_all_outside_cells": _add_all_outside_cells,
    "point_in_cell": _point_in_cell,
    "find_visible_child_cell": _find_visible_child_cell,
    "check_entry_restrictions": _check_entry_restrictions,
    "cross_cells": _cross_cells,
}
"""Operation name to function."""
