"""Where things lie in the row of a body: a CPhysicsObj that ticks (06, 1).

Like a query's row it is float64 throughout, and kernels address it with the constants below. Python
reads it by name through `BODY_DTYPE`.
"""

from __future__ import annotations

from typing import Final

from engine.constants import frozen
from engine.layout import (
    MAX_SPHERES,
    PLANE_SIZE,
    POSE_SIZE,
    POSITION_SIZE,
    SKIPPED_SIZE,
    SPHERE_SIZE,
    VECTOR_SIZE,
    Row,
)

_row = Row()

# --- where it is (m_position), laid out as `engine.layout.POSITION_SIZE` says -----------------------
B_POSITION: Final = _row.field("cell_id")
_row.field("rotation", 4)
_row.field("matrix", 9)
B_ORIGIN: Final = _row.field("origin", VECTOR_SIZE)
B_CELL: Final = _row.field("cell")
"""Index of the cell that it is in; `engine.layout.NO_CELL` once it is lost."""
B_HAS_PARENT: Final = _row.field("has_parent")
"""Whether it is attached to another object, and so does not move by itself."""

# --- what it is ------------------------------------------------------------------------------------
B_ID: Final = _row.field("id")
B_NUM_SPHERE: Final = _row.field("num_sphere")
B_SPHERES: Final = _row.field("spheres", MAX_SPHERES, SPHERE_SIZE)
"""In object space, before `B_SCALE`."""
B_SCALE: Final = _row.field("scale")
B_STEP_UP_HEIGHT: Final = _row.field("step_up_height")
B_STEP_DOWN_HEIGHT: Final = _row.field("step_down_height")
B_FRICTION: Final = _row.field("friction")
B_ELASTICITY: Final = _row.field("elasticity")
B_HAS_MOVEMENT_MANAGER: Final = _row.field("has_movement_manager")
B_FREE_HEADING: Final = _row.field("free_heading")
B_HAS_WEENIE: Final = _row.field("has_weenie")
B_WEENIE_BITS: Final = _row.field("weenie_bits")
"""ObjectInfo bits that its game object adds (OI-4)."""
B_BYPASSES_RESTRICTIONS: Final = _row.field("bypasses_restrictions")
"""Whether its game object may enter every cell (09, 3.1)."""
B_TRACKS_OBJECTS: Final = _row.field("tracks_objects")
"""Whether it takes notice of the objects that it touches (HC-2)."""

# --- how it moves ----------------------------------------------------------------------------------
B_STATE: Final = _row.field("state")
B_TRANSIENT: Final = _row.field("transient_state")
B_VELOCITY: Final = _row.field("velocity", VECTOR_SIZE)
B_ACCELERATION: Final = _row.field("acceleration", VECTOR_SIZE)
B_OMEGA: Final = _row.field("omega", VECTOR_SIZE)
B_CACHED_VELOCITY: Final = _row.field("cached_velocity", VECTOR_SIZE)
B_CONTACT_PLANE: Final = _row.field("contact_plane", PLANE_SIZE)
B_CONTACT_CELL_ID: Final = _row.field("contact_plane_cell_id")
B_SLIDING_NORMAL: Final = _row.field("sliding_normal", VECTOR_SIZE)
B_JUMPED: Final = _row.field("jumped_this_frame")
B_COLLIDING: Final = _row.field("colliding_with_environment")

# --- time, seconds, not rounded to float32 ---------------------------------------------------------
B_CLOCK: Final = _row.field("clock")
"""What time it is: Timer::cur_time."""
B_UPDATE_TIME: Final = _row.field("update_time")
"""Up to when it is simulated."""
B_PHYSICS_TIME: Final = _row.field("physics_time")
"""Up to when it will be after the tick that is running: PhysicsTimer::curr_time."""

# --- what the last tick did ------------------------------------------------------------------------
REPORT: Final = frozen(_row.size)
B_OUTCOME: Final = _row.field("outcome")
"""Index in `OUTCOMES`."""
B_KILL_VELOCITY: Final = _row.field("kill_velocity")
"""How often the transition stopped it."""
B_COLLISION_NORMAL_VALID: Final = _row.field("collision_normal_valid")
B_COLLISION_NORMAL: Final = _row.field("collision_normal", VECTOR_SIZE)
B_FRAMES_STATIONARY_FALL: Final = _row.field("frames_stationary_fall")
B_COLLIDED_WITH_ENVIRONMENT: Final = _row.field("collided_with_environment")
B_REPORTED: Final = _row.field("reported")
"""Whether a game object was told of a collision."""
B_NODES_VISITED: Final = _row.field("nodes_visited")
B_POLYGONS_TESTED: Final = _row.field("polygons_tested")
B_SKIPPED: Final = _row.field("skipped", SKIPPED_SIZE)
"""How often each shortcut was taken, as in `engine.layout.SKIPPED`."""
B_STATUS: Final = _row.field("status")
"""`engine.layout.STATUS_OK`, or why the tick could not be finished."""
REPORT_SIZE: Final = frozen(_row.size - REPORT)

B_WANTED: Final = _row.field("wanted", POSITION_SIZE)
"""Where the tick wanted to go: retail's local new_pos."""

# --- which objects it has touched lately (collision_table) ------------------------------------------
RECORD_SIZE: Final = frozen(3)
"""A record: the object's index in the world, when it was touched last, 1 if it was ethereal then."""
RECORD_TIME: Final = frozen(1)
RECORD_ETHEREAL: Final = frozen(2)
MAX_RECORDS: Final = frozen(256)
"""How many objects a body can remember, all of them touched within the last second."""
STATUS_CROWDED: Final = frozen(32)
"""Status of a body that has touched more; a number that no status of `engine.layout` has."""
B_NUM_RECORDS: Final = _row.field("num_records")
B_RECORDS: Final = _row.field("records", MAX_RECORDS, RECORD_SIZE)
"""The first `B_NUM_RECORDS` are in use, in any order."""

BODY_SIZE: Final = frozen(_row.size)
BODY_DTYPE: Final = _row.dtype()

# --- where a body is to be put down (06, 10) --------------------------------------------------------
_placement = Row()

P_POSE: Final = _placement.field("pose", POSE_SIZE)
"""Where; takes the origin where the body is found room for, if it must not slide."""
P_CELL: Final = _placement.field("cell")
"""Index of the cell that this is in, or `engine.layout.NO_CELL`."""
P_SLIDE: Final = _placement.field("slide")
"""Whether it may end somewhere near."""
P_DO_NOT_LOAD: Final = _placement.field("do_not_load_cells")
"""Whether only cells count that are visible from that one."""
P_RESULT: Final = _placement.field("result")
"""What came of it: one of the numbers below."""

PLACEMENT_SIZE: Final = frozen(_placement.size)
PLACEMENT_DTYPE: Final = _placement.dtype()

PLACED: Final = frozen(0)
NO_VALID_POSITION: Final = frozen(2)
"""There is no room."""
PLACED_IN_NO_CELL: Final = frozen(3)
"""There is room, but outside of all cells."""
PLACEMENT_COLLIDED: Final = frozen(4)
"""There is no room, and a game object was told what is in the way."""

OUTCOMES: Final = ("inactive", "nosphere", "still", "failed", "moved", "lost")
INACTIVE: Final = frozen(0)
"""It rests, nothing happened."""
NO_SPHERE: Final = frozen(1)
"""It has nothing to collide with, and only turned."""
STILL: Final = frozen(2)
"""It wanted to be where it is, and only turned."""
FAILED: Final = frozen(3)
"""The transition failed, and it only turned."""
MOVED: Final = frozen(4)
"""It took over what the transition ended in."""
LOST: Final = frozen(5)
"""It left the world."""
