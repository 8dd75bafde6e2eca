"""The row that a query runs on.

It holds everything retail keeps in its OBJECTINFO, SPHEREPATH and COLLISIONINFO (04, 2.2-2.4), and
counters. It is longer than `STATE_SIZE`: behind it lie areas whose size depends on the world (traversal
stack, cell list, touched objects, trace); the world's header says where each begins.
"""

from __future__ import annotations

from typing import Final

from engine.constants import frozen
from engine.layout.rows import MAX_SPHERES, PLANE_SIZE, POSITION_SIZE, SPHERE_SIZE, VECTOR_SIZE, Row

_row = Row()

# --- OBJECTINFO (04, 2.2) --------------------------------------------------------------------------
OI_STATE: Final = _row.field("state")
STEP_UP_HEIGHT: Final = _row.field("step_up_height")
STEP_DOWN_HEIGHT: Final = _row.field("step_down_height")
OI_ETHEREAL: Final = _row.field("ethereal")
OI_STEP_DOWN: Final = _row.field("may_step_down")
MOVER_GRAVITY: Final = _row.field("gravity")
"""The mover object's gravity bit, read by VT-10."""
MOVER_ID: Final = _row.field("mover_id")
"""The mover's own object id; an obstacle with that id is the mover itself (09, 3.2)."""
MOVER_MISSILE: Final = _row.field("mover_missile")
"""The mover object's missile bit (08, 2; 10, 7)."""
TARGET_ID: Final = _row.field("target_id")
"""Id of the object that a missile is meant for (08, 2)."""
MOVER_RESTRICTED: Final = _row.field("mover_restricted")
"""Whether the mover has a game object that can't bypass entry restrictions (09, 3.1)."""

# --- SPHEREPATH (04, 2.3) --------------------------------------------------------------------------
NUM_SPHERE: Final = _row.field("num_sphere")
LOCAL_SPHERE: Final = _row.field("local_sphere", MAX_SPHERES, SPHERE_SIZE)
LOCAL_LOW_POINT: Final = _row.field("local_low_point", 3)
GLOBAL_SPHERE: Final = _row.field("global_sphere", MAX_SPHERES, SPHERE_SIZE)
GLOBAL_LOW_POINT: Final = _row.field("global_low_point", 3)
LOCALSPACE_SPHERE: Final = _row.field("localspace_sphere", MAX_SPHERES, SPHERE_SIZE)
LOCALSPACE_CURR_CENTER: Final = _row.field("localspace_curr_center", MAX_SPHERES, 3)
GLOBAL_CURR_CENTER: Final = _row.field("global_curr_center", MAX_SPHERES, 3)
BEGIN_CELL: Final = _row.field("begin_cell")
"""Cells are held as their index in the world; `NO_CELL` is retail's null pointer."""
HAS_BEGIN_POS: Final = _row.field("has_begin_pos")
CURR_CELL: Final = _row.field("curr_cell")
GLOBAL_OFFSET: Final = _row.field("global_offset", 3)
STEP_UP: Final = _row.field("step_up")
STEP_UP_NORMAL: Final = _row.field("step_up_normal", 3)
COLLIDE: Final = _row.field("collide")
CHECK_CELL: Final = _row.field("check_cell")
CHECK_POS: Final = _row.field("check_pos", POSITION_SIZE)
INSERT_TYPE: Final = _row.field("insert_type")
STEP_DOWN: Final = _row.field("step_down")
BACKUP: Final = _row.field("backup")
BACKUP_CELL: Final = _row.field("backup_cell")
OBSTRUCTION_ETHEREAL: Final = _row.field("obstruction_ethereal")
HITS_INTERIOR_CELL: Final = _row.field("hits_interior_cell")
BLDG_CHECK: Final = _row.field("bldg_check")
WALKABLE_ALLOWANCE: Final = _row.field("walkable_allowance")
WALK_INTERP: Final = _row.field("walk_interp")
STEP_DOWN_AMT: Final = _row.field("step_down_amt")
WALKABLE: Final = _row.field("walkable")
"""Offset of the polygon's record in the world's floats; `NO_POLYGON` is retail's null pointer."""
CHECK_WALKABLE: Final = _row.field("check_walkable")
CELL_ARRAY_VALID: Final = _row.field("cell_array_valid")
NEG_STEP_UP: Final = _row.field("neg_step_up")
NEG_COLLISION_NORMAL: Final = _row.field("neg_collision_normal", 3)
NEG_POLY_HIT: Final = _row.field("neg_poly_hit")
PLACEMENT_ALLOWS_SLIDING: Final = _row.field("placement_allows_sliding")

# --- COLLISIONINFO (04, 2.4) -----------------------------------------------------------------------
# The same block begins a query (what the mover brings along) and a result (what it ended with).
COLLISION_INFO: Final = frozen(_row.size)
LAST_KNOWN_VALID: Final = _row.field("last_known_contact_plane_valid")
LAST_KNOWN_PLANE: Final = _row.field("last_known_contact_plane", PLANE_SIZE)
LAST_KNOWN_IS_WATER: Final = _row.field("last_known_contact_plane_is_water")
LAST_KNOWN_CELL_ID: Final = _row.field("last_known_contact_plane_cell_id")
CONTACT_VALID: Final = _row.field("contact_plane_valid")
CONTACT_PLANE: Final = _row.field("contact_plane", PLANE_SIZE)
CONTACT_IS_WATER: Final = _row.field("contact_plane_is_water")
CONTACT_CELL_ID: Final = _row.field("contact_plane_cell_id")
SLIDING_VALID: Final = _row.field("sliding_normal_valid")
SLIDING_NORMAL: Final = _row.field("sliding_normal", VECTOR_SIZE)
COLLISION_NORMAL_VALID: Final = _row.field("collision_normal_valid")
COLLISION_NORMAL: Final = _row.field("collision_normal", VECTOR_SIZE)
NUM_COLLIDE_OBJECT: Final = _row.field("num_collide_object")
LAST_COLLIDED_OBJECT: Final = _row.field("last_collided_object")
"""Index of an object in the world; `NO_OBJECT` is retail's null pointer."""
COLLIDED_WITH_ENVIRONMENT: Final = _row.field("collided_with_environment")
FRAMES_STATIONARY_FALL: Final = _row.field("frames_stationary_fall")
COLLISION_INFO_SIZE: Final = frozen(_row.size - COLLISION_INFO)

# --- CELLARRAY (04, 2.5): its entries lie behind the row -------------------------------------------
NUM_CELLS: Final = _row.field("num_cells")
ADDED_OUTSIDE: Final = _row.field("added_outside")
DO_NOT_LOAD_CELLS: Final = _row.field("do_not_load_cells")

# --- the engine's own ------------------------------------------------------------------------------
KILL_VELOCITY: Final = _row.field("kill_velocity")
"""How often OBJECTINFO::kill_velocity ran."""
NODES_VISITED: Final = _row.field("nodes_visited")
POLYGONS_TESTED: Final = _row.field("polygons_tested")
CELLS_LISTED: Final = _row.field("cells_listed")
OBJECTS_TESTED: Final = _row.field("objects_tested")
STATUS: Final = _row.field("status")
"""`STATUS_OK`, or which bound of the engine was violated."""
CONTACT_POINT: Final = _row.field("contact_point", 3)
"""Last projection of a sphere on a polygon's plane; retail's out argument contact_pt."""
LOCALSPACE_OF: Final = _row.field("localspace_of")
"""Where in the world's floats the position lies in whose space the row's `localspace` fields are, with the
current position as it is; 0 for none."""
LOCALSPACE_HAS_CURRENT: Final = _row.field("localspace_has_current")
"""Whether sphere 0's current centre is in that space, too."""
PLAN: Final = _row.field("plan")
"""Which shortcuts may be taken: bits `PLAN_PORTALS`, ... (`engine.plan`)."""
SKIPPED_SIZE: Final = frozen(6)
"""How many shortcuts there are."""
SKIPPED: Final = _row.field("skipped", SKIPPED_SIZE)
"""How often each was, in the order of the bits; of objects, how many were passed over; of bounds, in how many
walks they were."""
TRACE_LENGTH: Final = _row.field("trace_length")
TRACE_CAPACITY: Final = _row.field("trace_capacity")
"""Places for trace characters behind the row; 0 turns the trace off."""

CLEARED_SIZE: Final = frozen(_row.size)
"""What is before this is cleared for each transition.

What follows is half of the row: positions, and what goes with them. A transition reads none of it before it
has written it.
"""

# --- not cleared -----------------------------------------------------------------------------------
LOCALSPACE_LOW_POINT: Final = _row.field("localspace_low_point", 3)
LOCALSPACE_POS: Final = _row.field("localspace_pos", POSITION_SIZE)
LOCALSPACE_Z: Final = _row.field("localspace_z", 3)
BEGIN_POS: Final = _row.field("begin_pos", POSITION_SIZE)
"""Where the mover began, and where it wants to be: nobody asks for their matrices, which are not there."""
END_POS: Final = _row.field("end_pos", POSITION_SIZE)
CURR_POS: Final = _row.field("curr_pos", POSITION_SIZE)
BACKUP_CHECK_POS: Final = _row.field("backup_check_pos", POSITION_SIZE)
WALKABLE_CHECK_POS: Final = _row.field("walkable_check_pos", SPHERE_SIZE)
WALKABLE_UP: Final = _row.field("walkable_up", 3)
WALKABLE_POS: Final = _row.field("walkable_pos", POSITION_SIZE)
WALKABLE_SCALE: Final = _row.field("walkable_scale")
REQUESTED_NORMAL: Final = _row.field("requested_normal", 3)
"""World normal that goes with the answer NEEDS_STEP_UP."""
LOCALSPACE_INVERSE: Final = _row.field("localspace_inverse")
"""One by the scale of what lies in that space."""
SAVED_POS: Final = _row.field("saved_pos", POSITION_SIZE)
"""The local in which CTransition::check_walkable keeps the check position (WK-3)."""
SCRATCH_FRAME: Final = _row.field("scratch_frame", POSITION_SIZE)
"""The frame that find_placement_pos turns around."""

PLAN_PORTALS: Final = frozen(1)
PLAN_OBJECTS: Final = frozen(2)
PLAN_GROUND: Final = frozen(4)
PLAN_FLIGHT: Final = frozen(8)
PLAN_BOUNDS: Final = frozen(16)
PLAN_WALKS: Final = frozen(32)
SKIPPED_PORTALS: Final = frozen(SKIPPED)
SKIPPED_OBJECTS: Final = frozen(SKIPPED + 1)
SKIPPED_GROUND: Final = frozen(SKIPPED + 2)
SKIPPED_FLIGHT: Final = frozen(SKIPPED + 3)
SKIPPED_BOUNDS: Final = frozen(SKIPPED + 4)
SKIPPED_WALKS: Final = frozen(SKIPPED + 5)

STATE_SIZE: Final = frozen(_row.size)
STATE_DTYPE: Final = _row.dtype()

NO_CELL: Final = frozen(-1)
NO_OBJECT: Final = frozen(-1)
NO_POLYGON: Final = frozen(0)

STATUS_OK: Final = frozen(0)
STATUS_RECURSION: Final = frozen(1)
"""An inner insert reached what retail only reaches from the outermost one (05, 10)."""
STATUS_UNDETERMINED: Final = frozen(2)
"""A root was NaN where the specification doesn't know which way retail goes (07, 11)."""
STATUS_STRANGE: Final = frozen(3)
"""The row names what its world doesn't have: a cell, an object, more spheres than a mover may have."""
STATUS_ENDLESS: Final = frozen(4)
"""The row takes more than `engine.constants.MAX_STEPS` steps, or puts down less than a `SPECK`."""
