"""CTransition::transitional_insert (05, 5): test the check position, and answer what is struck."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import ADJUSTED, COLLIDED, INVALID, NEEDS_STEP_UP, OK, SLID, Z_LANDING
from engine.kernels.cell_array import listed_cell
from engine.kernels.cells import (
    accept_fixed,
    build_cell_array,
    fixed_count,
    is_tested,
    object_count,
    object_in,
    test_fixed,
)
from engine.kernels.collision_info import forget_contact, set_collision_normal
from engine.kernels.compile import kernel
from engine.kernels.edge_slide import keep_contact
from engine.kernels.objects import accept_object, begin_object, test_object_shape
from engine.kernels.path import restore_check_pos
from engine.kernels.probing import enter_cell, insert_once, stays_in_contact
from engine.kernels.restrictions import check_entry_restrictions, is_restricted
from engine.kernels.sphere import slide_sphere
from engine.kernels.stepping import (
    check_walkable,
    insert_as_placement,
    step_up,
    step_up_or_slide,
    step_up_slide,
)
from engine.kernels.trace import trace_close
from engine.kernels.vector import load
from engine.layout import (
    CHECK_CELL,
    COLLIDE,
    CONTACT_VALID,
    KILL_VELOCITY,
    LAST_KNOWN_VALID,
    NEG_COLLISION_NORMAL,
    NEG_POLY_HIT,
    NEG_STEP_UP,
    NO_CELL,
    NO_POLYGON,
    NUM_CELLS,
    STEP_DOWN,
    STEP_UP,
    STEP_UP_NORMAL,
    WALKABLE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def answer_step_up(wf: Array, wi: Ints, s: Array) -> int:
    """Run the step up that a collision asked for, and end its trace.

    retail: 03 11.2-3, 07 5, 07 10.6
    """
    ts = step_up_or_slide(wf, wi, s)
    trace_close(wi, s, ts)
    return ts


@kernel
def find_object(wf: Array, wi: Ints, s: Array, thing: int) -> int:
    """Test the mover against an object.

    retail: CPhysicsObj::FindObjCollisions 0x0050F050, 08 3
    """
    shapes = begin_object(wi, s, thing)
    if shapes < 0:
        return OK
    ts = OK
    for k in range(shapes):
        ts = test_object_shape(wf, wi, s, thing, k)
        if ts == NEEDS_STEP_UP:
            ts = answer_step_up(wf, wi, s)
        if ts != OK:
            break
    return accept_object(wi, s, thing, ts)


@kernel
def find_obj_collisions(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Test the mover against the objects of a cell.

    retail: CObjCell::find_obj_collisions 0x0052B750, 09 3.2
    """
    for i in range(object_count(wf, wi, s, cell)):
        thing = object_in(wi, cell, i)
        if is_tested(wf, wi, s, thing):
            ts = find_object(wf, wi, s, thing)
            if ts != OK:
                return ts
    return OK


@kernel
def find_in_cell(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Test the mover against a cell.

    retail: CEnvCell::find_collisions 0x0052C100, CLandCell::find_collisions 0x00532D60, 09 3.1-7
    """
    if is_restricted(wi, cell) and check_entry_restrictions(wf, wi, s, cell) != OK:
        return COLLIDED
    for fixed in range(fixed_count(wf, wi, s, cell)):
        ts = test_fixed(wf, wi, s, cell, fixed)
        if ts == NEEDS_STEP_UP:
            ts = answer_step_up(wf, wi, s)
        accept_fixed(wi, s, cell, fixed, ts)
        if ts != OK:
            return ts
    return find_obj_collisions(wf, wi, s, cell)


@kernel
def insert_into_cell(wf: Array, wi: Ints, s: Array, cell: int, attempts: int) -> int:
    """Test the mover against a cell until it is neither adjusted nor slid.

    retail: CTransition::insert_into_cell 0x00509E70, IC-1...IC-3
    """
    if cell == NO_CELL:
        return COLLIDED
    ts = OK
    for _ in range(attempts):
        ts = find_in_cell(wf, wi, s, cell)
        if ts in (OK, COLLIDED):
            return ts
        if ts == SLID:
            forget_contact(s)
    return ts


@kernel
def check_other_cells(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Test the mover against the other cells that it reaches, and change to the one that contains it.

    A step up in between lists the cells anew; the loop goes on in the new list, and the cell that is
    entered is that of the old position.

    retail: CTransition::check_other_cells 0x0050AE50, OC-1...OC-7
    """
    new_cell = build_cell_array(wf, wi, s)
    i = 0
    while i < int(s[NUM_CELLS]):
        other = listed_cell(wi, s, i)
        i += 1
        if other < 0 or other == cell:
            continue
        ts = find_in_cell(wf, wi, s, other)
        if ts == SLID:
            forget_contact(s)
        if ts in (COLLIDED, ADJUSTED, SLID):
            return ts
    return enter_cell(wf, wi, s, new_cell)


@kernel
def transitional_insert(wf: Array, wi: Ints, s: Array, attempts: int) -> int:
    """Insert the mover at its check position.

    retail: CTransition::transitional_insert 0x0050B6F0, TI-1...TI-22
    """
    if s[CHECK_CELL] == NO_CELL:
        return OK
    ts = INVALID
    for _ in range(attempts):
        ts = insert_into_cell(wf, wi, s, int(s[CHECK_CELL]), attempts)
        if ts == OK:
            ts = check_other_cells(wf, wi, s, int(s[CHECK_CELL]))
        insert_once(s, ts)
        if ts == COLLIDED:
            return ts
        if ts != OK:
            continue
        if s[COLLIDE] != 0.0:
            return _land(wf, wi, s, attempts)
        if s[NEG_POLY_HIT] != 0.0 and s[STEP_DOWN] == 0.0 and s[STEP_UP] == 0.0:
            ts = _answer_negative_hit(wf, wi, s)
            continue
        if stays_in_contact(s):
            return OK
        stop, ts = keep_contact(wf, wi, s)
        if stop:
            return ts
    return ts


@kernel
def _land(wf: Array, wi: Ints, s: Array, attempts: int) -> int:
    """Accept a landing that was found, or go back to before the collision.

    retail: TI-8...TI-12
    """
    s[COLLIDE] = 0.0
    landed = s[CONTACT_VALID] != 0.0 and check_walkable(wf, wi, s, Z_LANDING)
    if landed:
        landed = insert_as_placement(wf, wi, s, attempts) == OK
    s[WALKABLE] = NO_POLYGON
    if landed:
        return OK
    restore_check_pos(s)
    forget_contact(s)
    if s[LAST_KNOWN_VALID] != 0.0:
        s[KILL_VELOCITY] += 1.0
        s[LAST_KNOWN_VALID] = 0.0
    else:
        x, y, z = load(s, STEP_UP_NORMAL)
        set_collision_normal(s, x, y, z)
    return COLLIDED


@kernel
def _answer_negative_hit(wf: Array, wi: Ints, s: Array) -> int:
    """Step on, or slide along, a polygon that was overlapped from behind.

    retail: TI-13
    """
    s[NEG_POLY_HIT] = 0.0
    if s[NEG_STEP_UP] == 0.0:
        return slide_sphere(s, NEG_COLLISION_NORMAL)
    x, y, z = load(s, NEG_COLLISION_NORMAL)
    if step_up(wf, wi, s, x, y, z):
        return OK
    return step_up_slide(s)
