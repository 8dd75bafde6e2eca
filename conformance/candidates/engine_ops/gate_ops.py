"""The time gates of frames and objects (``update_object_gates`` of ``tick.jsonl``), by the engine."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np

from conformance.candidates.engine_ops.bodies import LiveBody
from conformance.candidates.engine_ops.values import floats, position
from engine import layout as at
from engine.kernels import tick_gates

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query

GATES: Final = {tick_gates.WAIT: "wait", tick_gates.RESET: "reset", tick_gates.RUN: "run"}
"""What a frame gate's answer is called in FORMAT.md."""


def _update_object_gates(query: Query) -> Fields:
    inputs = query.inputs
    body = LiveBody(inputs["body"], 0 if inputs["body"]["position"]["cell"] else at.NO_CELL)
    body.record["update_time"] = inputs["update_time"]
    body.record["has_parent"] = inputs.get("parent", 0)
    player = None if inputs.get("player") is None else position(inputs["player"])
    maintained = bool(inputs.get("maintainer_active", 0))
    last_update, distance = float(inputs["last_update"]), math.nan
    steps: list[Fields] = []
    for time in inputs["times"]:
        gate, last_update = tick_gates.frame_gate(last_update, float(time))
        step: Fields = {"gate": GATES[gate], "last_update": last_update}
        if gate == tick_gates.RUN:
            body.record["clock"] = time
            if player is not None:
                distance = tick_gates.near_player(body.row, player, maintained)
            step |= _object_gate(body)
        steps.append(step)
    return {"steps": steps} | ({} if math.isnan(distance) else {"player_distance": distance})


def _object_gate(body: LiveBody) -> Fields:
    quanta = np.zeros(tick_gates.MAX_TICKS, dtype=np.float64)
    times = quanta.copy()
    count = tick_gates.object_gate(body.row, quanta, times)
    return {
        "quanta": floats(quanta[:count]),
        "curr": floats(times[:count]),
        "update_time": float(body.record["update_time"]),
        **body.integers("transient_state"),
    }


OPS: Final[dict[str, Callable[[Query], Fields]]] = {"update_object_gates": _update_object_gates}
"""Operation name to function."""
