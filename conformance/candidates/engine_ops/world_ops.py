"""Whole transitions in worlds (``world_transition.jsonl``), by the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.engine_ops.rows import query_row
from conformance.candidates.engine_ops.running import run_noting
from conformance.candidates.engine_ops.state_block import object_block, state_block, walkable_geometry
from conformance.candidates.engine_ops.worlds import engine_world
from engine.kernels.program import RESOLVE

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query


def _world_transition(query: Query) -> Fields:
    """One `find_valid_position` call; the mover begins in the cell that its position names."""
    inputs = query.inputs
    world = engine_world(inputs["world"], query.geometries)
    begin = inputs["to"] if inputs["from"] is None else inputs["from"]
    row = query_row(inputs, world.cell_index(begin["cell"]))
    result, trace, touched = run_noting(RESOLVE, world, row)
    outcome: Fields = {"result": int(result["result"]), "trace": trace, **state_block(result, world)}
    geometry = walkable_geometry(result, world)
    if geometry is not None:
        outcome["walkable_geometry"] = geometry
    return outcome | object_block(result, touched, world)


OPS: Final[dict[str, Callable[[Query], Fields]]] = {"world_transition": _world_transition}
"""Operation name to function."""
