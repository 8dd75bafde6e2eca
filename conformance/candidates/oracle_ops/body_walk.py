"""Bodies that move by themselves, tick after tick (``body_walk`` of ``tick.jsonl``), by the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.oracle_ops.body import Body
from conformance.candidates.oracle_ops.scene import build_world
from conformance.candidates.oracle_ops.state_block import struck, touched_objects
from conformance.candidates.oracle_ops.values import nxyzd, quaternion, vector, xyz
from conformance.candidates.oracle_ops.world import build_world as world_of_record
from oracle.arithmetic import f32
from oracle.transient_state import ACTIVE_TS, CONTACT_TS, SLIDING_TS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query

IDENTITY: Final = [1.0, 0.0, 0.0, 0.0]
"""The rotation that a tick leaves out."""


class UntrackedBody(Body):
    """A body of a CELLS record: FORMAT.md does not track what it touches."""

    def track_object_collision(self, *_args: object) -> int:
        """Take no notice of a static."""
        return 0


def _body_walk(query: Query) -> Fields:
    inputs = query.inputs
    recorder = _in_world(query) if "world" in inputs else _in_cells(query)
    ticks: list[Fields] = []
    for tick in inputs["ticks"]:
        ticks.append(recorder.tick(tick))
        if ticks[-1]["r"] == "lost":
            break
    return {"ticks": ticks}


def _in_cells(query: Query) -> Recorder:
    world = build_world(query.inputs["cells"], query.geometries)
    body = UntrackedBody(query.inputs["body"], world)
    body.cell = world.cells[body.m_position.objcell_id]
    return Recorder(body)


def _in_world(query: Query) -> WorldRecorder:
    """Put a body into a world of its own, where it registers in the cells that it reaches."""
    world = world_of_record(query.inputs["world"], query.geometries)
    body = Body(query.inputs["body"], world)
    body.cell = world.get_visible(body.m_position.objcell_id)
    return WorldRecorder(body)


class Recorder:
    """Moves a body and writes what each tick did; some fields only when they have changed."""

    def __init__(self, body: Body) -> None:
        self.body = body
        self.cell = body.m_position.objcell_id
        self.state = body.state

    def tick(self, tick: Mapping[str, Any]) -> Fields:
        """Perform one tick."""
        body = self.body
        if "omega" in tick:
            body.m_omega.assign(vector(tick["omega"]))
        if "set_velocity" in tick:
            body.set_velocity(vector(tick["set_velocity"]), 0)
        if "set_local_velocity" in tick:
            body.set_local_velocity(vector(tick["set_local_velocity"]), 0)
        quantum = f32(tick["q"])
        body.world.clock.curr_time += quantum
        acts = body.transient_state & ACTIVE_TS and body.cell is not None  # UO-1
        kills = body.kill_velocity_calls
        body.forget()
        body.update_object_internal(quantum)
        fields = {"r": _outcome(body) if acts else "inactive", **self._always()}
        if body.begun is not None:
            fields["t"] = "".join(body.begun.trace or ())
        if fields["r"] == "moved":
            fields |= self._touched()
        if body.kill_velocity_calls != kills:
            fields["kill"] = body.kill_velocity_calls - kills
        return fields

    def _always(self) -> Fields:
        """Write position and velocity, and what has changed since the last tick."""
        body = self.body
        rotation = quaternion(body.m_position.frame)
        fields: Fields = {
            "pos": xyz(body.m_position.frame.origin),
            "v": xyz(body.m_velocity),
            "ts": body.transient_state,
        }
        if rotation != IDENTITY:
            fields["rot"] = rotation
        if body.m_position.objcell_id != self.cell:
            self.cell = fields["cell"] = body.m_position.objcell_id
        if body.state != self.state:
            self.state = fields["state"] = body.state
        if body.cell is not None and body.cell.id != body.m_position.objcell_id:
            fields["cell_object"] = body.cell.id
        if any(xyz(body.m_omega)):
            fields["om"] = xyz(body.m_omega)
        return fields

    def _touched(self) -> Fields:
        """Write contact and collisions after a write-back."""
        body = self.body
        fields: Fields = {"cv": xyz(body.cached_velocity)}
        if body.transient_state & CONTACT_TS:
            fields |= {"cp": nxyzd(body.contact_plane), "cp_cell": body.contact_plane_cell_id}
        if body.transient_state & SLIDING_TS:
            fields["sn"] = xyz(body.sliding_normal)
        if body.accepted is not None:
            fields |= struck(body.accepted.collision_info)
        return fields


class WorldRecorder(Recorder):
    """Also writes what only a body in a world is told: the objects it touches, and the latch."""

    def _always(self) -> Fields:
        fields = super()._always()
        return fields | ({"cwe": 1} if self.body.colliding_with_environment else {})

    def _touched(self) -> Fields:
        fields = super()._touched()
        if self.body.accepted is not None:
            fields |= touched_objects(self.body.accepted.collision_info)
        return fields


def _outcome(body: Body) -> str:
    """Return the name of what a tick did to an active body."""
    if body.part_array is None or not body.part_array.get_num_sphere():
        return "nosphere"
    if body.begun is None:
        return "still"
    if body.accepted is None:
        return "failed"
    return "lost" if body.cell is None else "moved"


OPS: Final[dict[str, Callable[[Query], Fields]]] = {"body_walk": _body_walk}
"""Operation name to function."""
