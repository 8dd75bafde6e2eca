"""Whole objects put into a world and taken out of its cells, by the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_ops.body import Body
from conformance.candidates.oracle_ops.state_block import pose_block
from conformance.candidates.oracle_ops.tick_ops import written_back
from conformance.candidates.oracle_ops.values import position
from conformance.candidates.oracle_ops.world import build_world, world_and_objects
from oracle.physics_state import STATIC_PS

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from oracle.obj_cell import ObjCell
    from oracle.world import World


def _place_body(query: Query) -> Fields:
    """`CPhysicsObj::SetPosition`; the body registers itself: the world is not a shared one."""
    inputs = query.inputs
    world = build_world(inputs["world"], query.geometries)
    body = Body(inputs["body"], world)
    body.cell = world.get_visible(body.m_position.objcell_id)
    to, cell_id = position(inputs["to"]), inputs["cell"]
    result = body.set_position(to, inputs["flags"], None if cell_id is None else world.get_visible(cell_id))
    return {"result": int(result), "to": pose_block(to), **written_back(body)}


def _registration(query: Query) -> Fields:
    """Register objects and take them out again, in the order of the calls; tell each cell's list."""
    inputs = query.inputs
    world, named = world_and_objects(inputs["world"], query.geometries)
    for block in inputs["world"]["objects"]:
        named(block["id"]).children = [named(child) for child in block.get("attached", ())]
    for call in inputs["calls"]:
        thing = named(call["object"])
        if call["call"] == "leave":
            thing.remove_shadows_from_cells()
            continue
        thing.cell = world.get_visible(thing.m_position.objcell_id)
        if thing.state & STATIC_PS:
            thing.calc_cross_cells_static()
        else:
            thing.calc_cross_cells()
    return {"shadow": [_listed(cell) for cell in _loaded_cells(world) if cell.shadow_object_list]}


def _loaded_cells(world: World) -> list[ObjCell]:
    land = [cell for block in world.landscape.blocks.values() for cell in block.cells]
    return sorted([*world.cells.values(), *land], key=lambda cell: cell.id)


def _listed(cell: ObjCell) -> Fields:
    return {"cell": cell.id, "objects": [thing.id for thing in cell.shadow_object_list]}


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "place_body": _place_body,
    "registration": _registration,
}
"""Operation name to function."""
