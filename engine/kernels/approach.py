"""What a query will look up first in its tree's lattice, brought near while others are answered.

In a large world it finds little of that in a cache: its block's words, the list that one of them points to,
and the polygons of the list lie all over memory, each where the one before says, and it would wait for each.
So while a query is answered, one step is taken for each of the next four: what a step reads was brought near
by the step before, a query ago.

Queries are single calls of a cell's tree, and moves, which nearly always look up first what is near where
they end.

The mover is taken for upright, which nearly all are. For another, something is brought near that nobody
reads: no answer depends on it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, TypeAlias

from engine.constants import frozen
from engine.kernels.ahead import bring_near
from engine.kernels.cell_array import ints_of, is_land, position_of
from engine.kernels.clearance import bring_clearance
from engine.kernels.compile import inlined, kernel
from engine.kernels.indexing import unsigned
from engine.kernels.lattice import NOWHERE, cube_at, half, is_unknown, listed, lists_of
from engine.kernels.plan_flight import into_cell
from engine.kernels.position import block_offset
from engine.kernels.vector import load
from engine.layout import (
    CELL_TREE,
    NO_TREE,
    POLYGON_CORNERS,
    POSE_ORIGIN,
    Q_BEGIN_CELL,
    Q_END,
    Q_SCALE,
    Q_SPHERES,
    Q_START,
    SPHERE_SIZE,
    WORLD_CELLS,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Vector

Steps: TypeAlias = tuple[tuple[int, int, int], tuple[int, int, int], tuple[int, int, int]]
"""Of the queries whose turn comes in four, three and two: where the table tells of the block, the cube in it,
and the tree's lists; where the block's words begin, and the same; where in the lists the polygons begin and
end, and the lists."""

STEPS: Final = frozen(4)
"""How many queries before its turn a query's first step is taken."""
NO_STEPS: Final[Steps] = (NOWHERE, 0, 0), (NOWHERE, 0, 0), (0, 0, 0)
"""What is known of queries that no step has been taken for."""
MOST: Final = frozen(4)
"""Polygons of a list that are brought near, at most."""
LARGE: Final = frozen(1 << 17)
"""Numbers of a world that no second cache has room for: a megabyte. A smaller one is in it anyway."""
HUGE: Final = frozen(1 << 19)
"""Numbers of a world of which not even the clearances, a tenth of it or so, stay in a near cache."""


@inlined
def is_large(wf: Array, wi: Ints) -> bool:
    """Say whether a world is not in a near cache as a whole."""
    return len(wf) + len(wi) > LARGE


@inlined
def is_huge(wf: Array, wi: Ints) -> bool:
    """Say whether it pays to bring near what a flight looks up, which is little."""
    return len(wf) + len(wi) > HUGE


@inlined
def _place(wf: Array, p: int, q: Array) -> Vector:
    """Return about where a query's first sphere is in the space of the position at ``wf[p]``."""
    x, y, z = load(q, Q_END + POSE_ORIGIN)
    bx, by = block_offset(wf[p], q[Q_END])
    return into_cell(wf, p, bx + x, by + y, z + q[Q_SPHERES + 2])


@inlined
def _find_entry(wf: Array, wi: Ints, q: Array, cell: float) -> tuple[int, int, int]:
    """Take the first step of a query: find out where its cube is."""
    if not 0.0 <= cell < wi[WORLD_CELLS]:
        return NOWHERE, 0, 0
    index = int(cell)
    root = wi[ints_of(wi, index) + CELL_TREE]
    if root == NO_TREE:
        return NOWHERE, 0, 0
    x, y, z = _place(wf, position_of(wi, index), q)
    entry, cube = cube_at(wf, wi, root, x, y, z)
    if entry != NOWHERE:
        bring_near(wi, entry, 1)
    return entry, cube, lists_of(wi, root)


@inlined
def _find_words(wi: Ints, entry: int, cube: int, lists: int) -> tuple[int, int, int]:
    """Take the second: find the words of its block."""
    if entry == NOWHERE:
        return NOWHERE, 0, 0
    words = wi[unsigned(entry)]
    bring_near(wi, words + (cube >> 1), 1)
    return words, cube, lists


@inlined
def _find_list(wi: Ints, words: int, cube: int, lists: int) -> tuple[int, int, int]:
    """Take the third: find its polygons' list."""
    if words == NOWHERE:
        return 0, 0, 0
    word = half(wi, words, cube)
    if is_unknown(word):
        return 0, 0, 0
    first, end = listed(word)
    bring_near(wi, lists + (first >> 1), 1)
    return first, end, lists


@inlined
def _bring_polygons(wf: Array, wi: Ints, first: int, end: int, lists: int) -> None:
    """Take the last: of each polygon, bring what a sphere is tested against first."""
    for i in range(first, min(end, first + MOST)):
        bring_near(wf, half(wi, lists, i), POLYGON_CORNERS)


@inlined
def approach_flight(wf: Array, wi: Ints, q: Array) -> None:
    """Bring near what says whether the way of a mover that may fly is clear (`engine.kernels.clearance`).

    `q` is the row of a move whose turn comes soon.
    """
    cell = q[Q_BEGIN_CELL]
    if not 0.0 <= cell < wi[WORLD_CELLS] or is_land(wi, int(cell)):
        return
    index = int(cell)
    p = position_of(wi, index)
    x, y, z = load(q, Q_START + POSE_ORIGIN)
    tx, ty, tz = load(q, Q_END + POSE_ORIGIN)
    up = q[Q_SCALE] * (q[Q_SPHERES + 2] + q[Q_SPHERES + SPHERE_SIZE + 2])
    x, y, z = into_cell(wf, p, 0.5 * (x + tx), 0.5 * (y + ty), 0.5 * (z + tz + up))
    bring_clearance(wf, wi, index, x, y, z)


@kernel
def approach(wf: Array, wi: Ints, q: Array, cell: float, steps: Steps) -> Steps:
    """Take one step for each of the queries that come next.

    `q` is the row of the last of them, `STEPS` queries from now, and `cell` the index of the cell in which it
    looks something up; `steps` has been returned a query ago.
    """
    (entry, its_cube, its_lists), (words, cube, lists), (first, end, near) = steps
    _bring_polygons(wf, wi, first, end, near)
    return (
        _find_entry(wf, wi, q, cell),
        _find_words(wi, entry, its_cube, its_lists),
        _find_list(wi, words, cube, lists),
    )
