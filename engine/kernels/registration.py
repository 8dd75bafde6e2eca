"""Where an object is found: the cells that its parts reach (08, 9.3; 09, 4.3, 4.5, 6.5 and 8).

Parts are `count` records at ``first`` of `a`, laid out in `engine.kernels.reach`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import LAND_WIDTH
from engine.kernels.cell_array import add_cell, ints_of, is_land, listed_cell, position_of
from engine.kernels.cell_ids import find_cell
from engine.kernels.cell_list import find_cell_list
from engine.kernels.compile import entry, kernel
from engine.kernels.land_defs import gid_to_lcoord, outside_cell
from engine.kernels.outside import add_outside_cell
from engine.kernels.position import position_localtoglobal
from engine.kernels.reach import REACH_SIZE, columns_under, enters, is_entered, leaves
from engine.kernels.vector import load, store
from engine.layout import (
    ADDED_OUTSIDE,
    BUILDING_INTS,
    BUILDING_PORTAL_CELL,
    BUILDING_PORTAL_COUNT,
    BUILDING_PORTAL_INTS,
    BUILDING_PORTAL_OTHER,
    BUILDING_PORTALS,
    CELL_PORTAL_COUNT,
    CELL_PORTALS,
    EXTERIOR,
    LAND_BUILDING,
    NO_BUILDING,
    NO_CELL,
    NUM_CELLS,
    ORIGIN,
    PORTAL_CELL,
    PORTAL_INTS,
    PORTAL_PLANE,
    PORTAL_SIDE,
    RADIUS,
    SPHERE_SIZE,
    WORLD_BUILDINGS,
    WORLD_ROW,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


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
        a0, b0, a1, b1 = columns_under(float(number), a, first + REACH_SIZE * i)
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
            if not leaves(wf, position, plane, side, a, part):
                continue
            if other == EXTERIOR:
                outside = True
                break
            if other < 0 or is_entered(wf, wi, other, a, part):
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
        if enters(wf, position, plane, side, a, part) and is_entered(wf, wi, cell, a, part):
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
