"""Where things lie in the engine's flat arrays.

A query runs on one *row* of float64: everything retail keeps in its OBJECTINFO, SPHEREPATH and
COLLISIONINFO (04, 2.2-2.4), the query itself, and counters. Kernels address it with the constants
below, which Numba freezes; Python reads the same row through `STATE_DTYPE`. Integers (flags, cell
ids, indices) are stored as float64, which holds them exactly. What goes in and comes out of a batch
are shorter rows, `QUERY_DTYPE` and `RESULT_DTYPE`, so that a thousand queries share one row of state.

A row is longer than `STATE_SIZE`: behind it lie areas whose size depends on the world (traversal
stack, cell list, touched objects, trace). `WORLD_*` below says where a world's integers keep that.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from engine.constants import frozen


class Row:
    """Assigns consecutive offsets, and remembers names and shapes."""

    def __init__(self) -> None:
        self.size = 0
        self.names: list[str] = []
        self.shapes: list[tuple[int, ...]] = []

    def field(self, name: str, *shape: int) -> int:
        """Take the next place for a field and return its offset."""
        offset = self.size
        self.names.append(name)
        self.shapes.append(shape)
        self.size += math.prod(shape)
        return frozen(offset)

    def block(self, source: Row, first: int, size: int) -> int:
        """Take over consecutive fields of another row, names and all; return where they begin."""
        begin = self.size
        offset = 0
        for name, shape in zip(source.names, source.shapes, strict=True):
            if first <= offset < first + size:
                self.field(name, *shape)
            offset += math.prod(shape)
        return frozen(begin)

    def dtype(self) -> np.dtype[np.void]:
        """Return the structured type that views a row by name."""
        fields = [(name, np.float64, shape) for name, shape in zip(self.names, self.shapes, strict=True)]
        return np.dtype(fields)


# --- a Position: cell id, quaternion w x y z, matrix m0..m8, origin x y z (01, 4.1 and 5) -----------
POSITION_SIZE: Final = frozen(17)
QUATERNION: Final = frozen(1)
MATRIX: Final = frozen(5)
ORIGIN: Final = frozen(14)

# --- a plane record: normal x y z, d;  a sphere record: centre x y z, radius ------------------------
QUATERNION_SIZE: Final = frozen(4)
VECTOR_SIZE: Final = frozen(3)
PLANE_SIZE: Final = frozen(4)
SPHERE_SIZE: Final = frozen(4)
RADIUS: Final = frozen(3)
MAX_SPHERES: Final = frozen(2)

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
LOCALSPACE_LOW_POINT: Final = _row.field("localspace_low_point", 3)
LOCALSPACE_CURR_CENTER: Final = _row.field("localspace_curr_center", MAX_SPHERES, 3)
GLOBAL_CURR_CENTER: Final = _row.field("global_curr_center", MAX_SPHERES, 3)
LOCALSPACE_POS: Final = _row.field("localspace_pos", POSITION_SIZE)
LOCALSPACE_Z: Final = _row.field("localspace_z", 3)
BEGIN_CELL: Final = _row.field("begin_cell")
"""Cells are held as their index in the world; `NO_CELL` is retail's null pointer."""
HAS_BEGIN_POS: Final = _row.field("has_begin_pos")
BEGIN_POS: Final = _row.field("begin_pos", POSITION_SIZE)
END_POS: Final = _row.field("end_pos", POSITION_SIZE)
CURR_CELL: Final = _row.field("curr_cell")
CURR_POS: Final = _row.field("curr_pos", POSITION_SIZE)
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
BACKUP_CHECK_POS: Final = _row.field("backup_check_pos", POSITION_SIZE)
OBSTRUCTION_ETHEREAL: Final = _row.field("obstruction_ethereal")
HITS_INTERIOR_CELL: Final = _row.field("hits_interior_cell")
BLDG_CHECK: Final = _row.field("bldg_check")
WALKABLE_ALLOWANCE: Final = _row.field("walkable_allowance")
WALK_INTERP: Final = _row.field("walk_interp")
STEP_DOWN_AMT: Final = _row.field("step_down_amt")
WALKABLE_CHECK_POS: Final = _row.field("walkable_check_pos", SPHERE_SIZE)
WALKABLE: Final = _row.field("walkable")
"""Offset of the polygon's record in the world's floats; `NO_POLYGON` is retail's null pointer."""
CHECK_WALKABLE: Final = _row.field("check_walkable")
WALKABLE_UP: Final = _row.field("walkable_up", 3)
WALKABLE_POS: Final = _row.field("walkable_pos", POSITION_SIZE)
WALKABLE_SCALE: Final = _row.field("walkable_scale")
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
REQUESTED_NORMAL: Final = _row.field("requested_normal", 3)
"""World normal that goes with the answer NEEDS_STEP_UP."""
CONTACT_POINT: Final = _row.field("contact_point", 3)
"""Last projection of a sphere on a polygon's plane; retail's out argument contact_pt."""
SAVED_POS: Final = _row.field("saved_pos", POSITION_SIZE)
"""The local in which CTransition::check_walkable keeps the check position (WK-3)."""
SCRATCH_FRAME: Final = _row.field("scratch_frame", POSITION_SIZE)
"""The frame that find_placement_pos turns around."""
TRACE_LENGTH: Final = _row.field("trace_length")
TRACE_CAPACITY: Final = _row.field("trace_capacity")
"""Places for trace characters behind the row; 0 turns the trace off."""

STATE_SIZE: Final = frozen(_row.size)
STATE_DTYPE: Final = _row.dtype()

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
Q_COLLISION_INFO: Final = _query.block(_row, COLLISION_INFO, COLLISION_INFO_SIZE)
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
R_COLLISION_INFO: Final = _result.block(_row, COLLISION_INFO, COLLISION_INFO_SIZE)
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
R_STATUS: Final = _result.field("status")

RESULT_SIZE: Final = frozen(_result.size)
RESULT_DTYPE: Final = _result.dtype()

NO_CELL: Final = frozen(-1)
NO_OBJECT: Final = frozen(-1)
NO_POLYGON: Final = frozen(0)

STATUS_OK: Final = frozen(0)
STATUS_RECURSION: Final = frozen(1)
"""An inner insert reached what retail only reaches from the outermost one (05, 10)."""
STATUS_UNDETERMINED: Final = frozen(2)
"""A root was NaN where the specification doesn't know which way retail goes (07, 11)."""

# --- the world's arrays ----------------------------------------------------------------------------
# floats: node k at NODE_FLOATS * k (splitting plane, bounding sphere), then polygon, plane, cell, part,
# object and shape records. ints: the header below in the place of the first nodes, node k at
# NODE_INTS * k, then records and lists. A leaf keeps no plane; a polygon is named by the offset of its
# record.
NODE_FLOATS: Final = frozen(8)
NODE_SPHERE: Final = frozen(4)
NODE_INTS: Final = frozen(4)
NODE_KIND: Final = frozen(0)
NODE_POSITIVE: Final = frozen(1)
NODE_NEGATIVE: Final = frozen(2)
LEAF_FIRST: Final = frozen(1)
LEAF_COUNT: Final = frozen(2)
KIND_NODE: Final = frozen(0)
KIND_LEAF: Final = frozen(1)
KIND_SOLID_LEAF: Final = frozen(2)
NOT_SOLID: Final = frozen(0)
NO_TREE: Final = frozen(0)

POLYGON_COUNT: Final = frozen(4)
POLYGON_ID: Final = frozen(5)
POLYGON_SHAPE: Final = frozen(6)
POLYGON_CORNERS: Final = frozen(8)
"""A polygon record: plane, number of vertices, its id, its shape's index, pad, corners, edges."""
CORNER_SIZE: Final = frozen(6)
"""A vertex x y z, and the in-plane normal of the edge from it to the next one, as PP-2 rounds it."""
CORNER_NORMAL: Final = frozen(3)
EDGE_SIZE: Final = frozen(8)
"""Behind the corners, of the edge from each vertex to the next, what PH-4 computes without the sphere:
the edge x y z, its in-plane normal x y z, and the squared lengths of the normal and of the edge."""
EDGE_NORMAL: Final = frozen(3)
EDGE_NORMAL_SQUARED: Final = frozen(6)
EDGE_SQUARED: Final = frozen(7)

_header = Row()

WORLD_CELLS: Final = _header.field("num_environment_cells")
"""Cells below this number are environment cells, the others land cells."""
WORLD_CELL_FLOATS: Final = _header.field("cell_floats")
WORLD_CELL_INTS: Final = _header.field("cell_ints")
WORLD_OBJECT_FLOATS: Final = _header.field("object_floats")
WORLD_OBJECT_INTS: Final = _header.field("object_ints")
WORLD_PART_FLOATS: Final = _header.field("part_floats")
WORLD_PART_INTS: Final = _header.field("part_ints")
WORLD_BUILDINGS: Final = _header.field("building_ints")
WORLD_IDS: Final = _header.field("ids")
"""Where the table from cell ids to cells begins (`engine.kernels.cell_ids`)."""
WORLD_IDS_MASK: Final = _header.field("ids_mask")
"""Number of entries of that table, a power of two, less one."""
WORLD_STACK: Final = _header.field("stack")
"""Where in a row the stack of a traversal begins, and then the cell list, the touched objects, the trace."""
WORLD_CELL_LIST: Final = _header.field("cell_list")
WORLD_TOUCHED: Final = _header.field("touched")
WORLD_ROW: Final = _header.field("row")
"""How long a row is without its trace."""

FIRST_NODE: Final = frozen(math.ceil(_header.size / NODE_INTS))
"""The nodes before it do not exist: their integers are the header, and 0 says `no tree`."""

CELL_FLOATS: Final = POSITION_SIZE + 1
CELL_ID: Final = POSITION_SIZE
CELL_INTS: Final = frozen(10)
CELL_OBJECTS: Final = frozen(0)
"""Where the list of the cell's objects begins, as indices; those with a parent are not in it."""
CELL_OBJECT_COUNT: Final = frozen(1)
CELL_RESTRICTION: Final = frozen(9)
"""Where the record begins of what restricts the cell, or `NO_RESTRICTION`."""
# An environment cell:
CELL_TREE: Final = frozen(2)
CELL_PLANES: Final = frozen(3)
CELL_PLANE_COUNT: Final = frozen(4)
CELL_PORTALS: Final = frozen(5)
CELL_PORTAL_COUNT: Final = frozen(6)
CELL_STAB: Final = frozen(7)
"""Where the list of cell ids begins that may be visible from the cell."""
CELL_STAB_COUNT: Final = frozen(8)
# A land cell:
LAND_TERRAIN: Final = frozen(2)
"""Offset of the record of its first triangle; the second one's follows."""
LAND_BUILDING: Final = frozen(3)
LAND_WATER: Final = frozen(4)
"""Its water type: `engine.constants.NOT_WATER`, ..."""
LAND_BLOCK_WATER: Final = frozen(5)
"""The water type of its whole block."""
LAND_WET_CORNERS: Final = frozen(6)
"""Bits: 1 south-west, 2 north-west, 4 south-east, 8 north-east corner is water."""

RESTRICTION_KNOWN: Final = frozen(0)
"""Whether what restricts the cell is there and can be asked."""
RESTRICTION_COUNT: Final = frozen(1)
"""How many movers it admits; their ids follow."""
RESTRICTION_IDS: Final = frozen(2)
NO_RESTRICTION: Final = frozen(0)

NO_PLANES: Final = frozen(-1)
"""Containment plane count of a cell that contains every point."""
NO_PORTALS: Final = frozen(-1)
"""Portal count of a cell without a portal array, which contains no point (09, 4.1)."""
NO_BUILDING: Final = frozen(-1)

TERRAIN_POLYGON: Final = POLYGON_CORNERS + 3 * (CORNER_SIZE + EDGE_SIZE)
"""Size of a triangle's record."""
LAND_CELLS: Final = frozen(64)
"""Land cells of a block; cell 8 * i + j lies in column i from the west, row j from the south."""

PORTAL_INTS: Final = frozen(3)
PORTAL_CELL: Final = frozen(0)
"""Index of the cell behind a portal; minus its id if it is not in the world; or `EXTERIOR`."""
PORTAL_SIDE: Final = frozen(1)
"""The cell's interior is on the positive (0) or negative (1) side of the portal's plane."""
PORTAL_PLANE: Final = frozen(2)
"""Offset of the plane, in cell space."""
EXTERIOR: Final = frozen(-0xFFFF_FFFF)
"""Retail's id of what is behind a door (09, 2.1)."""

PART_FLOATS: Final = POSITION_SIZE + 1
PART_SCALE: Final = POSITION_SIZE
PART_INTS: Final = frozen(1)
PART_TREE: Final = frozen(0)

BUILDING_INTS: Final = frozen(3)
BUILDING_PART: Final = frozen(0)
"""Index of its part 0, or `NO_PART`."""
BUILDING_PORTALS: Final = frozen(1)
BUILDING_PORTAL_COUNT: Final = frozen(2)
NO_PART: Final = frozen(-1)

BUILDING_PORTAL_INTS: Final = frozen(2)
BUILDING_PORTAL_CELL: Final = frozen(0)
"""As `PORTAL_CELL`; never `EXTERIOR`."""
BUILDING_PORTAL_OTHER: Final = frozen(1)
"""Index of the portal in the cell behind it, negative for none."""

OBJECT_FLOATS: Final = POSITION_SIZE + 1
OBJECT_SCALE: Final = POSITION_SIZE
OBJECT_INTS: Final = frozen(6)
OBJECT_ID: Final = frozen(0)
"""0 if it has none."""
OBJECT_STATE: Final = frozen(1)
"""PhysicsState bits."""
OBJECT_WEENIE: Final = frozen(2)
"""Bits of `engine.constants.WEENIE_PRESENT`, ..."""
OBJECT_FAMILY: Final = frozen(3)
"""Which of its shapes are tested: `FAMILY_NONE`, ..."""
OBJECT_FIRST: Final = frozen(4)
"""Index of the first part, or offset of the first record of the other families."""
OBJECT_COUNT: Final = frozen(5)

FAMILY_NONE: Final = frozen(0)
FAMILY_PARTS: Final = frozen(1)
FAMILY_CYLSPHERES: Final = frozen(2)
FAMILY_SPHERES: Final = frozen(3)

CYLSPHERE_SIZE: Final = frozen(5)
"""A cylsphere record: low point x y z, radius, height, in object space, unscaled."""
CYLSPHERE_HEIGHT: Final = frozen(4)
