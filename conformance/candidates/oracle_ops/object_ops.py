"""Spheres, cylinders and whole objects in a mover's way, by the oracle.

The operations of ``sphere.jsonl``, ``cylsphere.jsonl`` and ``objects.jsonl``. Their world is one cell that
contains every point; the objects are its shadow list.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.oracle_ops.blocks import at_check_pos, take_mover, take_path, take_seed
from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.candidates.oracle_ops.objects import physics_object
from conformance.candidates.oracle_ops.state_block import geometry_of, state_block, touched_block
from conformance.candidates.oracle_ops.values import position, vector
from oracle.arithmetic import f32
from oracle.env_cell import CellStruct, EnvCell
from oracle.sphere_obstacle import find_time_of_collision
from oracle.transition import Transition
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query
    from oracle.enums import TransitionState
    from oracle.physics_object import PhysicsObj
    from oracle.physics_part import PartArray


def _find_time_of_collision(query: Query) -> Fields:
    inputs = query.inputs
    movement, disp = vector(inputs["movement"]), vector(inputs["disp"])
    return {"t": find_time_of_collision(movement, disp, f32(inputs["radsum"]))}


def _object_call(query: Query) -> Fields:
    inputs = query.inputs
    cell = _only_cell(query)
    made = at_check_pos(inputs, cell.world, cell, trace_to=[])
    take_path(made, inputs["path"])
    result = FUNCTIONS[inputs["function"]](cell, made, inputs)
    return {"result": result.name, **_written(made, query)}


def _object_transition(query: Query) -> Fields:
    inputs = query.inputs
    cell = _only_cell(query)
    end = position(inputs["to"])
    begin = None if inputs["from"] is None else position(inputs["from"])
    made = Transition(cell.world, trace=[])
    take_mover(made, inputs["mover"], end if begin is None else begin)
    take_seed(made, inputs["seed"])
    made.sphere_path.placement_allows_sliding = inputs.get("placement_allows_sliding", 1)
    made.init_path(cell, begin, end)
    return {"result": made.find_valid_position(), **_written(made, query)}


def _check_collisions(query: Query) -> Fields:
    """`CTransition::check_collisions` with the first object."""
    cell = _only_cell(query)
    here = position(query.inputs["from"])
    made = Transition(cell.world)
    take_mover(made, query.inputs["mover"], here)
    made.init_path(cell, here, here)
    return {"r": made.check_collisions(cell.shadow_object_list[0])}


def _only_cell(query: Query) -> EnvCell:
    """Make the world of a query and return its cell."""
    block, world = query.inputs["cell"], World()
    bsp = None
    if block["geometry"] is not None:
        bsp = oracle_geometry(query.geometries[block["geometry"]]).tree
    # without a cell BSP a cell contains every point, whatever the geometry's own
    cell = EnvCell(block["id"], position(block["pose"]), CellStruct(bsp, None), world, portals=())
    cell.shadow_object_list = [
        physics_object(item, query.geometries, world) for item in query.inputs["objects"]
    ]
    world.add_cell(cell)
    return cell


def _sphere(cell: EnvCell, made: Transition, inputs: Mapping[str, Any]) -> TransitionState:
    first = cell.shadow_object_list[0]
    return (
        _parts(first)
        .get_sphere()[0]
        .intersects_sphere_at(
            first.m_position, first.m_scale, made, is_creature=bool(inputs.get("is_creature", 0))
        )
    )


def _cylsphere(cell: EnvCell, made: Transition, _inputs: Mapping[str, Any]) -> TransitionState:
    first = cell.shadow_object_list[0]
    return _parts(first).get_cylsphere()[0].intersects_sphere_at(first.m_position, first.m_scale, made)


def _object(cell: EnvCell, made: Transition, _inputs: Mapping[str, Any]) -> TransitionState:
    return cell.shadow_object_list[0].find_obj_collisions(made)


def _cell_objects(cell: EnvCell, made: Transition, _inputs: Mapping[str, Any]) -> TransitionState:
    return cell.find_obj_collisions(made)


def _cell(cell: EnvCell, made: Transition, _inputs: Mapping[str, Any]) -> TransitionState:
    return cell.find_collisions(made)


def _parts(obstacle: PhysicsObj) -> PartArray:
    if obstacle.part_array is None:
        raise ValueError(f"object {obstacle.id} has no part array, and so no shape to call")
    return obstacle.part_array


def _written(made: Transition, query: Query) -> Fields:
    """Write the trace and the state block."""
    fields: Fields = {"trace": "".join(made.trace or ()), **state_block(made), **touched_block(made)}
    walkable = made.sphere_path.walkable
    if walkable is not None:
        fields["walkable_geometry"] = geometry_of(walkable, query.geometries.values())
    return fields


FUNCTIONS: Final[dict[str, Callable[[EnvCell, Transition, Mapping[str, Any]], TransitionState]]] = {
    "sphere": _sphere,
    "cylsphere": _cylsphere,
    "object": _object,
    "cell_objects": _cell_objects,
    "cell": _cell,
}
"""What an ``object_call`` calls, by the name of its ``function``."""

OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "find_time_of_collision": _find_time_of_collision,
    "object_call": _object_call,
    "object_transition": _object_transition,
    "check_collisions": _check_collisions,
}
"""Operation name to function."""
