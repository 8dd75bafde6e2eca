"""Lists of cells, transit, containment and registration (``cells.jsonl``), by the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_ops.blocks import take_mover
from conformance.candidates.oracle_ops.objects import physics_object
from conformance.candidates.oracle_ops.state_block import valid_normal
from conformance.candidates.oracle_ops.values import position, sphere, vector
from conformance.candidates.oracle_ops.world import build_world, oracle_world
from oracle.cell_array import CellArray
from oracle.cell_list import find_cell_list
from oracle.ref import Ref
from oracle.sphere_path import SpherePath
from oracle.transition import Transition

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from oracle.obj_cell import ObjCell
    from oracle.world import World


def listed(array: CellArray) -> Fields:
    """Write a list of cells: each id, and whether the cell is loaded."""
    return {
        "cells": [[entry.cell_id, int(entry.cell is not None)] for entry in array.cells],
        "added_outside": array.added_outside,
    }


def _find_cell_list(query: Query) -> Fields:
    inputs, array, path = query.inputs, CellArray(), SpherePath()
    array.do_not_load_cells = inputs.get("do_not_load", 0)
    without_path = inputs.get("without_path", 0)
    spheres = [sphere(values) for values in inputs["spheres"]]
    found: Ref[ObjCell | str | None] = Ref("untouched")
    find_cell_list(
        oracle_world(inputs["world"], query.geometries),
        position(inputs["position"]),
        len(spheres),
        spheres,
        array,
        found,  # type: ignore[arg-type] # the mark of a pointer that is not written
        None if without_path else path,
    )
    new = found.value
    fields: Fields = {"new_cell": new if new is None or isinstance(new, str) else new.id}
    return fields | listed(array) | {"hits_interior_cell": path.hits_interior_cell}


def _find_transit_cells(query: Query) -> Fields:
    inputs, array, path = query.inputs, CellArray(), SpherePath()
    world = oracle_world(inputs["world"], query.geometries)
    for cell_id in inputs.get("array", ()):
        array.add_cell(cell_id, world.get_visible(cell_id))
    spheres = [sphere(values) for values in inputs["spheres"]]
    cell = _loaded(world, inputs["cell"])
    cell.find_transit_cells(position(inputs["position"]), len(spheres), spheres, array, path)
    return listed(array) | {"hits_interior_cell": path.hits_interior_cell}


def _check_building_transit(query: Query) -> Fields:
    inputs, array, path = query.inputs, CellArray(), SpherePath()
    spheres = [sphere(values) for values in inputs["spheres"]]
    cell = oracle_world(inputs["world"], query.geometries).cells[inputs["cell"]]
    p = position(inputs["position"])
    cell.check_building_transit(inputs["portal_id"], p, len(spheres), spheres, array, path)
    return listed(array) | {"hits_interior_cell": path.hits_interior_cell}


def _point_in_cell(query: Query) -> Fields:
    cell = _loaded(oracle_world(query.inputs["world"], query.geometries), query.inputs["cell"])
    return {"r": cell.point_in_cell(vector(query.inputs["point"]))}


def _find_visible_child_cell(query: Query) -> Fields:
    inputs = query.inputs
    cell = oracle_world(inputs["world"], query.geometries).cells[inputs["cell"]]
    point = vector(inputs["point"])
    found = cell.find_visible_child_cell(point, search_stabs=bool(inputs["search_stabs"]))
    return {"cell": None if found is None else found.id}


def _check_entry_restrictions(query: Query) -> Fields:
    """Ask a cell whether a mover may enter; null asks for nobody."""
    inputs = query.inputs
    world = oracle_world(inputs["world"], query.geometries)
    made, where = Transition(world), position(inputs["position"])
    if inputs["mover"] is not None:
        take_mover(made, inputs["mover"], where)
    made.sphere_path.curr_pos.assign(where)
    result = _loaded(world, inputs["cell"]).check_entry_restrictions(made)
    ci = made.collision_info
    return {
        "result": result.name,
        "collision_normal": valid_normal(ci.collision_normal_valid, ci.collision_normal),
    }


def _cross_cells(query: Query) -> Fields:
    """Register an object, which changes the world: it is not a shared one."""
    inputs = query.inputs
    world = build_world(inputs["world"], query.geometries)
    block = {**inputs["object"], "sorting_sphere": inputs.get("sorting_sphere")}
    thing = physics_object(block, query.geometries, world)
    thing.cell = world.get_visible(thing.m_position.objcell_id)
    return listed(thing.calc_cross_cells_static() if inputs["static"] else thing.calc_cross_cells())


def _loaded(world: World, cell_id: int) -> ObjCell:
    cell = world.get_visible(cell_id)
    if cell is None:
        raise ValueError(f"the world has no cell {cell_id:#010x}")
    return cell


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "find_cell_list": _find_cell_list,
    "find_transit_cells": _find_transit_cells,
    "check_building_transit": _check_building_transit,
    "point_in_cell": _point_in_cell,
    "find_visible_child_cell": _find_visible_child_cell,
    "check_entry_restrictions": _check_entry_restrictions,
    "cross_cells": _cross_cells,
}
"""Operation name to function."""
