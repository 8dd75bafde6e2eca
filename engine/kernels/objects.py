"""Objects as obstacles (08): who is tested, against which shapes, and what an answer means.

A test of an object is in three parts, `begin_object`, `test_object_shape` for each of its shapes and
`accept_object`, because the answer of a shape may be that of a step up, which is run in between
(`engine.kernels.bsp_tree`). What an object is made of was decided when the world was compiled: it has
shapes of one family only.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine.constants import (
    CONTACT,
    ETHEREAL,
    IGNORE_COLLISIONS,
    IGNORE_CREATURES,
    INITIAL_PLACEMENT_INSERT,
    IS_IMPENETRABLE,
    IS_PK,
    IS_PKLITE,
    IS_PLAYER,
    IS_VIEWER,
    MISSILE,
    OK,
    STATIC,
    WEENIE_CREATURE,
    WEENIE_IMPENETRABLE,
    WEENIE_PK,
    WEENIE_PKLITE,
    WEENIE_PLAYER,
    frozen,
)
from engine.kernels.bsp_node import in_bounds
from engine.kernels.bsp_placement import placement_insert
from engine.kernels.bsp_tree import find_collisions
from engine.kernels.collision_info import add_object
from engine.kernels.compile import inlined, kernel
from engine.kernels.cylsphere import test_cylsphere
from engine.kernels.path import enter_localspace, entered_sphere
from engine.kernels.sphere_obstacle import test_sphere
from engine.layout import (
    COLLIDED_WITH_ENVIRONMENT,
    COLLISION_NORMAL_VALID,
    CYLSPHERE_SIZE,
    FAMILY_CYLSPHERES,
    FAMILY_PARTS,
    INSERT_TYPE,
    MOVER_MISSILE,
    NUM_SPHERE,
    OBJECT_COUNT,
    OBJECT_FAMILY,
    OBJECT_FIRST,
    OBJECT_FLOATS,
    OBJECT_ID,
    OBJECT_INTS,
    OBJECT_SCALE,
    OBJECT_STATE,
    OBJECT_WEENIE,
    OBJECTS_TESTED,
    OBSTRUCTION_ETHEREAL,
    OI_ETHEREAL,
    OI_STATE,
    PART_FLOATS,
    PART_INTS,
    PART_SCALE,
    PART_TREE,
    SPHERE_SIZE,
    STEP_DOWN,
    TARGET_ID,
    WORLD_OBJECT_FLOATS,
    WORLD_OBJECT_INTS,
    WORLD_PART_FLOATS,
    WORLD_PART_INTS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints

SKIPPED: Final = frozen(-1)
"""Answer of `begin_object` for an object that is passed over: nothing of the row has changed."""


@inlined
def _record(wi: Ints, thing: int) -> int:
    """Return where an object's integers lie."""
    return wi[WORLD_OBJECT_INTS] + OBJECT_INTS * thing


@inlined
def _passes_through(s: Array, state: int) -> bool:
    """Say whether mover or obstacle is ethereal, so that a touch is noted but does not block.

    retail: 08 3.3
    """
    return state & ETHEREAL != 0 or (s[OI_ETHEREAL] != 0.0 and state & STATIC == 0)


@inlined
def is_creature(wi: Ints, thing: int) -> bool:
    """Say whether an object counts as a creature, as a missile does.

    retail: 08 3.6
    """
    record = _record(wi, thing)
    return wi[record + OBJECT_STATE] & MISSILE != 0 or wi[record + OBJECT_WEENIE] & WEENIE_CREATURE != 0


@inlined
def _is_exempt(s: Array, weenie: int) -> bool:
    """Say whether mover and obstacle are players who may not fight each other.

    retail: 08 3.5
    """
    state = int(s[OI_STATE])
    if not (weenie & WEENIE_PLAYER and state & IS_PLAYER):
        return False
    if state & IS_IMPENETRABLE or weenie & WEENIE_IMPENETRABLE:
        return False
    return not (state & IS_PK and weenie & WEENIE_PK) and not (state & IS_PKLITE and weenie & WEENIE_PKLITE)


@inlined
def _missile_ignores(wi: Ints, s: Array, record: int) -> bool:
    """Say whether a missile is in play that takes no notice.

    retail: OBJECTINFO::missile_ignore 0x0050CEB0, 08 2
    """
    state, weenie = wi[record + OBJECT_STATE], wi[record + OBJECT_WEENIE]
    if state & MISSILE:
        return True
    if s[MOVER_MISSILE] == 0.0 or wi[record + OBJECT_ID] == int(s[TARGET_ID]):
        return False
    if state & ETHEREAL and weenie:
        return True
    return s[TARGET_ID] != 0.0 and weenie & WEENIE_CREATURE != 0


@kernel
def begin_object(wi: Ints, s: Array, thing: int) -> int:
    """Return how many shapes of an object are to be tested, or `SKIPPED`.

    retail: CPhysicsObj::FindObjCollisions 0x0050F050, 08 3.1-5, 3.7
    """
    record = _record(wi, thing)
    state, weenie = wi[record + OBJECT_STATE], wi[record + OBJECT_WEENIE]
    if state & ETHEREAL and state & IGNORE_COLLISIONS:
        return SKIPPED
    if int(s[OI_STATE]) & IS_VIEWER and weenie & WEENIE_CREATURE:
        return SKIPPED
    eth = _passes_through(s, state)
    if eth and s[STEP_DOWN] != 0.0:
        return SKIPPED
    s[OBSTRUCTION_ETHEREAL] = 1.0 if eth else 0.0
    s[OBJECTS_TESTED] += 1.0
    if _is_exempt(s, weenie) or _missile_ignores(wi, s, record):
        return 0
    return wi[record + OBJECT_COUNT]


@kernel
def test_object_shape(wf: Array, wi: Ints, s: Array, thing: int, shape: int) -> int:
    """Test the mover against one of an object's shapes; a TransitionState, or NEEDS_STEP_UP.

    retail: CPhysicsObj::FindObjCollisions 0x0050F050, 08 3.8
    """
    record = _record(wi, thing)
    family, first = wi[record + OBJECT_FAMILY], wi[record + OBJECT_FIRST]
    if family == FAMILY_PARTS:
        return test_part(wf, wi, s, first + shape)
    position = wi[WORLD_OBJECT_FLOATS] + OBJECT_FLOATS * thing
    scale = wf[position + OBJECT_SCALE]
    if family == FAMILY_CYLSPHERES:
        return test_cylsphere(wf, wi, s, position, scale, first + CYLSPHERE_SIZE * shape)
    return test_sphere(wf, wi, s, position, scale, first + SPHERE_SIZE * shape, is_creature(wi, thing))


@kernel
def accept_object(wi: Ints, s: Array, thing: int, ts: int) -> int:
    """Note what was touched; a touch that does not block turns into OK.

    retail: CPhysicsObj::FindObjCollisions 0x0050F050, 08 3.9-10
    """
    state = wi[_record(wi, thing) + OBJECT_STATE]
    if ts != OK and s[STEP_DOWN] == 0.0:
        if state & STATIC:
            if not int(s[OI_STATE]) & CONTACT:
                s[COLLIDED_WITH_ENVIRONMENT] = 1.0
        else:
            ignored = is_creature(wi, thing) and int(s[OI_STATE]) & IGNORE_CREATURES != 0
            if _passes_through(s, state) or ignored:
                ts = OK
                s[COLLISION_NORMAL_VALID] = 0.0
            add_object(wi, s, thing, ts)
    s[OBSTRUCTION_ETHEREAL] = 0.0
    return ts


@inlined
def _any_sphere_near(wf: Array, s: Array, root: int) -> bool:
    """Test every sphere against the part's physics sphere.

    retail: 08 7.2
    """
    for i in range(int(s[NUM_SPHERE])):
        x, y, z, r = entered_sphere(s, i)
        if in_bounds(wf, root, (x, y, z, r)):
            return True
    return False


@kernel
def test_part(wf: Array, wi: Ints, s: Array, part: int) -> int:
    """Test the mover against a part with a tree.

    retail: CPhysicsPart::find_obj_collisions 0x0050D8D0, CGfxObj::find_obj_collisions 0x00534700,
    08 6 and 7
    """
    position = wi[WORLD_PART_FLOATS] + PART_FLOATS * part
    root = wi[wi[WORLD_PART_INTS] + PART_INTS * part + PART_TREE]
    scale = wf[position + PART_SCALE]
    enter_localspace(s, wf, position, scale)
    if not _any_sphere_near(wf, s, root):
        return OK
    if s[INSERT_TYPE] == INITIAL_PLACEMENT_INSERT:
        return placement_insert(wf, wi, s, root)
    return find_collisions(wf, wi, s, root, scale)
