"""Clearance: how large a ball about a point is certain to touch nothing, looked up instead of walked for.

When a world is compiled, the box about a cell's tree is divided into cubes, and for the middle of each the
largest of some radii is noted of which `engine.kernels.broad.tree_beyond` says that no sphere inside the ball
strikes or overlaps a polygon. A ball that lies inside such a ball is clear for the same reason: the spheres
inside it are inside the larger one, too.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.kernels.broad import tree_beyond
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.indexing import unsigned
from engine.layout import (
    CLEARANCE_BITS,
    CLEARANCE_CORNER,
    CLEARANCE_COUNTS,
    CLEARANCE_EDGE,
    CLEARANCE_LEVELS,
    CLEARANCE_MASK,
    CLEARANCE_MOST,
    CLEARANCE_PER_METRE,
    CLEARANCE_SHIFT,
    CLEARANCE_STEP,
    NO_CLEARANCE,
    WORLD_CLEARANCES,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Bytes, Ints


@inlined
def _beside(u: float, i: int, count: int) -> int:
    """Return the cube next to which a point of the i-th is, of so many along an axis; the i-th at the end."""
    return min(max(i + (1 if u - i > 0.5 else -1), 0), count - 1)


@inlined
def _off(edge: float, u: float, i: int) -> float:
    """Return the square of how far a point is from the middle of the i-th cube, along an axis."""
    away = edge * (u - i - 0.5)
    return away * away


@inlined
def _room(wi: Ints, levels: int, cube: int, step: float, r: float, squared: float) -> float:
    """Return more than 0 if the clear ball about the middle of a cube holds a ball that is so far off."""
    word = wi[unsigned(levels + (cube >> CLEARANCE_SHIFT))]
    level = (word >> CLEARANCE_BITS * (cube & CLEARANCE_MASK)) & CLEARANCE_MOST
    room = max(0.0, step * level - r)
    return room * room - squared


@inlined
def known_clear(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float, r: float) -> bool:
    """Say whether a ball, in an environment cell's own frame, is known to be clear of the cell's tree.

    It is if it lies inside the ball that was found clear about the middle of a cube: of the one that holds
    its centre, or of the three that are next to it beside that. Points outside the box are in no cube, and
    NaN is nowhere. What is rounded here is less than a part in 2**45 of the size of the grid, which the
    slack that balls are given for roundings to float32 is far above.

    All four are looked at, without a branch: which of them will do nobody can foresee, and to have guessed
    wrong takes longer than to look.
    """
    g = unsigned(wi[unsigned(wi[WORLD_CLEARANCES] + cell)])
    if g == NO_CLEARANCE:
        return False
    scale = wf[g + CLEARANCE_PER_METRE]
    u = scale * (x - wf[g + CLEARANCE_CORNER])
    v = scale * (y - wf[g + CLEARANCE_CORNER + 1])
    w = scale * (z - wf[g + CLEARANCE_CORNER + 2])
    nu, nv, nw = wf[g + CLEARANCE_COUNTS], wf[g + CLEARANCE_COUNTS + 1], wf[g + CLEARANCE_COUNTS + 2]
    if not (0.0 <= u < nu and 0.0 <= v < nv and 0.0 <= w < nw):
        return False
    edge, step, levels = wf[g + CLEARANCE_EDGE], wf[g + CLEARANCE_STEP], int(wf[g + CLEARANCE_LEVELS])
    i, j, k, ny, nz = int(u), int(v), int(w), int(nv), int(nw)
    a, b, c = _beside(u, i, int(nu)), _beside(v, j, ny), _beside(w, k, nz)
    dx, dy, dz = _off(edge, u, i), _off(edge, v, j), _off(edge, w, k)
    column = (i * ny + j) * nz
    own = _room(wi, levels, column + k, step, r, dx + dy + dz)
    along_z = _room(wi, levels, column + c, step, r, dx + dy + _off(edge, w, c))
    along_x = _room(wi, levels, (a * ny + j) * nz + k, step, r, _off(edge, u, a) + dy + dz)
    along_y = _room(wi, levels, (i * ny + b) * nz + k, step, r, dx + _off(edge, v, b) + dz)
    return max(own, along_z, along_x, along_y) > 0.0


@entry
def measure_clearance(wf: Array, wi: Ints, s: Array, root: int, grid: Array, levels: Bytes) -> None:
    """Find the level of every cube of a grid: how many steps the largest clear ball about its middle has.

    `grid` is a record as in the world's floats; `levels` has a number for each cube, z changing fastest.
    The search goes on from the cube before: clearances of neighbours differ by little.
    """
    edge, step = grid[CLEARANCE_EDGE], grid[CLEARANCE_STEP]
    ny, nz = int(grid[CLEARANCE_COUNTS + 1]), int(grid[CLEARANCE_COUNTS + 2])
    level = 0
    for cube in range(len(levels)):
        x = grid[CLEARANCE_CORNER] + edge * (cube // (ny * nz) + 0.5)
        y = grid[CLEARANCE_CORNER + 1] + edge * (cube // nz % ny + 0.5)
        z = grid[CLEARANCE_CORNER + 2] + edge * (cube % nz + 0.5)
        level = _level_at(wf, wi, s, root, x, y, z, step, level)
        levels[cube] = level


@kernel
def _level_at(
    wf: Array, wi: Ints, s: Array, root: int, x: float, y: float, z: float, step: float, guess: int
) -> int:
    """Return the largest level near a guess of which the ball about a point is clear; 0 is no ball at all."""
    level = guess
    while level > 0 and not tree_beyond(wf, wi, s, root, x, y, z, level * step):
        level -= 1
    if level < guess:
        return level
    while level < CLEARANCE_MOST and tree_beyond(wf, wi, s, root, x, y, z, (level + 1) * step):
        level += 1
    return level
