"""The MOVER and SEED blocks of FORMAT.md, given to a transition of the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.oracle_ops.values import plane, sphere, vector
from oracle.arithmetic import f32
from oracle.physics_object import PhysicsObj
from oracle.physics_part import PartArray, Setup
from oracle.physics_state import ETHEREAL_PS, GRAVITY_PS, MISSILE_PS
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Mapping

    from oracle.position import Position
    from oracle.transition import Transition

UNIT: Final = 1.0
"""The mover's step heights are given as used: its part array does not scale them."""


def moving_object(mover: Mapping[str, Any], pose: Position) -> PhysicsObj:
    """Make the live object of a MOVER."""
    state = ETHEREAL_PS if mover["ethereal"] else 0
    state |= GRAVITY_PS if mover["gravity"] else 0
    state |= MISSILE_PS if mover.get("missile") else 0
    setup = Setup(
        step_up_height=f32(mover["step_up_height"]),
        step_down_height=f32(mover["step_down_height"]),
    )
    return PhysicsObj(
        mover.get("id", 0),
        state,
        pose,
        scale=f32(mover["scale"]),
        part_array=PartArray([], setup, Vector3(UNIT, UNIT, UNIT)),
    )


def take_mover(transition: Transition, mover: Mapping[str, Any], pose: Position) -> None:
    """Give a MOVER to a transition: object, state bits and spheres."""
    transition.init_object(moving_object(mover, pose), mover["state"])
    oi = transition.object_info
    oi.ethereal = mover["ethereal"]
    oi.step_down = mover["step_down"]
    oi.targetID = mover.get("target_id", 0)
    spheres = [sphere(values) for values in mover["spheres"]]
    transition.init_sphere(len(spheres), spheres, f32(mover["scale"]))


def take_seed(transition: Transition, seed: Mapping[str, Any]) -> None:
    """Give a SEED to a transition; what is absent stays zero."""
    ci = transition.collision_info
    contact = seed.get("contact")
    if contact is not None:
        ci.set_contact_plane(plane(contact["plane"]), contact["is_water"])
        ci.contact_plane_cell_id = contact["cell"]
    last_known = seed.get("last_known")
    if last_known is not None:
        ci.last_known_contact_plane_valid = 1
        ci.last_known_contact_plane.assign(plane(last_known["plane"]))
        ci.last_known_contact_plane_cell_id = last_known["cell"]
        ci.last_known_contact_plane_is_water = last_known["is_water"]
    if seed.get("sliding") is not None:
        transition.init_sliding_normal(vector(seed["sliding"]))
    ci.frames_stationary_fall = seed.get("frames_stationary_fall", 0)
