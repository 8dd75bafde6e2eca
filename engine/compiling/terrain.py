"""Landblocks compiled (10, 3 and 6): triangles with their planes, water, and the cells' records."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from engine import layout as at
from engine.constants import BLOCK_STEP, ENTIRELY_WATER, HALF_CELL, NOT_WATER, PARTIALLY_WATER
from engine.errors import WorldError
from engine.float32 import float32_array
from engine.kernels.land_cells import make_planes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.kernels.types import Array, Ints

Flags = npt.NDArray[np.bool_]

SIDE: Final = 8
"""Land cells along an edge of a block (10, 1)."""
DETAILS: Final = (SIDE, 4, 2, 1)
"""How many of them a block may be loaded with (10, 3)."""
VERTICES: Final = SIDE + 1
"""Vertices along an edge of a block."""
MAX_BLOCK: Final = 254
"""Largest block coordinate (10, 1)."""

_FIRST_WATER, _LAST_WATER = 16, 20
"""Terrain types that are water (10, 6.1)."""
_I, _J = np.meshgrid(np.arange(SIDE), np.arange(SIDE), indexing="ij")
_SW, _NW = VERTICES * _I + _J, VERTICES * _I + _J + 1
_SE, _NE = _SW + VERTICES, _NW + VERTICES
_CORNERS = np.stack((_SW, _NW, _SE, _NE), axis=-1)
"""Vertices of a cell, in the order of the bits of `engine.layout.LAND_WET_CORNERS`."""
_SW_NE_CUT = np.stack((_SW, _SE, _NE, _SW, _NE, _NW), axis=-1)
_NW_SE_CUT = np.stack((_SW, _SE, _NW, _NE, _NW, _SE), axis=-1)
"""Vertices of both triangles of a cell (10, 3.3)."""


class Water(NamedTuple):
    """Where a block's water is.

    Attributes
    ----------
    corners : ndarray of int, shape (8, 8)
        Bits of `engine.layout.LAND_WET_CORNERS`.
    cells : ndarray of int, shape (8, 8)
        The water type of each cell.
    block : int
        The water type of the whole block.
    """

    corners: Ints
    cells: Ints
    block: int


def split_cuts(block: int) -> Flags:
    """Say which cells of a block are cut from south-west to north-east, the others from north-west.

    Parameters
    ----------
    block : int
        256 * x + y.

    Returns
    -------
    ndarray of bool, shape (8, 8)
        Index i from the west, j from the south.

    Notes
    -----
    retail: CLandBlockStruct::ConstructPolygons 0x00531D10, 10 3.3
    """
    x = (_I + SIDE * (block >> 8)).astype(np.uint32)
    y = (_J + SIDE * (block & 0xFF)).astype(np.uint32)
    h = y * (np.uint32(214614067) * x + np.uint32(1813693831)) - np.uint32(1109124029) * x
    cuts: Flags = (h - np.uint32(1369149221)) >= np.uint32(0x80000000)
    return cuts


def water_of(terrain: Sequence[int] | Ints) -> Water:
    """Find the water of a block of 81 terrain words.

    retail: CLandBlockStruct::CalcCellWater 0x00531550, CalcWater 0x005327E0, 10 6.1-3
    """
    kind = (np.asarray(terrain, dtype=np.int64) >> 2) & 0x1F
    wet = ((kind >= _FIRST_WATER) & (kind <= _LAST_WATER))[_CORNERS]
    cells = np.where(wet.all(axis=-1), ENTIRELY_WATER, np.where(wet.any(axis=-1), PARTIALLY_WATER, NOT_WATER))
    block = NOT_WATER
    if (cells == ENTIRELY_WATER).all():
        block = ENTIRELY_WATER
    elif (cells != NOT_WATER).any():
        block = PARTIALLY_WATER
    return Water((wet * (1, 2, 4, 8)).sum(axis=-1), cells, int(block))


def triangles(block: int, heights: Sequence[float] | Array) -> Array:
    """Return the records of a block's triangles, with their planes, in the block's frame.

    Returns
    -------
    ndarray of float, shape (8, 8, 2, TERRAIN_POLYGON)
        Of cell i, j the polygons 0 and 1, as `engine.layout` lays out a polygon.

    Notes
    -----
    retail: CLandBlockStruct::ConstructVertices 0x005328D0, ConstructPolygons 0x00531D10, 10 3.2-4
    """
    vertices = np.empty((VERTICES * VERTICES, 3), dtype=np.float64)
    vertices[:, 0] = np.repeat(np.arange(VERTICES) * BLOCK_STEP, VERTICES)
    vertices[:, 1] = np.tile(np.arange(VERTICES) * BLOCK_STEP, VERTICES)
    vertices[:, 2] = heights
    corners = np.where(split_cuts(block)[..., None], _SW_NE_CUT, _NW_SE_CUT).reshape(SIDE, SIDE, 2, 3)
    records = np.zeros((SIDE, SIDE, 2, at.TERRAIN_POLYGON), dtype=np.float64)
    records[..., at.POLYGON_COUNT] = 3.0
    records[..., at.POLYGON_ID] = (0.0, 1.0)
    records[..., at.POLYGON_SHAPE] = -1.0
    for k in range(3):
        place = at.POLYGON_CORNERS + at.CORNER_SIZE * k
        records[..., place : place + at.VECTOR_SIZE] = vertices[corners[..., k]]
    make_planes(records.ravel(), 0, int(at.TERRAIN_POLYGON), 2 * SIDE * SIDE)
    return records


def block_heights(heights: Any, where: str) -> Array:
    """Return checked heights of a block."""
    return float32_array(heights, (VERTICES * VERTICES,), f"{where}, heights", WorldError)


def block_terrain(terrain: Sequence[int] | None, where: str) -> Ints:
    """Return checked terrain words of a block; zeros for None."""
    if terrain is None:
        return np.zeros(VERTICES * VERTICES, dtype=np.int64)
    words = np.asarray(terrain)
    if words.shape != (VERTICES * VERTICES,) or not np.issubdtype(words.dtype, np.integer):
        raise WorldError(f"{where}, terrain", f"not {VERTICES * VERTICES} whole numbers")
    return words.astype(np.int64)


def cell_positions(block: int) -> Array:
    """Return the positions of a block's land cells, and their ids, 0 off the land.

    Each is `engine.layout.CELL_FLOATS` numbers.

    retail: CLandBlockStruct::ConstructPolygons 0x00531D10, 10 3.3
    """
    cells = np.zeros((SIDE, SIDE, at.CELL_FLOATS), dtype=np.float64)
    on_land = block >> 8 <= MAX_BLOCK and block & 0xFF <= MAX_BLOCK
    ids = (block << 16) + SIDE * _I + _J + 1
    cells[..., 0] = cells[..., at.CELL_ID] = ids if on_land else 0
    cells[..., at.QUATERNION] = 1.0
    for diagonal in (0, 4, 8):
        cells[..., at.MATRIX + diagonal] = 1.0
    cells[..., at.ORIGIN] = (2 * _I + 1) * HALF_CELL
    cells[..., at.ORIGIN + 1] = (2 * _J + 1) * HALF_CELL
    return cells.reshape(SIDE * SIDE, at.CELL_FLOATS)
