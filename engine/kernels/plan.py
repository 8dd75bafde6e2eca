"""The plan: what of a transition is left out, decided where it would begin (`engine.plan`).

A shortcut stands where retail's code does, asks the broad phase whether what follows is certain to find
nothing, and leaves in the row what the code would have left that it skips. What the skipped code may
besides have written is read by nobody: the spheres in the space of what was tested (``localspace_*`` are
read within a test of a tree, and by SPHEREPATH::set_walkable inside it, always after that test has put
them there), and the last point of contact.

The row's `PLAN` says which shortcuts may be taken, its `SKIPPED` counters how often each was.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import BOUND_CORNER, IS_VIEWER
from engine.kernels.broad import ball_beyond, bounds_of, listed_ball
from engine.kernels.cell_array import ints_of
from engine.kernels.compile import inlined, kernel
from engine.kernels.polygon import plane_distance
from engine.kernels.rounding import slack
from engine.kernels.vector import load
from engine.layout import (
    CHECK_POS,
    GLOBAL_SPHERE,
    LAND_TERRAIN,
    LOCAL_SPHERE,
    MATRIX,
    NUM_SPHERE,
    OI_STATE,
    ORIGIN,
    PLAN,
    PLAN_GROUND,
    PLAN_OBJECTS,
    RADIUS,
    SKIPPED_GROUND,
    SKIPPED_OBJECTS,
    SPHERE_SIZE,
    TERRAIN_POLYGON,
    WORLD_BUILDING_BOUNDS,
    WORLD_OBJECT_BOUNDS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints

_SECOND_SPHERE = GLOBAL_SPHERE + SPHERE_SIZE


@inlined
def allows(s: Array, stage: int) -> bool:
    """Say whether the row's plan has a shortcut."""
    return int(s[PLAN]) & stage != 0


@inlined
def _distance(x: float, y: float, z: float) -> float:
    return math.sqrt(x * x + y * y + z * z)


@inlined
def _sphere_reach(s: Array, number: int, x: float, y: float, z: float) -> float:
    """Return how far a centre of the mover's is from a point, wherever it is taken to be.

    In a sub-step the check position has turned already, but the global spheres have not (FT-9, FT-11): trees
    are tested with the one, shapes with the other.
    """
    at, m, o = GLOBAL_SPHERE + SPHERE_SIZE * number, CHECK_POS + MATRIX, CHECK_POS + ORIGIN
    lx, ly, lz = load(s, LOCAL_SPHERE + SPHERE_SIZE * number)
    tx = s[m] * lx + s[m + 3] * ly + s[m + 6] * lz + s[o] - x
    ty = s[m + 1] * lx + s[m + 4] * ly + s[m + 7] * lz + s[o + 1] - y
    tz = s[m + 2] * lx + s[m + 5] * ly + s[m + 8] * lz + s[o + 2] - z
    return max(_distance(s[at] - x, s[at + 1] - y, s[at + 2] - z), _distance(tx, ty, tz))


@kernel
def _clear_of(wf: Array, s: Array, ball: int) -> bool:
    """Say whether the mover at the check position is clear of a bounding ball.

    The spheres are bounded by one ball, with the larger of both radii for both: retail tests the second
    sphere of the mover with the radius of the first (07 2, 10.1); and it squares sums of radii, so that a
    negative one, which only the second may have, reaches as far as a positive one. And at the edge of a
    cylinder a sphere counts as if it were one, too: its corner is `BOUND_CORNER` radii from its centre.
    """
    x, y, z = load(s, GLOBAL_SPHERE)
    r = s[GLOBAL_SPHERE + RADIUS]
    two = s[NUM_SPHERE] > 1.0
    if two:
        x, y, z = (
            0.5 * (x + s[_SECOND_SPHERE]),
            0.5 * (y + s[_SECOND_SPHERE + 1]),
            0.5 * (z + s[_SECOND_SPHERE + 2]),
        )
        r = max(r, abs(s[_SECOND_SPHERE + RADIUS]))
    reach = _sphere_reach(s, 0, x, y, z)
    if two:
        reach = max(reach, _sphere_reach(s, 1, x, y, z))
    return ball_beyond(wf, ball, s[CHECK_POS], x, y, z, reach + BOUND_CORNER * r + slack(x, y, z))


@kernel
def objects_beyond(wf: Array, wi: Ints, s: Array, cell: int, count: int) -> bool:
    """Say whether none of a cell's `count` objects is in reach of the mover.

    CPhysicsObj::FindObjCollisions of such an object answers OK: its spheres and cylinders overlap neither
    sphere of the mover, and no sphere is near the physics sphere of a part. The only thing that it writes
    is ``obstruction_ethereal``, which it ends with as it was in a transition: 0.

    retail: CObjCell::find_obj_collisions 0x0052B750, 09 3.2
    """
    if count == 0 or not allows(s, PLAN_OBJECTS) or not _clear_of(wf, s, bounds_of(wi, cell)):
        return False
    s[SKIPPED_OBJECTS] += count
    return True


@kernel
def object_beyond(wf: Array, wi: Ints, s: Array, thing: int) -> bool:
    """Say the same of one object.

    retail: CPhysicsObj::FindObjCollisions 0x0050F050, 08 3
    """
    if not allows(s, PLAN_OBJECTS) or not _clear_of(wf, s, listed_ball(wi, WORLD_OBJECT_BOUNDS, thing)):
        return False
    s[SKIPPED_OBJECTS] += 1.0
    return True


@kernel
def building_beyond(wf: Array, wi: Ints, s: Array, building: int) -> bool:
    """Say the same of the outside of a house.

    Its test sets ``bldg_check`` and, with the answer OK, unsets it, and does nothing else.

    retail: CBuildingObj::find_building_collisions 0x006B5300, 09 3.7
    """
    if not allows(s, PLAN_OBJECTS) or not _clear_of(wf, s, listed_ball(wi, WORLD_BUILDING_BOUNDS, building)):
        return False
    s[SKIPPED_OBJECTS] += 1.0
    return True


@kernel
def ground_beyond(wf: Array, wi: Ints, s: Array, cell: int, bx: float, by: float) -> bool:
    """Say whether sphere 0 is clear above both triangles of a land cell, whichever it is tested against.

    `bx`, `by`: origin of the cell's block. OBJECTINFO::validate_walkable then finds a distance of more
    than EPS, to which the depth of water only adds, and answers OK before it writes anything, as retail
    does where the mover is over neither triangle. The camera's distance is another one (VW-1), and a block
    that is nothing but sea is a wall at any height (10, 7): neither is skipped; the caller has asked for the
    wall.

    retail: OBJECTINFO::validate_walkable 0x0050D010, VW-10...VW-12; CLandCell::find_env_collisions 0x00532F20
    """
    if not allows(s, PLAN_GROUND) or int(s[OI_STATE]) & IS_VIEWER:
        return False
    x, y, z = load(s, GLOBAL_SPHERE)
    x, y, z = x - bx, y - by, z - s[GLOBAL_SPHERE + RADIUS]
    poly = wi[ints_of(wi, cell) + LAND_TERRAIN]
    far = slack(x, y, z)
    if not plane_distance(wf, poly, x, y, z) > far:
        return False
    if not plane_distance(wf, poly + TERRAIN_POLYGON, x, y, z) > far:
        return False
    s[SKIPPED_GROUND] += 1.0
    return True
