"""CTransition::transitional_insert (05, 5): test the check position, and answer what is struck."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import (
    ADJUSTED,
    COLLIDED,
    EDGE_SLIDE,
    INVALID,
    NEEDS_STEP_UP,
    OK,
    ON_WALKABLE,
    SLID,
    Z_LANDING,
)
from engine.kernels.adjust import cliff_slide
from engine.kernels.cells import accept_shape, build_cell_array, listed_cell, shape_count, test_shape
from engine.kernels.collision_info import forget_contact, set_collision_normal
from engine.kernels.compile import inlined, kernel, pasted
from engine.kernels.path import (
    add_offset_to_check_pos,
    cache_localspace_sphere,
    restore_check_pos,
    save_check_pos,
)
from engine.kernels.probing import enter_cell, insert_once, stays_in_contact
from engine.kernels.rounding import f32
from engine.kernels.sphere import slide_sphere
from engine.kernels.stepping import (
    check_walkable,
    insert_as_placement,
    precipice_slide,
    step_down,
    step_limits,
    step_up,
    step_up_or_slide,
    step_up_slide,
)
from engine.kernels.trace import trace_close
from engine.kernels.vector import copy, load
from engine.layout import (
    CELL_ARRAY_VALID,
    CHECK_CELL,
    COLLIDE,
    CONTACT_PLANE,
    CONTACT_VALID,
    GLOBAL_CURR_CENTER,
    GLOBAL_SPHERE,
    KILL_VELOCITY,
    LAST_KNOWN_VALID,
    LOCALSPACE_SPHERE,
    NEG_COLLISION_NORMAL,
    NEG_POLY_HIT,
    NEG_STEP_UP,
    NO_CELL,
    NO_POLYGON,
    NUM_CELLS,
    NUM_SPHERE,
    OI_STATE,
    RADIUS,
    SPHERE_SIZE,
    STEP_DOWN,
    STEP_DOWN_HEIGHT,
    STEP_UP,
    STEP_UP_NORMAL,
    WALKABLE,
    WALKABLE_ALLOWANCE,
    WALKABLE_CHECK_POS,
    WALKABLE_POS,
    WALKABLE_SCALE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def _find_in_cell(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Test the mover against a cell; run the step up that a collision asks for.

    retail: CEnvCell::find_collisions 0x0052C100, 09 3.3
    """
    for shape in range(shape_count(wi, s, cell)):
        ts = test_shape(wf, wi, s, cell, shape)
        if ts == NEEDS_STEP_UP:
            ts = step_up_or_slide(wf, wi, s)
            trace_close(wi, s, ts)
        ts = accept_shape(wi, s, cell, shape, ts)
        if ts != OK:
            return ts
    return OK


@pasted
def insert_into_cell(wf: Array, wi: Ints, s: Array, cell: int, attempts: int) -> int:
    """Test the mover against a cell until it is neither adjusted nor slid.

    retail: CTransition::insert_into_cell 0x00509E70, IC-1...IC-3
    """
    if cell == NO_CELL:
        return COLLIDED
    ts = OK
    for _ in range(attempts):
        ts = _find_in_cell(wf, wi, s, cell)
        if ts in (OK, COLLIDED):
            return ts
        if ts == SLID:
            forget_contact(s)
    return ts


@pasted
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
        if other == cell:
            continue
        ts = _find_in_cell(wf, wi, s, other)
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
        stop, ts = _keep_contact(wf, wi, s)
        if stop:
            return ts
    return ts


@pasted
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


@pasted
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


@kernel
def step_down_in_halves(wf: Array, wi: Ints, s: Array, height: float, z: float) -> tuple[bool, float]:
    """Step down at once, or in two halves where the step is higher than the sphere.

    Returns whether ground was found, and the height of a single step.

    retail: TI-18, TI-19, FP-5
    """
    r = s[GLOBAL_SPHERE + RADIUS]
    if s[NUM_SPHERE] < 2.0 and r + r < height:
        height = f32(r * 0.5)
    if r + r >= height:
        return step_down(wf, wi, s, height, z), height
    height = f32(height * 0.5)
    found = step_down(wf, wi, s, height, z) or step_down(wf, wi, s, height, z)
    return found, height


@pasted
def _keep_contact(wf: Array, wi: Ints, s: Array) -> tuple[bool, int]:
    """Step down to stay on the ground, or deal with the edge that the mover is beyond.

    Returns whether the insert ends here, and its answer.

    retail: TI-16...TI-22
    """
    height, z = step_limits(s, STEP_DOWN_HEIGHT)
    s[WALKABLE_ALLOWANCE] = z
    save_check_pos(s)
    found, height = step_down_in_halves(wf, wi, s, height, z)
    if found:
        s[WALKABLE] = NO_POLYGON
        return True, OK
    return _edge_slide(wf, wi, s, height, z)


@inlined
def _leave_ground(s: Array) -> None:
    """Go back to before the step, without a ground.

    retail: ES-1, ES-4
    """
    s[WALKABLE] = NO_POLYGON
    restore_check_pos(s)
    forget_contact(s)
    s[CELL_ARRAY_VALID] = 1.0


@pasted
def _edge_slide(wf: Array, wi: Ints, s: Array, height: float, z: float) -> tuple[bool, int]:
    """Slide along a cliff or an edge, or step off it.

    Returns whether the insert ends here, and its answer.

    retail: CTransition::edge_slide 0x0050B3D0, ES-1...ES-4
    """
    state = int(s[OI_STATE])
    if not (state & ON_WALKABLE and state & EDGE_SLIDE):
        _leave_ground(s)
        return True, OK
    if s[CONTACT_VALID] != 0.0 and s[CONTACT_PLANE + 2] < z:
        s[WALKABLE] = NO_POLYGON
        restore_check_pos(s)
        ts = cliff_slide(s, CONTACT_PLANE)
        forget_contact(s)
        return False, ts
    if s[WALKABLE] != NO_POLYGON:
        restore_check_pos(s)
        forget_contact(s)
        ts = precipice_slide(wf, s)
        return ts == COLLIDED, ts
    if s[CONTACT_VALID] != 0.0:
        _leave_ground(s)
        return True, OK
    return _edge_behind(wf, wi, s, height, z)


@pasted
def _edge_behind(wf: Array, wi: Ints, s: Array, height: float, z: float) -> tuple[bool, int]:
    """Look for the edge where the mover came from.

    Returns whether the insert ends here, and its answer.

    retail: CTransition::edge_slide 0x0050B3D0, ES-5...ES-7
    """
    cx, cy, cz = load(s, GLOBAL_CURR_CENTER)
    gx, gy, gz = load(s, GLOBAL_SPHERE)
    add_offset_to_check_pos(s, f32(cx - gx), f32(cy - gy), f32(cz - gz))
    step_down(wf, wi, s, height, z)
    forget_contact(s)
    restore_check_pos(s)
    if s[WALKABLE] == NO_POLYGON:
        s[CELL_ARRAY_VALID] = 1.0
        return True, COLLIDED
    cache_localspace_sphere(s, s, WALKABLE_POS, s[WALKABLE_SCALE])
    copy(s, WALKABLE_CHECK_POS, s, LOCALSPACE_SPHERE, SPHERE_SIZE)
    ts = precipice_slide(wf, s)
    return ts == COLLIDED, ts
