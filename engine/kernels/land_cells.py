"""Land cells (10, 5 to 7): the ground under a point, the water on it, and a mover against both."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import (
    BLOCK_STEP,
    COLLIDED,
    DEEP_WATER,
    ENTIRELY_WATER,
    HALF_CELL,
    IS_VIEWER,
    NOT_WATER,
    OK,
    SHALLOW_WATER,
    WET_LAND,
)
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.object_info import validate_walkable
from engine.kernels.plan import ground_beyond
from engine.kernels.polygon import polygon_make_plane, polygon_point_in_poly2d
from engine.kernels.polygon_record import polygon_make_edges
from engine.kernels.position import block_offset
from engine.kernels.rounding import f32
from engine.kernels.trace import TERRAIN_CALL, trace_close, trace_open
from engine.kernels.vector import load
from engine.layout import (
    CELL_FLOATS,
    CELL_ID,
    CELL_INTS,
    CHECK_POS,
    GLOBAL_LOW_POINT,
    GLOBAL_SPHERE,
    LAND_BLOCK_WATER,
    LAND_TERRAIN,
    LAND_WATER,
    LAND_WET_CORNERS,
    MOVER_MISSILE,
    NO_POLYGON,
    OI_STATE,
    RADIUS,
    TERRAIN_POLYGON,
    WORLD_CELL_FLOATS,
    WORLD_CELL_INTS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@entry
def make_planes(wf: Array, first: int, stride: int, count: int) -> None:
    """Compute the planes and edges of polygon records that lie behind each other.

    retail: CLandBlockStruct::AddPolygon 0x005310D0, 10 3.4
    """
    for i in range(count):
        polygon_make_plane(wf, first + stride * i)
        polygon_make_edges(wf, first + stride * i)


@entry
def find_terrain_poly(wf: Array, wi: Ints, cell: int, x: float, y: float) -> int:
    """Return the first triangle of a land cell that has a point of its block above or below it.

    Its record's offset, or NO_POLYGON; the edges belong to both sides.

    retail: CLandCell::find_terrain_poly 0x00532CF0, 10 5
    """
    poly = wi[wi[WORLD_CELL_INTS] + CELL_INTS * cell + LAND_TERRAIN]
    if polygon_point_in_poly2d(wf, poly, x, y, 0):
        return poly
    poly += TERRAIN_POLYGON
    if polygon_point_in_poly2d(wf, poly, x, y, 0):
        return poly
    return NO_POLYGON


@entry
def water_depth(wf: Array, wi: Ints, cell: int, x: float, y: float) -> float:
    """Return how deep a mover sinks in at a point of a land cell's block, metres.

    retail: CObjCell::get_water_depth 0x0052B8A0, CLandBlockStruct::calc_water_depth 0x005315F0, 10 6.4-5
    """
    ints = wi[WORLD_CELL_INTS] + CELL_INTS * cell
    if wi[ints + LAND_WATER] == NOT_WATER:
        return 0.0
    if wi[ints + LAND_WATER] == ENTIRELY_WATER:
        return DEEP_WATER
    number = (int(wf[wi[WORLD_CELL_FLOATS] + CELL_FLOATS * cell + CELL_ID]) & 0xFFFF) - 1
    corner = 1
    if y > (number & 7) * BLOCK_STEP + HALF_CELL:
        corner = 2
    if x > (number >> 3) * BLOCK_STEP + HALF_CELL:
        corner *= 4
    return SHALLOW_WATER if wi[ints + LAND_WET_CORNERS] & corner != 0 else WET_LAND


@inlined
def _is_wall(wi: Ints, s: Array, ints: int) -> bool:
    """Say whether a block that is nothing but sea keeps the mover out.

    retail: 10 7 step 4
    """
    return (
        wi[ints + LAND_BLOCK_WATER] == ENTIRELY_WATER
        and int(s[OI_STATE]) & IS_VIEWER == 0
        and s[MOVER_MISSILE] == 0.0
    )


@entry
def find_terrain_collisions(wf: Array, wi: Ints, s: Array, cell: int) -> int:
    """Test the mover against the ground of a land cell.

    retail: CLandCell::find_env_collisions 0x00532F20, 10 7
    """
    land_cell = wf[wi[WORLD_CELL_FLOATS] + CELL_FLOATS * cell + CELL_ID]
    bx, by = block_offset(s[CHECK_POS], land_cell)
    if not _is_wall(wi, s, wi[WORLD_CELL_INTS] + CELL_INTS * cell) and ground_beyond(wf, wi, s, cell, bx, by):
        return OK
    lx, ly = f32(s[GLOBAL_LOW_POINT] - bx), f32(s[GLOBAL_LOW_POINT + 1] - by)
    poly = find_terrain_poly(wf, wi, cell, lx, ly)
    if poly == NO_POLYGON:
        return OK
    return _collide_with(wf, wi, s, cell, poly, bx, by, lx, ly)


@kernel
def _collide_with(
    wf: Array, wi: Ints, s: Array, cell: int, poly: int, bx: float, by: float, lx: float, ly: float
) -> int:
    """Test the mover against the sea, or a triangle.

    `bx`, `by`: origin of the cell's block; `lx`, `ly`: the low point in that block.

    retail: 10 7 step 4...7
    """
    ints = wi[WORLD_CELL_INTS] + CELL_INTS * cell
    land_cell = wf[wi[WORLD_CELL_FLOATS] + CELL_FLOATS * cell + CELL_ID]
    trace_open(wi, s, TERRAIN_CALL)
    if _is_wall(wi, s, ints):
        ts = COLLIDED
    else:
        x, y, z = load(s, GLOBAL_SPHERE)
        x, y, z = f32(x - bx), f32(y - by), f32(z - 0.0)
        is_water = 1.0 if wi[ints + LAND_WATER] != NOT_WATER else 0.0
        depth = water_depth(wf, wi, cell, lx, ly)
        r = s[GLOBAL_SPHERE + RADIUS]
        ts = validate_walkable(s, x, y, z, r, wf, poly, is_water, depth, land_cell)
    trace_close(wi, s, ts)
    return ts
