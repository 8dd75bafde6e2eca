"""Position (01, 5): a frame in the coordinates of its cell's landblock."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import BLOCK_STEP
from engine.kernels.compile import entry, inlined, inlined_entry
from engine.kernels.frame import frame_globaltolocal
from engine.kernels.indexing import unsigned
from engine.kernels.rounding import f32
from engine.kernels.vector import load
from engine.layout import MATRIX, ORIGIN

if TYPE_CHECKING:
    from engine.kernels.types import Array, Vector


@inlined
def _block_coordinates(cell: float) -> tuple[int, int]:
    """Return eight times the block bytes of a cell id.

    retail: LandDefs::get_block_offset 0x0043E630, 01 5.1
    """
    block = int(cell) >> 16
    return (block >> 8) * 8, (block & 0xFF) * 8


@entry
def block_offset(cell_from: float, cell_to: float) -> tuple[float, float]:
    """Return the origin of one cell's block in another's: x and y in metres; z is always 0.

    A cell id of 0 counts as block (0, 0).

    retail: LandDefs::get_block_offset 0x0043E630, 01 5.1
    """
    if cell_from == cell_to or int(cell_from) >> 16 == int(cell_to) >> 16:
        return 0.0, 0.0
    fx, fy = _block_coordinates(cell_from)
    tx, ty = _block_coordinates(cell_to)
    return f32((tx - fx) * BLOCK_STEP), f32((ty - fy) * BLOCK_STEP)


@inlined
def _out_of_frame(a: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Take a point out of a position's frame, z term last.

    retail: Position::localtoglobal 0x00456180, 01 5.3 step 1
    """
    m, o = unsigned(p + MATRIX), unsigned(p + ORIGIN)
    return (
        f32(((a[m + 3] * y + a[m] * x) + a[m + 6] * z) + a[o]),
        f32(((a[m + 4] * y + a[m + 1] * x) + a[m + 7] * z) + a[o + 1]),
        f32(((a[m + 5] * y + a[m + 2] * x) + a[m + 8] * z) + a[o + 2]),
    )


@entry
def position_localtoglobal(cell: float, a: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Take a point, local to a position, into the block coordinates of a cell.

    retail: Position::localtoglobal 0x00456180, 01 5.3
    """
    gx, gy, gz = _out_of_frame(a, p, x, y, z)
    bx, by = block_offset(cell, a[p])
    return f32(bx + gx), f32(by + gy), f32(0.0 + gz)


@entry
def position_localtoglobalvec(a: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Rotate a vector out of a position, z term last.

    retail: Position::localtoglobalvec 0x00456220, 01 5.4
    """
    m = unsigned(p + MATRIX)
    return (
        f32((a[m + 3] * y + a[m] * x) + a[m + 6] * z),
        f32((a[m + 4] * y + a[m + 1] * x) + a[m + 7] * z),
        f32((a[m + 5] * y + a[m + 2] * x) + a[m + 8] * z),
    )


@entry
def position_globaltolocalvec(a: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Rotate a vector into a position, z term last.

    retail: Position::globaltolocalvec 0x0050C420, 01 5.5
    """
    m = unsigned(p + MATRIX)
    return (
        f32((a[m + 1] * y + a[m] * x) + a[m + 2] * z),
        f32((a[m + 4] * y + a[m + 3] * x) + a[m + 5] * z),
        f32((a[m + 7] * y + a[m + 6] * x) + a[m + 8] * z),
    )


@inlined_entry
def position_localtolocal(b: Array, to: int, a: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Take a point from one position's space to another's.

    retail: Position::localtolocal 0x004527F0, 01 5.6
    """
    bx, by = block_offset(b[to], a[p])
    gx, gy, gz = _out_of_frame(a, p, x, y, z)
    return frame_globaltolocal(b, to, f32(bx + gx), f32(by + gy), f32(0.0 + gz))


@inlined
def offset_between(home: float, begin: Vector, other: float, end: Vector) -> Vector:
    """Return the way from one place to another, in the first one's block: of what cells both are told.

    retail: Position::get_offset 0x00509F60, 01 5.8
    """
    bx, by = block_offset(home, other)
    return (
        f32((bx + end[0]) - begin[0]),
        f32(f32(by + end[1]) - begin[1]),
        f32(f32(0.0 + end[2]) - begin[2]),
    )


@inlined_entry
def position_get_offset(a: Array, p: int, b: Array, r: int) -> Vector:
    """Return the way from one position's origin to another's, in the first one's block.

    retail: Position::get_offset 0x00509F60, 01 5.8
    """
    return offset_between(a[p], load(a, p + ORIGIN), b[r], load(b, r + ORIGIN))
