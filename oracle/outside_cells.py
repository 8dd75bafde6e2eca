"""CLandCell, the static functions: which land cells spheres or parts reach."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.arithmetic import f32, floor
from oracle.constants import CELL_EDGE
from oracle.land_defs import adjust_to_outside, gid_to_lcoord, in_bounds, lcoord_to_gid
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.cell_array import CellArray
    from oracle.physics_part import PhysicsPart
    from oracle.position import Position
    from oracle.sphere import Sphere
    from oracle.world import World


def add_outside_cell(world: World, array: CellArray, x: int, y: int) -> None:
    """Add the land cell with these coordinates, if it is on the land; it need not be loaded.

    retail: CLandCell::add_outside_cell 0x00532EC0, 09 6.1.
    """
    if in_bounds(x, y):
        cell_id = lcoord_to_gid(x, y)
        array.add_cell(cell_id, world.landscape.get_landcell(cell_id))


def check_add_cell_boundary(
    world: World, array: CellArray, pt: Vector3, x: int, y: int, hi: float, lo: float
) -> None:
    """Add the neighbours of a land cell that the square around a point reaches.

    Parameters
    ----------
    pt : Vector3
        The point from the cell's south-west corner, metres.
    x, y : int
        The cell's coordinates.
    hi, lo : float
        The cell's edge less the radius, and the radius; metres.

    Notes
    -----
    retail: CLandCell::check_add_cell_boundary 0x00533260, 09 6.2.
    """
    # 09 6.2.1
    if pt.x > hi:
        add_outside_cell(world, array, x + 1, y)
        if pt.y > hi:
            add_outside_cell(world, array, x + 1, y + 1)
        if pt.y < lo:
            add_outside_cell(world, array, x + 1, y - 1)
    # 09 6.2.2
    if pt.x < lo:
        add_outside_cell(world, array, x - 1, y)
        if pt.y > hi:
            add_outside_cell(world, array, x - 1, y + 1)
        if pt.y < lo:
            add_outside_cell(world, array, x - 1, y - 1)
    # 09 6.2.3
    if pt.y > hi:
        add_outside_cell(world, array, x, y + 1)
    # 09 6.2.4
    if pt.y < lo:
        add_outside_cell(world, array, x, y - 1)


def add_all_outside_cells(
    world: World, p: Position, num_sphere: int, spheres: Sequence[Sphere], array: CellArray
) -> None:
    """Add the land cells that spheres (block coordinates of `p`) reach, or the one under `p`.

    retail: CLandCell::add_all_outside_cells 0x00533630, 09 6.4.
    """
    # 09 6.4.1
    if array.added_outside:
        return
    array.added_outside = 1
    # 09 6.4.2
    for sphere in spheres[:num_sphere]:
        point = sphere.center.copy()
        found, cell_id = adjust_to_outside(p.objcell_id, point)
        if not found:
            break
        ix = floor(point.x / CELL_EDGE)
        iy = floor(point.y / CELL_EDGE)
        lo = sphere.radius
        pt = Vector3(f32(point.x - ix * CELL_EDGE), f32(point.y - iy * CELL_EDGE), 0.0)
        hi = f32(CELL_EDGE - lo)
        found, x, y = gid_to_lcoord(cell_id)
        if found:
            add_outside_cell(world, array, x, y)
            check_add_cell_boundary(world, array, pt, x, y, hi, lo)
    # 09 6.4.3
    if num_sphere == 0:
        found, cell_id = adjust_to_outside(p.objcell_id, p.frame.origin.copy())
        found, x, y = gid_to_lcoord(cell_id) if found else (0, 0, 0)
        if found:
            add_outside_cell(world, array, x, y)


def add_all_outside_cells_of_parts(
    world: World, parts: Sequence[PhysicsPart | None], array: CellArray
) -> None:
    """Add a rectangle of land cells that holds an object's parts.

    retail: CLandCell::add_all_outside_cells 0x00533360, 09 6.5.
    """
    # 09 6.5.1
    if array.added_outside:
        return
    array.added_outside = 1
    present = [part for part in parts if part is not None]
    # 09 6.5.2
    if not present:
        return
    loc = present[0].pos.frame.origin.copy()
    _, cell_id = adjust_to_outside(present[0].pos.objcell_id, loc)
    ref = world.landscape.get_landcell(cell_id)
    found, x, y = gid_to_lcoord(cell_id)
    if ref is None or not found:
        return
    # 09 6.5.3
    low = cell_id & 0xFFFF
    lx, ly = (low - 1) >> 3, (low - 1) & 7
    min_x = min_y = max_x = max_y = 0
    # 09 6.5.4
    for part in present:
        a0, b0, a1, b1 = _cells_under(part, ref.pos)
        min_x, min_y = min(min_x, a0 - lx), min(min_y, b0 - ly)
        max_x, max_y = max(max_x, a1 - lx), max(max_y, b1 - ly)
    # 09 6.5.5
    add_cell_block(world, array, min_x + x, min_y + y, x + max_x, y + max_y)


def _cells_under(part: PhysicsPart, ref: Position) -> tuple[int, int, int, int]:
    """Return the first and last columns and rows of cells, in a block, that a part covers (09 6.5.4)."""
    if part.always_2d():
        sphere = part.bounding_sphere()
        r = 0.0 if sphere is None else sphere.radius
        q = part.pos.frame.origin
        west, south, east, north = q.x - r, q.y - r, q.x + r, q.y + r
    else:
        box = part.bounding_box().local_to_global(part.pos, ref)
        west, south, east, north = box.min.x, box.min.y, box.max.x, box.max.y
    a0, b0 = floor(west / CELL_EDGE), floor(south / CELL_EDGE)
    a1, b1 = floor(east / CELL_EDGE), floor(north / CELL_EDGE)
    return a0, b0, a1, b1


def add_cell_block(world: World, array: CellArray, min_x: int, min_y: int, max_x: int, max_y: int) -> None:
    """Add a rectangle of land cells, column by column, its last column and row included.

    retail: CLandCell::add_cell_block 0x005331D0, 09 6.5.5.
    """
    for x in range(min_x, max_x + 1):
        for y in range(min_y, max_y + 1):
            add_outside_cell(world, array, x, y)
