"""The insert inside a step (05, 10): transitional_insert while stepping, probing and placing.

In those modes collisions only take paths 1 to 3, nothing was struck from behind, no landing is
pending and a contact plane is known, so neither TI-7 nor TI-13 nor TI-16 can run. A row that gets
there all the same is marked with `STATUS_RECURSION`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import ADJUSTED, COLLIDED, CONTACT, INVALID, NEEDS_STEP_UP, OK, SLID
from engine.kernels.cell_array import cell_id, is_outdoors, listed_cell
from engine.kernels.cells import (
    accept_fixed,
    build_cell_array,
    fixed_count,
    is_tested,
    object_count,
    object_in,
    test_fixed,
)
from engine.kernels.collision_info import forget_contact
from engine.kernels.compile import inlined, kernel
from engine.kernels.land_defs import outside_cell
from engine.kernels.objects import accept_object, begin_object, test_object_shape
from engine.kernels.path import adjust_check_pos, set_check_pos
from engine.kernels.restrictions import check_entry_restrictions, is_restricted
from engine.layout import (
    CELL_ARRAY_VALID,
    CHECK_CELL,
    CHECK_POS,
    COLLIDE,
    CONTACT_VALID,
    NEG_POLY_HIT,
    NO_CELL,
    NUM_CELLS,
    OI_STATE,
    OI_STEP_DOWN,
    ORIGIN,
    STATUS,
    STATUS_RECURSION,
    STEP_DOWN,
    STEP_UP,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@inlined
def _without_step_up(s: Array, ts: int) -> int:
    """Mark a row in which a collision asks for a step up where retail cannot."""
    if ts != NEEDS_STEP_UP:
        return ts
    s[STATUS] = STATUS_RECURSION
    return COLLIDED


@kernel
def _probe_object(wf: Array, wi: Ints, s: Array, thing: int) -> int:
    """Test the mover against an object.

    retail: CPhysicsObj::FindObjCollisions 0x0050F050, 08 3
    """
    shapes = begin_object(wi, s, thing)
    if shapes < 0:
        return OK
    ts = OK
    for k in range(shapes):
        ts = _without_step_up(s, test_object_shape(wf, wi, s, thing, k))
        if ts != OK:
            break
    return accept_object(wi, s, thing, ts)


@kernel
def _probe_cell(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Test the mover against a cell.

    retail: CEnvCell::find_collisions 0x0052C100, CLandCell::find_collisions 0x00532D60, 09 3.1-7
    """
    if is_restricted(wi, cell) and check_entry_restrictions(wf, wi, s, cell) != OK:
        return COLLIDED
    for fixed in range(fixed_count(wf, wi, s, cell)):
        ts = _without_step_up(s, test_fixed(wf, wi, s, cell, fixed))
        accept_fixed(wi, s, cell, fixed, ts)
        if ts != OK:
            return ts
    for i in range(object_count(wf, wi, s, cell)):
        thing = object_in(wi, cell, i)
        if is_tested(wf, wi, s, thing):
            ts = _probe_object(wf, wi, s, thing)
            if ts != OK:
                return ts
    return OK


@kernel
def probe_into_cell(wf: Array, wi: Ints, s: Array, cell: int, attempts: int) -> int:
    """Test the mover against a cell until it is neither adjusted nor slid.

    retail: CTransition::insert_into_cell 0x00509E70, IC-1...IC-3
    """
    if cell == NO_CELL:
        return COLLIDED
    ts = OK
    for _ in range(attempts):
        ts = _probe_cell(wf, wi, s, cell)
        if ts in (OK, COLLIDED):
            return ts
        if ts == SLID:
            forget_contact(s)
    return ts


@kernel
def enter_cell(wf: Array, wi: Ints, s: Array, new_cell: int) -> int:
    """Go to the cell that contains the mover, or out of all cells.

    retail: CTransition::check_other_cells 0x0050AE50, OC-3...OC-7
    """
    s[CHECK_CELL] = new_cell
    if new_cell != NO_CELL:
        adjust_check_pos(s, cell_id(wf, wi, new_cell))
        return OK
    if s[STEP_DOWN] != 0.0:
        return COLLIDED
    if is_outdoors(s[CHECK_POS]):
        o = CHECK_POS + ORIGIN
        land_cell, x, y = outside_cell(int(s[CHECK_POS]), s[o], s[o + 1])
        if land_cell == 0:
            return COLLIDED
        s[CHECK_POS] = land_cell
        s[o] = x
        s[o + 1] = y
    set_check_pos(s, CHECK_POS, NO_CELL)
    s[CELL_ARRAY_VALID] = 1.0
    return OK


@kernel
def probe_other_cells(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Test the mover against the other cells that it reaches, and change to the one that contains it.

    retail: CTransition::check_other_cells 0x0050AE50, OC-1...OC-7
    """
    new_cell = build_cell_array(wf, wi, s)
    i = 0
    while i < int(s[NUM_CELLS]):
        other = listed_cell(wi, s, i)
        i += 1
        if other < 0 or other == cell:
            continue
        ts = _probe_cell(wf, wi, s, other)
        if ts == SLID:
            forget_contact(s)
        if ts in (COLLIDED, ADJUSTED, SLID):
            return ts
    return enter_cell(wf, wi, s, new_cell)


@kernel
def insert_once(s: Array, ts: int) -> int:
    """Draw the consequences of a test that was not OK.

    retail: TI-5
    """
    if ts != OK:
        s[NEG_POLY_HIT] = 0.0
        if ts == SLID:
            forget_contact(s)
    return ts


@inlined
def stays_in_contact(s: Array) -> bool:
    """Say whether nothing is left to do: the ground is known, or none is looked for.

    retail: TI-14, TI-15
    """
    return (
        s[CONTACT_VALID] != 0.0
        or not int(s[OI_STATE]) & CONTACT
        or s[STEP_DOWN] != 0.0
        or s[CHECK_CELL] == NO_CELL
        or s[OI_STEP_DOWN] == 0.0
    )


@inlined
def _beyond_bound(s: Array) -> bool:
    """Say whether retail would recurse here.

    retail: TI-7, TI-13, TI-16
    """
    struck = s[NEG_POLY_HIT] != 0.0 and s[STEP_DOWN] == 0.0 and s[STEP_UP] == 0.0
    return s[COLLIDE] != 0.0 or struck or not stays_in_contact(s)


@kernel
def probe(wf: Array, wi: Ints, s: Array, attempts: int) -> int:
    """Insert the mover at its check position, inside a step.

    retail: CTransition::transitional_insert 0x0050B6F0, TI-1...TI-6, TI-14, TI-15
    """
    if s[CHECK_CELL] == NO_CELL:
        return OK
    ts = INVALID
    for _ in range(attempts):
        ts = probe_into_cell(wf, wi, s, int(s[CHECK_CELL]), attempts)
        if ts == OK:
            ts = probe_other_cells(wf, wi, s, int(s[CHECK_CELL]))
        insert_once(s, ts)
        if ts == COLLIDED:
            return ts
        if ts == OK:
            if _beyond_bound(s):
                s[STATUS] = STATUS_RECURSION
            return OK
    return ts
