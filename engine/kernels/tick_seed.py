"""CPhysicsObj, the seed (06, 6 and 10): what a tick, or a placement, tells its transition."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.body_layout import (
    B_BYPASSES_RESTRICTIONS,
    B_CELL,
    B_CONTACT_CELL_ID,
    B_CONTACT_PLANE,
    B_FREE_HEADING,
    B_HAS_WEENIE,
    B_ID,
    B_NUM_SPHERE,
    B_POSITION,
    B_SCALE,
    B_SLIDING_NORMAL,
    B_SPHERES,
    B_STATE,
    B_STEP_DOWN_HEIGHT,
    B_STEP_UP_HEIGHT,
    B_TRANSIENT,
    B_WANTED,
    B_WEENIE_BITS,
    P_CELL,
    P_DO_NOT_LOAD,
    P_POSE,
    P_SLIDE,
)
from engine.constants import (
    CONTACT,
    CONTACT_TS,
    DUMMY_RADIUS,
    EDGE_SLIDE,
    EDGE_SLIDE_PS,
    ETHEREAL,
    FREE_ROTATE,
    GRAVITY_PS,
    IS_IMPENETRABLE,
    IS_PK,
    IS_PKLITE,
    IS_PLAYER,
    MISSILE,
    ON_WALKABLE,
    ON_WALKABLE_TS,
    PATH_CLIPPED,
    SLIDING_TS,
    STATIONARY_FALL_TS,
    STATIONARY_STOP_TS,
    STATIONARY_STUCK_TS,
    WATER_CONTACT_TS,
)
from engine.kernels.collision_info import set_sliding_normal
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.path import init_path
from engine.kernels.query import clear, init_spheres, load_pose
from engine.kernels.tick_contact import leaves_contact
from engine.kernels.tick_velocity import has_bit
from engine.kernels.vector import copy_four, copy_place, copy_position, store
from engine.layout import (
    BEGIN_CELL,
    BEGIN_POS,
    CONTACT_CELL_ID,
    CONTACT_IS_WATER,
    CONTACT_PLANE,
    CONTACT_VALID,
    CURR_POS,
    DO_NOT_LOAD_CELLS,
    END_POS,
    FRAMES_STATIONARY_FALL,
    HAS_BEGIN_POS,
    LAST_KNOWN_CELL_ID,
    LAST_KNOWN_IS_WATER,
    LAST_KNOWN_PLANE,
    LAST_KNOWN_VALID,
    LOCAL_LOW_POINT,
    LOCAL_SPHERE,
    MOVER_GRAVITY,
    MOVER_ID,
    MOVER_MISSILE,
    MOVER_RESTRICTED,
    NUM_SPHERE,
    OI_ETHEREAL,
    OI_STATE,
    OI_STEP_DOWN,
    PLACEMENT_ALLOWS_SLIDING,
    RADIUS,
    STEP_DOWN_HEIGHT,
    STEP_UP_HEIGHT,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array


@entry
def seed_transition(s: Array, b: Array, admin_move: bool) -> int:
    """Prepare a transition from where the body is to where it wants to be; return its own flags.

    retail: CPhysicsObj::transition 0x00512DC0, SEED-1...SEED-6
    """
    clear(s)
    flags = _get_object_info(s, b, admin_move)
    _init_object(s, b, flags)
    _give_spheres(s, b)
    s[PLACEMENT_ALLOWS_SLIDING] = 1.0
    s[HAS_BEGIN_POS] = 1.0
    s[BEGIN_CELL] = b[B_CELL]
    copy_place(s, BEGIN_POS, b, B_POSITION)
    copy_place(s, END_POS, b, B_WANTED)
    copy_position(s, CURR_POS, b, B_POSITION)
    init_path(s)
    if has_bit(b, B_TRANSIENT, STATIONARY_STUCK_TS):
        s[FRAMES_STATIONARY_FALL] = 3.0
    elif has_bit(b, B_TRANSIENT, STATIONARY_STOP_TS):
        s[FRAMES_STATIONARY_FALL] = 2.0
    elif has_bit(b, B_TRANSIENT, STATIONARY_FALL_TS):
        s[FRAMES_STATIONARY_FALL] = 1.0
    return flags


@kernel
def seed_placement(s: Array, b: Array, p: Array) -> None:
    """Prepare the transition that puts a body down: it brings nothing along, and asks nothing of its state.

    retail: CPhysicsObj::SetPosition 0x005160C0, CPhysicsObj::CheckPositionInternal, SP-4, SP-5
    """
    clear(s)
    _init_object(s, b, 0)
    _give_spheres(s, b)
    s[PLACEMENT_ALLOWS_SLIDING] = p[P_SLIDE]
    s[DO_NOT_LOAD_CELLS] = p[P_DO_NOT_LOAD]
    s[BEGIN_CELL] = p[P_CELL]
    load_pose(s, CURR_POS, p, P_POSE)
    init_path(s)


@kernel
def _get_object_info(s: Array, b: Array, admin_move: bool) -> int:
    """Seed contact plane and sliding normal; return the mover's flags.

    retail: CPhysicsObj::get_object_info 0x00511CC0, GO-1...GO-8
    """
    flags = EDGE_SLIDE if has_bit(b, B_STATE, EDGE_SLIDE_PS) else 0
    if not admin_move:
        if has_bit(b, B_TRANSIENT, CONTACT_TS):
            flags |= _seed_contact(s, b)
        if has_bit(b, B_TRANSIENT, SLIDING_TS):
            set_sliding_normal(s, b[B_SLIDING_NORMAL], b[B_SLIDING_NORMAL + 1])
    if b[B_FREE_HEADING] != 0.0:
        flags |= FREE_ROTATE
    if has_bit(b, B_STATE, MISSILE):
        flags |= PATH_CLIPPED
    return flags


@inlined
def _seed_contact(s: Array, b: Array) -> int:
    """Seed the contact plane, or, when the body leaves it, only as the last known one.

    In that case the cell id goes to the contact plane's field all the same. What counts as water is the
    body's bit itself, 8.

    retail: GO-3...GO-5; CTransition::init_contact_plane 0x0050E850,
    init_last_known_contact_plane 0x0050E8E0
    """
    water = float(int(b[B_TRANSIENT]) & WATER_CONTACT_TS)
    s[LAST_KNOWN_VALID] = 1.0
    copy_four(s, LAST_KNOWN_PLANE, b, B_CONTACT_PLANE)
    s[LAST_KNOWN_IS_WATER] = water
    if leaves_contact(b):
        s[CONTACT_CELL_ID] = b[B_CONTACT_CELL_ID]
        return 0
    s[LAST_KNOWN_CELL_ID] = b[B_CONTACT_CELL_ID]
    s[CONTACT_VALID] = 1.0
    copy_four(s, CONTACT_PLANE, b, B_CONTACT_PLANE)
    s[CONTACT_IS_WATER] = water
    s[CONTACT_CELL_ID] = b[B_CONTACT_CELL_ID]
    return CONTACT | ON_WALKABLE if has_bit(b, B_TRANSIENT, ON_WALKABLE_TS) else CONTACT


@inlined
def _init_object(s: Array, b: Array, flags: int) -> None:
    """Set what the mover is and may do; the bits of its game object one by one, as a trace tells them.

    retail: OBJECTINFO::init 0x0050CF30, OI-1...OI-4
    """
    s[OI_STATE] = flags
    weenie = int(b[B_WEENIE_BITS])
    for bit in (IS_IMPENETRABLE, IS_PLAYER, IS_PK, IS_PKLITE):
        s[OI_STATE] = int(s[OI_STATE]) | (weenie & bit)
    s[STEP_UP_HEIGHT] = b[B_STEP_UP_HEIGHT]
    s[STEP_DOWN_HEIGHT] = b[B_STEP_DOWN_HEIGHT]
    s[OI_ETHEREAL] = int(b[B_STATE]) & ETHEREAL
    s[OI_STEP_DOWN] = 0.0 if has_bit(b, B_STATE, MISSILE) else 1.0
    s[MOVER_GRAVITY] = 1.0 if has_bit(b, B_STATE, GRAVITY_PS) else 0.0
    s[MOVER_ID] = b[B_ID]
    s[MOVER_MISSILE] = 1.0 if has_bit(b, B_STATE, MISSILE) else 0.0
    s[MOVER_RESTRICTED] = 0.0 if b[B_BYPASSES_RESTRICTIONS] != 0.0 else b[B_HAS_WEENIE]


@inlined
def _give_spheres(s: Array, b: Array) -> None:
    """Give the transition the body's spheres, or a small one if it has none.

    retail: SEED-4
    """
    count = int(b[B_NUM_SPHERE])
    if count > 0:
        init_spheres(s, count, b, B_SPHERES, b[B_SCALE])
        return
    s[NUM_SPHERE] = 1.0
    store(s, LOCAL_SPHERE, 0.0, 0.0, DUMMY_RADIUS)
    s[LOCAL_SPHERE + RADIUS] = DUMMY_RADIUS
    store(s, LOCAL_LOW_POINT, 0.0, 0.0, 0.0)
