"""Single moves in a world (``world_transition.jsonl``), by the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_ops.blocks import take_mover, take_seed
from conformance.candidates.oracle_ops.state_block import geometry_of, touched_block, traced_state
from conformance.candidates.oracle_ops.values import position
from conformance.candidates.oracle_ops.world import oracle_world
from oracle.enums import InsertType
from oracle.transition import Transition

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query


def _world_transition(query: Query) -> Fields:
    """One `find_valid_position` call."""
    made = _ready(query)
    return _found(query, made, made.find_valid_position())


def _find_transitional_position(query: Query) -> Fields:
    """One `find_transitional_position` call, also with an insert type that retail sends elsewhere."""
    made = _ready(query)
    made.sphere_path.insert_type = InsertType(query.inputs["insert_type"])
    return _found(query, made, made.find_transitional_position())


def _ready(query: Query) -> Transition:
    inputs = query.inputs
    world = oracle_world(inputs["world"], query.geometries)
    end = position(inputs["to"])
    begin = None if inputs["from"] is None else position(inputs["from"])
    first = end if begin is None else begin
    made = Transition(world, trace=[])
    take_mover(made, inputs["mover"], first)
    take_seed(made, inputs["seed"])
    made.sphere_path.placement_allows_sliding = inputs.get("placement_allows_sliding", 1)
    made.init_path(world.get_visible(first.objcell_id), begin, end)
    return made


def _found(query: Query, made: Transition, result: int) -> Fields:
    outcome: Fields = {"result": result, **traced_state(made), **touched_block(made)}
    walkable = made.sphere_path.walkable
    if walkable is not None:
        outcome["walkable_geometry"] = geometry_of(walkable, query.geometries.values())
    return outcome


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "world_transition": _world_transition,
    "find_transitional_position": _find_transitional_position,
}
"""Operation name to function."""
