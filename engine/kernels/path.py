"""SPHEREPATH (04, 4): where the mover is, where it may go, and its spheres in each space."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import FIRST_INDOOR, PLACEMENT_INSERT, TRANSITION_INSERT
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.position import block_offset, position_localtolocal
from engine.kernels.rounding import f32
from engine.kernels.vector import copy_position, copy_vector, load, load_four, store
from engine.layout import (
    BACKUP_CELL,
    BACKUP_CHECK_POS,
    BEGIN_CELL,
    CELL_ARRAY_VALID,
    CHECK_CELL,
    CHECK_POS,
    COLLIDE,
    CURR_CELL,
    CURR_POS,
    GLOBAL_CURR_CENTER,
    GLOBAL_LOW_POINT,
    GLOBAL_SPHERE,
    HAS_BEGIN_POS,
    INSERT_TYPE,
    LOCAL_LOW_POINT,
    LOCAL_SPHERE,
    LOCALSPACE_CURR_CENTER,
    LOCALSPACE_HAS_CURRENT,
    LOCALSPACE_INVERSE,
    LOCALSPACE_LOW_POINT,
    LOCALSPACE_OF,
    LOCALSPACE_POS,
    LOCALSPACE_SPHERE,
    LOCALSPACE_Z,
    MATRIX,
    NEG_COLLISION_NORMAL,
    NEG_POLY_HIT,
    NEG_STEP_UP,
    NUM_SPHERE,
    ORIGIN,
    RADIUS,
    SPHERE_SIZE,
    STEP_UP_NORMAL,
    WALK_INTERP,
    WALKABLE,
    WALKABLE_CHECK_POS,
    WALKABLE_POS,
    WALKABLE_SCALE,
    WALKABLE_UP,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Matrix, Sphere, Vector


@kernel
def init_path(s: Array) -> None:
    """Start at the current position: who calls has put begin_pos there or, for a placement, end_pos.

    retail: SPHEREPATH::init_path 0x0050CE20, SPP-1...SPP-4
    """
    s[CURR_CELL] = s[BEGIN_CELL]
    s[LOCALSPACE_OF] = 0.0
    cache_global_curr_center(s)
    s[INSERT_TYPE] = PLACEMENT_INSERT if s[HAS_BEGIN_POS] == 0.0 else TRANSITION_INSERT


@kernel
def cache_global_curr_center(s: Array) -> None:
    """Put the spheres' centres at the current position.

    retail: SPHEREPATH::cache_global_curr_center 0x0050C740, 04 4
    """
    m, o = CURR_POS + MATRIX, CURR_POS + ORIGIN
    for i in range(int(s[NUM_SPHERE])):
        x, y, z = load(s, LOCAL_SPHERE + SPHERE_SIZE * i)
        store(
            s,
            GLOBAL_CURR_CENTER + 3 * i,
            f32(((x * s[m] + y * s[m + 3]) + z * s[m + 6]) + s[o]),
            f32(((s[m + 7] * z + x * s[m + 1]) + s[m + 4] * y) + s[o + 1]),
            f32(((s[m + 8] * z + s[m + 5] * y) + s[m + 2] * x) + s[o + 2]),
        )


@inlined
def placed(matrix: Matrix, origin: Vector, x: float, y: float, z: float) -> Vector:
    """Return a sphere's centre as a check position has it.

    retail: SPHEREPATH::cache_global_sphere 0x0050C810, 04 4, form B
    """
    m0, m1, m2, m3, m4, m5, m6, m7, m8 = matrix
    return (
        f32(((x * m0 + y * m3) + z * m6) + origin[0]),
        f32(((m7 * z + x * m1) + m4 * y) + origin[1]),
        f32(((m8 * z + m2 * x) + m5 * y) + origin[2]),
    )


@inlined
def _placed(s: Array, sphere: int) -> Vector:
    """Return the same as the row's check position has it."""
    m = CHECK_POS + MATRIX
    matrix = *load(s, m), *load(s, m + 3), *load(s, m + 6)
    x, y, z = load(s, sphere)
    return placed(matrix, load(s, CHECK_POS + ORIGIN), x, y, z)


@kernel
def cache_global_sphere(s: Array) -> None:
    """Put the spheres and the low point at the check position.

    retail: SPHEREPATH::cache_global_sphere 0x0050C810, 04 4, form B
    """
    for i in range(int(s[NUM_SPHERE])):
        local, at = LOCAL_SPHERE + SPHERE_SIZE * i, GLOBAL_SPHERE + SPHERE_SIZE * i
        s[at + RADIUS] = s[local + RADIUS]
        x, y, z = _placed(s, local)
        store(s, at, x, y, z)
    m, o = CHECK_POS + MATRIX, CHECK_POS + ORIGIN
    x, y, z = load(s, LOCAL_LOW_POINT)
    store(
        s,
        GLOBAL_LOW_POINT,
        f32(((s[m + 6] * z + s[m] * x) + s[m + 3] * y) + s[o]),
        f32(((s[m + 7] * z + s[m + 1] * x) + s[m + 4] * y) + s[o + 1]),
        f32(((s[m + 8] * z + s[m + 2] * x) + s[m + 5] * y) + s[o + 2]),
    )


@inlined
def _add(s: Array, at: int, x: float, y: float, z: float) -> None:
    """Add a vector to three stored numbers."""
    store(s, at, f32(s[at] + x), f32(s[at + 1] + y), f32(s[at + 2] + z))


@kernel
def shift_global_sphere(s: Array, x: float, y: float, z: float) -> None:
    """Move the spheres and the low point; rounding errors add up, as in retail.

    retail: SPHEREPATH::cache_global_sphere 0x0050C810, 04 4, form A
    """
    for i in range(int(s[NUM_SPHERE])):
        _add(s, GLOBAL_SPHERE + SPHERE_SIZE * i, x, y, z)
    _add(s, GLOBAL_LOW_POINT, x, y, z)


@kernel
def add_offset_to_check_pos(s: Array, x: float, y: float, z: float) -> None:
    """Move the check position and its spheres by a stored vector.

    retail: SPHEREPATH::add_offset_to_check_pos 0x00509D10, AO-1...AO-3
    """
    s[CELL_ARRAY_VALID] = 0.0
    _add(s, CHECK_POS + ORIGIN, x, y, z)
    shift_global_sphere(s, x, y, z)


@inlined
def _to_localspace(s: Array, a: Array, p: int, pos: int, i: int) -> Vector:
    """Take the i-th sphere's centre at a position of the row into the space at p, which was entered.

    retail: LS-2
    """
    x, y, z = load(s, LOCAL_SPHERE + SPHERE_SIZE * i)
    vx, vy, vz = position_localtolocal(a, p, s, pos, x, y, z)
    inv = s[LOCALSPACE_INVERSE]
    return f32(inv * vx), f32(inv * vy), f32(inv * vz)


@inlined
def _begin_localspace(s: Array, a: Array, p: int, scale: float) -> None:
    """Note what the space at p is, and where up is in it.

    retail: LS-1, LS-3, LS-4
    """
    copy_position(s, LOCALSPACE_POS, a, p)
    s[LOCALSPACE_INVERSE] = f32(1.0 / scale)
    m = LOCALSPACE_POS + MATRIX
    ux = f32((s[m + 1] + s[m]) * 0.0 + s[m + 2])
    uy = f32((s[m + 4] + s[m + 3]) * 0.0 + s[m + 5])
    uz = f32((s[m + 7] + s[m + 6]) * 0.0 + s[m + 8])
    store(s, LOCALSPACE_Z, ux, uy, uz)


@inlined
def _enter_sphere(s: Array, a: Array, p: int, i: int) -> None:
    """Put the i-th sphere, at the check position, into the space at p, which was entered.

    retail: LS-2
    """
    at = LOCALSPACE_SPHERE + SPHERE_SIZE * i
    x, y, z = _to_localspace(s, a, p, CHECK_POS, i)
    store(s, at, x, y, z)
    s[at + RADIUS] = f32(s[LOCALSPACE_INVERSE] * s[LOCAL_SPHERE + SPHERE_SIZE * i + RADIUS])


@inlined
def _enter_center(s: Array, i: int) -> None:
    """Put the centre of the i-th sphere, at the current position, into the space that was entered.

    retail: LS-2
    """
    x, y, z = _to_localspace(s, s, LOCALSPACE_POS, CURR_POS, i)
    store(s, LOCALSPACE_CURR_CENTER + 3 * i, x, y, z)


@entry
def cache_localspace_sphere(s: Array, a: Array, p: int, scale: float) -> None:
    """Put all of the spheres, at the check and the current position, into the space of what is tested.

    `a`, `p`: the position of that space; `scale`: of the thing tested. What is only tested against a tree
    takes `enter_localspace`.

    retail: SPHEREPATH::cache_localspace_sphere 0x0050C9D0, LS-1...LS-5
    """
    _begin_localspace(s, a, p, scale)
    for i in range(int(s[NUM_SPHERE])):
        _enter_sphere(s, a, p, i)
        _enter_center(s, i)
    ux, uy, uz = load(s, LOCALSPACE_Z)
    r = s[LOCALSPACE_SPHERE + RADIUS]
    by, bz = f32(r * uy), f32(r * uz)
    x, y, z = load(s, LOCALSPACE_SPHERE)
    store(s, LOCALSPACE_LOW_POINT, f32(x - r * ux), f32(y - by), f32(z - bz))
    s[LOCALSPACE_OF] = 0.0


@kernel
def enter_localspace(s: Array, wf: Array, p: int, scale: float) -> None:
    """Put sphere 0, at the check position, into the space of a cell or a part, at ``wf[p]``.

    It is all that looking for ground takes. What some paths through a tree need besides, they ask for
    themselves: `enter_second_sphere`, `enter_current_center`. Nobody reads the second sphere's current
    centre, or the low point.

    A step tests the same cell several times. Unless the mover has moved on in between, or something else
    has been tested, only what depends on the check position has changed since.

    retail: SPHEREPATH::cache_localspace_sphere 0x0050C9D0, LS-1...LS-4
    """
    if s[LOCALSPACE_OF] != p:
        _begin_localspace(s, wf, p, scale)
        s[LOCALSPACE_OF] = p
        s[LOCALSPACE_HAS_CURRENT] = 0.0
    if s[NUM_SPHERE] > 0.0:
        _enter_sphere(s, wf, p, 0)


@kernel
def enter_second_sphere(s: Array) -> None:
    """Put sphere 1 into the space that was entered last.

    retail: SPHEREPATH::cache_localspace_sphere 0x0050C9D0, LS-2
    """
    _enter_sphere(s, s, LOCALSPACE_POS, 1)


@inlined
def entered_sphere(s: Array, i: int) -> Sphere:
    """Return the i-th sphere, centre and radius, in the space that was entered last; put the second there."""
    if i > 0:
        enter_second_sphere(s)
    return load_four(s, LOCALSPACE_SPHERE + SPHERE_SIZE * i)


@kernel
def enter_current_center(s: Array) -> None:
    """Put sphere 0's centre at the current position into the space that was entered last, unless it is there.

    retail: SPHEREPATH::cache_localspace_sphere 0x0050C9D0, LS-2
    """
    if s[LOCALSPACE_HAS_CURRENT] == 0.0 and s[NUM_SPHERE] > 0.0:
        _enter_center(s, 0)
        s[LOCALSPACE_HAS_CURRENT] = 1.0


@kernel
def set_check_pos(s: Array, p: int, cell: float) -> None:
    """Go to another position of the row, and recompute the spheres.

    retail: SPHEREPATH::set_check_pos 0x0050A8B0, 04 4
    """
    copy_position(s, CHECK_POS, s, p)
    arrive(s, cell)


@inlined
def arrive(s: Array, cell: float) -> None:
    """Take the spheres to a new check position, which is in a cell."""
    s[CHECK_CELL] = cell
    s[CELL_ARRAY_VALID] = 0.0
    cache_global_sphere(s)


@kernel
def save_check_pos(s: Array) -> None:
    """Remember the check position in the one slot there is.

    retail: SPHEREPATH::save_check_pos 0x0050A880, 04 4
    """
    s[BACKUP_CELL] = s[CHECK_CELL]
    copy_position(s, BACKUP_CHECK_POS, s, CHECK_POS)


@kernel
def restore_check_pos(s: Array) -> None:
    """Go back to the remembered check position.

    retail: SPHEREPATH::restore_check_pos 0x0050B100, 04 4
    """
    set_check_pos(s, BACKUP_CHECK_POS, s[BACKUP_CELL])


@kernel
def adjust_check_pos(s: Array, cell_id: float) -> None:
    """Express the check position in a cell's block.

    retail: SPHEREPATH::adjust_check_pos 0x0050CC00, AC-1, AC-2
    """
    if (int(cell_id) & 0xFFFF) < FIRST_INDOOR:
        bx, by = block_offset(cell_id, s[CHECK_POS])
        shift_global_sphere(s, bx, by, 0.0)
        _add(s, CHECK_POS + ORIGIN, bx, by, 0.0)
    s[CHECK_POS] = cell_id


@kernel
def set_collide(s: Array, x: float, y: float, z: float) -> None:
    """Note that an airborne mover struck something, so that a landing is tried.

    retail: SPHEREPATH::set_collide 0x005378A0, 04 4
    """
    s[COLLIDE] = 1.0
    save_check_pos(s)
    store(s, STEP_UP_NORMAL, x, y, z)
    s[WALK_INTERP] = 1.0


@inlined
def set_neg_poly_hit(s: Array, step_up: float, x: float, y: float, z: float) -> None:
    """Note an overlapped polygon that faces along the movement; its normal is stored negated.

    retail: SPHEREPATH::set_neg_poly_hit 0x005398E0, 04 4
    """
    s[NEG_STEP_UP] = step_up
    s[NEG_POLY_HIT] = 1.0
    store(s, NEG_COLLISION_NORMAL, -x, -y, -z)


@kernel
def set_walkable(s: Array, x: float, y: float, z: float, r: float, poly: int, scale: float) -> None:
    """Note the polygon that supports the mover, with the sphere and the space it was found in.

    retail: SPHEREPATH::set_walkable 0x00539FC0, 04 4
    """
    store(s, WALKABLE_CHECK_POS, x, y, z)
    s[WALKABLE_CHECK_POS + RADIUS] = r
    s[WALKABLE] = poly
    copy_vector(s, WALKABLE_UP, s, LOCALSPACE_Z)
    copy_position(s, WALKABLE_POS, s, LOCALSPACE_POS)
    s[WALKABLE_SCALE] = scale
