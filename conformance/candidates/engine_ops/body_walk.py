"""Bodies that move by themselves, tick after tick (``body_walk`` of ``tick.jsonl``), by the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from conformance.candidates.engine_ops.bodies import LiveBody
from conformance.candidates.engine_ops.probing import note_work
from conformance.candidates.engine_ops.running import TRACE_CAPACITY, demand_same, demand_same_answer
from conformance.candidates.engine_ops.state_block import trace_text
from conformance.candidates.engine_ops.values import floats, vector
from conformance.candidates.engine_ops.world_cache import world_of
from conformance.candidates.engine_ops.worlds import engine_world
from engine import layout as at
from engine.batch import check_status
from engine.body_layout import BODY_DTYPE, OUTCOMES
from engine.coherence import AS_ASKED
from engine.constants import CONTACT_TS, SLIDING_TS
from engine.kernels import program, tick_velocity
from engine.plan import FULL_PLAN
from engine.threads import new_share
from engine.tracing import runnable

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query
    from engine.kernels.types import Array
    from engine.world import World

IDENTITY: Final = [1.0, 0.0, 0.0, 0.0]
"""The rotation that a tick leaves out."""
TRANSITION_OUTCOMES: Final = ("failed", "moved", "lost")
"""Outcomes of ticks that have run a transition."""


def _body_walk(query: Query) -> Fields:
    inputs = query.inputs
    recorder: Recorder
    if "world" in inputs:
        recorder = WorldRecorder(engine_world(inputs["world"], query.geometries), inputs["body"])
    else:
        recorder = Recorder(world_of(inputs["cells"], query.geometries), inputs["body"])
    ticks: list[Fields] = []
    for given in inputs["ticks"]:
        ticks.append(recorder.tick(given))
        if ticks[-1]["r"] == "lost":
            break
    return {"ticks": ticks}


class Recorder:
    """Moves a body and writes what each tick did; some fields only when they have changed."""

    def __init__(self, world: World, block: Mapping[str, Any]) -> None:
        self.world: Final = world
        self.body: Final = LiveBody(block, world.cell_index(block["position"]["cell"]))
        self.cell = int(self.body.record["cell_id"])
        self.state = int(self.body.record["state"])
        self.touched: list[int] = []

    def tick(self, given: Mapping[str, Any]) -> Fields:
        """Perform one tick."""
        body, record = self.body, self.body.record
        if "omega" in given:
            record["omega"] = given["omega"]
        if "set_velocity" in given:
            tick_velocity.set_velocity(body.row, *vector(given["set_velocity"]))
        if "set_local_velocity" in given:
            tick_velocity.set_local_velocity(body.row, *vector(given["set_local_velocity"]))
        trace = self._step(float(given["q"]))
        outcome = OUTCOMES[int(record["outcome"])]
        fields = {"r": outcome, **self._always()}
        if outcome in TRANSITION_OUTCOMES:
            fields["t"] = trace
        if outcome == "moved":
            fields |= self._touched()
        kills = int(record["kill_velocity"])
        return fields | ({"kill": kills} if kills else {})

    def _step(self, quantum: float) -> str:
        """Run a tick and return its trace; with too little room for it, the tick is run again.

        It is run with shortcuts besides (`conformance.candidates.engine_ops.running`).
        """
        row, capacity = self.body.row, TRACE_CAPACITY
        before = row.copy()
        short, touched = self._step_with_shortcuts(before.copy(), quantum)
        while True:
            state = self.world.new_row(trace_capacity=capacity)
            step, times = runnable(program.run), np.array([[quantum, 1.0]])
            bodies, world = row.reshape(1, -1), self.world
            step(world.floats, world.ints, state, program.STEP, bodies, times, AS_ASKED, new_share(1))
            check_status(self.body.record["status"].reshape(1))
            trace = trace_text(state, self.world.ints)
            if trace is not None:
                note_work(state)
                self.touched = self.world.touched(state)
                demand_same_answer(short, self.body.record)
                demand_same("touched", touched, self.touched)
                return trace
            row[:] = before
            capacity = int(state[at.TRACE_LENGTH])

    def _step_with_shortcuts(self, row: Array, quantum: float) -> tuple[Any, list[int]]:
        """Run a tick of a body's row as large batches do; return its record, and the objects it touched."""
        world = self.world
        world.prepare()
        state = world.new_row(plan=FULL_PLAN)
        times = np.array([[quantum, 1.0]])
        bodies = row.reshape(1, -1)
        program.run(world.floats, world.ints, state, program.STEP, bodies, times, AS_ASKED, new_share(1))
        note_work(state)
        return row.view(BODY_DTYPE)[0], world.touched(state)

    def _always(self) -> Fields:
        """Write position and velocity, and what has changed since the last tick."""
        record = self.body.record
        rotation, cell = floats(record["rotation"]), int(record["cell_id"])
        fields: Fields = {
            "pos": floats(record["origin"]),
            "v": floats(record["velocity"]),
            "ts": int(record["transient_state"]),
        }
        if rotation != IDENTITY:
            fields["rot"] = rotation
        if cell != self.cell:
            self.cell = fields["cell"] = cell
        if int(record["state"]) != self.state:
            self.state = fields["state"] = int(record["state"])
        if record["cell"] != at.NO_CELL and self.world.cell_ids[int(record["cell"])] != cell:
            fields["cell_object"] = self.world.cell_ids[int(record["cell"])]
        if record["omega"].any():
            fields["om"] = floats(record["omega"])
        return fields

    def _touched(self) -> Fields:
        """Write contact and collisions after a write-back."""
        record = self.body.record
        bits = int(record["transient_state"])
        fields: Fields = {"cv": floats(record["cached_velocity"])}
        if bits & CONTACT_TS:
            fields["cp"] = floats(record["contact_plane"])
            fields["cp_cell"] = int(record["contact_plane_cell_id"])
        if bits & SLIDING_TS:
            fields["sn"] = floats(record["sliding_normal"])
        if record["collision_normal_valid"]:
            fields["cn"] = floats(record["collision_normal"])
        if record["frames_stationary_fall"]:
            fields["fsf"] = int(record["frames_stationary_fall"])
        if record["collided_with_environment"]:
            fields["env"] = 1
        return fields


class WorldRecorder(Recorder):
    """Also writes what only a body in a world is told: the objects it touches, and the latch."""

    def __init__(self, world: World, block: Mapping[str, Any]) -> None:
        super().__init__(world, block)
        self.body.record["tracks_objects"] = 1

    def _always(self) -> Fields:
        return super()._always() | ({"cwe": 1} if self.body.record["colliding_with_environment"] else {})

    def _touched(self) -> Fields:
        touched = [self.world.objects[thing].id for thing in self.touched]
        return super()._touched() | ({"objs": touched} if touched else {})


OPS: Final[dict[str, Callable[[Query], Fields]]] = {"body_walk": _body_walk}
"""Operation name to function."""
