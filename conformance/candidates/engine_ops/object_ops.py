"""Spheres, cylinders and whole objects in a mover's way, by the engine.

The operations of ``sphere.jsonl``, ``cylsphere.jsonl`` and ``objects.jsonl``. Their world is one cell that
contains every point; the objects are its shadow list.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.engine_ops.obstacles import obstacle
from conformance.candidates.engine_ops.rows import query_row, take_path
from conformance.candidates.engine_ops.running import run_noting
from conformance.candidates.engine_ops.state_block import object_block, state_block, walkable_geometry
from conformance.candidates.engine_ops.values import vector
from conformance.candidates.engine_ops.world_cache import engine_pose, unbounded_shape
from engine.cells import Cell
from engine.constants import PLACEMENT_INSERT, STATE_NAMES
from engine.kernels.program import MEET, RESOLVE
from engine.kernels.sphere_responses import find_time_of_collision
from engine.object_call import Target
from engine.objects import Obstacle, Weenie
from engine.world import World

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query

TARGETS: Final[Mapping[str, Target]] = {
    "sphere": Target.FIRST_SHAPE,
    "cylsphere": Target.FIRST_SHAPE,
    "object": Target.OBJECT,
    "cell_objects": Target.OBJECTS,
    "cell": Target.CELL,
}
"""What each `function` of an ``object_call`` tests."""


def _find_time_of_collision(query: Query) -> Fields:
    inputs = query.inputs
    movement, disp = vector(inputs["movement"]), vector(inputs["disp"])
    return {"t": find_time_of_collision(*movement, *disp, float(inputs["radsum"]))}


def _object_call(query: Query) -> Fields:
    inputs = query.inputs
    things = _obstacles(query)
    called = _called(things[0], inputs)
    world = World([_cell(query, things if called is things[0] else [*things, called])])
    row = query_row(inputs, begin_cell=0)
    take_path(row, inputs["path"])
    row["target_kind"] = TARGETS[inputs["function"]]
    row["target_object"] = world.objects.index(called)
    result, trace, touched = run_noting(MEET, world, row)
    fields: Fields = {"result": STATE_NAMES[int(result["result"])], "trace": trace}
    return fields | _state(result, touched, world)


def _object_transition(query: Query) -> Fields:
    world = World([_cell(query, _obstacles(query))])
    result, trace, touched = run_noting(RESOLVE, world, query_row(query.inputs, begin_cell=0))
    fields: Fields = {"result": int(result["result"]), "trace": trace}
    return fields | _state(result, touched, world)


def _check_collisions(query: Query) -> Fields:
    """Ask for the first object as a placement does, at the place where the mover is."""
    inputs = query.inputs
    world = World([_cell(query, _obstacles(query))])
    row = query_row({**inputs, "to": inputs["from"]}, begin_cell=0)
    take_path(row, {"insert_type": PLACEMENT_INSERT})
    row["target_kind"], row["target_object"] = Target.OBJECT, 0
    result, _, _ = run_noting(MEET, world, row)
    return {"r": int(STATE_NAMES[int(result["result"])] != "OK")}


def _cell(query: Query, things: list[Obstacle]) -> Cell:
    block = query.inputs["cell"]
    name = block["geometry"]
    shape = None if name is None else unbounded_shape(query.geometries[name])
    return Cell(block["id"], engine_pose(block["pose"]), shape, things)


def _obstacles(query: Query) -> list[Obstacle]:
    return [obstacle(block, query.geometries) for block in query.inputs["objects"]]


def _called(first: Obstacle, inputs: Mapping[str, Any]) -> Obstacle:
    """Return the first object, or what has of it only the shape that is called.

    The latter is attached to another object, so that it is in nobody's way.
    """
    if inputs["function"] == "cylsphere":
        return replace(first, state=0, has_parent=True)
    if inputs["function"] == "sphere":
        creature = Weenie(creature=bool(inputs.get("is_creature", 0)))
        return replace(first, state=0, cylspheres=(), weenie=creature, has_parent=True)
    return first


def _state(result: Any, touched: list[int], world: World) -> Fields:
    fields = state_block(result, world) | object_block(result, touched, world)
    geometry = walkable_geometry(result, world)
    return fields if geometry is None else fields | {"walkable_geometry": geometry}


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "find_time_of_collision": _find_time_of_collision,
    "object_call": _object_call,
    "object_transition": _object_transition,
    "check_collisions": _check_collisions,
}
"""Operation name to function."""
