"""Whole objects put into a world and taken out of its cells, by the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.engine_ops.bodies import LiveBody
from conformance.candidates.engine_ops.obstacles import obstacle
from conformance.candidates.engine_ops.tick_ops import written_back
from conformance.candidates.engine_ops.values import floats
from conformance.candidates.engine_ops.world_cache import engine_pose
from conformance.candidates.engine_ops.worlds import engine_world
from engine.placing import place
from engine.shadows import ShadowLists

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query

SLIDE: Final = 0x10
"""SetPosition flag: the body may end somewhere near (06 SP-5)."""
DO_NOT_LOAD_CELLS: Final = 0x20
"""SetPosition flag: only cells that are visible from the first one count (06 SP-4)."""


def _place_body(query: Query) -> Fields:
    inputs = query.inputs
    world, flags = engine_world(inputs["world"], query.geometries), int(inputs["flags"])
    body = LiveBody(inputs["body"], world.cell_index(inputs["body"]["position"]["cell"]))
    body.record["tracks_objects"] = 1
    placed = place(
        world,
        body.record,
        engine_pose(inputs["to"]),
        inputs["cell"],
        slide=bool(flags & SLIDE),
        do_not_load_cells=bool(flags & DO_NOT_LOAD_CELLS),
    )
    body.rows[0] = placed.body
    to = {**inputs["to"], "origin": floats(placed.origin)}
    return {"result": int(placed.result), "to": to, **written_back(body)}


def _registration(query: Query) -> Fields:
    inputs = query.inputs
    blocks = inputs["world"]["objects"]
    number = {block["id"]: index for index, block in enumerate(blocks)}
    lists = ShadowLists(
        engine_world(inputs["world"], query.geometries),
        [obstacle(block, query.geometries) for block in blocks],
        {number[block["id"]]: [number[k] for k in block.get("attached", ())] for block in blocks},
    )
    for call in inputs["calls"]:
        (lists.leave if call["call"] == "leave" else lists.enter)(number[call["object"]])
    found = sorted(lists.by_cell().items())
    return {"shadow": [{"cell": cell, "objects": [thing.id for thing in things]} for cell, things in found]}


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "place_body": _place_body,
    "registration": _registration,
}
"""Operation name to function."""
