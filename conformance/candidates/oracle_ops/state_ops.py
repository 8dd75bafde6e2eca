"""Operations on the state of a transition: from one slide to a whole `find_valid_position`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.dispatch_names import DISPATCH_NAMES
from conformance.candidates.oracle_ops.blocks import at_check_pos, take_mover, take_path, take_seed
from conformance.candidates.oracle_ops.geometry import oracle_geometry
from conformance.candidates.oracle_ops.scene import build_world
from conformance.candidates.oracle_ops.state_block import (
    centers,
    geometry_of,
    traced_state,
    valid_normal,
)
from conformance.candidates.oracle_ops.values import plane, position, vector, xyz
from oracle import trace
from oracle.arithmetic import f32
from oracle.enums import InsertType
from oracle.transition import Transition
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Query
    from oracle.physics_object import PhysicsObj
    from oracle.physics_part import PhysicsPart

STATIC_WITH_BSP: Final = 0x10001
"""PhysicsState of the static that a ``find_collisions`` query puts its geometry into."""


def find_collisions(query: Query) -> Fields:
    """One call of a BSP tree, as a cell's or a static's, with the path state given."""
    inputs = query.inputs
    as_static = inputs["as"] == "static"
    world = build_world([_only_cell(inputs, as_static=as_static)], query.geometries)
    cell = world.cells[inputs["pose"]["cell"]]
    transition = at_check_pos(inputs, world, cell, trace_to=[])
    path = transition.sphere_path
    take_path(transition, inputs["path"])
    tree = oracle_geometry(query.geometries[inputs["geometry"]]).tree
    if as_static:
        _static_part(cell.shadow_object_list[0]).cache_local_space(path)
    else:
        cell.cache_local_space(path)
    if path.insert_type == InsertType.INITIAL_PLACEMENT:
        letter = trace.initial_placement(transition)
        result = tree.placement_insert(transition)
    else:
        letter = trace.dispatch(transition)
        result = tree.find_collisions(transition, f32(inputs["scale"]))
    outcome: Fields = {"dispatch": DISPATCH_NAMES[letter], "result": result.name}
    return outcome | traced_state(transition)


def transition(query: Query) -> Fields:
    """One `find_valid_position` call."""
    inputs = query.inputs
    world = build_world(inputs["cells"], query.geometries)
    end = position(inputs["to"])
    begin = None if inputs["from"] is None else position(inputs["from"])
    made = Transition(world, trace=[])
    take_mover(made, inputs["mover"], end if begin is None else begin)
    take_seed(made, inputs["seed"])
    made.sphere_path.placement_allows_sliding = inputs.get("placement_allows_sliding", 1)
    made.init_path(world.cells[inputs["begin_cell"]], begin, end)
    outcome: Fields = {"result": made.find_valid_position()}
    outcome |= traced_state(made)
    walkable = made.sphere_path.walkable
    if walkable is not None:
        outcome["walkable_geometry"] = geometry_of(walkable, query.geometries.values())
    return outcome


def slide_sphere(query: Query) -> Fields:
    """`CSphere::slide_sphere` of sphere 0 with a given normal."""
    made = _nowhere(query.inputs)
    sp = made.sphere_path
    normal = vector(query.inputs["normal"])
    result = sp.global_sphere[0].slide_sphere(sp, made.collision_info, normal, sp.global_curr_center[0])
    outcome: Fields = {"result": result.name, "normal": xyz(normal)}
    return outcome | _moved(made)


def adjust_offset(query: Query) -> Fields:
    """`CTransition::adjust_offset` of a given offset."""
    made = _nowhere(query.inputs)
    offset = made.adjust_offset(vector(query.inputs["offset"]))
    outcome: Fields = {"offset": xyz(offset)}
    return outcome | _moved(made)


def cliff_slide(query: Query) -> Fields:
    """`CTransition::cliff_slide` with a given new contact plane."""
    made = _nowhere(query.inputs)
    outcome: Fields = {"result": made.cliff_slide(plane(query.inputs["plane"])).name}
    return outcome | _moved(made)


def calc_num_steps(query: Query) -> Fields:
    """`CTransition::calc_num_steps` from a position, or from none."""
    inputs = query.inputs
    made, end = Transition(World()), position(inputs["to"])
    begin = None if inputs["from"] is None else position(inputs["from"])
    take_mover(made, inputs["mover"], end)
    made.init_path(None, begin, end)
    offset, step, num_steps = made.calc_num_steps()
    return {"offset": xyz(offset), "step": xyz(step), "num_steps": num_steps}


def cache_localspace_sphere(query: Query) -> Fields:
    """`SPHEREPATH::cache_localspace_sphere` for a given pose and scale."""
    made = _nowhere(query.inputs)
    sp = made.sphere_path
    sp.cache_localspace_sphere(position(query.inputs["pose"]), f32(query.inputs["scale"]))
    count = sp.num_sphere
    return {
        "spheres": [[*xyz(s.center), s.radius] for s in sp.localspace_sphere[:count]],
        "curr": [xyz(c) for c in sp.localspace_curr_center[:count]],
        "z": xyz(sp.localspace_z),
        "low_point": xyz(sp.localspace_low_point),
        "global_spheres": centers(made),
        "global_curr": [xyz(c) for c in sp.global_curr_center[:count]],
    }


def set_check_pos(query: Query) -> Fields:
    """`SPHEREPATH::set_check_pos` for a position, the spheres of the current one beside it."""
    made = _nowhere(query.inputs)
    sp = made.sphere_path
    return {
        "global_spheres": centers(made),
        "global_curr": [xyz(c) for c in sp.global_curr_center[: sp.num_sphere]],
        "low_point": xyz(sp.global_low_point),
    }


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "find_collisions": find_collisions,
    "transition": transition,
    "slide_sphere": slide_sphere,
    "adjust_offset": adjust_offset,
    "cliff_slide": cliff_slide,
    "cache_localspace_sphere": cache_localspace_sphere,
    "calc_num_steps": calc_num_steps,
    "set_check_pos": set_check_pos,
}


def _only_cell(inputs: Mapping[str, Any], *, as_static: bool) -> dict[str, Any]:
    """Write the CELLS entry of the one cell of a ``find_collisions`` query."""
    pose = inputs["pose"]
    cell = {"id": pose["cell"], "pose": pose, "geometry": None if as_static else inputs["geometry"]}
    if as_static:
        static = {"geometry": inputs["geometry"], "pose": pose, "scale": inputs["scale"]}
        cell["statics"] = [static | {"state": STATIC_WITH_BSP}]
    return cell


def _nowhere(inputs: Mapping[str, Any]) -> Transition:
    return at_check_pos(inputs, World(), None, trace_to=None)


def _static_part(obstacle: PhysicsObj) -> PhysicsPart:
    """Return the only part of an object that `static_object` made."""
    parts = obstacle.part_array.parts if obstacle.part_array is not None else []
    (part,) = parts
    if part is None:
        raise TypeError("a static's part is missing")
    return part


def _moved(made: Transition) -> Fields:
    """Write what the single-step operations move."""
    ci = made.collision_info
    return {
        "check_origin": xyz(made.sphere_path.check_pos.frame.origin),
        "global_spheres": centers(made),
        "collision_normal": valid_normal(ci.collision_normal_valid, ci.collision_normal),
        "sliding_valid": ci.sliding_normal_valid,
    }
