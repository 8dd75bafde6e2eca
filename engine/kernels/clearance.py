"""Clearance: how large a ball about a point is certain to touch nothing, looked up instead of walked for.

When a world is prepared, the box about a cell's tree is divided into cubes, and for the middle of each the
largest of some radii is noted of which `engine.kernels.broad.tree_beyond` says that no sphere inside the ball
strikes or overlaps a polygon. A ball that lies inside such a ball is clear for the same reason: the spheres
inside it are inside the larger one, too.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.kernels.ahead import bring_near
from engine.kernels.broad import tree_beyond
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.indexing import unsigned
from engine.kernels.octets import BYTES, octet
from engine.layout import (
    CLEARANCE_CORNER,
    CLEARANCE_COUNTS,
    CLEARANCE_EDGE,
    CLEARANCE_LEVELS,
    CLEARANCE_MOST,
    CLEARANCE_PER_METRE,
    CLEARANCE_STEPS,
    NO_CLEARANCE,
    WORLD_CLEARANCES,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Bytes, Ints


@inlined
def _off(u: float, i: int) -> float:
    """Return how far a point is from the middle of the i-th cube, which holds it, along an axis; in steps."""
    return CLEARANCE_STEPS * (u - i - 0.5)


@inlined
def _beside(i: int, off: float) -> int:
    """Return the cube that a point of the i-th is next to, along an axis."""
    return i + 1 if off > 0.0 else i - 1


@inlined
def _room(wi: Ints, cube: int, r: float, x: float, y: float, z: float) -> float:
    """Return more than 0 if the clear ball about the middle of a cube holds one of radius r; all in steps.

    `cube`: its byte; `x`, `y`, `z`: how far the other's centre is from there.
    """
    room = max(0.0, octet(wi, cube) - r)
    return room * room - ((x * x + y * y) + z * z)


@inlined
def _cubes_about(
    wf: Array, g: int, x: float, y: float, z: float
) -> tuple[bool, float, float, float, int, int]:
    """Say whether a point has cubes of a grid on all sides; where it is, in cubes; how many y and z have.

    `g`: where the grid's record is. NaN has none on any side.
    """
    scale = wf[g + CLEARANCE_PER_METRE]
    u = scale * (x - wf[g + CLEARANCE_CORNER])
    v = scale * (y - wf[g + CLEARANCE_CORNER + 1])
    w = scale * (z - wf[g + CLEARANCE_CORNER + 2])
    nu, nv, nw = wf[g + CLEARANCE_COUNTS], wf[g + CLEARANCE_COUNTS + 1], wf[g + CLEARANCE_COUNTS + 2]
    inside = 1.0 <= u < nu - 1.0 and 1.0 <= v < nv - 1.0 and 1.0 <= w < nw - 1.0
    return inside, u, v, w, int(nv), int(nw)


@inlined
def bring_clearance(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float) -> None:
    """Have the cubes brought near that `known_clear` looks at for a ball about a point."""
    g = unsigned(wi[unsigned(wi[WORLD_CLEARANCES] + cell)])
    if g == NO_CLEARANCE:
        return
    inside, u, v, w, ny, nz = _cubes_about(wf, g, x, y, z)
    if not inside:
        return
    i, j = int(u), int(v)
    first = int(wf[g + CLEARANCE_LEVELS]) + int(w)
    bring_near(wi, (first + (i * ny + j) * nz) // BYTES, 1)
    bring_near(wi, (first + (_beside(i, _off(u, i)) * ny + j) * nz) // BYTES, 1)
    bring_near(wi, (first + (i * ny + _beside(j, _off(v, j))) * nz) // BYTES, 1)


@inlined
def known_clear(wf: Array, wi: Ints, cell: int, x: float, y: float, z: float, r: float) -> bool:
    """Say whether a ball, in an environment cell's own frame, is known to be clear of the cell's tree.

    It is if it lies inside the ball that was found clear about the middle of a cube: of the one that holds
    its centre, or of the three that are next to it beside that. Of points outside the box, or in one of its
    outermost cubes, nothing is known, and NaN is nowhere. What is rounded here is less than a part in 2**45
    of the size of the grid, which the slack that balls are given for roundings to float32 is far above.

    All four are looked at, without a branch: which of them will do nobody can foresee, and to have guessed
    wrong takes longer than to look.
    """
    g = unsigned(wi[unsigned(wi[WORLD_CLEARANCES] + cell)])
    if g == NO_CLEARANCE:
        return False
    inside, u, v, w, ny, nz = _cubes_about(wf, g, x, y, z)
    if not inside:
        return False
    i, j, k = int(u), int(v), int(w)
    dx, dy, dz = _off(u, i), _off(v, j), _off(w, k)
    ex, ey, ez = CLEARANCE_STEPS - abs(dx), CLEARANCE_STEPS - abs(dy), CLEARANCE_STEPS - abs(dz)
    steps = CLEARANCE_STEPS * wf[g + CLEARANCE_PER_METRE] * r
    levels = int(wf[g + CLEARANCE_LEVELS])
    column = levels + (i * ny + j) * nz
    beside_x, beside_y = (_beside(i, dx) * ny + j) * nz, (i * ny + _beside(j, dy)) * nz
    return (
        max(
            _room(wi, column + k, steps, dx, dy, dz),
            _room(wi, column + _beside(k, dz), steps, dx, dy, ez),
            _room(wi, levels + beside_x + k, steps, ex, dy, dz),
            _room(wi, levels + beside_y + k, steps, dx, ey, dz),
        )
        > 0.0
    )


@entry
def measure_clearance(wf: Array, wi: Ints, s: Array, root: int, grid: Array, levels: Bytes) -> None:
    """Find the level of every cube of a grid: how many steps the largest clear ball about its middle has.

    `grid` is a record as in the world's floats; `levels` has a number for each cube, z changing fastest.
    The search goes on from the cube before: clearances of neighbours differ by little.
    """
    edge = grid[CLEARANCE_EDGE]
    step = edge / CLEARANCE_STEPS
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
    while level > 0 and not tree_beyond(wf, wi, s, root, (x, y, z, level * step)):
        level -= 1
    if level < guess:
        return level
    while level < CLEARANCE_MOST and tree_beyond(wf, wi, s, root, (x, y, z, (level + 1) * step)):
        level += 1
    return level
