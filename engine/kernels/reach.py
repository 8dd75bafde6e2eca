"""A part of an object, and what its box and its sphere reach: cells, portals, columns of land cells.

A part is a record at ``part`` of `a`, laid out below.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final, TypeAlias

from engine.constants import BLOCK_STEP, EPS, frozen
from engine.kernels.cell_array import ints_of, position_of
from engine.kernels.compile import inlined, kernel
from engine.kernels.position import position_localtoglobal, position_localtolocal
from engine.kernels.rounding import f32
from engine.kernels.vector import load
from engine.layout import (
    CELL_PLANE_COUNT,
    CELL_PLANES,
    ORIGIN,
    PLANE_SIZE,
    POSITION_SIZE,
    RADIUS,
    SPHERE_SIZE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints

    Box: TypeAlias = tuple[float, float, float, float, float, float]

REACH_SPHERE: Final = POSITION_SIZE
"""A part's record: its position; the sphere of its tree, which has a negative radius if there is none;"""
REACH_BOX: Final = frozen(REACH_SPHERE + SPHERE_SIZE)
"""the least and the greatest corner of its box, both in its own space, unscaled;"""
REACH_FLAT: Final = frozen(REACH_BOX + 6)
"""and 1 if even its most detailed picture is flat."""
REACH_SIZE: Final = frozen(REACH_FLAT + 1)

_POSITIVE: Final = frozen(0)
_NEGATIVE: Final = frozen(1)
_CROSSING: Final = frozen(3)
"""Sides of a plane (01, 6.2); the first two are also those of a portal."""
_CORNERS: Final = frozen(8)
_FAR: Final = 1e6
"""A column or row of land cells that is beyond the land, whatever it is counted from."""


@inlined
def _corner(box: Array, at: int, k: int) -> tuple[float, float, float]:
    """Return a corner of a box at ``box[at]``: bits 1, 2 and 4 of `k` choose the greater x, y and z."""
    return (
        box[at + 3 * (k & 1)],
        box[at + 1 + 3 * ((k >> 1) & 1)],
        box[at + 2 + 3 * ((k >> 2) & 1)],
    )


@inlined
def _grown(box: Box, x: float, y: float, z: float) -> Box:
    """Grow a box until a point is in it.

    retail: 09 8
    """
    return (
        min(x, box[0]),
        min(y, box[1]),
        min(z, box[2]),
        max(x, box[3]),
        max(y, box[4]),
        max(z, box[5]),
    )


@kernel
def _box_within(wf: Array, cell: int, a: Array, part: int) -> Box:
    """Return the box about a part's box, in the space of a cell's position at ``wf[cell]``.

    retail: BBox::LocalToLocal 0x005B1E60, 09 8
    """
    x, y, z = load(a, part + REACH_BOX)
    x, y, z = position_localtolocal(wf, cell, a, part, x, y, z)
    box = (x, y, z, x, y, z)
    for k in range(1, _CORNERS):
        x, y, z = _corner(a, part + REACH_BOX, k)
        x, y, z = position_localtolocal(wf, cell, a, part, x, y, z)
        box = _grown(box, x, y, z)
    return box


@kernel
def _box_in_block(home: float, a: Array, part: int) -> Box:
    """Return the box about a part's box, in the block of a cell id.

    retail: BBox::LocalToGlobal 0x005B2120, 09 8
    """
    x, y, z = load(a, part + REACH_BOX)
    x, y, z = position_localtoglobal(home, a, part, x, y, z)
    box = (x, y, z, x, y, z)
    for k in range(1, _CORNERS):
        x, y, z = _corner(a, part + REACH_BOX, k)
        x, y, z = position_localtoglobal(home, a, part, x, y, z)
        box = _grown(box, x, y, z)
    return box


@inlined
def _pick(box: Box, k: int) -> tuple[float, float, float]:
    """Return a corner of a box in registers, as `_corner` chooses it."""
    return (
        box[3] if k & 1 else box[0],
        box[4] if k & 2 else box[1],
        box[5] if k & 4 else box[2],
    )


@kernel
def _side_of(wf: Array, plane: int, box: Box) -> int:
    """Say on which side of a plane all corners of a box are, if they are on one.

    retail: Plane::intersect_box 0x005AA170, 01 6.6
    """
    front, behind = 0, 0
    for k in range(_CORNERS):
        x, y, z = _pick(box, k)
        d = ((z * wf[plane + 2] + y * wf[plane + 1]) + x * wf[plane]) + wf[plane + 3]
        if d > EPS:
            front += 1
        elif d < -EPS:
            behind += 1
    if front == _CORNERS:
        return _POSITIVE
    return _NEGATIVE if behind == _CORNERS else _CROSSING


@kernel
def is_entered(wf: Array, wi: Ints, cell: int, a: Array, part: int) -> bool:
    """Say whether a part's box reaches into an environment cell: no plane has all of it behind.

    retail: BSPNODE::box_intersects_cell_bsp 0x0053C880, 03 8.3
    """
    box = _box_within(wf, position_of(wi, cell), a, part)
    ints = ints_of(wi, cell)
    for i in range(wi[ints + CELL_PLANE_COUNT]):
        if _side_of(wf, wi[ints + CELL_PLANES] + PLANE_SIZE * i, box) == _NEGATIVE:
            return False
    return True


@kernel
def _distance(wf: Array, cell: int, plane: int, a: Array, part: int) -> tuple[float, float]:
    """Return how far a part's sphere is from a portal's plane, and its radius enlarged by EPS.

    `cell`: where the position of the portal's cell lies.

    retail: 09 4.3.2-3
    """
    x, y, z = load(a, part + REACH_SPHERE)
    x, y, z = position_localtolocal(wf, cell, a, part, x, y, z)
    d = ((y * wf[plane + 1] + z * wf[plane + 2]) + x * wf[plane]) + wf[plane + 3]
    return d, f32(a[part + REACH_SPHERE + RADIUS] + EPS)


@kernel
def leaves(wf: Array, cell: int, plane: int, side: int, a: Array, part: int) -> bool:
    """Say whether a part is not all on the inner side of a portal.

    retail: 09 4.3.1-5
    """
    if a[part + REACH_SPHERE + RADIUS] < 0.0:
        return False
    d, rad = _distance(wf, cell, plane, a, part)
    if (d < -rad) if side == _NEGATIVE else (d > rad):
        return False
    return _side_of(wf, plane, _box_within(wf, cell, a, part)) != side


@kernel
def enters(wf: Array, cell: int, plane: int, side: int, a: Array, part: int) -> bool:
    """Say whether a part reaches to the inner side of a portal.

    retail: 09 4.5.1-2
    """
    if a[part + REACH_SPHERE + RADIUS] < 0.0:
        return False
    d, rad = _distance(wf, cell, plane, a, part)
    if (d > rad) if side == _NEGATIVE else (d < -rad):
        return False
    found = _side_of(wf, plane, _box_within(wf, cell, a, part))
    return found in (_CROSSING, side)


@inlined
def _column(x: float) -> int:
    """Return the column, or row, of land cells that a coordinate of a block is in.

    retail: 09 6.5.4
    """
    return math.floor(min(max(x / BLOCK_STEP, -_FAR), _FAR))


@kernel
def columns_under(home: float, a: Array, part: int) -> tuple[int, int, int, int]:
    """Return the first and last column and row of land cells that a part covers.

    retail: 09 6.5.4
    """
    if a[part + REACH_FLAT] != 0.0:
        r = max(a[part + REACH_SPHERE + RADIUS], 0.0)
        x, y = a[part + ORIGIN], a[part + ORIGIN + 1]
        return _column(x - r), _column(y - r), _column(x + r), _column(y + r)
    box = _box_in_block(home, a, part)
    return _column(box[0]), _column(box[1]), _column(box[3]), _column(box[4])
