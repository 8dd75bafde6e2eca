"""A free flight from the row of a query to the row of its result, past the transition (`engine.plan`).

A transition prepares some three hundred numbers for whatever it may meet. Of a mover that meets nothing, from
begin to end of its way, a fifth is enough: the spheres, and where they come from and go to.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import CONTACT, EPS, EPS2, FLIGHT_STEPS, FREE_ROTATE, IS_VIEWER, ON_WALKABLE
from engine.kernels.ahead import bring_near
from engine.kernels.compile import inlined, kernel
from engine.kernels.frame import frame_cache, frame_interpolate_rotation
from engine.kernels.path import write_spheres
from engine.kernels.plan import allows
from engine.kernels.plan_flight import ball_about_way, cell_beyond, cell_holds, is_flown_through, turns
from engine.kernels.position import position_get_offset
from engine.kernels.query import init_spheres, load_pose
from engine.kernels.rounding import f32
from engine.kernels.transition import calc_num_steps
from engine.kernels.vector import copy, copy_four, copy_vector, load, store
from engine.layout import (
    CHECK_POS,
    COLLISION_INFO,
    CONTACT_IS_WATER,
    CONTACT_VALID,
    END_POS,
    FRAMES_STATIONARY_FALL,
    LAST_COLLIDED_OBJECT,
    LAST_KNOWN_VALID,
    NO_OBJECT,
    NODES_VISITED,
    NUM_COLLIDE_OBJECT,
    NUM_SPHERE,
    OBJECTS_TESTED,
    ORIGIN,
    PLAN_FLIGHT,
    POLYGONS_TESTED,
    POSE_ORIGIN,
    Q_BEGIN_CELL,
    Q_COLLISION_INFO,
    Q_END,
    Q_HAS_START,
    Q_NUM_SPHERE,
    Q_SCALE,
    Q_SPHERES,
    Q_START,
    Q_STATE,
    QUATERNION,
    R_CHECK,
    R_CHECK_CELL,
    R_COLLISION_INFO,
    R_CURR,
    R_CURR_CELL,
    R_DISPATCH,
    R_GLOBAL_SPHERES,
    R_HITS_INTERIOR_CELL,
    R_NODES_VISITED,
    R_NUM_SPHERE,
    R_POLYGONS_TESTED,
    R_RESULT,
    R_SKIPPED,
    R_STATE,
    R_WALKABLE,
    R_WALKABLE_SHAPE,
    RESULT_SIZE,
    SKIPPED,
    SKIPPED_FLIGHT,
    SLIDING_VALID,
    TRACE_LENGTH,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Quaternion, Vector

_Q = Q_COLLISION_INFO - COLLISION_INFO
"""From a field of COLLISIONINFO in a row of state to the same in a query's."""
_R = R_COLLISION_INFO - COLLISION_INFO
"""The same for a result's."""


@kernel
def fly_through(wf: Array, wi: Ints, s: Array, q: Array, out: Array, next_out: Array) -> bool:
    """Answer a query if it is a free flight all the way; say whether it was.

    It is one if the mover neither touches, slides along nor looks for anything, and the ball about its way
    (`ball_about_way`) is inside its cell and clear of everything: in every sub-step the cell contains its
    first sphere, which `fly` asks each time (OC-3). All that CTransition::find_transitional_position does
    then is to turn and to move (FT-8, FT-11), and to accept where the mover is (VT-3); as long as that is
    more than EPS away, VT-10 counts nothing. All other queries are left to it; what is written here into
    the row of state, it writes before it reads.

    retail: CTransition::find_transitional_position 0x0050BDF0, 05 2
    """
    cell = int(q[Q_BEGIN_CELL])
    if not _is_in_the_air(s, q) or not is_flown_through(wf, wi, cell, q[Q_START]):
        return False
    bring_near(next_out, 0, RESULT_SIZE)
    _take_off(s, q)
    turning = turns(s, CHECK_POS)
    if turning:
        frame_cache(s, END_POS)
    x, y, z = position_get_offset(s, CHECK_POS, s, END_POS)
    sx, sy, sz, steps = calc_num_steps(s, False, x, y, z)
    if not 0.0 < steps <= FLIGHT_STEPS or (sz * sz + sy * sy) + sx * sx < EPS2:
        return False
    cx, cy, cz, far = ball_about_way(s, CHECK_POS, turning, x, y, z)
    if not cell_holds(wf, wi, cell, cx, cy, cz, far) or not cell_beyond(wf, wi, s, cell, cx, cy, cz, far):
        return False
    if not _glide(s, q, sx, sy, sz, steps):
        return False
    s[SKIPPED_FLIGHT] = steps
    _land(s, q, out)
    return True


@inlined
def _is_in_the_air(s: Array, q: Array) -> bool:
    """Say whether a query is about a mover on its way through the air that notices nothing."""
    return (
        q[_Q + CONTACT_VALID] == 0.0
        and q[_Q + SLIDING_VALID] == 0.0
        and q[_Q + FRAMES_STATIONARY_FALL] == 0.0
        and q[Q_HAS_START] != 0.0
        and q[Q_NUM_SPHERE] >= 1.0
        and not int(q[Q_STATE]) & (CONTACT | IS_VIEWER | FREE_ROTATE)
        and allows(s, PLAN_FLIGHT)
    )


@inlined
def _take_off(s: Array, q: Array) -> None:
    """Set what of the row a flight reads, and its counters."""
    for i in range(NODES_VISITED, OBJECTS_TESTED + 1):
        s[i] = 0.0
    for i in range(SKIPPED, TRACE_LENGTH):
        s[i] = 0.0
    s[NUM_COLLIDE_OBJECT] = 0.0
    init_spheres(s, int(q[Q_NUM_SPHERE]), q, Q_SPHERES, q[Q_SCALE])
    load_pose(s, CHECK_POS, q, Q_START)
    s[END_POS] = q[Q_END]
    copy_four(s, END_POS + QUATERNION, q, Q_END + QUATERNION)
    copy_vector(s, END_POS + ORIGIN, q, Q_END + POSE_ORIGIN)


@inlined
def _glide(s: Array, q: Array, x: float, y: float, z: float, steps: float) -> bool:
    """Make sub-steps by x, y, z; say whether the mover has moved in each.

    retail: FT-8, FT-11; Frame::is_equal 0x00424C30, 04 3
    """
    o = CHECK_POS + ORIGIN
    i = 0.0
    while i < steps:
        i += 1.0
        frame_interpolate_rotation(s, CHECK_POS, q, Q_START, Q_END, f32(i / steps))
        ox, oy, oz = load(s, o)
        nx, ny, nz = f32(ox + x), f32(oy + y), f32(oz + z)
        if not (abs(nx - ox) > EPS or abs(ny - oy) > EPS or abs(nz - oz) > EPS):
            return False
        store(s, o, nx, ny, nz)
    return True


@inlined
def _write_pose(out: Array, pose: int, cell: float, turn: Quaternion, place: Vector) -> None:
    """Write a pose to a row of results."""
    out[pose] = cell
    out[pose + QUATERNION] = turn[0]
    store(out, pose + QUATERNION + 1, turn[1], turn[2], turn[3])
    store(out, pose + POSE_ORIGIN, place[0], place[1], place[2])


@inlined
def _land(s: Array, q: Array, out: Array) -> None:
    """Write the answer: where the mover is, and of the rest what a transition leaves that has met nothing.

    The position is read before anything is written: compiled code then has it at hand, and does not wait for
    what it has put into the row of state a moment ago.

    retail: VT-3, VT-11, VT-12
    """
    home = s[CHECK_POS]
    turn = s[CHECK_POS + QUATERNION], *load(s, CHECK_POS + QUATERNION + 1)
    place = load(s, CHECK_POS + ORIGIN)
    write_spheres(s, out, R_GLOBAL_SPHERES)
    for i in range(R_COLLISION_INFO, RESULT_SIZE):
        out[i] = 0.0
    out[R_RESULT] = 1.0
    out[R_DISPATCH] = 0.0
    _write_pose(out, R_CHECK, home, turn, place)
    _write_pose(out, R_CURR, home, turn, place)
    out[R_CHECK_CELL] = q[Q_BEGIN_CELL]
    out[R_CURR_CELL] = q[Q_BEGIN_CELL]
    out[R_NUM_SPHERE] = s[NUM_SPHERE]
    copy(out, _R + LAST_KNOWN_VALID + 1, q, _Q + LAST_KNOWN_VALID + 1, SLIDING_VALID - LAST_KNOWN_VALID - 1)
    out[_R + CONTACT_VALID] = 0.0
    out[_R + CONTACT_IS_WATER] = 0.0
    out[_R + LAST_COLLIDED_OBJECT] = NO_OBJECT
    out[R_WALKABLE] = -1.0
    out[R_WALKABLE_SHAPE] = -1.0
    out[R_HITS_INTERIOR_CELL] = 1.0
    out[R_STATE] = int(q[Q_STATE]) & ~(CONTACT | ON_WALKABLE)
    out[R_NODES_VISITED] = s[NODES_VISITED]
    out[R_POLYGONS_TESTED] = s[POLYGONS_TESTED]
    out[R_SKIPPED + SKIPPED_FLIGHT - SKIPPED] = s[SKIPPED_FLIGHT]
