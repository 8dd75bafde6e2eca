"""The MOVER, SEED and path blocks of FORMAT.md, given to a transition of the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.oracle_ops.objects import weenie
from conformance.candidates.oracle_ops.values import plane, position, sphere, vector
from oracle.arithmetic import f32
from oracle.enums import InsertType
from oracle.physics_object import PhysicsObj
from oracle.physics_part import PartArray, Setup
from oracle.physics_state import ETHEREAL_PS, GRAVITY_PS, MISSILE_PS
from oracle.transition import Transition
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Mapping

    from oracle.obj_cell import ObjCell
    from oracle.position import Position
    from oracle.world import World

UNIT: Final = 1.0
"""The mover's step heights are given as used: its part array does not scale them."""
PATH_FLAGS: Final = (
    "step_down",
    "check_walkable",
    "collide",
    "obstruction_ethereal",
    "bldg_check",
    "hits_interior_cell",
)
"""Integer fields of the path block, 0 if absent."""
PATH_NUMBERS: Final = ("step_down_amt", "walk_interp", "walkable_allowance")
"""Float fields of the path block, 0 if absent."""


def at_check_pos(
    inputs: Mapping[str, Any], world: World, cell: ObjCell | None, *, trace_to: list[str] | None
) -> Transition:
    """Make a transition at current position `from` and check position `to`, both in one cell or none.

    It has the seed of the inputs, in the order in which the engine takes it: a trace tells both alike.
    """
    made = Transition(world, trace_to)
    begin, end = position(inputs["from"]), position(inputs["to"])
    take_mover(made, inputs["mover"], begin)
    take_seed(made, inputs.get("seed", {}))
    made.init_path(cell, begin, end)
    made.sphere_path.set_check_pos(end, cell)
    return made


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
        weenie=weenie(mover["weenie"], mover.get("id", 0)) if "weenie" in mover else None,
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
    last_known = seed.get("last_known")
    if last_known is not None:
        ci.last_known_contact_plane_valid = 1
        ci.last_known_contact_plane.assign(plane(last_known["plane"]))
        ci.last_known_contact_plane_is_water = last_known["is_water"]
        ci.last_known_contact_plane_cell_id = last_known["cell"]
    contact = seed.get("contact")
    if contact is not None:
        ci.set_contact_plane(plane(contact["plane"]), contact["is_water"])
        ci.contact_plane_cell_id = contact["cell"]
    if seed.get("sliding") is not None:
        transition.init_sliding_normal(vector(seed["sliding"]))
    ci.frames_stationary_fall = seed.get("frames_stationary_fall", 0)


def take_path(transition: Transition, path: Mapping[str, Any]) -> None:
    """Give the path block of a call to a transition; what is absent becomes zero."""
    sp = transition.sphere_path
    sp.insert_type = InsertType(path.get("insert_type", 0))
    for name in PATH_FLAGS:
        setattr(sp, name, path.get(name, 0))
    for name in PATH_NUMBERS:
        setattr(sp, name, f32(path.get(name, 0)))
