"""Where things lie in a world's two arrays: floats and integers."""

from __future__ import annotations

import math
from typing import Final

from engine.constants import frozen
from engine.layout.rows import PLANE_SIZE, POSITION_SIZE, SPHERE_SIZE, Row

# --- the world's arrays ----------------------------------------------------------------------------
# floats: node k at NODE_FLOATS * k (splitting plane, bounding sphere), then polygon, plane, cell, part,
# object and shape records. ints: the header below in the place of the first nodes, node k at
# NODE_INTS * k, then records and lists. A leaf keeps no plane, but where those of its polygons are if a leaf
# of its tree is wide; a polygon is named by the offset of its record. A node's floats are a cache line, and
# the integers of a node and its positive child, which is the next, are in one, too.
NODE_FLOATS: Final = frozen(8)
NODE_SPHERE: Final = frozen(4)
NODE_INTS: Final = frozen(2)
NODE_NEXT: Final = frozen(0)
"""The negative child; of a leaf, in its lower bits, where the list of its polygons begins."""
LEAF_FIRST_MASK: Final = frozen(0xFFFF_FFFF)
LEAF_SLOPES_SHIFT: Final = frozen(32)
"""Above those bits, of a leaf that is not wide, is one for each polygon of its list, set if that may be flat
enough to be walked on (`engine.compiling.slopes`)."""
NODE_LEAF: Final = frozen(1)
"""0 for a node that splits; else the two bits below, and the number of polygons above them."""
LEAF_BIT: Final = frozen(1)
SOLID_BIT: Final = frozen(2)
LEAF_COUNT_SHIFT: Final = frozen(2)
WIDE_LEAF: Final = frozen(24)
"""How many polygons a wide leaf lists at least: walks go on in `engine.kernels.bsp_wide` there."""
GATE_NODES: Final = frozen(2)
"""Before each root there is room for two more nodes, the gate of the tree: what walks are told of it."""
GATE: Final = frozen(-1)
"""The second of them, of which most is read."""
GATE_RADIUS: Final = frozen(0)
"""Of a gate's floats: of how large a sphere the walk needs no bounding spheres, metres, or `NO_GATE`
(`engine.kernels.gate`)."""
NO_GATE: Final = -math.inf
LATTICE_CORNER: Final = frozen(1)
"""Of a gate's floats: the least x, y, z of the cubes that know what is near (`engine.kernels.lattice`), in
the frame of the tree, metres."""
LATTICE_PER_METRE: Final = frozen(4)
"""Cubes in a metre."""
LATTICE_COUNTS: Final = frozen(5)
"""Cubes along x, y, z, in whole blocks; 0 in a tree without."""
GATE_UP: Final = frozen(-NODE_FLOATS)
"""In the first of them: the up that slopes have been measured along, a vector in the frame of the tree; 0 if
none have been."""
LATTICE_TABLE: Final = frozen(0)
"""Of a gate's integers: where the table begins of where the words of each block of cubes do."""
LATTICE_LISTS: Final = frozen(1)
"""Where the lists begin that those point to: polygons, by the offsets of their records."""
LATTICE_BLOCK: Final = frozen(2)
"""A block is 2**2 cubes along each axis. Blocks whose words are all the same, in rock or in mid-air, are kept
once."""
LATTICE_BLOCK_MASK: Final = frozen(3)
WORD_BITS: Final = frozen(32)
WORD_MASK: Final = frozen(0xFFFF_FFFF)
"""An integer holds two words, or two polygons of a list, the first one lower."""
WORD_SOLID: Final = frozen(1)
"""In a word: whether a centre in the cube may be in a solid leaf that lists polygons."""
WORD_COUNT_SHIFT: Final = frozen(1)
WORD_LIST_SHIFT: Final = frozen(6)
"""Above that bit, how many polygons are near the cube, and above those, where in the lists they are."""
CROWDED: Final = frozen(31)
"""In place of their number, if they are not listed."""
LEAF_PLANES: Final = frozen(0)
"""Of a leaf's floats, in a tree that has a wide one: where in the world's floats the planes of its polygons
begin, in blocks of `ABREAST`."""
ABREAST: Final = frozen(8)
"""Planes in a block: first all x components, then y, z and d."""

# --- the nodes of a shape, before they are part of a world -------------------------------------------
SHAPE_NODE_INTS: Final = frozen(4)
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

# --- the world's records ----------------------------------------------------------------------------
POLYGON_COUNT: Final = frozen(4)
POLYGON_ID: Final = frozen(5)
POLYGON_SHAPE: Final = frozen(6)
POLYGON_CONVEX: Final = frozen(7)
"""1 if it is convex, and flat and fat as well (`engine.compiling.balls.bounding_balls`), else 0."""
POLYGON_SIDES: Final = frozen(8)
"""A polygon record: plane, number of vertices, its id, its shape's index, whether it is convex; the first
block of sides, corners, edges, and the other blocks of sides. Padded to `POLYGON_ALIGNMENT`.

What rules out most polygons is the plane, and most others the first block: what is read comes first."""
POLYGON_ALIGNMENT: Final = frozen(8)
"""Numbers in a cache line: the plane is in one."""
SIDES: Final = frozen(4)
"""Edges in a block of sides."""
SIDE_NORMAL: Final = frozen(3 * SIDES)
SIDE_FAR: Final = frozen(6 * SIDES)
SIDES_SIZE: Final = frozen(7 * SIDES)
"""In blocks of `SIDES` edges, what PP-2 computes without the point: the x of the vertices that they begin at,
then y and z, the same of their in-plane normals as PP-2 rounds them, and the squared lengths of
`EDGE_NORMAL_SQUARED`. What is left of the last block is zeros, which no point is outside of."""
POLYGON_CORNERS: Final = frozen(POLYGON_SIDES + SIDES_SIZE)
CORNER_SIZE: Final = frozen(3)
"""A vertex x y z."""
EDGE_SIZE: Final = frozen(8)
"""Behind the corners, of the edge from each vertex to the next, what PH-4 computes without the sphere:
the edge x y z, its in-plane normal x y z, and the squared lengths of the normal and of the edge."""
EDGE_NORMAL: Final = frozen(3)
EDGE_NORMAL_SQUARED: Final = frozen(6)
EDGE_SQUARED: Final = frozen(7)

_header = Row()

WORLD_CELLS: Final = _header.field("num_environment_cells")
"""Cells below this number are environment cells, the others land cells."""
WORLD_ALL_CELLS: Final = _header.field("num_cells")
WORLD_OBJECTS: Final = _header.field("num_objects")
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
WORLD_CELL_BOUNDS: Final = _header.field("cell_bounds")
WORLD_OBJECT_BOUNDS: Final = _header.field("object_bounds")
WORLD_BUILDING_BOUNDS: Final = _header.field("building_bounds")
WORLD_LEAF_BOUNDS: Final = _header.field("leaf_bounds")
"""The plate of the polygon that ``ints[i]`` of a leaf's list names is at this place plus `PLATE_SIZE` * i."""

WORLD_CLEARANCES: Final = _header.field("clearances")
"""Where the table begins of where each environment cell's grid of clearances does, or `NO_CLEARANCE`."""

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

# --- bounds, for shortcuts (`engine.kernels.broad`) ------------------------------------------------
BALL_SIZE: Final = frozen(5)
"""A bounding ball: centre x y z in the block of a cell, radius (negative: nothing to bound), cell id."""
BALL_CELL: Final = frozen(4)
PLATE_SIZE: Final = PLANE_SIZE + SPHERE_SIZE
"""A polygon's plane and the ball about it, side by side for all that a leaf lists."""
PLATE_BALL: Final = PLANE_SIZE
BOUNDS_SIZE: Final = BALL_SIZE + 3
"""Of a cell: the ball about its objects, its fences, and whether it may be flown through unseen."""
BOUNDS_FENCES: Final = BALL_SIZE
"""Offset of the first plane; one for each portal."""
BOUNDS_FENCE_COUNT: Final = BALL_SIZE + 1
BOUNDS_PASSABLE: Final = BALL_SIZE + 2
NOT_FENCED: Final = frozen(-1)
"""Fence count of a cell with a portal into one without containment planes, or with a fence too steep."""

# --- a grid of clearances (`engine.kernels.clearance`) ---------------------------------------------
CLEARANCE_CORNER: Final = frozen(0)
"""The grid's least x, y, z, in the frame of the tree, metres."""
CLEARANCE_COUNTS: Final = frozen(3)
"""Cubes along x, y, z."""
CLEARANCE_LEVELS: Final = frozen(6)
"""The byte of the world's integers, eight in each, with which the cubes' levels begin, z changing fastest."""
CLEARANCE_EDGE: Final = frozen(7)
"""Of a cube, metres."""
CLEARANCE_PER_METRE: Final = frozen(8)
"""Cubes in a metre."""
CLEARANCE_SIZE: Final = frozen(9)
CLEARANCE_STEPS: Final = frozen(8)
"""Steps in an edge: each level adds one to the radius of the clear ball."""
CLEARANCE_BITS: Final = frozen(8)
"""Of a level; the first one of an integer lies lowest."""
CLEARANCE_MOST: Final = frozen(127)
"""Highest level."""
NO_CLEARANCE: Final = frozen(0)
