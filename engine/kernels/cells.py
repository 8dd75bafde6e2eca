"""Environment cells (09): what is in one, which ones the mover reaches, which one contains it.

A cell's *shapes* are its own tree, number 0, and then its objects in order. A test of a shape is in
two halves, because the answer may be that of a step up (`engine.kernels.bsp_tree`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import CONTACT, FIRST_INDOOR, INITIAL_PLACEMENT_INSERT, OK, OUTSIDE
from engine.kernels.bsp_cell import point_inside_cell_bsp, sphere_intersects_cell_bsp
from engine.kernels.bsp_placement import placement_insert
from engine.kernels.bsp_tree import find_collisions
from engine.kernels.compile import inlined, kernel, pasted
from engine.kernels.frame import frame_globaltolocal
from engine.kernels.objects import accept_object, test_object
from engine.kernels.path import cache_localspace_sphere
from engine.kernels.position import block_offset
from engine.kernels.rounding import f32
from engine.kernels.vector import load
from engine.layout import (
    CELL_ARRAY_VALID,
    CELL_FLOATS,
    CELL_ID,
    CELL_INTS,
    CELL_OBJECT_COUNT,
    CELL_OBJECTS,
    CELL_PLANE_COUNT,
    CELL_PLANES,
    CELL_PORTAL_COUNT,
    CELL_PORTALS,
    CELL_TREE,
    CHECK_CELL,
    CHECK_POS,
    COLLIDED_WITH_ENVIRONMENT,
    GLOBAL_SPHERE,
    HITS_INTERIOR_CELL,
    INSERT_TYPE,
    NO_CELL,
    NO_PLANES,
    NO_TREE,
    NUM_CELLS,
    NUM_SPHERE,
    OBSTRUCTION_ETHEREAL,
    OI_STATE,
    RADIUS,
    SPHERE_SIZE,
    STATUS,
    STATUS_OUTDOORS,
    WORLD_CELL_FLOATS,
    WORLD_CELL_INTS,
    WORLD_CELL_LIST,
    WORLD_CELLS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@inlined
def _position_of(wi: Ints, cell: int) -> int:
    """Return where a cell's position lies in the world's floats."""
    return wi[WORLD_CELL_FLOATS] + CELL_FLOATS * cell


@inlined
def _ints_of(wi: Ints, cell: int) -> int:
    """Return where a cell's integers lie."""
    return wi[WORLD_CELL_INTS] + CELL_INTS * cell


@inlined
def cell_id(wf: Array, wi: Ints, cell: int) -> float:
    """Return the id of a cell."""
    return wf[_position_of(wi, cell) + CELL_ID]


@inlined
def is_outdoors(cell: float) -> bool:
    """Say whether an id is that of a land cell, or 0."""
    return (int(cell) & 0xFFFF) < FIRST_INDOOR


@kernel
def find_cell(wf: Array, wi: Ints, wanted: float, hint: int) -> int:
    """Return the cell with an id, or NO_CELL; `hint` is looked at first.

    retail: CEnvCell::GetVisible 0x0052DC10, 09 2
    """
    if hint != NO_CELL and cell_id(wf, wi, hint) == wanted:
        return hint
    for cell in range(wi[WORLD_CELLS]):
        if cell_id(wf, wi, cell) == wanted:
            return cell
    return NO_CELL


@inlined
def shape_count(wi: Ints, s: Array, cell: int) -> int:
    """Return how many shapes of a cell are tested: for an initial placement only its own.

    retail: CObjCell::find_obj_collisions 0x0052B750, 09 3.2.1
    """
    if s[INSERT_TYPE] == INITIAL_PLACEMENT_INSERT:
        return 1
    return 1 + wi[_ints_of(wi, cell) + CELL_OBJECT_COUNT]


@kernel
def test_shape(wf: Array, wi: Ints, s: Array, cell: int, shape: int) -> int:
    """Test the mover against one shape of a cell; a TransitionState, or NEEDS_STEP_UP.

    retail: CEnvCell::find_collisions 0x0052C100, 09 3.2-4
    """
    if shape > 0:
        return test_object(wf, wi, s, wi[_ints_of(wi, cell) + CELL_OBJECTS] + shape - 1)
    s[OBSTRUCTION_ETHEREAL] = 0.0
    root = wi[_ints_of(wi, cell) + CELL_TREE]
    if root == NO_TREE:
        return OK
    cache_localspace_sphere(s, wf, _position_of(wi, cell), 1.0)
    if s[INSERT_TYPE] == INITIAL_PLACEMENT_INSERT:
        return placement_insert(wf, wi, s, root)
    return find_collisions(wf, wi, s, root, 1.0)


@kernel
def accept_shape(wi: Ints, s: Array, cell: int, shape: int, ts: int) -> int:
    """Note what was touched.

    retail: CEnvCell::find_env_collisions 0x0052C130, 09 3.4.3, CPhysicsObj::FindObjCollisions, 08 3.9
    """
    if shape > 0:
        return accept_object(wi, s, wi[_ints_of(wi, cell) + CELL_OBJECTS] + shape - 1, ts)
    if ts != OK and not int(s[OI_STATE]) & CONTACT:
        s[COLLIDED_WITH_ENVIRONMENT] = 1.0
    return ts


@pasted
def _contains(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float) -> bool:
    """Say whether a cell contains a point of its block.

    retail: CEnvCell::point_in_cell 0x0052C300, 09 4.1
    """
    ints = _ints_of(wi, cell)
    count = wi[ints + CELL_PLANE_COUNT]
    if count == NO_PLANES:
        return True
    lx, ly, lz = frame_globaltolocal(wf, _position_of(wi, cell), x, y, z)
    return point_inside_cell_bsp(wf, wi[ints + CELL_PLANES], count, lx, ly, lz)


@pasted
def _reached(wf: Array, wi: Ints, s: Array, cell: int) -> bool:
    """Say whether any of the check position's spheres is partly inside a cell.

    retail: CEnvCell::find_transit_cells 0x0052C820, 09 4.2.B
    """
    ints = _ints_of(wi, cell)
    count = wi[ints + CELL_PLANE_COUNT]
    if count == NO_PLANES:
        return s[NUM_SPHERE] > 0.0
    for i in range(int(s[NUM_SPHERE])):
        at = GLOBAL_SPHERE + SPHERE_SIZE * i
        x, y, z = load(s, at)
        lx, ly, lz = frame_globaltolocal(wf, _position_of(wi, cell), x, y, z)
        if (
            sphere_intersects_cell_bsp(wf, wi[ints + CELL_PLANES], count, lx, ly, lz, s[at + RADIUS])
            != OUTSIDE
        ):
            return True
    return False


@inlined
def listed_cell(wi: Ints, s: Array, i: int) -> int:
    """Return an entry of the cell list."""
    return int(s[wi[WORLD_CELL_LIST] + i])


@kernel
def _add_cell(wi: Ints, s: Array, cell: int) -> None:
    """Append a cell to the list unless it is there.

    retail: CELLARRAY::add_cell 0x006B4FF0, 09 1.1
    """
    count = int(s[NUM_CELLS])
    for i in range(count):
        if listed_cell(wi, s, i) == cell:
            return
    s[wi[WORLD_CELL_LIST] + count] = cell
    s[NUM_CELLS] = count + 1


@pasted
def _add_neighbours(wf: Array, wi: Ints, s: Array, cell: int) -> None:
    """Append the cells behind a cell's portals that the spheres reach.

    retail: CEnvCell::find_transit_cells 0x0052C820, 09 4.2
    """
    ints = _ints_of(wi, cell)
    first = wi[ints + CELL_PORTALS]
    for i in range(first, first + wi[ints + CELL_PORTAL_COUNT]):
        if _reached(wf, wi, s, wi[i]):
            _add_cell(wi, s, wi[i])


@pasted
def _containing_cell(wf: Array, wi: Ints, s: Array) -> int:
    """Return the first listed cell that contains sphere 0, or NO_CELL.

    retail: CObjCell::find_cell_list 0x0052B4E0, 09 5.1.6
    """
    x, y, z = load(s, GLOBAL_SPHERE)
    for i in range(int(s[NUM_CELLS])):
        cell = listed_cell(wi, s, i)
        bx, by = block_offset(s[CHECK_POS], cell_id(wf, wi, cell))
        if _contains(wf, wi, cell, f32(x - bx), f32(y - by), f32(z - 0.0)):
            return cell
    return NO_CELL


@kernel
def build_cell_array(wf: Array, wi: Ints, s: Array) -> int:
    """List the cells that the check position's spheres reach; return the one that contains sphere 0.

    NO_CELL if none does, or if the check position's own cell is not in the world.

    retail: CTransition::build_cell_array 0x00509EE0, CObjCell::find_cell_list 0x0052B4E0, 09 5.1
    """
    s[CELL_ARRAY_VALID] = 1.0
    s[HITS_INTERIOR_CELL] = 0.0
    s[NUM_CELLS] = 0.0
    if is_outdoors(s[CHECK_POS]):
        s[STATUS] = STATUS_OUTDOORS
        return NO_CELL
    s[HITS_INTERIOR_CELL] = 1.0
    start = find_cell(wf, wi, s[CHECK_POS], int(s[CHECK_CELL]))
    if start == NO_CELL:
        return NO_CELL
    _add_cell(wi, s, start)
    if s[NUM_SPHERE] == 0.0:
        return NO_CELL
    i = 0
    while i < int(s[NUM_CELLS]):
        _add_neighbours(wf, wi, s, listed_cell(wi, s, i))
        i += 1
    return _containing_cell(wf, wi, s)
