"""What is in a cell (09, 3): its environment, its building, its objects.

Environment and building are numbered 0 and 1: what is fixed in the cell. A test of either is in two
halves, because the answer may be that of a step up (`engine.kernels.bsp_tree`). Whether the mover may
enter at all is asked first (`engine.kernels.restrictions`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import CONTACT, INITIAL_PLACEMENT_INSERT, OK
from engine.kernels.bsp_placement import placement_insert
from engine.kernels.bsp_tree import find_collisions
from engine.kernels.cell_array import ints_of, is_land, position_of
from engine.kernels.cell_list import UNTOUCHED, find_cell_list
from engine.kernels.compile import inlined, kernel
from engine.kernels.land_cells import find_terrain_collisions
from engine.kernels.objects import test_part
from engine.kernels.path import enter_localspace
from engine.kernels.plan import building_beyond, object_beyond, objects_beyond
from engine.kernels.plan_portals import list_alone, reaches_no_portal
from engine.kernels.trace import BUILDING_CALL, trace_close, trace_open
from engine.layout import (
    BLDG_CHECK,
    BUILDING_INTS,
    BUILDING_PART,
    CELL_ARRAY_VALID,
    CELL_OBJECT_COUNT,
    CELL_OBJECTS,
    CELL_TREE,
    CHECK_CELL,
    CHECK_POS,
    COLLIDED_WITH_ENVIRONMENT,
    GLOBAL_SPHERE,
    HITS_INTERIOR_CELL,
    INSERT_TYPE,
    LAND_BUILDING,
    MOVER_ID,
    NO_BUILDING,
    NO_CELL,
    NO_PART,
    NO_TREE,
    NUM_SPHERE,
    OBJECT_ID,
    OBJECT_INTS,
    OBSTRUCTION_ETHEREAL,
    OI_STATE,
    ORIGIN,
    SKIPPED_PORTALS,
    WORLD_BUILDINGS,
    WORLD_OBJECT_INTS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@inlined
def _building_part(wi: Ints, cell: int) -> int:
    """Return the part that a land cell's building is collided with, or NO_PART if it has no shell."""
    building = wi[ints_of(wi, cell) + LAND_BUILDING]
    return wi[wi[WORLD_BUILDINGS] + BUILDING_INTS * building + BUILDING_PART]


@inlined
def fixed_count(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Return how many fixed things of a cell are tested: its environment, and perhaps a building."""
    if not is_land(wi, cell) or wi[ints_of(wi, cell) + LAND_BUILDING] == NO_BUILDING:
        return 1
    return 1 if building_beyond(wf, wi, s, wi[ints_of(wi, cell) + LAND_BUILDING]) else 2


@kernel
def test_fixed(wf: Array, wi: Ints, s: Array, cell: int, fixed: int) -> int:
    """Test the mover against what is fixed in a cell; a TransitionState, or NEEDS_STEP_UP.

    retail: CEnvCell::find_collisions 0x0052C100, CLandCell::find_collisions 0x00532D60, 09 3.3-7
    """
    if fixed > 0:
        return _test_building(wf, wi, s, _building_part(wi, cell))
    if is_land(wi, cell):
        return find_terrain_collisions(wf, wi, s, cell)
    return _test_environment(wf, wi, s, cell)


@kernel
def _test_environment(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Test the mover against an environment cell's own tree.

    retail: CEnvCell::find_env_collisions 0x0052C130, 09 3.4
    """
    s[OBSTRUCTION_ETHEREAL] = 0.0
    root = wi[ints_of(wi, cell) + CELL_TREE]
    if root == NO_TREE:
        return OK
    enter_localspace(s, wf, position_of(wi, cell), 1.0)
    if s[INSERT_TYPE] == INITIAL_PLACEMENT_INSERT:
        return placement_insert(wf, wi, s, root)
    return find_collisions(wf, wi, s, root, 1.0)


@kernel
def _test_building(wf: Array, wi: Ints, s: Array, part: int) -> int:
    """Test the mover against the outside of a house.

    retail: CBuildingObj::find_building_collisions 0x006B5300, 09 3.7
    """
    trace_open(wi, s, BUILDING_CALL)
    if part == NO_PART:
        return OK
    s[BLDG_CHECK] = 1.0
    return test_part(wf, wi, s, part)


@inlined
def accept_fixed(wi: Ints, s: Array, cell: int, fixed: int, ts: int) -> None:
    """Note what was touched; the ground has done so itself.

    retail: CEnvCell::find_env_collisions 0x0052C130, 09 3.4.3;
    CBuildingObj::find_building_collisions 0x006B5300, 09 3.7.4-5
    """
    if fixed > 0:
        if _building_part(wi, cell) != NO_PART:
            s[BLDG_CHECK] = 0.0
        trace_close(wi, s, ts)
    elif is_land(wi, cell):
        return
    if ts != OK and not int(s[OI_STATE]) & CONTACT:
        s[COLLIDED_WITH_ENVIRONMENT] = 1.0


@inlined
def object_count(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Return how many objects of a cell are looked at: for an initial placement none.

    retail: CObjCell::find_obj_collisions 0x0052B750, 09 3.2.1
    """
    if s[INSERT_TYPE] == INITIAL_PLACEMENT_INSERT:
        return 0
    count = wi[ints_of(wi, cell) + CELL_OBJECT_COUNT]
    return 0 if objects_beyond(wf, wi, s, cell, count) else count


@inlined
def object_in(wi: Ints, cell: int, i: int) -> int:
    """Return the i-th object of a cell."""
    return wi[wi[ints_of(wi, cell) + CELL_OBJECTS] + i]


@inlined
def is_mover(wi: Ints, s: Array, thing: int) -> bool:
    """Say whether an object is the mover itself.

    retail: CObjCell::find_obj_collisions 0x0052B750, 09 3.2.2
    """
    mover = s[MOVER_ID]
    return mover != 0.0 and wi[wi[WORLD_OBJECT_INTS] + OBJECT_INTS * thing + OBJECT_ID] == mover


@inlined
def is_tested(wf: Array, wi: Ints, s: Array, thing: int) -> bool:
    """Say whether an object is tested: it is not the mover itself, and in reach."""
    return not is_mover(wi, s, thing) and not object_beyond(wf, wi, s, thing)


@kernel
def build_cell_array(wf: Array, wi: Ints, s: Array) -> int:
    """List the cells that the check position's spheres reach; return the one that contains sphere 0.

    NO_CELL if none does, or if the check position's own cell is not in the world.

    retail: CTransition::build_cell_array 0x00509EE0, CObjCell::find_cell_list 0x0052B960, 09 5.2
    """
    s[CELL_ARRAY_VALID] = 1.0
    s[HITS_INTERIOR_CELL] = 0.0
    hint, count = int(s[CHECK_CELL]), int(s[NUM_SPHERE])
    if reaches_no_portal(wf, wi, s, hint):
        s[SKIPPED_PORTALS] += 1.0
        return list_alone(wf, wi, s, hint)
    x, y = s[CHECK_POS + ORIGIN], s[CHECK_POS + ORIGIN + 1]
    found = find_cell_list(wf, wi, s, hint, s[CHECK_POS], x, y, s, GLOBAL_SPHERE, count)
    return NO_CELL if found == UNTOUCHED else found
