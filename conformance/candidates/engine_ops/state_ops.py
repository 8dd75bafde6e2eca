"""Operations on the state of a transition, by the engine: from one slide to a whole collision call."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from conformance.candidates.dispatch_names import DISPATCH_NAMES
from conformance.candidates.engine_ops.not_askable import NotAskableError
from conformance.candidates.engine_ops.rows import numbers_of, query_row, take_path
from conformance.candidates.engine_ops.running import run
from conformance.candidates.engine_ops.state_block import state_block, walkable_geometry
from conformance.candidates.engine_ops.values import floats, numbers, position, vector
from conformance.candidates.engine_ops.world_cache import world_around, world_of
from engine import layout as at
from engine.constants import IS_VIEWER, STATE_NAMES
from engine.kernels import adjust, path, query, sphere
from engine.kernels import transition as transitions
from engine.kernels.position import position_get_offset as get_offset
from engine.kernels.program import COLLIDE, RESOLVE

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from engine.kernels.types import Array


def find_collisions(question: Query) -> Fields:
    """One call of a BSP tree, as a cell's or a static's, with the path state given."""
    inputs = question.inputs
    world = world_around(inputs, question.geometries[inputs["geometry"]])
    row = query_row(inputs, begin_cell=0)
    row["target_object"] = at.NO_OBJECT if inputs["as"] == "cell" else 0
    take_path(row, inputs["path"])
    result, trace = run(COLLIDE, world, row)
    outcome: Fields = {
        "dispatch": DISPATCH_NAMES[chr(int(result["dispatch"]))],
        "result": STATE_NAMES[int(result["result"])],
        "trace": trace,
    }
    return outcome | state_block(result, world)


def transition(question: Query) -> Fields:
    """One `find_valid_position` call."""
    inputs = question.inputs
    world = world_of(inputs["cells"], question.geometries)
    result, trace = run(RESOLVE, world, query_row(inputs, world.cell_index(inputs["begin_cell"])))
    outcome: Fields = {"result": int(result["result"]), "trace": trace}
    outcome |= state_block(result, world)
    geometry = walkable_geometry(result, world)
    if geometry is not None:
        outcome["walkable_geometry"] = geometry
    return outcome


def _at_check_pos(question: Query) -> Array:
    """Return a row of state at current position `from` and check position `to`, in no cell."""
    state = np.zeros(at.STATE_SIZE, dtype=np.float64)
    numbers = numbers_of(query_row(question.inputs))
    query.prepare(state, numbers)
    query.go_to_end(state, numbers, float(at.NO_CELL))
    return state


def _vector(state: Array, where: int) -> list[float]:
    return floats(state[where : where + at.VECTOR_SIZE])


def _centers(state: Array) -> list[list[float]]:
    count = int(state[at.NUM_SPHERE])
    return [_vector(state, at.GLOBAL_SPHERE + at.SPHERE_SIZE * i) for i in range(count)]


def _moved(state: Array) -> Fields:
    """Write what the single-step operations move."""
    valid = state[at.COLLISION_NORMAL_VALID] != 0.0
    return {
        "check_origin": _vector(state, at.CHECK_POS + at.ORIGIN),
        "global_spheres": _centers(state),
        "collision_normal": _vector(state, at.COLLISION_NORMAL) if valid else None,
        "sliding_valid": int(state[at.SLIDING_VALID]),
    }


def slide_sphere(question: Query) -> Fields:
    """`CSphere::slide_sphere` of sphere 0 with a given normal."""
    state = _at_check_pos(question)
    where = at.REQUESTED_NORMAL
    state[where : where + at.VECTOR_SIZE] = question.inputs["normal"]
    result = sphere.slide_sphere(state, where)
    outcome: Fields = {"result": STATE_NAMES[result], "normal": _vector(state, where)}
    return outcome | _moved(state)


def calc_num_steps(question: Query) -> Fields:
    """`CTransition::calc_num_steps` of a whole movement."""
    inputs = question.inputs
    if inputs["from"] is None:
        raise NotAskableError("the number of steps of a placement")
    state = np.zeros(at.STATE_SIZE, dtype=np.float64)
    query.prepare(state, numbers_of(query_row(inputs)))
    viewer = int(state[at.OI_STATE]) & IS_VIEWER != 0
    offset = get_offset(state, int(at.BEGIN_POS), state, int(at.END_POS))
    radius = state[at.LOCAL_SPHERE + at.RADIUS]
    *step, count = transitions.calc_num_steps(radius, viewer, *offset)
    return {"offset": list(offset), "step": step, "num_steps": int(count)}


def adjust_offset(question: Query) -> Fields:
    """`CTransition::adjust_offset` of a given offset."""
    state = _at_check_pos(question)
    outcome: Fields = {"offset": list(adjust.adjust_offset(state, *vector(question.inputs["offset"])))}
    return outcome | _moved(state)


def cliff_slide(question: Query) -> Fields:
    """`CTransition::cliff_slide` with a given new contact plane."""
    state = np.concatenate((_at_check_pos(question), numbers(question.inputs["plane"])))
    outcome: Fields = {"result": STATE_NAMES[adjust.cliff_slide(state, int(at.STATE_SIZE))]}
    return outcome | _moved(state)


def cache_localspace_sphere(question: Query) -> Fields:
    """`SPHEREPATH::cache_localspace_sphere` for a given pose and scale."""
    state = _at_check_pos(question)
    pose = position(question.inputs["pose"])
    path.cache_localspace_sphere(state, pose, 0, float(question.inputs["scale"]))
    spheres = range(int(state[at.NUM_SPHERE]))
    first = at.LOCALSPACE_SPHERE
    return {
        "spheres": [floats(state[first + 4 * i : first + 4 * i + at.SPHERE_SIZE]) for i in spheres],
        "curr": [_vector(state, at.LOCALSPACE_CURR_CENTER + 3 * i) for i in spheres],
        "z": _vector(state, at.LOCALSPACE_Z),
        "low_point": _vector(state, at.LOCALSPACE_LOW_POINT),
        "global_spheres": _centers(state),
        "global_curr": [_vector(state, at.GLOBAL_CURR_CENTER + 3 * i) for i in spheres],
    }


def set_check_pos(question: Query) -> Fields:
    """`SPHEREPATH::set_check_pos` for a position, the spheres of the current one beside it."""
    state = _at_check_pos(question)
    return {
        "global_spheres": _centers(state),
        "global_curr": [
            _vector(state, at.GLOBAL_CURR_CENTER + 3 * i) for i in range(int(state[at.NUM_SPHERE]))
        ],
        "low_point": _vector(state, at.GLOBAL_LOW_POINT),
    }


OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    "find_collisions": find_collisions,
    "transition": transition,
    "slide_sphere": slide_sphere,
    "calc_num_steps": calc_num_steps,
    "adjust_offset": adjust_offset,
    "cliff_slide": cliff_slide,
    "cache_localspace_sphere": cache_localspace_sphere,
    "set_check_pos": set_check_pos,
}
"""Operation name to function."""
