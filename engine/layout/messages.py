"""What goes into a batch and comes out of it: a row for each query, and one for each result.

They are shorter than a row of state, so that a thousand queries share one of those.
"""

from __future__ import annotations

from typing import Final

from engine.constants import frozen
from engine.layout.rows import MAX_SPHERES, SPHERE_SIZE, Row
from engine.layout.state import COLLISION_INFO, COLLISION_INFO_SIZE, SKIPPED_SIZE
from engine.layout.state import _row as _state

# --- a query: what the caller sets -----------------------------------------------------------------
POSE_SIZE: Final = frozen(8)
"""A pose: cell id, quaternion w x y z, origin x y z; a position without its matrix."""
POSE_ORIGIN: Final = frozen(5)

_query = Row()

Q_NUM_SPHERE: Final = _query.field("num_sphere")
Q_SPHERES: Final = _query.field("spheres", MAX_SPHERES, SPHERE_SIZE)
"""The mover's spheres in object space, before `Q_SCALE`."""
Q_SCALE: Final = _query.field("scale")
Q_STATE: Final = _query.field("state")
Q_STEP_UP_HEIGHT: Final = _query.field("step_up_height")
Q_STEP_DOWN_HEIGHT: Final = _query.field("step_down_height")
Q_ETHEREAL: Final = _query.field("ethereal")
Q_MAY_STEP_DOWN: Final = _query.field("may_step_down")
Q_GRAVITY: Final = _query.field("gravity")
Q_MOVER_ID: Final = _query.field("mover_id")
Q_MOVER_MISSILE: Final = _query.field("mover_missile")
Q_TARGET_ID: Final = _query.field("target_id")
Q_MOVER_RESTRICTED: Final = _query.field("mover_restricted")
Q_HAS_START: Final = _query.field("has_start")
Q_START: Final = _query.field("start", POSE_SIZE)
Q_END: Final = _query.field("end", POSE_SIZE)
Q_BEGIN_CELL: Final = _query.field("begin_cell")
"""Index of the cell in which the mover begins, or `NO_CELL`."""
Q_PLACEMENT_ALLOWS_SLIDING: Final = _query.field("placement_allows_sliding")
Q_COLLISION_INFO: Final = _query.block(_state, COLLISION_INFO, COLLISION_INFO_SIZE)
"""What the mover brings along: contact planes, sliding normal (made horizontal and unit), counter."""

# The rest is read by a single collision call only: what to test, and SPHEREPATH fields to set.
Q_TARGET_CELL: Final = _query.field("target_cell")
Q_TARGET_KIND: Final = _query.field("target_kind")
"""What an object call tests: `engine.constants.TARGET_FIRST_SHAPE`, ..."""
Q_TARGET_OBJECT: Final = _query.field("target_object")
"""Index of a static object, or `NO_OBJECT` to test the target cell's own tree."""
Q_INSERT_TYPE: Final = _query.field("insert_type")
Q_STEP_DOWN: Final = _query.field("step_down")
Q_STEP_DOWN_AMT: Final = _query.field("step_down_amt")
Q_WALK_INTERP: Final = _query.field("walk_interp")
Q_WALKABLE_ALLOWANCE: Final = _query.field("walkable_allowance")
Q_CHECK_WALKABLE: Final = _query.field("check_walkable")
Q_COLLIDE: Final = _query.field("collide")
Q_OBSTRUCTION_ETHEREAL: Final = _query.field("obstruction_ethereal")
Q_BLDG_CHECK: Final = _query.field("bldg_check")
Q_HITS_INTERIOR_CELL: Final = _query.field("hits_interior_cell")

QUERY_SIZE: Final = frozen(_query.size)
QUERY_DTYPE: Final = _query.dtype()

# --- a result: what the engine answers -------------------------------------------------------------
_result = Row()

R_RESULT: Final = _result.field("result")
"""A TransitionState of a collision call; 1 or 0 of a transition."""
R_DISPATCH: Final = _result.field("dispatch")
"""Trace letter of the path that a collision call took."""
R_CHECK: Final = _result.field("check", POSE_SIZE)
R_CURR: Final = _result.field("curr", POSE_SIZE)
R_CHECK_CELL: Final = _result.field("check_cell")
R_CURR_CELL: Final = _result.field("curr_cell")
R_NUM_SPHERE: Final = _result.field("num_sphere")
R_GLOBAL_SPHERES: Final = _result.field("global_spheres", MAX_SPHERES, SPHERE_SIZE)
R_COLLISION_INFO: Final = _result.block(_state, COLLISION_INFO, COLLISION_INFO_SIZE)
R_WALKABLE: Final = _result.field("walkable")
"""Id of the walkable polygon in its shape, or -1."""
R_WALKABLE_SHAPE: Final = _result.field("walkable_shape")
"""Index of that shape in the world, or -1."""
R_WALK_INTERP: Final = _result.field("walk_interp")
R_WALKABLE_ALLOWANCE: Final = _result.field("walkable_allowance")
R_COLLIDE: Final = _result.field("collide")
R_STEP_UP: Final = _result.field("step_up")
R_STEP_UP_NORMAL: Final = _result.field("step_up_normal", 3)
R_NEG_POLY_HIT: Final = _result.field("neg_poly_hit")
R_NEG_STEP_UP: Final = _result.field("neg_step_up")
R_NEG_COLLISION_NORMAL: Final = _result.field("neg_collision_normal", 3)
R_OBSTRUCTION_ETHEREAL: Final = _result.field("obstruction_ethereal")
R_HITS_INTERIOR_CELL: Final = _result.field("hits_interior_cell")
R_STATE: Final = _result.field("state")
R_KILL_VELOCITY: Final = _result.field("kill_velocity")
R_NODES_VISITED: Final = _result.field("nodes_visited")
R_POLYGONS_TESTED: Final = _result.field("polygons_tested")
R_CELLS_LISTED: Final = _result.field("cells_listed")
R_OBJECTS_TESTED: Final = _result.field("objects_tested")
R_SKIPPED: Final = _result.field("skipped", SKIPPED_SIZE)
"""How often each shortcut was taken, as in `SKIPPED`."""
R_STATUS: Final = _result.field("status")

RESULT_SIZE: Final = frozen(_result.size)
RESULT_DTYPE: Final = _result.dtype()
