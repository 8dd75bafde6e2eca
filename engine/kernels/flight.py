"""A free flight from the row of a query to the row of its result, past the transition (`engine.plan`).

A transition prepares some three hundred numbers for whatever it may meet. Of a mover that meets nothing, from
begin to end of its way, a fifth is enough: the spheres, and where they come from and go to.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import CONTACT, EPS, EPS2, FLIGHT_STEPS, FREE_ROTATE, IS_VIEWER, ON_WALKABLE
from engine.kernels.ahead import bring_to_write
from engine.kernels.compile import inlined, kernel
from engine.kernels.fours import FOUR, move_four, put_four
from engine.kernels.frame import interpolated, is_unit, matrix_of, normalised
from engine.kernels.path import placed
from engine.kernels.plan import allows
from engine.kernels.plan_flight import (
    ball_about_way,
    cell_holds,
    is_clear,
    is_flown_through,
    is_known_clear,
    opens_about,
)
from engine.kernels.position import offset_between
from engine.kernels.rounding import f32
from engine.kernels.transition import calc_num_steps
from engine.kernels.upright import held_upright, is_off_zero, is_upright, placed_upright
from engine.kernels.vector import load, load_four
from engine.layout import (
    COLLISION_INFO,
    CONTACT_IS_WATER,
    CONTACT_VALID,
    FRAMES_STATIONARY_FALL,
    LAST_COLLIDED_OBJECT,
    LAST_KNOWN_VALID,
    NO_OBJECT,
    NODES_VISITED,
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
    SPHERE_SIZE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Quaternion, Sphere, Vector

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
    more than EPS away, VT-10 counts nothing. All other queries are left to it, which writes all that may
    have been written here.

    retail: CTransition::find_transitional_position 0x0050BDF0, 05 2
    """
    cell = int(q[Q_BEGIN_CELL])
    if not _is_in_the_air(s, q) or not is_flown_through(wf, wi, cell, q[Q_START]):
        return False
    bring_to_write(next_out, 0, RESULT_SIZE)
    # Told apart only once: of either kind, compiled code has its own.
    if is_upright(q):
        return _fly(wf, wi, s, q, out, cell, True)
    return _fly(wf, wi, s, q, out, cell, False)


@inlined
def _fly(wf: Array, wi: Ints, s: Array, q: Array, out: Array, cell: int, upright: bool) -> bool:
    """Make a flight, if it is one; say whether it was.

    Of the rotations only the last one is made, at its end: it depends on none before it unless it is not
    valid. The clearance is asked for first, and what it says looked at last, when the answer is written: both
    take long, and neither has to wait for the other.

    retail: FT-8, FT-11
    """
    begin, end = load_four(q, Q_START + QUATERNION), load_four(q, Q_END + QUATERNION)
    place = load(q, Q_START + POSE_ORIGIN)
    x, y, z = offset_between(q[Q_START], place, q[Q_END], load(q, Q_END + POSE_ORIGIN))
    count, first, second = _spheres(q, upright)
    sx, sy, sz, steps = calc_num_steps(first[3], False, x, y, z)
    if not 0.0 < steps <= FLIGHT_STEPS or (sz * sz + sy * sy) + sx * sx < EPS2:
        return False
    way = x, y, z
    cx, cy, cz, far = ball_about_way(upright, count, first, second, place, begin, end, way)
    if not cell_holds(wf, wi, cell, cx, cy, cz, far) or not opens_about(wf, wi, cell, cx, cy, cz, far):
        return False
    known = is_known_clear(wf, wi, cell, cx, cy, cz, far)
    turn = held_upright(begin, end) if upright else normalised(interpolated(begin, end, 1.0))
    moved, there = _glide(place, sx, sy, sz, steps)
    if not moved or not is_unit(turn):
        return False
    _write_spheres(upright, out, turn, there, count, first, second)
    _land(q, out, count, steps, turn, there)
    return known or _is_found_clear(wf, wi, s, q, out, cell)


@kernel
def _is_found_clear(wf: Array, wi: Ints, s: Array, q: Array, out: Array, cell: int) -> bool:
    """Say whether a mover's way is clear of which that is not known at once, and write what that has cost.

    All is taken from the query once more: it is seldom asked for, and kept in registers it would be in the
    way of all others.
    """
    s[NODES_VISITED] = 0.0
    s[POLYGONS_TESTED] = 0.0
    place, end = load(q, Q_START + POSE_ORIGIN), load(q, Q_END + POSE_ORIGIN)
    way = offset_between(q[Q_START], place, q[Q_END], end)
    count, first, second = _spheres(q, False)
    turns = load_four(q, Q_START + QUATERNION), load_four(q, Q_END + QUATERNION)
    clear = is_clear(wf, wi, s, cell, count, first, second, place, turns[0], turns[1], way)
    out[R_NODES_VISITED] = s[NODES_VISITED]
    out[R_POLYGONS_TESTED] = s[POLYGONS_TESTED]
    return clear


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
def _sphere(q: Array, at: int, upright: bool) -> Sphere:
    """Return one of the mover's spheres, scaled.

    retail: SPHEREPATH::init_sphere 0x0050C670, SPI-1, SPI-2
    """
    scale = q[Q_SCALE]
    x, y, z, r = load_four(q, at)
    if upright:
        return 0.0, 0.0, f32(scale * z), f32(scale * r)
    return f32(scale * x), f32(scale * y), f32(scale * z), f32(scale * r)


@inlined
def _spheres(q: Array, upright: bool) -> tuple[float, Sphere, Sphere]:
    """Return how many spheres the mover has, one or two, and both that it may have."""
    count = 2.0 if q[Q_NUM_SPHERE] >= 2.0 else 1.0
    return count, _sphere(q, Q_SPHERES, upright), _sphere(q, Q_SPHERES + SPHERE_SIZE, upright)


@inlined
def _glide(place: Vector, x: float, y: float, z: float, steps: float) -> tuple[bool, Vector]:
    """Make sub-steps by x, y, z; say whether the mover has moved in each, and where it is.

    retail: FT-11; Frame::is_equal 0x00424C30, 04 3
    """
    ox, oy, oz = place
    moved = True
    i = 0.0
    while i < steps:
        i += 1.0
        nx, ny, nz = f32(ox + x), f32(oy + y), f32(oz + z)
        moved = moved and (abs(nx - ox) > EPS or abs(ny - oy) > EPS or abs(nz - oz) > EPS)
        ox, oy, oz = nx, ny, nz
    return moved, (ox, oy, oz)


@inlined
def _write_pose(out: Array, pose: int, cell: float, turn: Quaternion, place: Vector) -> None:
    """Write a pose to a row of results."""
    put_four(out, pose, cell, turn[0], turn[1], turn[2])
    put_four(out, pose + FOUR, turn[3], place[0], place[1], place[2])


@inlined
def _placed(upright: bool, turn: Quaternion, place: Vector, x: float, y: float, z: float) -> Vector:
    """Return where a sphere's centre is."""
    if upright and is_off_zero(place):
        return placed_upright(place, z)
    return placed(matrix_of(turn), place, x, y, z)


@inlined
def _write_spheres(
    upright: bool, out: Array, turn: Quaternion, place: Vector, count: float, first: Sphere, second: Sphere
) -> None:
    """Write where the spheres are; zeros for one that is not.

    All is computed before any of it is written: compiled code cannot know that `out` is not what is read.
    """
    x, y, z = _placed(upright, turn, place, first[0], first[1], first[2])
    ux, uy, uz, ur = 0.0, 0.0, 0.0, 0.0
    if count > 1.0:
        ux, uy, uz = _placed(upright, turn, place, second[0], second[1], second[2])
        ur = second[3]
    put_four(out, R_GLOBAL_SPHERES, x, y, z, first[3])
    put_four(out, R_GLOBAL_SPHERES + SPHERE_SIZE, ux, uy, uz, ur)


@inlined
def _copy_planes(q: Array, out: Array) -> None:
    """Hand on what the mover knows of contact planes: all that is before the sliding normal."""
    last = SLIDING_VALID - FOUR
    for i in range(LAST_KNOWN_VALID, last, FOUR):
        move_four(out, _R + i, q, _Q + i)
    move_four(out, _R + last, q, _Q + last)


@inlined
def _land(q: Array, out: Array, count: float, steps: float, turn: Quaternion, place: Vector) -> None:
    """Write the answer: where the mover is, and of the rest what a transition leaves that has met nothing.

    retail: VT-3, VT-11, VT-12
    """
    home, cell = q[Q_START], q[Q_BEGIN_CELL]
    for i in range(_R + SLIDING_VALID, RESULT_SIZE):
        out[i] = 0.0
    out[R_RESULT] = 1.0
    out[R_DISPATCH] = 0.0
    _write_pose(out, R_CHECK, home, turn, place)
    _write_pose(out, R_CURR, home, turn, place)
    out[R_CHECK_CELL] = cell
    out[R_CURR_CELL] = cell
    out[R_NUM_SPHERE] = count
    _copy_planes(q, out)
    out[_R + LAST_KNOWN_VALID] = 0.0
    out[_R + CONTACT_VALID] = 0.0
    out[_R + CONTACT_IS_WATER] = 0.0
    out[_R + LAST_COLLIDED_OBJECT] = NO_OBJECT
    out[R_WALKABLE] = -1.0
    out[R_WALKABLE_SHAPE] = -1.0
    out[R_HITS_INTERIOR_CELL] = 1.0
    out[R_STATE] = int(q[Q_STATE]) & ~(CONTACT | ON_WALKABLE)
    out[R_SKIPPED + SKIPPED_FLIGHT - SKIPPED] = steps
