"""Static objects with a BSP-shaped part (08): who is tested, and what an answer means.

A test is in two halves, `test_object` and `accept_object`, because the answer may be that of a step
up, which is run in between (`engine.kernels.bsp_tree`). No object has a weenie, so the exemptions
among creatures and players never apply.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import (
    CONTACT,
    ETHEREAL,
    HAS_PHYSICS_BSP,
    IGNORE_COLLISIONS,
    INITIAL_PLACEMENT_INSERT,
    MISSILE,
    OK,
    STATIC,
)
from engine.kernels.bsp_node import in_bounds
from engine.kernels.bsp_placement import placement_insert
from engine.kernels.bsp_tree import find_collisions
from engine.kernels.collision_info import add_object
from engine.kernels.compile import inlined, pasted
from engine.kernels.path import cache_localspace_sphere
from engine.kernels.vector import load
from engine.layout import (
    COLLIDED_WITH_ENVIRONMENT,
    COLLISION_NORMAL_VALID,
    INSERT_TYPE,
    LOCALSPACE_SPHERE,
    NUM_SPHERE,
    OBJECT_FLOATS,
    OBJECT_INTS,
    OBJECT_SCALE,
    OBJECT_STATE,
    OBJECT_TREE,
    OBSTRUCTION_ETHEREAL,
    OI_ETHEREAL,
    OI_STATE,
    RADIUS,
    SPHERE_SIZE,
    STEP_DOWN,
    WORLD_OBJECT_FLOATS,
    WORLD_OBJECT_INTS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@inlined
def _state_of(wi: Ints, thing: int) -> int:
    """Return an object's PhysicsState."""
    return wi[wi[WORLD_OBJECT_INTS] + OBJECT_INTS * thing + OBJECT_STATE]


@inlined
def _passes_through(s: Array, state: int) -> bool:
    """Say whether mover or obstacle is ethereal, so that a touch is noted but does not block.

    retail: 08 3.3
    """
    return state & ETHEREAL != 0 or (s[OI_ETHEREAL] != 0.0 and state & STATIC == 0)


@pasted
def test_object(wf: Array, wi: Ints, s: Array, thing: int) -> int:
    """Test the mover against one object; a TransitionState, or NEEDS_STEP_UP.

    retail: CPhysicsObj::FindObjCollisions 0x0050F050, 08 3.1-8
    """
    state = _state_of(wi, thing)
    if state & ETHEREAL and state & IGNORE_COLLISIONS:
        return OK
    eth = _passes_through(s, state)
    if eth and s[STEP_DOWN] != 0.0:
        return OK
    s[OBSTRUCTION_ETHEREAL] = 1.0 if eth else 0.0
    if state & HAS_PHYSICS_BSP and not state & MISSILE:
        return _test_part(wf, wi, s, thing)
    return OK


@pasted
def accept_object(wi: Ints, s: Array, thing: int, ts: int) -> int:
    """Note what was touched; an ethereal obstacle turns into OK.

    retail: CPhysicsObj::FindObjCollisions 0x0050F050, 08 3.9-10
    """
    state = _state_of(wi, thing)
    if ts != OK and s[STEP_DOWN] == 0.0:
        if state & STATIC:
            if not int(s[OI_STATE]) & CONTACT:
                s[COLLIDED_WITH_ENVIRONMENT] = 1.0
        elif _passes_through(s, state):
            ts = OK
            s[COLLISION_NORMAL_VALID] = 0.0
            add_object(wi, s, thing, ts)
        else:
            add_object(wi, s, thing, ts)
    s[OBSTRUCTION_ETHEREAL] = 0.0
    return ts


@inlined
def _any_sphere_near(wf: Array, s: Array, root: int) -> bool:
    """Test every sphere against the part's physics sphere.

    retail: 08 7.2
    """
    for i in range(int(s[NUM_SPHERE])):
        at = LOCALSPACE_SPHERE + SPHERE_SIZE * i
        x, y, z = load(s, at)
        if in_bounds(wf, root, x, y, z, s[at + RADIUS]):
            return True
    return False


@pasted
def _test_part(wf: Array, wi: Ints, s: Array, thing: int) -> int:
    """Test the mover against an object's only part.

    retail: CPhysicsPart::find_obj_collisions 0x0050D8D0, CGfxObj::find_obj_collisions 0x00534700,
    08 6 and 7
    """
    position = wi[WORLD_OBJECT_FLOATS] + OBJECT_FLOATS * thing
    root = wi[wi[WORLD_OBJECT_INTS] + OBJECT_INTS * thing + OBJECT_TREE]
    scale = wf[position + OBJECT_SCALE]
    cache_localspace_sphere(s, wf, position, scale)
    if not _any_sphere_near(wf, s, root):
        return OK
    if s[INSERT_TYPE] == INITIAL_PLACEMENT_INSERT:
        return placement_insert(wf, wi, s, root)
    return find_collisions(wf, wi, s, root, scale)
