"""Free flight: a move of which nothing is in reach, from its begin to its end (`engine.plan`)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import BOUND_ROUNDING, BOUND_TILT, FLIGHT_STEPS
from engine.kernels.broad import ball_beyond, bounds_of, fences_beyond, listed_ball, slack, tree_beyond
from engine.kernels.cell_array import cell_id, ints_of, is_land, position_of
from engine.kernels.compile import inlined, kernel
from engine.kernels.plan import allows
from engine.kernels.plan_portals import list_alone
from engine.kernels.probing import stays_in_contact
from engine.kernels.vector import load
from engine.layout import (
    BOUNDS_PASSABLE,
    CELL_ARRAY_VALID,
    CELL_OBJECT_COUNT,
    CELL_OBJECTS,
    CELL_TREE,
    CHECK_CELL,
    CONTACT_VALID,
    CURR_CELL,
    CURR_POS,
    END_POS,
    LOCAL_SPHERE,
    MATRIX,
    NO_CELL,
    NO_TREE,
    NUM_SPHERE,
    ORIGIN,
    PLAN_FLIGHT,
    RADIUS,
    SKIPPED_FLIGHT,
    SLIDING_VALID,
    SPHERE_SIZE,
    WORLD_OBJECT_BOUNDS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Vector

_TURNS = 3.0 * BOUND_TILT
"""How far, as a part of its distance from the origin, three rotations that are off unit length misplace a
sphere: the begin's, the end's, and what is between them."""


@inlined
def _length(x: float, y: float, z: float) -> float:
    return math.sqrt(x * x + y * y + z * z)


@inlined
def _turned(s: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Rotate a vector out of a position of the row; no rounding is retail's."""
    m = p + MATRIX
    return (
        s[m] * x + s[m + 3] * y + s[m + 6] * z,
        s[m + 1] * x + s[m + 4] * y + s[m + 7] * z,
        s[m + 2] * x + s[m + 5] * y + s[m + 8] * z,
    )


@inlined
def _sphere_reach(s: Array, sphere: int, x: float, y: float, z: float) -> float:
    """Return how far a sphere of the mover reaches from x, y, z, a point that moves with it.

    Between begin and end the rotation goes the shorter way about one axis, so that a centre is never
    farther from where the begin's rotation puts it than where the end's does.

    retail: Frame::interpolate_rotation 0x00535390, 01 4.8
    """
    lx, ly, lz = load(s, sphere)
    ax, ay, az = _turned(s, CURR_POS, lx, ly, lz)
    bx, by, bz = _turned(s, END_POS, lx, ly, lz)
    turn = _length(bx - ax, by - ay, bz - az) + _TURNS * _length(lx, ly, lz)
    return _length(ax - x, ay - y, az - z) + turn + s[sphere + RADIUS]


@inlined
def _middle(s: Array) -> Vector:
    """Return the middle of the spheres' centres, from the mover's origin, as the begin's rotation has it."""
    x, y, z = load(s, LOCAL_SPHERE)
    if s[NUM_SPHERE] > 1.0:
        ux, uy, uz = load(s, LOCAL_SPHERE + SPHERE_SIZE)
        x, y, z = 0.5 * (x + ux), 0.5 * (y + uy), 0.5 * (z + uz)
    return _turned(s, CURR_POS, x, y, z)


@kernel
def _objects_beyond(
    wf: Array, wi: Ints, cell: int, home: float, x: float, y: float, z: float, r: float
) -> bool:
    """Say whether a ball is clear of all objects of a cell."""
    if ball_beyond(wf, bounds_of(wi, cell), home, x, y, z, r):
        return True
    first = wi[ints_of(wi, cell) + CELL_OBJECTS]
    for i in range(first, first + wi[ints_of(wi, cell) + CELL_OBJECT_COUNT]):
        if not ball_beyond(wf, listed_ball(wi, WORLD_OBJECT_BOUNDS, wi[i]), home, x, y, z, r):
            return False
    return True


@kernel
def _cell_beyond(wf: Array, wi: Ints, s: Array, cell: int, x: float, y: float, z: float, r: float) -> bool:
    """Say whether a ball of an environment cell's block touches nothing in the cell, and no portal."""
    if not fences_beyond(wf, wi, cell, x, y, z, r):
        return False
    if not _objects_beyond(wf, wi, cell, cell_id(wf, wi, cell), x, y, z, r):
        return False
    root = wi[ints_of(wi, cell) + CELL_TREE]
    if root == NO_TREE:
        return True
    m, o = position_of(wi, cell) + MATRIX, position_of(wi, cell) + ORIGIN
    dx, dy, dz = x - wf[o], y - wf[o + 1], z - wf[o + 2]
    lx = wf[m] * dx + wf[m + 1] * dy + wf[m + 2] * dz
    ly = wf[m + 3] * dx + wf[m + 4] * dy + wf[m + 5] * dz
    lz = wf[m + 6] * dx + wf[m + 7] * dy + wf[m + 8] * dz
    return tree_beyond(
        wf, wi, s, root, lx, ly, lz, r + BOUND_ROUNDING * (abs(wf[o]) + abs(wf[o + 1]) + abs(wf[o + 2]))
    )


@inlined
def _is_in_the_air(wf: Array, wi: Ints, s: Array, cell: int) -> bool:
    """Say whether a mover neither touches nor looks for anything, and where it is can be flown through."""
    return (
        s[CONTACT_VALID] == 0.0
        and s[SLIDING_VALID] == 0.0
        and stays_in_contact(s)
        and cell != NO_CELL
        and not is_land(wi, cell)
        and cell_id(wf, wi, cell) == s[CURR_POS]
        and wf[bounds_of(wi, cell) + BOUNDS_PASSABLE] != 0.0
    )


@kernel
def flies_freely(wf: Array, wi: Ints, s: Array, x: float, y: float, z: float, steps: float) -> bool:
    """Say whether nothing at all is in reach of a move by x, y, z, in so many sub-steps.

    Asked once, at the begin of CTransition::find_transitional_position. All sub-steps of a mover that has
    neither contact nor sliding plane go straight (AD-9), so that one ball bounds its spheres wherever any
    of them is tested, in every rotation between the begin's and the end's. Nothing is in reach if no
    portal of the cell is (`fences_beyond`), no object, and no polygon of the cell's tree.

    retail: CTransition::find_transitional_position 0x0050BDF0, 05 2
    """
    cell = int(s[CURR_CELL])
    if not allows(s, PLAN_FLIGHT) or not steps <= FLIGHT_STEPS or not _is_in_the_air(wf, wi, s, cell):
        return False
    mx, my, mz = _middle(s)
    reach = _sphere_reach(s, LOCAL_SPHERE, mx, my, mz)
    if s[NUM_SPHERE] > 1.0:
        reach = max(reach, _sphere_reach(s, LOCAL_SPHERE + SPHERE_SIZE, mx, my, mz))
    reach += 0.5 * _length(x, y, z)
    ox, oy, oz = load(s, CURR_POS + ORIGIN)
    cx, cy, cz = ox + mx + 0.5 * x, oy + my + 0.5 * y, oz + mz + 0.5 * z
    far = reach * (1.0 + BOUND_TILT) + slack(cx, cy, cz) + BOUND_ROUNDING * (abs(x) + abs(y) + abs(z))
    return _cell_beyond(wf, wi, s, cell, cx, cy, cz, far)


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
