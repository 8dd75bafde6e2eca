"""The cells that spheres reach from a cell: through portals, doors, into buildings (09, 4 and 6).

Spheres are `count` records at ``first`` of `a`, in the block of the position that they come with.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import EPS, OUTSIDE
from engine.kernels.bsp_cell import sphere_intersects_cell_bsp
from engine.kernels.cell_array import add_cell, ints_of, is_land, position_of
from engine.kernels.compile import entry, kernel
from engine.kernels.frame import frame_globaltolocal
from engine.kernels.outside import add_all_outside_cells
from engine.kernels.rounding import f32
from engine.kernels.vector import load
from engine.layout import (
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
    HITS_INTERIOR_CELL,
    LAND_BUILDING,
    MATRIX,
    NO_BUILDING,
    NO_PLANES,
    ORIGIN,
    PORTAL_CELL,
    PORTAL_INTS,
    PORTAL_PLANE,
    PORTAL_SIDE,
    RADIUS,
    SPHERE_SIZE,
    WORLD_BUILDINGS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def _is_reached(wf: Array, wi: Ints, cell: int, a: Array, first: int, count: int) -> bool:
    """Say whether any sphere is partly inside an environment cell.

    retail: CEnvCell::find_transit_cells 0x0052C820, 09 4.2.B
    """
    ints = ints_of(wi, cell)
    planes = wi[ints + CELL_PLANE_COUNT]
    if planes == NO_PLANES:
        return count > 0
    for i in range(count):
        ball = first + SPHERE_SIZE * i
        x, y, z = load(a, ball)
        x, y, z = frame_globaltolocal(wf, position_of(wi, cell), x, y, z)
        if (
            sphere_intersects_cell_bsp(wf, wi[ints + CELL_PLANES], planes, x, y, z, a[ball + RADIUS])
            != OUTSIDE
        ):
            return True
    return False


@kernel
def _touches_exterior(wf: Array, position: int, plane: int, a: Array, first: int, count: int) -> bool:
    """Say whether any sphere touches the plane of a door, which has no end.

    retail: CEnvCell::find_transit_cells 0x0052C820, 09 4.2.A
    """
    m, o = position + MATRIX, position + ORIGIN
    for i in range(count):
        ball = first + SPHERE_SIZE * i
        dx, dy, dz = a[ball] - wf[o], a[ball + 1] - wf[o + 1], a[ball + 2] - wf[o + 2]
        lx = f32((dx * wf[m] + dz * wf[m + 2]) + dy * wf[m + 1])
        ly = f32((dx * wf[m + 3] + dz * wf[m + 5]) + dy * wf[m + 4])
        lz = (dz * wf[m + 8] + dy * wf[m + 7]) + dx * wf[m + 6]
        rad = f32(a[ball + RADIUS] + EPS)
        d = ((lz * wf[plane + 2] + ly * wf[plane + 1]) + lx * wf[plane]) + wf[plane + 3]
        if -rad < d < rad:
            return True
    return False


@kernel
def _reaches_unloaded(
    wf: Array, position: int, plane: int, side: int, a: Array, first: int, count: int
) -> bool:
    """Say whether any sphere reaches to the other side of a portal's plane.

    retail: CEnvCell::find_transit_cells 0x0052C820, 09 4.2.C
    """
    for i in range(count):
        ball = first + SPHERE_SIZE * i
        x, y, z = load(a, ball)
        x, y, z = frame_globaltolocal(wf, position, x, y, z)
        rad = a[ball + RADIUS] + EPS
        d = ((y * wf[plane + 1] + z * wf[plane + 2]) + x * wf[plane]) + wf[plane + 3]
        if (d > -rad and side == 1) or (d < rad and side == 0):
            return True
    return False


@entry
def check_building_transit(
    wf: Array, wi: Ints, s: Array, cell: int, portal: int, a: Array, first: int, count: int
) -> None:
    """Append an environment cell if the spheres reach into it through a building's portal.

    `portal`: index of the portal in that cell, negative for none.

    retail: CEnvCell::check_building_transit 0x0052C5D0, 09 4.4
    """
    if portal >= 0 and _is_reached(wf, wi, cell, a, first, count):
        s[HITS_INTERIOR_CELL] = 1.0
        add_cell(wi, s, cell)


@kernel
def _add_rooms(wf: Array, wi: Ints, s: Array, building: int, a: Array, first: int, count: int) -> None:
    """Append the cells that the spheres reach into through a building's portals.

    retail: CBuildingObj::find_building_transit_cells 0x006B5230, 09 6.3
    """
    record = wi[WORLD_BUILDINGS] + BUILDING_INTS * building
    portal = wi[record + BUILDING_PORTALS]
    for _ in range(wi[record + BUILDING_PORTAL_COUNT]):
        cell = wi[portal + BUILDING_PORTAL_CELL]
        if cell >= 0:
            check_building_transit(wf, wi, s, cell, wi[portal + BUILDING_PORTAL_OTHER], a, first, count)
        portal += BUILDING_PORTAL_INTS


@kernel
def _add_neighbours(wf: Array, wi: Ints, s: Array, cell: int, a: Array, first: int, count: int) -> bool:
    """Append the cells behind an environment cell's portals that the spheres reach.

    Returns whether they reach outside.

    retail: CEnvCell::find_transit_cells 0x0052C820, 09 4.2
    """
    ints, position = ints_of(wi, cell), position_of(wi, cell)
    outside = False
    portal = wi[ints + CELL_PORTALS]
    for _ in range(wi[ints + CELL_PORTAL_COUNT]):
        other = wi[portal + PORTAL_CELL]
        if other >= 0:
            if _is_reached(wf, wi, other, a, first, count):
                add_cell(wi, s, other)
        elif other == EXTERIOR:
            if not outside:
                outside = _touches_exterior(wf, position, wi[portal + PORTAL_PLANE], a, first, count)
        elif _reaches_unloaded(
            wf, position, wi[portal + PORTAL_PLANE], wi[portal + PORTAL_SIDE], a, first, count
        ):
            add_cell(wi, s, other)
        portal += PORTAL_INTS
    return outside


@entry
def find_transit_cells(
    wf: Array,
    wi: Ints,
    s: Array,
    cell: int,
    home: float,
    hx: float,
    hy: float,
    a: Array,
    first: int,
    count: int,
) -> None:
    """Append the cells that the spheres reach from a cell.

    retail: CEnvCell::find_transit_cells 0x0052C820, 09 4.2; CLandCell::find_transit_cells 0x00533800, 09 6.3
    """
    land = is_land(wi, cell)
    if land or _add_neighbours(wf, wi, s, cell, a, first, count):
        add_all_outside_cells(wi, s, home, hx, hy, a, first, count)
    if land:
        building = wi[ints_of(wi, cell) + LAND_BUILDING]
        if building != NO_BUILDING:
            _add_rooms(wf, wi, s, building, a, first, count)
