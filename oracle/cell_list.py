"""CObjCell, the lists of cells that spheres reach, and the cell that contains the first of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from oracle.arithmetic import f32
from oracle.land_defs import FIRST_INTERIOR_CELL, get_block_offset
from oracle.outside_cells import add_all_outside_cells
from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.cell_array import CellArray
    from oracle.cyl_sphere import CylSphere
    from oracle.obj_cell import ObjCell
    from oracle.position import Position
    from oracle.ref import Ref
    from oracle.sphere_path import SpherePath
    from oracle.world import World

MAX_CYLSPHERES: Final = 10
"""How many of an object's cylinders are looked at (09 5.4)."""


def find_cell_list(
    world: World,
    p: Position,
    num_sphere: int,
    spheres: Sequence[Sphere],
    array: CellArray,
    curr_cell: Ref[ObjCell | None] | None,
    path: SpherePath | None,
) -> None:
    """List the cells that spheres reach, and find the one that contains sphere 0.

    Parameters
    ----------
    world : World
        The loaded cells.
    p : Position
        Where the search starts; the spheres are in its landblock's coordinates, metres.
    num_sphere : int
        How many of `spheres` count.
    array : CellArray
        Filled anew.
    curr_cell : Ref or None
        Takes the containing cell or None: the first interior one, else the last land cell. Left alone if
        the starting cell is not loaded or there are no spheres.
    path : SpherePath or None
        Is told that an interior cell was reached.

    Notes
    -----
    retail: CObjCell::find_cell_list 0x0052B4E0, 09 5.1.
    """
    # 09 5.1.1
    array.cells.clear()
    array.added_outside = 0
    # 09 5.1.2
    start = world.get_visible(p.objcell_id)
    # 09 5.1.3
    interior = (p.objcell_id & 0xFFFF) >= FIRST_INTERIOR_CELL
    if interior:
        if path is not None:
            path.hits_interior_cell = 1
        array.add_cell(p.objcell_id, start)
    else:
        add_all_outside_cells(world, p, num_sphere, spheres, array)
    # 09 5.1.4
    if start is None or num_sphere == 0:
        return
    # 09 5.1.5
    i = 0
    while i < array.num_cells:
        cell = array.cells[i].cell
        if cell is not None:
            cell.find_transit_cells(p, num_sphere, spheres, array, path)
        i += 1
    # 09 5.1.6
    if curr_cell is not None:
        curr_cell.value = _containing_cell(p, spheres[0].center, array, path)
    # 09 5.1.7
    if array.do_not_load_cells and interior:
        _prune(array, start)


def _containing_cell(
    p: Position, center: Vector3, array: CellArray, path: SpherePath | None
) -> ObjCell | None:
    """Return the first interior cell that contains the point, else the last outdoor one (09 5.1.6)."""
    found: ObjCell | None = None
    for entry in array.cells:
        cell = entry.cell
        if cell is None:
            continue
        off = get_block_offset(p.objcell_id, cell.id)
        lp = Vector3(f32(center.x - off.x), f32(center.y - off.y), f32(center.z - off.z))
        if cell.point_in_cell(lp):
            found = cell
            if cell.is_interior:
                if path is not None:
                    path.hits_interior_cell = 1
                break
    return found


def _prune(array: CellArray, start: ObjCell) -> None:
    """Keep only the starting cell and what is visible from it (09 5.1.7)."""
    i = 0
    while i < array.num_cells:
        cell_id = array.cells[i].cell_id
        if cell_id == start.id or cell_id in start.stab_list:
            i += 1
        else:
            array.remove_cell(i)


def find_cell_list_for_path(
    world: World, array: CellArray, curr_cell: Ref[ObjCell | None] | None, path: SpherePath
) -> None:
    """List the cells that the check position's spheres reach.

    retail: CObjCell::find_cell_list(array, check_cell, path) 0x0052B960, 09 5.2.
    """
    find_cell_list(world, path.check_pos, path.num_sphere, path.global_sphere, array, curr_cell, path)


def find_cell_list_for_sphere(
    world: World, p: Position, sphere: Sphere, array: CellArray, path: SpherePath | None
) -> None:
    """List the cells that one sphere of the space of `p`, metres, reaches.

    retail: CObjCell::find_cell_list(p, sphere, array, path) 0x0052B990, 09 5.3.
    """
    ball = Sphere(p.localtoglobal(p, sphere.center), sphere.radius)
    find_cell_list(world, p, 1, [ball], array, None, path)


def find_cell_list_for_cylspheres(
    world: World, p: Position, cylspheres: Sequence[CylSphere], array: CellArray, path: SpherePath | None
) -> None:
    """List the cells that balls around the low points of cylinders, in the space of `p`, reach.

    The height of the cylinders plays no role.

    retail: CObjCell::find_cell_list(p, num_cylsphere, cylsphere, array, path) 0x0052B9F0, 09 5.4.
    """
    balls = [Sphere(p.localtoglobal(p, cyl.low_pt), cyl.radius) for cyl in cylspheres[:MAX_CYLSPHERES]]
    find_cell_list(world, p, len(balls), balls, array, None, path)
