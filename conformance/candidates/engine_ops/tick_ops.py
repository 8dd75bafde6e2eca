"""Single calls of the tick (``tick.jsonl``), by the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from conformance.candidates.engine_ops.bodies import LiveBody
from conformance.candidates.engine_ops.values import floats, position, vector
from engine import body_layout as of_body
from engine import layout as at
from engine.constants import ETHEREAL, ON_WALKABLE_TS
from engine.kernels import tick, tick_collisions, tick_contact, tick_position, tick_seed, tick_velocity
from engine.step import set_elasticity

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query
    from engine.kernels.types import Array

CURRENT_CELL: Final = 0
"""Index that stands for the cell that the body is in."""
OTHER_CELL: Final = 1
"""Index that stands for another."""


def _update_physics(query: Query) -> Fields:
    body = LiveBody(query.inputs["body"])
    body.record["wanted"] = body.row[: at.POSITION_SIZE]
    tick_velocity.update_physics_internal(body.row, of_body.B_WANTED, float(query.inputs["quantum"]))
    return _wanted(body)


def _update_position(query: Query) -> Fields:
    body = LiveBody(query.inputs["body"])
    tick.update_position_internal(body.row, float(query.inputs["quantum"]))
    return _wanted(body)


def _wanted(body: LiveBody) -> Fields:
    wanted = body.record["wanted"]
    return {
        "origin": floats(wanted[at.ORIGIN :]),
        "rotation": floats(wanted[at.QUATERNION : at.QUATERNION + at.QUATERNION_SIZE]),
        **body.numbers("velocity"),
        **body.integers("transient_state"),
    }


def _calc_friction(query: Query) -> Fields:
    body = LiveBody(query.inputs["body"])
    tick_velocity.calc_friction(body.row, float(query.inputs["quantum"]), float(query.inputs["v2"]))
    return body.numbers("velocity")


def _calc_acceleration(query: Query) -> Fields:
    body = LiveBody(query.inputs["body"])
    tick_velocity.calc_acceleration(body.row)
    return body.numbers("acceleration", "omega")


def _set_velocity(query: Query) -> Fields:
    return _velocity_set(query, tick_velocity.set_velocity)


def _set_local_velocity(query: Query) -> Fields:
    return _velocity_set(query, tick_velocity.set_local_velocity)


def _velocity_set(query: Query, kernel: Callable[..., None]) -> Fields:
    body = LiveBody(query.inputs["body"])
    body.record["update_time"] = query.inputs["update_time"]
    body.record["clock"] = query.inputs["cur_time"]
    kernel(body.row, *vector(query.inputs["v"]))
    return {
        **body.numbers("velocity"),
        "jumped": int(body.record["jumped_this_frame"]),
        **body.integers("transient_state"),
        "update_time": float(body.record["update_time"]),
    }


def _set_on_walkable(query: Query) -> Fields:
    body = LiveBody(query.inputs["body"])
    tick_contact.set_on_walkable(body.row, bool(query.inputs["flag"]))
    return body.integers("transient_state") | body.numbers("acceleration", "omega")


def _clear_transient_states(query: Query) -> Fields:
    body = LiveBody(query.inputs["body"])
    tick_contact.clear_transient_states(body.row)
    return body.integers("transient_state") | body.numbers("acceleration", "omega")


def _handle_all_collisions(query: Query) -> Fields:
    inputs = query.inputs
    body, state = _collided_body(inputs)
    reported = _respond(inputs["collisions"], state, body, on_walkable=bool(inputs["prev_on_walkable"]))
    return {"r": int(reported), **body.numbers("velocity"), **_responded(body)}


def _responded(body: LiveBody) -> Fields:
    return body.integers("transient_state", "state", "colliding_with_environment")


def _collided_body(inputs: Mapping[str, Any]) -> tuple[LiveBody, Array]:
    """Return the body, knowing what is known to it, and a row of state with the COLLISIONS block."""
    block = inputs["collisions"]
    body = LiveBody(inputs["body"], CURRENT_CELL)
    known = {int(t["id"]): int(t["state"]) for t in block.get("objects", ()) if t.get("known", 0)}
    body.record["num_records"] = len(known)
    for record, (thing, bits) in zip(body.record["records"], known.items(), strict=False):
        record[:] = thing, 0.0, bits & ETHEREAL != 0
    state = np.zeros(at.STATE_SIZE, dtype=np.float64)
    state[at.FRAMES_STATIONARY_FALL] = block["frames_stationary_fall"]
    state[at.COLLIDED_WITH_ENVIRONMENT] = block["collided_with_environment"]
    if block["collision_normal"] is not None:
        state[at.COLLISION_NORMAL_VALID] = 1.0
        state[at.COLLISION_NORMAL : at.COLLISION_NORMAL + at.VECTOR_SIZE] = block["collision_normal"]
    return body, state


def _respond(block: Mapping[str, Any], state: Array, body: LiveBody, *, on_walkable: bool) -> bool:
    """Perform handle_all_collisions with objects that are in no world: ids stand for their indices."""
    reported = False
    for thing in block.get("objects", ()):
        reported |= tick_collisions.track_object_collision(
            body.row, int(thing["id"]), int(thing["state"]), bool(thing.get("weenie", 0))
        )
    return reported | tick_collisions.respond(state, body.row, on_walkable)


def _set_position(query: Query) -> Fields:
    inputs = query.inputs
    body, state = _collided_body(inputs)
    on_walkable = bool(int(body.record["transient_state"]) & ON_WALKABLE_TS)
    state[at.CURR_POS : at.CURR_POS + at.POSITION_SIZE] = position(inputs["curr_pos"])
    cell = inputs["curr_cell"]
    if cell is None:
        tick_position.become_lost(state, body.row)
    else:
        state[at.CURR_CELL] = CURRENT_CELL if cell == body.record["cell_id"] else OTHER_CELL
        _take_contact(state, inputs["collisions"])
        tick_position.take_over(state, body.row, float(cell))
        _respond(inputs["collisions"], state, body, on_walkable=on_walkable)
    return written_back(body)


def written_back(body: LiveBody) -> Fields:
    """Write what a body has after a write-back."""
    return {
        "lost": int(body.record["cell"] == at.NO_CELL),
        "position": body.pose(),
        "contact_plane_cell": int(body.record["contact_plane_cell_id"]),
        **body.numbers("contact_plane", "sliding_normal", "velocity", "acceleration", "omega"),
        **_responded(body),
    }


def _set_elasticity(query: Query) -> Fields:
    body = LiveBody(query.inputs["body"])
    set_elasticity(body.rows, [query.inputs["elasticity"]])
    return {"elasticity": float(body.record["elasticity"])}


def _take_contact(state: Array, block: Mapping[str, Any]) -> None:
    state[at.CONTACT_PLANE : at.CONTACT_PLANE + at.PLANE_SIZE] = block["contact_plane"]
    state[at.CONTACT_VALID] = block["contact_plane_valid"]
    state[at.CONTACT_CELL_ID] = block["contact_plane_cell"]
    state[at.CONTACT_IS_WATER] = block["contact_plane_is_water"]
    state[at.SLIDING_NORMAL : at.SLIDING_NORMAL + at.VECTOR_SIZE] = block["sliding_normal"]
    state[at.SLIDING_VALID] = block["sliding_normal_valid"]


def _seed(query: Query) -> Fields:
    body = LiveBody(query.inputs["body"])
    body.record["wanted"] = body.row[: at.POSITION_SIZE]
    state = np.zeros(at.STATE_SIZE, dtype=np.float64)
    flags = tick_seed.seed_transition(state, body.row, bool(query.inputs.get("admin_move", 0)))
    seeded = state.view(at.STATE_DTYPE)[0]
    sliding = floats(seeded["sliding_normal"]) if seeded["sliding_normal_valid"] else None
    return {
        "flags": int(flags),
        "state": int(seeded["state"]),
        "scale": float(body.record["scale"]),
        "step_up_height": float(seeded["step_up_height"]),
        "step_down_height": float(seeded["step_down_height"]),
        "ethereal": int(seeded["ethereal"]),
        "step_down": int(seeded["may_step_down"]),
        "contact_plane": _plane_block(seeded, "contact_plane"),
        "last_known_contact_plane": _plane_block(seeded, "last_known_contact_plane"),
        "sliding_normal": sliding,
        "frames_stationary_fall": int(seeded["frames_stationary_fall"]),
    }


def _plane_block(seeded: Any, name: str) -> Fields:
    """Write a seeded plane, valid or not; retail's water flag is a bit of the body, here 0 or 1."""
    return {
        "valid": int(seeded[f"{name}_valid"]),
        "plane": floats(seeded[name]),
        "cell_id": int(seeded[f"{name}_cell_id"]),
        "is_water": int(seeded[f"{name}_is_water"] != 0),
    }


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "update_physics": _update_physics,
    "update_position": _update_position,
    "calc_friction": _calc_friction,
    "calc_acceleration": _calc_acceleration,
    "set_velocity": _set_velocity,
    "set_local_velocity": _set_local_velocity,
    "set_on_walkable": _set_on_walkable,
    "clear_transient_states": _clear_transient_states,
    "handle_all_collisions": _handle_all_collisions,
    "set_position": _set_position,
    "set_elasticity": _set_elasticity,
    "seed": _seed,
}
"""Operation name to function."""
