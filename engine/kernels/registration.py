"""Where an object is found: the cells that its parts reach (08, 9.3; 09, 4.3, 4.5, 6.5 and 8).

Parts are `count` records at ``first`` of `a`, laid out below.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final, TypeAlias

from engine.constants import BLOCK_STEP, EPS, LAND_WIDTH, frozen
from engine.kernels.cell_array import add_cell, ints_of, is_land, listed_cell, position_of
from engine.kernels.cell_ids import find_cell
from engine.kernels.cell_list import find_cell_list
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.land_defs import gid_to_lcoord, outside_cell
from engine.kernels.outside import add_outside_cell
from engine.kernels.position import position_localtoglobal, position_localtolocal
from engine.kernels.rounding import f32
from engine.kernels.vector import load, store
from engine.layout import (
    ADDED_OUTSIDE,
    BUILDING_INTS,
    BUILDING_PORTAL_CELL,
    BUILDING_PORTAL_COUNT,
    BUILDING_PORTAL_INTS,
    BUILDING_PORTAL_OTHER,
    BUILDING_PORTALS,
    CELL_PLANE_COUNT,
    CELL_PLANES,
    CELL_PORTAL_COUNT,
    CELL_PORTALS,
    EXTERIOR,
    LAND_BUILDING,
    NO_BUILDING,
    NO_CELL,
    NUM_CELLS,
    ORIGIN,
    PLANE_SIZE,
    PORTAL_CELL,
    PORTAL_INTS,
    PORTAL_PLANE,
    PORTAL_SIDE,
    POSITION_SIZE,
    RADIUS,
    SPHERE_SIZE,
    WORLD_BUILDINGS,
    WORLD_ROW,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints

    Box: TypeAlias = tuple[float, float, float, float, float, float]

REACH_SPHERE: Final = POSITION_SIZE
"""A part's record: its position; the sphere of its tree, which has a negative radius if there is none;"""
REACH_BOX: Final = frozen(REACH_SPHERE + SPHERE_SIZE)
"""the least and the greatest corner of its box, both in its own space, unscaled;"""
REACH_FLAT: Final = frozen(REACH_BOX + 6)
"""and 1 if even its most detailed picture is flat."""
REACH_SIZE: Final = frozen(REACH_FLAT + 1)

_POSITIVE: Final = frozen(0)
_NEGATIVE: Final = frozen(1)
_CROSSING: Final = frozen(3)
"""Sides of a plane (01, 6.2); the first two are also those of a portal."""
_CORNERS: Final = frozen(8)
_FAR: Final = 1e6
"""A column or row of land cells that is beyond the land, whatever it is counted from."""


@inlined
def _corner(box: Array, at: int, k: int) -> tuple[float, float, float]:
    """Return a corner of a box at ``box[at]``: bits 1, 2 and 4 of `k` choose the greater x, y and z."""
    return (
        box[at + 3 * (k & 1)],
        box[at + 1 + 3 * ((k >> 1) & 1)],
        box[at + 2 + 3 * ((k >> 2) & 1)],
    )


@inlined
def _grown(box: Box, x: float, y: float, z: float) -> Box:
    """Grow a box until a point is in it.

    retail: 09 8
    """
    return (
        min(x, box[0]),
        min(y, box[1]),
        min(z, box[2]),
        max(x, box[3]),
        max(y, box[4]),
        max(z, box[5]),
    )


@kernel
def _box_within(wf: Array, cell: int, a: Array, part: int) -> Box:
    """Return the box about a part's box, in the space of a cell's position at ``wf[cell]``.

    retail: BBox::LocalToLocal 0x005B1E60, 09 8
    """
    x, y, z = load(a, part + REACH_BOX)
    x, y, z = position_localtolocal(wf, cell, a, part, x, y, z)
    box = (x, y, z, x, y, z)
    for k in range(1, _CORNERS):
        x, y, z = _corner(a, part + REACH_BOX, k)
        x, y, z = position_localtolocal(wf, cell, a, part, x, y, z)
        box = _grown(box, x, y, z)
    return box


@kernel
def _box_in_block(home: float, a: Array, part: int) -> Box:
    """Return the box about a part's box, in the block of a cell id.

    retail: BBox::LocalToGlobal 0x005B2120, 09 8
    """
    x, y, z = load(a, part + REACH_BOX)
    x, y, z = position_localtoglobal(home, a, part, x, y, z)
    box = (x, y, z, x, y, z)
    for k in range(1, _CORNERS):
        x, y, z = _corner(a, part + REACH_BOX, k)
        x, y, z = position_localtoglobal(home, a, part, x, y, z)
        box = _grown(box, x, y, z)
    return box


@inlined
def _pick(box: Box, k: int) -> tuple[float, float, float]:
    """Return a corner of a box in registers, as `_corner` chooses it."""
    return (
        box[3] if k & 1 else box[0],
        box[4] if k & 2 else box[1],
        box[5] if k & 4 else box[2],
    )


@kernel
def _side_of(wf: Array, plane: int, box: Box) -> int:
    """Say on which side of a plane all corners of a box are, if they are on one.

    retail: Plane::intersect_box 0x005AA170, 01 6.6
    """
    front, behind = 0, 0
    for k in range(_CORNERS):
        x, y, z = _pick(box, k)
        d = ((z * wf[plane + 2] + y * wf[plane + 1]) + x * wf[plane]) + wf[plane + 3]
        if d > EPS:
            front += 1
        elif d < -EPS:
            behind += 1
    if front == _CORNERS:
        return _POSITIVE
    return _NEGATIVE if behind == _CORNERS else _CROSSING


@kernel
def _is_entered(wf: Array, wi: Ints, cell: int, a: Array, part: int) -> bool:
    """Say whether a part's box reaches into an environment cell: no plane has all of it behind.

    retail: BSPNODE::box_intersects_cell_bsp 0x0053C880, 03 8.3
    """
    box = _box_within(wf, position_of(wi, cell), a, part)
    ints = ints_of(wi, cell)
    for i in range(wi[ints + CELL_PLANE_COUNT]):
        if _side_of(wf, wi[ints + CELL_PLANES] + PLANE_SIZE * i, box) == _NEGATIVE:
            return False
    return True


@kernel
def _distance(wf: Array, cell: int, plane: int, a: Array, part: int) -> tuple[float, float]:
    """Return how far a part's sphere is from a portal's plane, and its radius enlarged by EPS.

    `cell`: where the position of the portal's cell lies.

    retail: 09 4.3.2-3
    """
    x, y, z = load(a, part + REACH_SPHERE)
    x, y, z = position_localtolocal(wf, cell, a, part, x, y, z)
    d = ((y * wf[plane + 1] + z * wf[plane + 2]) + x * wf[plane]) + wf[plane + 3]
    return d, f32(a[part + REACH_SPHERE + RADIUS] + EPS)


@kernel
def _leaves(wf: Array, cell: int, plane: int, side: int, a: Array, part: int) -> bool:
    """Say whether a part is not all on the inner side of a portal.

    retail: 09 4.3.1-5
    """
    if a[part + REACH_SPHERE + RADIUS] < 0.0:
        return False
    d, rad = _distance(wf, cell, plane, a, part)
    if (d < -rad) if side == _NEGATIVE else (d > rad):
        return False
    return _side_of(wf, plane, _box_within(wf, cell, a, part)) != side


@kernel
def _enters(wf: Array, cell: int, plane: int, side: int, a: Array, part: int) -> bool:
    """Say whether a part reaches to the inner side of a portal.

    retail: 09 4.5.1-2
    """
    if a[part + REACH_SPHERE + RADIUS] < 0.0:
        return False
    d, rad = _distance(wf, cell, plane, a, part)
    if (d > rad) if side == _NEGATIVE else (d < -rad):
        return False
    found = _side_of(wf, plane, _box_within(wf, cell, a, part))
    return found in (_CROSSING, side)


@inlined
def _column(x: float) -> int:
    """Return the column, or row, of land cells that a coordinate of a block is in.

    retail: 09 6.5.4
    """
    return math.floor(min(max(x / BLOCK_STEP, -_FAR), _FAR))


@kernel
def _columns_under(home: float, a: Array, part: int) -> tuple[int, int, int, int]:
    """Return the first and last column and row of land cells that a part covers.

    retail: 09 6.5.4
    """
    if a[part + REACH_FLAT] != 0.0:
        r = max(a[part + REACH_SPHERE + RADIUS], 0.0)
        x, y = a[part + ORIGIN], a[part + ORIGIN + 1]
        return _column(x - r), _column(y - r), _column(x + r), _column(y + r)
    box = _box_in_block(home, a, part)
    return _column(box[0]), _column(box[1]), _column(box[3]), _column(box[4])


@kernel
def _add_outside(wi: Ints, s: Array, a: Array, first: int, count: int) -> int:
    """Append a rectangle of land cells that holds all parts; return how much room the row lacks for it.

    retail: CLandCell::add_all_outside_cells 0x00533360, 09 6.5
    """
    if s[ADDED_OUTSIDE] != 0.0:
        return 0
    s[ADDED_OUTSIDE] = 1.0
    if count == 0:
        return 0
    number, _, _ = outside_cell(int(a[first]), a[first + ORIGIN], a[first + ORIGIN + 1])
    found, x, y = gid_to_lcoord(number)
    if not found or find_cell(wi, float(number)) == NO_CELL:
        return 0
    low = (number & 0xFFFF) - 1
    lx, ly = low >> 3, low & 7
    west, south, east, north = 0, 0, 0, 0
    for i in range(count):
        a0, b0, a1, b1 = _columns_under(float(number), a, first + REACH_SIZE * i)
        west, south = min(west, a0 - lx), min(south, b0 - ly)
        east, north = max(east, a1 - lx), max(north, b1 - ly)
    west, south = max(west + x, 0), max(south + y, 0)
    east, north = min(x + east, LAND_WIDTH - 1), min(y + north, LAND_WIDTH - 1)
    lacking = (east - west + 1) * (north - south + 1) - (len(s) - wi[WORLD_ROW])
    if lacking > 0:
        return lacking
    for i in range(west, east + 1):
        for j in range(south, north + 1):
            add_outside_cell(wi, s, i, j)
    return 0


@kernel
def _add_rooms(wf: Array, wi: Ints, s: Array, cell: int, a: Array, first: int, count: int) -> int:
    """Append the cells behind an environment cell's portals that the parts reach; return as `_add_outside`.

    retail: CEnvCell::find_transit_cells 0x0052CAE0, 09 4.3
    """
    ints, position = ints_of(wi, cell), position_of(wi, cell)
    outside = False
    portal = wi[ints + CELL_PORTALS]
    for _ in range(wi[ints + CELL_PORTAL_COUNT]):
        other, side, plane = wi[portal + PORTAL_CELL], wi[portal + PORTAL_SIDE], wi[portal + PORTAL_PLANE]
        for part in range(first, first + REACH_SIZE * count, REACH_SIZE):
            if not _leaves(wf, position, plane, side, a, part):
                continue
            if other == EXTERIOR:
                outside = True
                break
            if other < 0 or _is_entered(wf, wi, other, a, part):
                add_cell(wi, s, other)
                break
        portal += PORTAL_INTS
    return _add_outside(wi, s, a, first, count) if outside else 0


@kernel
def _enter_room(
    wf: Array, wi: Ints, s: Array, cell: int, portal: int, a: Array, first: int, count: int
) -> int:
    """Append an environment cell, and those behind its portals, if the parts reach into it from outside.

    `portal`: index of the portal in that cell, negative for none. Returns as `_add_outside`.

    retail: CEnvCell::check_building_transit 0x0052C680, 09 4.5
    """
    ints, position = ints_of(wi, cell), position_of(wi, cell)
    if portal < 0 or wi[ints + CELL_PORTAL_COUNT] <= portal:
        return 0
    record = wi[ints + CELL_PORTALS] + PORTAL_INTS * portal
    side, plane = wi[record + PORTAL_SIDE], wi[record + PORTAL_PLANE]
    for part in range(first, first + REACH_SIZE * count, REACH_SIZE):
        if _enters(wf, position, plane, side, a, part) and _is_entered(wf, wi, cell, a, part):
            add_cell(wi, s, cell)
            return _add_rooms(wf, wi, s, cell, a, first, count)
    return 0


@kernel
def _enter_building(wf: Array, wi: Ints, s: Array, building: int, a: Array, first: int, count: int) -> int:
    """Append the cells that the parts reach into through a building's portals; return as `_add_outside`.

    retail: CBuildingObj::find_building_transit_cells 0x006B52A0, 09 6.3
    """
    record = wi[WORLD_BUILDINGS] + BUILDING_INTS * building
    portal = wi[record + BUILDING_PORTALS]
    lacking = 0
    for _ in range(wi[record + BUILDING_PORTAL_COUNT]):
        cell = wi[portal + BUILDING_PORTAL_CELL]
        if cell >= 0:
            other = wi[portal + BUILDING_PORTAL_OTHER]
            lacking = max(lacking, _enter_room(wf, wi, s, cell, other, a, first, count))
        portal += BUILDING_PORTAL_INTS
    return lacking


@entry
def find_bbox_cell_list(
    wf: Array, wi: Ints, s: Array, home: float, has_parts: bool, a: Array, first: int, count: int
) -> int:
    """List the cells that an object's parts reach, beginning with its own.

    `home`: the id of its own cell; `has_parts`: it has a part array. Returns how many more numbers the
    row needs; then the list is not complete.

    retail: CPhysicsObj::find_bbox_cell_list 0x00510FC0, 08 9.3
    """
    s[NUM_CELLS] = 0.0
    s[ADDED_OUTSIDE] = 0.0
    own = find_cell(wi, home)
    add_cell(wi, s, -int(home) if own == NO_CELL else own)
    if own == NO_CELL or not has_parts:
        return 0
    lacking = 0
    i = 0
    while i < int(s[NUM_CELLS]) and lacking == 0:
        cell = listed_cell(wi, s, i)
        i += 1
        if cell < 0:
            continue
        if not is_land(wi, cell):
            lacking = _add_rooms(wf, wi, s, cell, a, first, count)
            continue
        lacking = _add_outside(wi, s, a, first, count)
        building = wi[ints_of(wi, cell) + LAND_BUILDING]
        if building != NO_BUILDING:
            lacking = max(lacking, _enter_building(wf, wi, s, building, a, first, count))
    return lacking


@entry
def find_ball_cell_list(
    wf: Array,
    wi: Ints,
    s: Array,
    positions: Array,
    p: int,
    a: Array,
    first: int,
    count: int,
    scratch: Array,
) -> None:
    """List the cells that spheres in an object's frame reach.

    `p`: where the object's position lies; the spheres are `count` records at ``first`` of `a`; `scratch`
    has room for as many.

    retail: CObjCell::find_cell_list 0x0052B990 and 0x0052B9F0, 09 5.3-4
    """
    home = positions[p]
    for i in range(count):
        ball = first + SPHERE_SIZE * i
        x, y, z = load(a, ball)
        x, y, z = position_localtoglobal(home, positions, p, x, y, z)
        store(scratch, SPHERE_SIZE * i, x, y, z)
        scratch[SPHERE_SIZE * i + RADIUS] = a[ball + RADIUS]
    hx, hy = positions[p + ORIGIN], positions[p + ORIGIN + 1]
    find_cell_list(wf, wi, s, NO_CELL, home, hx, hy, scratch, 0, count)
