"""Land: heights and terrain of landblocks by simple rules, and the surface that they make."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.strategies.numbers import unit

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from conformance.scenes.model import Vec3

CELL: Final = 24.0
"""Edge of a land cell, metres."""
BLOCK: Final = 192.0
"""Edge of a landblock, metres."""
CELLS_PER_SIDE: Final = 8
"""Of a landblock; it has one more vertex per side."""
WORLD_BLOCKS: Final = 255
"""Landblocks per side of the world (10 1)."""
_VERTICES: Final = CELLS_PER_SIDE + 1
_LIMIT_RISE: Final = 27.013426
"""Height gained over a cell on a slope whose normal's z is the walkable limit, metres."""
_TYPE_SHIFT: Final = 2
"""Place of the terrain type in a terrain word (10 3.1)."""
_GRASS: Final = 1
_WATER_TYPES: Final = (16, 17, 18, 19, 20)
"""Terrain types that are water (10 6.1)."""
_HASH: Final = 2654435761
"""Knuth's multiplicative hash: 2^32 over the golden ratio."""


def _scattered(x: int, y: int, count: int) -> int:
    """Return a number below `count` that looks random but always is the same at a vertex."""
    return (((x * 2040 + y + 1) * _HASH) >> 13) % count


def _waves(x: int, y: int) -> float:
    """Return hills a few metres high."""
    return 40.0 + 1.5 * abs(x % 10 - 5) + 1.25 * abs(y % 14 - 7)


def _near_limit(x: int, y: int) -> float:
    """Return ridges along y whose slopes lean a little more or less than the walkable limit."""
    return 50.0 + (x & 1) * (_LIMIT_RISE + (y % 5 - 2) * 1e-5)


_HEIGHTS: Final[Mapping[str, Callable[[int, int], float]]] = {
    "flat": lambda _x, _y: 20.0,
    "rolling": _waves,
    "limit": _near_limit,
    "tilted": lambda x, y: 100.0 + 24.0 * ((x % 16) * 0.125 + (y % 16) * 0.0625),
    "cliff": lambda x, y: 30.0 + 60.0 * ((x + y) % 5 == 0),
    "rough": lambda x, y: float(_scattered(x, y, 48)),
}
"""Height of the vertex at global coordinates (cells from the world's south-west corner), metres."""
LANDS: Final = tuple(_HEIGHTS)
"""Kinds of land, the simplest first."""

_TERRAINS: Final[Mapping[str, Callable[[int, int], int]]] = {
    "dry": lambda _x, _y: _GRASS,
    "ponds": lambda x, y: _WATER_TYPES[_scattered(y, x, 5)] if _scattered(x, y, 3) else _GRASS,
    "sea": lambda _x, _y: _WATER_TYPES[-1],
}
"""Terrain type of a vertex."""
WATERS: Final = tuple(_TERRAINS)
"""Kinds of water, none first."""


def landblock(block: int, land: str, water: str, level: Mapping[tuple[int, int], float]) -> dict[str, Any]:
    """Write a landblock of a world.

    Parameters
    ----------
    block : int
        Its 16-bit id.
    land, water : str
        How high and how wet it is: keys of the tables above.
    level : Mapping of (int, int) to float
        Heights that are other than the rule says, by global vertex, metres.
    """
    height, terrain = _HEIGHTS[land], _TERRAINS[water]
    vertices = [global_vertex(block, i, j) for i in range(_VERTICES) for j in range(_VERTICES)]
    return {
        "block": block,
        "heights": [level.get(vertex, height(*vertex)) for vertex in vertices],
        "terrain": [terrain(*vertex) << _TYPE_SHIFT for vertex in vertices],
    }


def height_at(land: str, vertex: tuple[int, int]) -> float:
    """Return how high a kind of land is at a global vertex, metres."""
    return _HEIGHTS[land](*vertex)


def global_vertex(block: int, i: int, j: int) -> tuple[int, int]:
    """Return how many cells a block's vertex is from the world's south-west corner."""
    return (block >> 8) * CELLS_PER_SIDE + i, (block & 0xFF) * CELLS_PER_SIDE + j


def land_cell(block: int, x: float, y: float) -> int:
    """Return the id of the land cell of a block that a point is in, or nearest to."""
    i, j = (min(max(int(v // CELL), 0), CELLS_PER_SIDE - 1) for v in (x, y))
    return block << 16 | i * CELLS_PER_SIDE + j + 1


def surface(landblock: Mapping[str, Any], x: float, y: float) -> tuple[float, Vec3]:
    """Return the height (metres) and unit normal of the ground at a point of a block.

    On an edge between triangles it is one of them; outside the block the outermost cell is extended.
    """
    i, j = divmod((land_cell(landblock["block"], x, y) & 0xFFFF) - 1, CELLS_PER_SIDE)
    heights: Sequence[float] = landblock["heights"]
    sw, nw, se, ne = (heights[_VERTICES * (i + di) + j + dj] for di in (0, 1) for dj in (0, 1))
    u, v = x / CELL - i, y / CELL - j
    gx, gy = global_vertex(landblock["block"], i, j)
    if _cut_north_east(gx, gy):
        du, dv = (se - sw, ne - se) if u >= v else (ne - nw, nw - sw)
        height = sw + u * du + v * dv
    elif u + v <= 1.0:
        du, dv = se - sw, nw - sw
        height = sw + u * du + v * dv
    else:
        du, dv = ne - nw, ne - se
        height = ne - (1.0 - u) * du - (1.0 - v) * dv
    return height, unit((-du, -dv, CELL))


def _cut_north_east(x: int, y: int) -> bool:
    """Tell whether a cell is cut from its south-west to its north-east corner (10 3.3)."""
    mixed = y * (214614067 * x + 1813693831) - 1109124029 * x - 1369149221
    return bool(mixed >> 31 & 1)
