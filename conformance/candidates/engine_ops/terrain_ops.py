"""Landblock arithmetic, terrain and land cells (``terrain.jsonl``), by the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from conformance.candidates.engine_ops.cell_ops import index_of
from conformance.candidates.engine_ops.rows import numbers_of, query_row, take_path
from conformance.candidates.engine_ops.running import TRACE_CAPACITY
from conformance.candidates.engine_ops.state_block import state_block, trace_text
from conformance.candidates.engine_ops.values import ball, floats, numbers, vector
from conformance.candidates.engine_ops.worlds import engine_world
from engine import layout as at
from engine.compiling import terrain
from engine.constants import STATE_NAMES
from engine.kernels import land_cells, land_defs, object_info, position
from engine.kernels.query import go_to_end, prepare, report, set_path_fields
from engine.tracing import runnable

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query


def _gid_to_lcoord(query: Query) -> Fields:
    return _found(*land_defs.gid_to_lcoord(query.inputs["cell"]))


def _get_outside_lcoord(query: Query) -> Fields:
    x, y, _ = vector(query.inputs["point"])
    return _found(*land_defs.get_outside_lcoord(query.inputs["cell"], x, y))


def _found(found: bool, x: int, y: int) -> Fields:
    return {"r": 1, "x": int(x), "y": int(y)} if found else {"r": 0}


def _blockid_to_lcoord(query: Query) -> Fields:
    cell_id = query.inputs["cell"]
    if cell_id == 0:
        return {"r": 0}
    x, y = land_defs.block_coordinates(cell_id)
    return {"r": int(land_defs.in_bounds(x, y)), "x": int(x), "y": int(y)}


def _inbound_valid_cellid(query: Query) -> Fields:
    return {"r": int(land_defs.inbound_valid_cellid(query.inputs["cell"]))}


def _lcoord_to_gid(query: Query) -> Fields:
    return {"id": int(land_defs.lcoord_to_gid(query.inputs["x"], query.inputs["y"]))}


def _adjust_to_outside(query: Query) -> Fields:
    x, y, z = vector(query.inputs["point"])
    cell_id, x, y = land_defs.outside_cell(query.inputs["cell"], x, y)
    return {"r": int(cell_id != 0), "cell": int(cell_id), "point": [x, y, z]}


def _get_block_offset(query: Query) -> Fields:
    from_cell, to_cell = query.inputs["from_cell"], query.inputs["to_cell"]
    return {"v": [*position.block_offset(float(from_cell), float(to_cell)), 0.0]}


def _terrain_split(query: Query) -> Fields:
    cuts = terrain.split_cuts(query.inputs["block"])
    return {"cuts": "".join(str(int(cut)) for cut in cuts.ravel())}


def _terrain_block(query: Query) -> Fields:
    inputs = query.inputs
    block = inputs["block"]
    heights = terrain.block_heights(inputs.get("heights_again", inputs["heights"]), "block")
    triangles = terrain.triangles(block, heights).reshape(int(at.LAND_CELLS), 2, -1)
    # A block of less detail is dry, whatever its corners are (10 6.3).
    detailed = inputs.get("side_cell_count", terrain.SIDE) == terrain.SIDE
    water = terrain.water_of(terrain.block_terrain(inputs.get("terrain") if detailed else None, "block"))
    cuts, kinds = terrain.split_cuts(block).ravel(), water.cells.ravel()
    cells = [
        {
            "id": int(cell[at.CELL_ID]),
            "sw_ne": int(cuts[k]),
            "water": int(kinds[k]),
            "origin": floats(cell[at.ORIGIN : at.ORIGIN + at.VECTOR_SIZE]),
            "planes": [floats(polygon[: at.PLANE_SIZE]) for polygon in triangles[k]],
        }
        for k, cell in enumerate(terrain.cell_positions(block))
    ]
    return {"water_type": water.block, "cells": cells}


def _find_terrain_poly(query: Query) -> Fields:
    world = engine_world(query.inputs["world"], query.geometries)
    cell, (x, y, _) = index_of(world, query.inputs), vector(query.inputs["point"])
    found = land_cells.find_terrain_poly(world.floats, world.ints, cell, x, y)
    return {
        "r": int(found != at.NO_POLYGON),
        "poly": None if found == at.NO_POLYGON else int(world.floats[found + at.POLYGON_ID]),
        "water_depth": float(land_cells.water_depth(world.floats, world.ints, cell, x, y)),
    }


class _LandCall:
    """A row of state in a land cell, ready for one call with the path state given."""

    def __init__(self, query: Query) -> None:
        inputs = query.inputs
        self.world: Final = engine_world(inputs["world"], query.geometries)
        self.cell: Final = index_of(self.world, inputs)
        self.row: Final = self.world.new_row(trace_capacity=TRACE_CAPACITY)
        given = query_row(inputs, begin_cell=self.cell)
        take_path(given, inputs["path"])
        numbers = numbers_of(given)
        runnable(prepare)(self.row, numbers)
        runnable(go_to_end)(self.row, numbers, float(self.cell))
        runnable(set_path_fields)(self.row, numbers)

    def outcome(self, ts: int) -> Fields:
        """Write what the call has answered, and the state that it left."""
        result = np.zeros(1, dtype=at.RESULT_DTYPE)
        report(self.world.floats, self.row, result.view(np.float64), ts)
        trace = trace_text(self.row, self.world.ints)
        return {"result": STATE_NAMES[ts], "trace": trace, **state_block(result[0], self.world)}


def _find_env_collisions(query: Query) -> Fields:
    call = _LandCall(query)
    world = call.world
    test = runnable(land_cells.find_terrain_collisions)
    return call.outcome(test(world.floats, world.ints, call.row, call.cell))


def _validate_walkable(query: Query) -> Fields:
    inputs, call = query.inputs, _LandCall(query)
    plane, (x, y, z, r) = numbers(inputs["plane"]), ball(inputs["sphere"])
    is_water, depth, cell = float(inputs["is_water"]), float(inputs["water_depth"]), float(inputs["cell"])
    test = runnable(object_info.validate_walkable)
    return call.outcome(test(call.row, x, y, z, r, plane, 0, is_water, depth, cell))


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "landdefs_gid_to_lcoord": _gid_to_lcoord,
    "landdefs_blockid_to_lcoord": _blockid_to_lcoord,
    "landdefs_inbound_valid_cellid": _inbound_valid_cellid,
    "landdefs_lcoord_to_gid": _lcoord_to_gid,
    "landdefs_get_outside_lcoord": _get_outside_lcoord,
    "landdefs_adjust_to_outside": _adjust_to_outside,
    "landdefs_get_block_offset": _get_block_offset,
    "terrain_split": _terrain_split,
    "terrain_block": _terrain_block,
    "land_find_terrain_poly": _find_terrain_poly,
    "land_find_env_collisions": _find_env_collisions,
    "land_validate_walkable": _validate_walkable,
}
"""Operation name to function."""
