"""Free flight: a move of which nothing is in reach, from its begin to its end (`engine.plan`)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import BOUND_CORNER, BOUND_ROUNDING, BOUND_TILT, FLIGHT_STEPS
from engine.kernels.broad import ball_beyond, bounds_of, fences_beyond, listed_ball, tree_beyond
from engine.kernels.cell_array import cell_id, ints_of, is_land, position_of
from engine.kernels.clearance import known_clear
from engine.kernels.compile import inlined, kernel
from engine.kernels.indexing import unsigned
from engine.kernels.plan import allows
from engine.kernels.plan_portals import list_alone
from engine.kernels.polygon import plane_distance
from engine.kernels.probing import stays_in_contact
from engine.kernels.rounding import slack
from engine.kernels.vector import load, load_four
from engine.layout import (
    BOUNDS_PASSABLE,
    CELL_ARRAY_VALID,
    CELL_OBJECT_COUNT,
    CELL_OBJECTS,
    CELL_PLANE_COUNT,
    CELL_PLANES,
    CELL_PORTAL_COUNT,
    CELL_TREE,
    CHECK_CELL,
    CONTACT_VALID,
    CURR_CELL,
    CURR_POS,
    END_POS,
    LOCAL_SPHERE,
    MATRIX,
    NO_CELL,
    NO_PORTALS,
    NO_TREE,
    NUM_SPHERE,
    ORIGIN,
    PLAN_FLIGHT,
    PLANE_SIZE,
    QUATERNION,
    SKIPPED_FLIGHT,
    SLIDING_VALID,
    SPHERE_SIZE,
    WORLD_OBJECT_BOUNDS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Quaternion, Sphere, Vector

_SECOND_SPHERE = LOCAL_SPHERE + SPHERE_SIZE
_TURNS = 3.0 * BOUND_TILT
"""How far, as a part of its distance from the origin, three rotations that are off unit length misplace a
sphere: the begin's, the end's, and what is between them."""


@inlined
def _length(x: float, y: float, z: float) -> float:
    return math.sqrt(x * x + y * y + z * z)


@inlined
def _turned(rotation: Quaternion, x: float, y: float, z: float) -> Vector:
    """Rotate a vector; no rounding is retail's."""
    w, i, j, k = rotation
    cx, cy, cz = 2.0 * (j * z - k * y), 2.0 * (k * x - i * z), 2.0 * (i * y - j * x)
    return x + w * cx + (j * cz - k * cy), y + w * cy + (k * cx - i * cz), z + w * cz + (i * cy - j * cx)


@kernel
def _objects_beyond(
    wf: Array, wi: Ints, cell: int, home: float, x: float, y: float, z: float, r: float
) -> bool:
    """Say whether spheres in a ball are clear of all objects of a cell, of cylinders' edges as well."""
    r *= BOUND_CORNER
    if ball_beyond(wf, bounds_of(wi, cell), home, x, y, z, r):
        return True
    first = wi[ints_of(wi, cell) + CELL_OBJECTS]
    for i in range(first, first + wi[ints_of(wi, cell) + CELL_OBJECT_COUNT]):
        if not ball_beyond(wf, listed_ball(wi, WORLD_OBJECT_BOUNDS, wi[i]), home, x, y, z, r):
            return False
    return True


@inlined
def into_cell(wf: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Take a point of a cell's block into its frame; no rounding is retail's."""
    m, o = unsigned(p + MATRIX), unsigned(p + ORIGIN)
    x, y, z = x - wf[o], y - wf[o + 1], z - wf[o + 2]
    return (
        wf[m] * x + wf[m + 1] * y + wf[m + 2] * z,
        wf[m + 3] * x + wf[m + 4] * y + wf[m + 5] * z,
        wf[m + 6] * x + wf[m + 7] * y + wf[m + 8] * z,
    )


@inlined
def _cell_rounding(wf: Array, p: int) -> float:
    """Return by how much roundings on the way into a cell's frame may misplace a point, metres."""
    o = unsigned(p + ORIGIN)
    return BOUND_ROUNDING * (abs(wf[o]) + abs(wf[o + 1]) + abs(wf[o + 2]))


@inlined
def _ball_into_cell(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float, r: float) -> Sphere:
    """Take a ball of a cell's block into the cell's frame, larger by what roundings may misplace it."""
    p = position_of(wi, cell)
    lx, ly, lz = into_cell(wf, p, x, y, z)
    return lx, ly, lz, r + _cell_rounding(wf, p)


@inlined
def cell_holds(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float, r: float) -> bool:
    """Say whether an environment cell contains all points of a ball of its block.

    retail: CEnvCell::point_in_cell 0x0052C300, 09 4.1
    """
    ints = ints_of(wi, cell)
    if wi[ints + CELL_PORTAL_COUNT] == NO_PORTALS:
        return False
    lx, ly, lz, far = _ball_into_cell(wf, wi, cell, x, y, z, r)
    first = wi[ints + CELL_PLANES]
    for i in range(wi[ints + CELL_PLANE_COUNT]):
        if not plane_distance(wf, first + PLANE_SIZE * i, lx, ly, lz) > far:
            return False
    return True


@inlined
def is_flown_through(wf: Array, wi: Ints, cell: int, home: float) -> bool:
    """Say whether an environment cell that a position is in may be flown through unseen."""
    return (
        cell != NO_CELL
        and not is_land(wi, cell)
        and cell_id(wf, wi, cell) == home
        and wf[bounds_of(wi, cell) + BOUNDS_PASSABLE] != 0.0
    )


@inlined
def _turn(begin: Quaternion, end: Quaternion, x: float, y: float, z: float) -> float:
    """Return how far a rotation from the begin's to the end's takes a sphere's centre from its place.

    It goes the shorter way about one axis, so that the centre is never farther from where the begin's
    rotation puts it than where the end's does.

    retail: Frame::interpolate_rotation 0x00535390, 01 4.8
    """
    ax, ay, az = _turned(begin, x, y, z)
    bx, by, bz = _turned(end, x, y, z)
    return _length(bx - ax, by - ay, bz - az)


@inlined
def ball_about_way(
    upright: bool,
    count: float,
    first: Sphere,
    second: Sphere,
    place: Vector,
    begin: Quaternion,
    end: Quaternion,
    way: Vector,
) -> Sphere:
    """Return a ball that the mover's spheres don't leave on their way.

    `upright`: whether all rotations are about the axis on which the spheres are (`engine.kernels.upright`);
    `count`: how many there are; `place`: where the mover's origin begins; `begin`, `end`: its rotations. The
    ball bounds the spheres wherever any of them is tested, in every rotation between both, and has all slack
    that there is to be. In the mover's frame its centre is in the middle of theirs.
    """
    lx, ly, lz, r = first
    x, y, z = way
    turning = not upright and begin != end
    spread, turn = 0.0, 0.0
    if turning:
        turn = _turn(begin, end, lx, ly, lz)
    if count > 1.0:
        ux, uy, uz, ur = second
        if turning:
            turn = max(turn, _turn(begin, end, ux, uy, uz))
        ux, uy, uz = 0.5 * (ux - lx), 0.5 * (uy - ly), 0.5 * (uz - lz)
        spread = _length(ux, uy, uz)
        lx, ly, lz = lx + ux, ly + uy, lz + uz
        r = max(r, abs(ur))
    turn += _TURNS * (spread + abs(lx) + abs(ly) + abs(lz))
    if not upright:
        lx, ly, lz = _turned(begin, lx, ly, lz)
    cx, cy, cz = place[0] + lx + 0.5 * x, place[1] + ly + 0.5 * y, place[2] + lz + 0.5 * z
    reach = (spread + r + turn + 0.5 * _length(x, y, z)) * (1.0 + BOUND_TILT)
    return cx, cy, cz, reach + slack(cx, cy, cz) + BOUND_ROUNDING * (abs(x) + abs(y) + abs(z))


@inlined
def opens_about(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float, r: float) -> bool:
    """Say whether a ball of an environment cell's block reaches no portal of the cell, and no object."""
    return fences_beyond(wf, wi, cell, x, y, z, r) and _objects_beyond(
        wf, wi, cell, cell_id(wf, wi, cell), x, y, z, r
    )


@inlined
def is_known_clear(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float, r: float) -> bool:
    """Say whether a ball of an environment cell's block is known to touch nothing of the cell's tree."""
    lx, ly, lz, far = _ball_into_cell(wf, wi, cell, x, y, z, r)
    return known_clear(wf, wi, cell, lx, ly, lz, far)


@kernel
def _ball_is_clear(
    wf: Array, wi: Ints, s: Array, cell: int, root: int, x: float, y: float, z: float, r: float
) -> bool:
    """Say whether a ball of an environment cell's block touches nothing of its tree, known or to be found."""
    lx, ly, lz, far = _ball_into_cell(wf, wi, cell, x, y, z, r)
    return known_clear(wf, wi, cell, lx, ly, lz, far) or tree_beyond(wf, wi, s, root, (lx, ly, lz, far))


@kernel
def is_clear(
    wf: Array,
    wi: Ints,
    s: Array,
    cell: int,
    count: float,
    first: Sphere,
    second: Sphere,
    place: Vector,
    begin: Quaternion,
    end: Quaternion,
    way: Vector,
) -> bool:
    """Say whether the mover's spheres touch nothing of an environment cell's tree on their way, each alone.

    To be asked of those about whom one ball is not known to be clear: two take less room. Each has the
    larger of both radii, as that ball has. All else as of `ball_about_way`.
    """
    root = wi[ints_of(wi, cell) + CELL_TREE]
    if root == NO_TREE:
        return True
    x, y, z, r = first
    ux, uy, uz, ur = second
    r = max(r, abs(ur)) if count > 1.0 else r
    cx, cy, cz, far = ball_about_way(False, 1.0, (x, y, z, r), second, place, begin, end, way)
    if not _ball_is_clear(wf, wi, s, cell, root, cx, cy, cz, far):
        return False
    if count < 2.0:
        return True
    cx, cy, cz, far = ball_about_way(False, 1.0, (ux, uy, uz, r), second, place, begin, end, way)
    return _ball_is_clear(wf, wi, s, cell, root, cx, cy, cz, far)


@kernel
def flies_freely(wf: Array, wi: Ints, s: Array, x: float, y: float, z: float, steps: float) -> bool:
    """Say whether nothing at all is in reach of a move by x, y, z, in so many sub-steps.

    Asked once, at the begin of CTransition::find_transitional_position. All sub-steps of a mover that has
    neither contact nor sliding plane go straight (AD-9), so that one ball bounds its spheres.

    retail: CTransition::find_transitional_position 0x0050BDF0, 05 2
    """
    cell = int(s[CURR_CELL])
    if s[CONTACT_VALID] != 0.0 or s[SLIDING_VALID] != 0.0 or not steps <= FLIGHT_STEPS:
        return False
    if (
        not allows(s, PLAN_FLIGHT)
        or not stays_in_contact(s)
        or not is_flown_through(wf, wi, cell, s[CURR_POS])
    ):
        return False
    count, first, second = s[NUM_SPHERE], load_four(s, LOCAL_SPHERE), load_four(s, _SECOND_SPHERE)
    place, way = load(s, CURR_POS + ORIGIN), (x, y, z)
    begin, end = load_four(s, CURR_POS + QUATERNION), load_four(s, END_POS + QUATERNION)
    cx, cy, cz, far = ball_about_way(False, count, first, second, place, begin, end, way)
    if not opens_about(wf, wi, cell, cx, cy, cz, far):
        return False
    return is_known_clear(wf, wi, cell, cx, cy, cz, far) or is_clear(
        wf, wi, s, cell, count, first, second, place, begin, end, way
    )


@kernel
def fly(wf: Array, wi: Ints, s: Array) -> bool:
    """Make one sub-step of a free flight in place of CTransition::transitional_insert; say whether it could.

    Of its steps TI-1 to TI-6 and TI-14, with nothing in reach: the tests of the cell's environment and
    objects answer OK, ``obstruction_ethereal`` stays 0, nothing is noted as struck (no landing, no
    polygon overlapped from behind), and the cell list is the cell alone. As long as that contains sphere 0
    (asked here, exactly), the mover stays in it (OC-3...OC-5 change neither cell nor position), and the
    insert answers OK. Otherwise nothing was done that the insert does not do again, and the flight is over:
    what is in reach of the mover in another cell, or off its way, was never asked.

    retail: CTransition::transitional_insert 0x0050B6F0, TI-1...TI-15
    """
    s[CELL_ARRAY_VALID] = 1.0
    if not stays_in_contact(s) or list_alone(wf, wi, s, int(s[CHECK_CELL])) == NO_CELL:
        return False
    s[SKIPPED_FLIGHT] += 1.0
    return True
