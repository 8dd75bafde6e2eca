"""OBJECT blocks of FORMAT.md as physics objects of the oracle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.candidates.oracle_ops.values import position, sphere, vector
from oracle.arithmetic import f32
from oracle.cyl_sphere import CylSphere
from oracle.physics_object import PhysicsObj
from oracle.physics_part import GfxObj, PartArray, PhysicsPart, Setup
from oracle.position import Position
from oracle.vector import Vector3
from oracle.weenie import Weenie

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from conformance.scenes.model import Geometry
    from oracle.world import World

FLAT_PICTURE: Final = 2
"""A way of drawing that is not the one of solid things (09 6.5.4)."""
HOLDER_ID: Final = 0
"""Id of what an attached object is attached to; only that there is something matters."""


def physics_object(
    block: Mapping[str, Any], geometries: Mapping[str, Geometry], world: World | None = None
) -> PhysicsObj:
    """Make the object of an OBJECT block.

    Parameters
    ----------
    block : Mapping
        As in FORMAT.md, numbers exact; ``sorting_sphere`` is taken too, as ``cross_cells`` gives it.
    geometries : Mapping of str to Geometry
        Those that the parts name.
    world : World or None
        Where it lives; None for a world of its own.

    Returns
    -------
    PhysicsObj
        It is in no cell yet.
    """
    pose, scale = position(block["pose"]), f32(block["scale"])
    return PhysicsObj(
        block["id"],
        block["state"],
        pose,
        scale=scale,
        part_array=None if block.get("no_part_array", 0) else _part_array(block, geometries, pose, scale),
        weenie=weenie(block["weenie"], block["id"]) if block.get("weenie") is not None else None,
        parent=holder() if block.get("parent", 0) else None,
        world=world,
    )


def weenie(block: Mapping[str, Any], object_id: int = 0) -> Weenie:
    """Make the game object of a `weenie` block; what is absent is 0."""
    return Weenie(
        is_creature=bool(block.get("creature", 0)),
        is_player=bool(block.get("player", 0)),
        is_pk=bool(block.get("pk", 0)),
        is_pklite=bool(block.get("pklite", 0)),
        is_impenetrable=bool(block.get("impenetrable", 0)),
        can_bypass_move_restrictions=bool(block.get("bypass", 0)),
        id=object_id,
    )


def cylsphere(values: Sequence[float]) -> CylSphere:
    """Make a cylinder of x, y, z of its low point, radius, height."""
    return CylSphere(vector(values[:3]), height=f32(values[4]), radius=f32(values[3]))


def _part_array(
    block: Mapping[str, Any], geometries: Mapping[str, Geometry], pose: Position, scale: float
) -> PartArray:
    sorting = block.get("sorting_sphere")
    setup = Setup(
        cylsphere=tuple(cylsphere(values) for values in block.get("cylspheres", ())),
        sphere=tuple(sphere(values) for values in block.get("spheres", ())),
        sorting_sphere=None if sorting is None else sphere(sorting),
    )
    parts = [_part(part, geometries, pose, scale) for part in block.get("parts", ())]
    return PartArray(parts, setup, Vector3(scale, scale, scale))


def _part(
    part: Mapping[str, Any], geometries: Mapping[str, Geometry], pose: Position, scale: float
) -> PhysicsPart | None:
    """Make a part, which has the object's pose and scale unless it says otherwise; null has none."""
    if part["geometry"] is None:
        return None
    own_pose = position(part["pose"]) if "pose" in part else pose.copy()
    own_scale = f32(part["scale"]) if "scale" in part else scale
    gfxobj = oracle_geometry(geometries[part["geometry"]]).gfx_obj
    if part.get("no_physics", 0):
        drawn = part.get("drawing_sphere")
        gfxobj = GfxObj(
            None,
            bounding_box=gfxobj.bounding_box,
            drawing_sphere=None if drawn is None else sphere(drawn),
        )
    made = PhysicsPart(gfxobj, own_pose, Vector3(own_scale, own_scale, own_scale))
    if part.get("flat", 0):
        made.degrade_modes = (FLAT_PICTURE,)
    return made


def holder() -> PhysicsObj:
    """Make something that another object hangs on."""
    return PhysicsObj(HOLDER_ID, 0, Position(), scale=1.0, part_array=None)
