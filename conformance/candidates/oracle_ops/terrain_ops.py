"""Landblock arithmetic, terrain and land cells (``terrain.jsonl``), by the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_ops.blocks import at_check_pos, take_path, take_seed
from conformance.candidates.oracle_ops.cell_ops import listed
from conformance.candidates.oracle_ops.state_block import traced_state
from conformance.candidates.oracle_ops.values import nxyzd, plane, position, sphere, vector, xyz
from conformance.candidates.oracle_ops.world import land_block, oracle_world
from oracle import land_defs
from oracle.arithmetic import f32
from oracle.cell_array import CellArray
from oracle.land_block_struct import cuts_sw_to_ne
from oracle.outside_cells import add_all_outside_cells
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from oracle.land_cell import LandCell
    from oracle.transition import Transition


def _gid_to_lcoord(query: Query) -> Fields:
    return _found(*land_defs.gid_to_lcoord(query.inputs["cell"]))


def _get_outside_lcoord(query: Query) -> Fields:
    point = vector(query.inputs["point"])
    return _found(*land_defs.get_outside_lcoord(query.inputs["cell"], point))


def _found(r: int, x: int, y: int) -> Fields:
    return {"r": r, "x": x, "y": y} if r else {"r": r}


def _blockid_to_lcoord(query: Query) -> Fields:
    cell_id = query.inputs["cell"]
    r, x, y = land_defs.blockid_to_lcoord(cell_id)
    return {"r": r, "x": x, "y": y} if cell_id else {"r": r}


def _inbound_valid_cellid(query: Query) -> Fields:
    return {"r": int(land_defs.inbound_valid_cellid(query.inputs["cell"]))}


def _lcoord_to_gid(query: Query) -> Fields:
    return {"id": land_defs.lcoord_to_gid(query.inputs["x"], query.inputs["y"])}


def _adjust_to_outside(query: Query) -> Fields:
    point = vector(query.inputs["point"])
    r, cell_id = land_defs.adjust_to_outside(query.inputs["cell"], point)
    return {"r": r, "cell": cell_id, "point": xyz(point)}


def _get_block_offset(query: Query) -> Fields:
    return {"v": xyz(land_defs.get_block_offset(query.inputs["from_cell"], query.inputs["to_cell"]))}


def _within_block(query: Query) -> Fields:
    point, radius = vector(query.inputs["point"]), f32(query.inputs["radius"])
    return {"r": int(land_defs.within_block(point, radius))}


def _set_height_table(query: Query) -> Fields:
    """Fill a table that is not filled yet; what is answered is how far it was."""
    untaken = -1.0
    table = [untaken] * land_defs.HEIGHT_TABLE_SIZE
    r = land_defs.set_height_table(table, [f32(z) for z in query.inputs["values"]])
    return {"r": r, "table": [z for z in table if z != untaken]}


def _terrain_split(query: Query) -> Fields:
    x, y = query.inputs["block"] >> 8, query.inputs["block"] & 0xFF
    side = range(land_defs.SIDE_CELLS)
    cuts = [
        cuts_sw_to_ne(land_defs.SIDE_CELLS * x + i, land_defs.SIDE_CELLS * y + j) for i in side for j in side
    ]
    return {"cuts": "".join(str(int(cut)) for cut in cuts)}


def _terrain_block(query: Query) -> Fields:
    block = land_block(query.inputs, World())
    if "heights_again" in query.inputs:
        block.land_height_table = [f32(z) for z in query.inputs["heights_again"]]
        block.generate()
    cells = [
        {
            "id": cell.id,
            "sw_ne": cell.sw_to_ne_cut,
            "water": int(cell.water_type),
            "origin": xyz(cell.pos.frame.origin),
            "planes": [nxyzd(polygon.plane) for polygon in cell.polygons],
        }
        for cell in block.cells
    ]
    return {"water_type": int(block.water_type), "cells": cells}


def _land_cell(query: Query) -> LandCell:
    """Return the land cell of a query; its world must have it."""
    inputs = query.inputs
    cell = oracle_world(inputs["world"], query.geometries).landscape.get_landcell(inputs["cell"])
    if cell is None:
        raise ValueError(f"the world has no land cell {inputs['cell']:#010x}")
    return cell


def _find_terrain_poly(query: Query) -> Fields:
    cell, point = _land_cell(query), vector(query.inputs["point"])
    polygon = cell.find_terrain_poly(point)
    return {
        "r": int(polygon is not None),
        "poly": None if polygon is None else cell.polygons.index(polygon),
        "water_depth": f32(cell.get_water_depth(point)),
    }


def _in_land_cell(query: Query, cell: LandCell) -> Transition:
    """Make a transition whose cell is a land cell."""
    made = at_check_pos(query.inputs, cell.world, cell, trace_to=[])
    take_seed(made, query.inputs["seed"])
    take_path(made, query.inputs["path"])
    return made


def _find_env_collisions(query: Query) -> Fields:
    cell = _land_cell(query)
    made = _in_land_cell(query, cell)
    result = cell.find_env_collisions(made)
    return {"result": result.name, **traced_state(made)}


def _validate_walkable(query: Query) -> Fields:
    inputs, cell = query.inputs, _land_cell(query)
    made = _in_land_cell(query, cell)
    result = made.object_info.validate_walkable(
        sphere(inputs["sphere"]),
        plane(inputs["plane"]),
        inputs["is_water"],
        f32(inputs["water_depth"]),
        made.sphere_path,
        made.collision_info,
        cell.id,
    )
    return {"result": result.name, **traced_state(made)}


def _add_all_outside_cells(query: Query) -> Fields:
    inputs, array = query.inputs, CellArray()
    world = oracle_world(inputs["world"], query.geometries)
    spheres = [sphere(values) for values in inputs["spheres"]]
    add_all_outside_cells(world, position(inputs["position"]), len(spheres), spheres, array)
    return listed(array)


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "landdefs_gid_to_lcoord": _gid_to_lcoord,
    "landdefs_blockid_to_lcoord": _blockid_to_lcoord,
    "landdefs_inbound_valid_cellid": _inbound_valid_cellid,
    "landdefs_lcoord_to_gid": _lcoord_to_gid,
    "landdefs_get_outside_lcoord": _get_outside_lcoord,
    "landdefs_adjust_to_outside": _adjust_to_outside,
    "landdefs_get_block_offset": _get_block_offset,
    "landdefs_within_block": _within_block,
    "landdefs_set_height_table": _set_height_table,
    "terrain_split": _terrain_split,
    "terrain_block": _terrain_block,
    "land_find_terrain_poly": _find_terrain_poly,
    "land_find_env_collisions": _find_env_collisions,
    "land_validate_walkable": _validate_walkable,
    "add_all_outside_cells": _add_all_outside_cells,
}
"""Operation name to function."""
