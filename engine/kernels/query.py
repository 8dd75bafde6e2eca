"""From a query row to a row of state, and from there to a result row."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine import layout as at
from engine.kernels.collision_info import set_sliding_normal
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.frame import frame_cache
from engine.kernels.path import arrive, init_path
from engine.kernels.rounding import f32
from engine.kernels.vector import copy, copy_four, copy_vector, load, store

if TYPE_CHECKING:
    from engine.kernels.types import Array


@entry
def prepare(s: Array, q: Array) -> None:
    """Make a fresh transition of a query: mover, seeds, path; the trace's capacity is kept.

    retail: what stands in 06 for CPhysicsObj::transition 0x00512DC0
    """
    clear(s)
    _init_object(s, q)
    _seed(s, q)
    init_spheres(s, int(q[at.Q_NUM_SPHERE]), q, at.Q_SPHERES, q[at.Q_SCALE])
    s[at.PLACEMENT_ALLOWS_SLIDING] = q[at.Q_PLACEMENT_ALLOWS_SLIDING]
    s[at.BEGIN_CELL] = q[at.Q_BEGIN_CELL]
    s[at.HAS_BEGIN_POS] = q[at.Q_HAS_START]
    _load_place(s, at.BEGIN_POS, q, at.Q_START)
    _load_place(s, at.END_POS, q, at.Q_END)
    load_pose(s, at.CURR_POS, q, at.Q_START if q[at.Q_HAS_START] != 0.0 else at.Q_END)
    init_path(s)


@inlined
def clear(s: Array) -> None:
    """Forget the last transition; plan and trace's capacity are kept, the check position is turned nowhere.

    retail: CTransition::init 0x00509DD0, SPHEREPATH::init 0x0050C330
    """
    plan, capacity = s[at.PLAN], s[at.TRACE_CAPACITY]
    for i in range(at.CLEARED_SIZE):
        s[i] = 0.0
    s[at.PLAN] = plan
    s[at.TRACE_CAPACITY] = capacity
    s[at.CURR_CELL] = at.NO_CELL
    s[at.CHECK_CELL] = at.NO_CELL
    s[at.CHECK_POS + at.QUATERNION] = 1.0
    s[at.BACKUP_CELL] = at.NO_CELL
    s[at.LAST_COLLIDED_OBJECT] = at.NO_OBJECT


@inlined
def load_pose(s: Array, p: int, q: Array, pose: int) -> None:
    """Make a position of a pose; the rotation is not normalised.

    retail: Frame::UnPack 0x005351A0, 01 4.4
    """
    _load_place(s, p, q, pose)
    frame_cache(s, p)


@inlined
def _load_place(s: Array, p: int, q: Array, pose: int) -> None:
    """Make of a pose all of a position but its matrix, for whom nobody asks for that."""
    s[p] = q[pose]
    copy_four(s, p + at.QUATERNION, q, pose + 1)
    copy_vector(s, p + at.ORIGIN, q, pose + 5)


@inlined
def store_pose(out: Array, pose: int, s: Array, p: int) -> None:
    """Make a pose of a position."""
    out[pose] = s[p]
    copy_four(out, pose + 1, s, p + at.QUATERNION)
    copy_vector(out, pose + 5, s, p + at.ORIGIN)


@kernel
def _init_object(s: Array, q: Array) -> None:
    """Set what the mover is and may do.

    retail: OBJECTINFO::init 0x0050CF30, OI-1...OI-3
    """
    s[at.OI_STATE] = q[at.Q_STATE]
    s[at.STEP_UP_HEIGHT] = q[at.Q_STEP_UP_HEIGHT]
    s[at.STEP_DOWN_HEIGHT] = q[at.Q_STEP_DOWN_HEIGHT]
    s[at.OI_ETHEREAL] = q[at.Q_ETHEREAL]
    s[at.OI_STEP_DOWN] = q[at.Q_MAY_STEP_DOWN]
    s[at.MOVER_GRAVITY] = q[at.Q_GRAVITY]
    s[at.MOVER_ID] = q[at.Q_MOVER_ID]
    s[at.MOVER_MISSILE] = q[at.Q_MOVER_MISSILE]
    s[at.TARGET_ID] = q[at.Q_TARGET_ID]
    s[at.MOVER_RESTRICTED] = q[at.Q_MOVER_RESTRICTED]


@inlined
def init_spheres(s: Array, count: int, a: Array, spheres: int, scale: float) -> None:
    """Scale the mover's spheres, which begin at ``a[spheres]``.

    retail: SPHEREPATH::init_sphere 0x0050C670, SPI-1...SPI-3
    """
    s[at.NUM_SPHERE] = count
    for i in range(at.SPHERE_SIZE * count):
        s[at.LOCAL_SPHERE + i] = f32(scale * a[spheres + i])
    x, y, z = load(s, at.LOCAL_SPHERE)
    store(s, at.LOCAL_LOW_POINT, x, y, f32(z - s[at.LOCAL_SPHERE + at.RADIUS]))


@kernel
def _seed(s: Array, q: Array) -> None:
    """Set what the mover brings along from its last move.

    retail: what CTransition::init_contact_plane 0x0050E850 and init_sliding_normal 0x0050FF20 set, 04 5
    """
    seed = at.Q_COLLISION_INFO - at.COLLISION_INFO
    copy(s, at.COLLISION_INFO, q, at.Q_COLLISION_INFO, at.SLIDING_VALID - at.COLLISION_INFO)
    if q[seed + at.SLIDING_VALID] != 0.0:
        set_sliding_normal(s, q[seed + at.SLIDING_NORMAL], q[seed + at.SLIDING_NORMAL + 1])
    s[at.FRAMES_STATIONARY_FALL] = q[seed + at.FRAMES_STATIONARY_FALL]


@entry
def go_to_end(s: Array, q: Array, cell: float) -> None:
    """Go to where a query ends, in a cell: there a single call is made.

    retail: SPHEREPATH::set_check_pos 0x0050A8B0, 04 4
    """
    load_pose(s, at.CHECK_POS, q, at.Q_END)
    arrive(s, cell)


@entry
def set_path_fields(s: Array, q: Array) -> None:
    """Set the SPHEREPATH fields that a single collision call is made with."""
    s[at.INSERT_TYPE] = q[at.Q_INSERT_TYPE]
    s[at.STEP_DOWN] = q[at.Q_STEP_DOWN]
    s[at.STEP_DOWN_AMT] = q[at.Q_STEP_DOWN_AMT]
    s[at.WALK_INTERP] = q[at.Q_WALK_INTERP]
    s[at.WALKABLE_ALLOWANCE] = q[at.Q_WALKABLE_ALLOWANCE]
    s[at.CHECK_WALKABLE] = q[at.Q_CHECK_WALKABLE]
    s[at.COLLIDE] = q[at.Q_COLLIDE]
    s[at.OBSTRUCTION_ETHEREAL] = q[at.Q_OBSTRUCTION_ETHEREAL]
    s[at.BLDG_CHECK] = q[at.Q_BLDG_CHECK]
    s[at.HITS_INTERIOR_CELL] = q[at.Q_HITS_INTERIOR_CELL]


@entry
def report(wf: Array, s: Array, out: Array, result: int) -> None:
    """Write the answer, and the state that the query ended in."""
    out[at.R_RESULT] = result
    out[at.R_DISPATCH] = 0.0
    store_pose(out, at.R_CHECK, s, at.CHECK_POS)
    store_pose(out, at.R_CURR, s, at.CURR_POS)
    out[at.R_CHECK_CELL] = s[at.CHECK_CELL]
    out[at.R_CURR_CELL] = s[at.CURR_CELL]
    out[at.R_NUM_SPHERE] = s[at.NUM_SPHERE]
    copy(out, at.R_GLOBAL_SPHERES, s, at.GLOBAL_SPHERE, at.MAX_SPHERES * at.SPHERE_SIZE)
    copy(out, at.R_COLLISION_INFO, s, at.COLLISION_INFO, at.COLLISION_INFO_SIZE)
    _report_path(wf, s, out)
    out[at.R_STATE] = s[at.OI_STATE]
    out[at.R_KILL_VELOCITY] = s[at.KILL_VELOCITY]
    out[at.R_NODES_VISITED] = s[at.NODES_VISITED]
    out[at.R_POLYGONS_TESTED] = s[at.POLYGONS_TESTED]
    out[at.R_CELLS_LISTED] = s[at.CELLS_LISTED]
    out[at.R_OBJECTS_TESTED] = s[at.OBJECTS_TESTED]
    copy(out, at.R_SKIPPED, s, at.SKIPPED, at.SKIPPED_SIZE)
    out[at.R_STATUS] = s[at.STATUS]


@kernel
def _report_path(wf: Array, s: Array, out: Array) -> None:
    """Write the part of SPHEREPATH that is not poses and spheres."""
    poly = int(s[at.WALKABLE])
    out[at.R_WALKABLE] = wf[poly + at.POLYGON_ID] if poly != at.NO_POLYGON else -1.0
    out[at.R_WALKABLE_SHAPE] = wf[poly + at.POLYGON_SHAPE] if poly != at.NO_POLYGON else -1.0
    out[at.R_WALK_INTERP] = s[at.WALK_INTERP]
    out[at.R_WALKABLE_ALLOWANCE] = s[at.WALKABLE_ALLOWANCE]
    out[at.R_COLLIDE] = s[at.COLLIDE]
    out[at.R_STEP_UP] = s[at.STEP_UP]
    copy_vector(out, at.R_STEP_UP_NORMAL, s, at.STEP_UP_NORMAL)
    out[at.R_NEG_POLY_HIT] = s[at.NEG_POLY_HIT]
    out[at.R_NEG_STEP_UP] = s[at.NEG_STEP_UP]
    copy_vector(out, at.R_NEG_COLLISION_NORMAL, s, at.NEG_COLLISION_NORMAL)
    out[at.R_OBSTRUCTION_ETHEREAL] = s[at.OBSTRUCTION_ETHEREAL]
    out[at.R_HITS_INTERIOR_CELL] = s[at.HITS_INTERIOR_CELL]
