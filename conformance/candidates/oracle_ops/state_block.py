"""The state block of FORMAT.md: what a transition holds after a call."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.candidates.oracle_ops.values import nxyzd, quaternion, xyz

if TYPE_CHECKING:
    from collections.abc import Iterable

    from conformance.query import Fields
    from conformance.scenes.model import Geometry
    from oracle.collision_info import CollisionInfo
    from oracle.obj_cell import ObjCell
    from oracle.plane import Plane
    from oracle.polygon import Polygon
    from oracle.position import Position
    from oracle.transition import Transition
    from oracle.vector import Vector3


def pose_block(p: Position) -> dict[str, Any]:
    """Write a POSE."""
    f = p.frame
    return {"cell": p.objcell_id, "origin": xyz(f.origin), "rotation": quaternion(f)}


def centers(transition: Transition) -> list[list[float]]:
    """Write the centres of the check position's spheres."""
    sp = transition.sphere_path
    return [xyz(sphere.center) for sphere in sp.global_sphere[: sp.num_sphere]]


def valid_normal(valid: int, normal: Vector3) -> list[float] | None:
    """Write a normal, or null if it is not valid."""
    return xyz(normal) if valid else None


def state_block(transition: Transition) -> Fields:
    """Write everything that FORMAT.md lists, except the trace and `walkable_geometry`."""
    sp, ci, oi = transition.sphere_path, transition.collision_info, transition.object_info
    block: Fields = {
        "check": pose_block(sp.check_pos),
        "curr": pose_block(sp.curr_pos),
        "check_cell": _cell_id(sp.check_cell),
        "curr_cell": _cell_id(sp.curr_cell),
        "global_spheres": centers(transition),
        "contact_plane": _plane_block(
            ci.contact_plane_valid, ci.contact_plane, ci.contact_plane_cell_id, ci.contact_plane_is_water
        ),
        "last_known_contact_plane": _plane_block(
            ci.last_known_contact_plane_valid,
            ci.last_known_contact_plane,
            ci.last_known_contact_plane_cell_id,
            ci.last_known_contact_plane_is_water,
        ),
        "collision_normal": valid_normal(ci.collision_normal_valid, ci.collision_normal),
        "sliding_normal": valid_normal(ci.sliding_normal_valid, ci.sliding_normal),
        "walkable": None if sp.walkable is None else sp.walkable.poly_id,
        "walk_interp": sp.walk_interp,
        "walkable_allowance": sp.walkable_allowance,
        "collide": sp.collide,
        "step_up": sp.step_up,
        "step_up_normal": xyz(sp.step_up_normal),
        "neg_poly_hit": sp.neg_poly_hit,
    }
    if sp.neg_poly_hit:
        block |= {"neg_step_up": sp.neg_step_up, "neg_normal": xyz(sp.neg_collision_normal)}
    return block | {
        "frames_stationary_fall": ci.frames_stationary_fall,
        "collided_with_environment": ci.collided_with_environment,
        "state": oi.state,
        "kill_velocity": oi.mover().kill_velocity_calls,
    }


def touched_block(transition: Transition) -> Fields:
    """Write what the state block has besides where there are objects."""
    sp, ci = transition.sphere_path, transition.collision_info
    last = ci.last_collided_object
    return {
        "collide_objects": [touched.id for touched in ci.collide_object],
        "last_collided": 0 if last is None else last.id,
        "obstruction_ethereal": sp.obstruction_ethereal,
        "hits_interior_cell": sp.hits_interior_cell,
    }


def traced_state(transition: Transition) -> Fields:
    """Write the trace and the state block."""
    trace: Fields = {"trace": "".join(transition.trace or ())}
    return trace | state_block(transition)


def geometry_of(polygon: Polygon, geometries: Iterable[Geometry]) -> str:
    """Return the name of the geometry that a polygon belongs to.

    Raises
    ------
    LookupError
        It belongs to none of them.
    """
    for geometry in geometries:
        if any(polygon is own for own in oracle_geometry(geometry).polygons):
            return geometry.name
    message = f"polygon {polygon.poly_id} belongs to no geometry of the query"
    raise LookupError(message)


def _cell_id(cell: ObjCell | None) -> int:
    return 0 if cell is None else cell.id


def _plane_block(valid: int, plane: Plane, cell_id: int, is_water: int) -> dict[str, Any]:
    if not valid:
        return {"valid": 0}
    return {
        "valid": 1,
        "plane": nxyzd(plane),
        "cell_id": cell_id,
        "is_water": is_water,
    }


def struck(ci: CollisionInfo) -> Fields:
    """Write what a tick of a walk has hit, under the short keys of walks; what was not hit is left out."""
    fields: Fields = {}
    if ci.collision_normal_valid:
        fields["cn"] = xyz(ci.collision_normal)
    if ci.frames_stationary_fall:
        fields["fsf"] = ci.frames_stationary_fall
    if ci.collided_with_environment:
        fields["env"] = 1
    return fields


def touched_objects(ci: CollisionInfo) -> Fields:
    """Write the objects that a tick of a walk in a world has touched; no key without any."""
    return {"objs": [touched.id for touched in ci.collide_object]} if ci.collide_object else {}
