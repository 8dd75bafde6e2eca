"""The time gates of frames and objects (``update_object_gates`` of ``tick.jsonl``), by the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.oracle_ops.body import Body, NamedCell
from conformance.candidates.oracle_ops.values import position
from oracle.physics import Physics
from oracle.physics_object import PhysicsObj
from oracle.position import Position
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query


class CountedBody(Body):
    """A body that notes its ticks instead of performing them.

    Attributes
    ----------
    frames : int
        How often it was asked to update.
    quanta, curr : list of float
        Length and end of each tick of the last frame, seconds.
    """

    def __init__(self, block: Mapping[str, Any], world: World) -> None:
        super().__init__(block, world)
        self.frames = 0
        self.quanta: list[float] = []
        self.curr: list[float] = []

    def update_object(self) -> None:
        """Note the frame."""
        self.frames += 1
        super().update_object()

    def update_object_internal(self, quantum: float) -> None:
        """Note the tick."""
        self.quanta.append(quantum)
        self.curr.append(self.world.clock.curr_time)


def _update_object_gates(query: Query) -> Fields:
    inputs = query.inputs
    world = World()
    body = CountedBody(inputs["body"], world)
    body.update_time = inputs["update_time"]
    if body.m_position.objcell_id:
        body.cell = NamedCell(body.m_position.objcell_id)
    if inputs.get("parent", 0):
        body.parent = _bystander(Position())
    if inputs.get("player") is not None:
        world.player = _bystander(position(inputs["player"]))
    world.maintainer_active = inputs.get("maintainer_active", 0)
    physics = Physics(world, inputs["last_update"])
    physics.objects.append(body)
    fields: Fields = {"steps": [_frame(physics, body, time) for time in inputs["times"]]}
    if body.player_distance is not None:
        fields["player_distance"] = body.player_distance
    return fields


def _frame(physics: Physics, body: CountedBody, time: float) -> Fields:
    """Render one frame and write what the gates did."""
    before, frames = physics.last_update, body.frames
    body.quanta, body.curr = [], []
    physics.world.clock.cur_time = time
    physics.use_time()
    if body.frames == frames:
        gate = "wait" if physics.last_update == before else "reset"
        return {"gate": gate, "last_update": physics.last_update}
    return {
        "gate": "run",
        "last_update": physics.last_update,
        "quanta": body.quanta,
        "curr": body.curr,
        "update_time": body.update_time,
        "transient_state": body.transient_state,
    }


def _bystander(where: Position) -> PhysicsObj:
    return PhysicsObj(0, 0, where, scale=1.0, part_array=None)


OPS: Final[dict[str, Callable[[Query], Fields]]] = {"update_object_gates": _update_object_gates}
"""Operation name to function."""
