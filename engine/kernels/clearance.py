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


_NEXT_TO = 0o73652140
"""Which cubes about a corner are looked at, one after the other: its bits, from the least, say whether
it is the next one along x, y and z. Rooms are wider than high: a mover is farthest from a middle along z."""


@inlined
def _level(wf: Array, wi: Ints, g: int, cube: int) -> int:
    """Return the level of a cube of the grid at `g`."""
    word = wi[unsigned(int(wf[unsigned(g + CLEARANCE_LEVELS)]) + (cube >> CLEARANCE_SHIFT))]
    return (word >> CLEARANCE_BITS * (cube & CLEARANCE_MASK)) & CLEARANCE_MOST


@inlined
def _side(u: float, i: int) -> int:
    """Return on which side of the middle of the i-th cube a point is."""
    return 1 if u - i > 0.5 else -1


@kernel
def known_clear(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float, r: float) -> bool:
    """Say whether a ball, in an environment cell's own frame, is known to be clear of the cell's tree.

    It is if it lies inside the ball that was found clear about the middle of a cube: of the one that holds
    its centre, or of the seven others about the corner that is next to it. Points outside the box are in
    no cube, and NaN is nowhere. What is rounded here is less than a part in 2**45 of the size of the grid,
    which the slack that balls are given for roundings to float32 is far above.
    """
    g = wi[unsigned(wi[WORLD_CLEARANCES] + cell)]
    if g == NO_CLEARANCE:
        return False
    scale, corner, counts = wf[unsigned(g + CLEARANCE_PER_METRE)], g + CLEARANCE_CORNER, g + CLEARANCE_COUNTS
    u = scale * (x - wf[unsigned(corner)])
    v = scale * (y - wf[unsigned(corner + 1)])
    w = scale * (z - wf[unsigned(corner + 2)])
    nu, nv, nw = wf[unsigned(counts)], wf[unsigned(counts + 1)], wf[unsigned(counts + 2)]
    if not (0.0 <= u < nu and 0.0 <= v < nv and 0.0 <= w < nw):
        return False
    edge, step = wf[unsigned(g + CLEARANCE_EDGE)], wf[unsigned(g + CLEARANCE_STEP)]
    i, j, n = int(u), int(v), int(w)
    for k in range(8):
        other = _NEXT_TO >> 3 * k & 7
        a = i + _side(u, i) * (other & 1)
        b = j + _side(v, j) * (other >> 1 & 1)
        c = n + _side(w, n) * (other >> 2)
        if not (0 <= a < nu and 0 <= b < nv and 0 <= c < nw):
            continue
        room = step * _level(wf, wi, g, (a * int(nv) + b) * int(nw) + c) - r
        dx, dy, dz = edge * (u - a - 0.5), edge * (v - b - 0.5), edge * (w - c - 0.5)
        if room > 0.0 and dx * dx + dy * dy + dz * dz < room * room:
            return True
    return False


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
