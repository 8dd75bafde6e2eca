"""Single calls of the tick (``tick.jsonl``), by the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.oracle_ops.body import Body, NamedCell, make_body
from conformance.candidates.oracle_ops.objects import weenie
from conformance.candidates.oracle_ops.state_block import pose_block, valid_normal
from conformance.candidates.oracle_ops.values import nxyzd, plane, position, quaternion, vector, xyz
from oracle.arithmetic import f32
from oracle.frame import Frame
from oracle.physics_object import PhysicsObj
from oracle.physics_object_collisions import CollisionRecord
from oracle.physics_state import ETHEREAL_PS
from oracle.position import Position
from oracle.transition import Transition

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query
    from oracle.collision_info import CollisionInfo
    from oracle.plane import Plane


def _update_physics(query: Query) -> Fields:
    body = make_body(query.inputs["body"])
    frame = body.m_position.frame.copy()
    body.update_physics_internal(f32(query.inputs["quantum"]), frame)
    return _moved(body, frame)


def _update_position(query: Query) -> Fields:
    body = make_body(query.inputs["body"])
    frame = Frame()
    body.update_position_internal(f32(query.inputs["quantum"]), frame)
    return _moved(body, frame)


def _moved(body: Body, frame: Frame) -> Fields:
    return {
        "origin": xyz(frame.origin),
        "rotation": quaternion(frame),
        "velocity": xyz(body.m_velocity),
        "transient_state": body.transient_state,
    }


def _calc_friction(query: Query) -> Fields:
    body = make_body(query.inputs["body"])
    body.calc_friction(f32(query.inputs["quantum"]), f32(query.inputs["v2"]))
    return {"velocity": xyz(body.m_velocity)}


def _calc_acceleration(query: Query) -> Fields:
    body = make_body(query.inputs["body"])
    body.calc_acceleration()
    return _accelerated(body)


def _accelerated(body: Body) -> Fields:
    return {"acceleration": xyz(body.m_acceleration), "omega": xyz(body.m_omega)}


def _set_velocity(query: Query) -> Fields:
    return _velocity_set(query, Body.set_velocity)


def _set_local_velocity(query: Query) -> Fields:
    return _velocity_set(query, Body.set_local_velocity)


def _velocity_set(query: Query, call: Callable[..., None]) -> Fields:
    body = make_body(query.inputs["body"])
    body.update_time = query.inputs["update_time"]
    body.world.clock.cur_time = query.inputs["cur_time"]
    call(body, vector(query.inputs["v"]), 0)
    return {
        "velocity": xyz(body.m_velocity),
        "jumped": body.jumped_this_frame,
        "transient_state": body.transient_state,
        "update_time": body.update_time,
    }


def _set_on_walkable(query: Query) -> Fields:
    body = make_body(query.inputs["body"])
    body.set_on_walkable(query.inputs["flag"])
    return {"transient_state": body.transient_state, **_accelerated(body)}


def _clear_transient_states(query: Query) -> Fields:
    body = make_body(query.inputs["body"])
    body.clear_transient_states()
    return {"transient_state": body.transient_state, **_accelerated(body)}


def _set_elasticity(query: Query) -> Fields:
    body = make_body(query.inputs["body"])
    body.set_elasticity(f32(query.inputs["elasticity"]))
    return {"elasticity": body.elasticity}


def _handle_all_collisions(query: Query) -> Fields:
    inputs = query.inputs
    body = make_body(inputs["body"])
    made = body.make_transition()
    _take_collisions(body, made.collision_info, inputs["collisions"])
    reported = body.handle_all_collisions(
        made.collision_info, inputs["prev_contact"], inputs["prev_on_walkable"]
    )
    return {"r": reported, "velocity": xyz(body.m_velocity), **_responded(body)}


def _responded(body: Body) -> Fields:
    return {
        "transient_state": body.transient_state,
        "state": body.state,
        "colliding_with_environment": body.colliding_with_environment,
    }


def _take_collisions(body: Body, ci: CollisionInfo, block: Mapping[str, Any]) -> None:
    """Give a COLLISIONS block to a collision info, and what is known already to the body's table."""
    ci.frames_stationary_fall = block["frames_stationary_fall"]
    ci.collided_with_environment = block["collided_with_environment"]
    if block["collision_normal"] is not None:
        ci.collision_normal_valid = 1
        ci.collision_normal.assign(vector(block["collision_normal"]))
    for touched in block.get("objects", ()):
        other = PhysicsObj(
            touched["id"],
            touched["state"],
            Position(),
            scale=1.0,
            part_array=None,
            weenie=weenie({}) if touched.get("weenie", 0) else None,
        )
        ci.collide_object.append(other)
        if touched.get("known", 0):
            now = body.world.clock.curr_time
            body.collision_table[other.id] = CollisionRecord(now, other.state & ETHEREAL_PS)


def _set_position(query: Query) -> Fields:
    inputs = query.inputs
    body = make_body(inputs["body"])
    cell = NamedCell(body.m_position.objcell_id)
    body.cell = cell
    made = Transition(body.world)
    sp, ci, block = made.sphere_path, made.collision_info, inputs["collisions"]
    sp.curr_pos.assign(position(inputs["curr_pos"]))
    if inputs["curr_cell"] is not None:
        sp.curr_cell = cell if inputs["curr_cell"] == cell.id else NamedCell(inputs["curr_cell"])
    _take_collisions(body, ci, block)
    ci.contact_plane.assign(plane(block["contact_plane"]))
    ci.contact_plane_valid = block["contact_plane_valid"]
    ci.contact_plane_cell_id = block["contact_plane_cell"]
    ci.contact_plane_is_water = block["contact_plane_is_water"]
    ci.sliding_normal.assign(vector(block["sliding_normal"]))
    ci.sliding_normal_valid = block["sliding_normal_valid"]
    body.set_position_internal(made)
    return written_back(body)


def written_back(body: Body) -> Fields:
    """Write what a body has after a write-back."""
    return {
        "lost": int(body.cell is None),
        "position": pose_block(body.m_position),
        "contact_plane": nxyzd(body.contact_plane),
        "contact_plane_cell": body.contact_plane_cell_id,
        "sliding_normal": xyz(body.sliding_normal),
        "velocity": xyz(body.m_velocity),
        **_accelerated(body),
        **_responded(body),
    }


def _seed(query: Query) -> Fields:
    body = make_body(query.inputs["body"])
    admin_move = query.inputs.get("admin_move", 0)
    made = body.seed_transition(body.m_position, body.m_position, admin_move)
    oi, ci = made.object_info, made.collision_info
    return {
        "flags": body.get_object_info(Transition(body.world), admin_move),
        "state": oi.state,
        "scale": oi.scale,
        "step_up_height": oi.step_up_height,
        "step_down_height": oi.step_down_height,
        "ethereal": oi.ethereal,
        "step_down": oi.step_down,
        "contact_plane": _plane_block(
            ci.contact_plane_valid, ci.contact_plane, ci.contact_plane_cell_id, ci.contact_plane_is_water
        ),
        "last_known_contact_plane": _plane_block(
            ci.last_known_contact_plane_valid,
            ci.last_known_contact_plane,
            ci.last_known_contact_plane_cell_id,
            ci.last_known_contact_plane_is_water,
        ),
        "sliding_normal": valid_normal(ci.sliding_normal_valid, ci.sliding_normal),
        "frames_stationary_fall": ci.frames_stationary_fall,
    }


def _plane_block(valid: int, given: Plane, cell_id: int, is_water: int) -> Fields:
    """Write a seeded plane, valid or not; retail's water flag is a bit of the body, here 0 or 1."""
    return {"valid": valid, "plane": nxyzd(given), "cell_id": cell_id, "is_water": int(is_water != 0)}


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "update_physics": _update_physics,
    "update_position": _update_position,
    "calc_friction": _calc_friction,
    "calc_acceleration": _calc_acceleration,
    "set_velocity": _set_velocity,
    "set_local_velocity": _set_local_velocity,
    "set_on_walkable": _set_on_walkable,
    "clear_transient_states": _clear_transient_states,
    "set_elasticity": _set_elasticity,
    "handle_all_collisions": _handle_all_collisions,
    "set_position": _set_position,
    "seed": _seed,
}
"""Operation name to function."""
