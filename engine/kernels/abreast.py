"""Several planes at a time: which of them a sphere reaches, and which can be walked on.

The machine computes `ABREAST` planes side by side, each with the operations, and in the order, of
`engine.kernels.polygon.plane_distance`: each has the bits that it would have alone. The planes lie in
blocks: `ABREAST` x components, then as many y, z and d.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from engine.kernels.compile import inlined, inlined_entry
from engine.kernels.lanes import bits, loaded, spread
from engine.layout import ABREAST, PLANE_SIZE

if TYPE_CHECKING:
    from engine.kernels.types import Array

_WIDTH: Final = int(ABREAST)


def _block(context: Any, builder: Any, signature: Any, arguments: Any) -> list[Any]:
    """Generate the loads of a block: x, y, z and d of all planes."""
    return [loaded(context, builder, signature, arguments, k, _WIDTH) for k in range(int(PLANE_SIZE))]


def _dot(builder: Any, planes: list[Any], arguments: Any) -> Any:
    """Generate the dot product of the normals and a vector, x term last.

    retail: 01 1.2
    """
    x, y, z = (spread(builder, number, _WIDTH) for number in arguments[2:5])
    rest = builder.fadd(builder.fmul(planes[1], y), builder.fmul(planes[2], z))
    return builder.fadd(builder.fmul(planes[0], x), rest)


def _reached(_typing: Any, wf: Any, _at: Any, _x: Any, _y: Any, _z: Any, _reach: Any) -> Any:
    """Generate the comparison of distances with a reach; NaN is reached (SS-1)."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        planes = _block(context, builder, signature, arguments)
        dist, reach = builder.fadd(_dot(builder, planes, arguments), planes[3]), arguments[5]
        above = builder.fcmp_unordered("<=", dist, spread(builder, reach, _WIDTH))
        below = builder.fcmp_unordered(">=", dist, spread(builder, builder.fneg(reach), _WIDTH))
        return bits(builder, builder.and_(above, below), _WIDTH)

    number = types.float64
    return types.int64(wf, types.int64, number, number, number, number), generate


def _flat(_typing: Any, wf: Any, _at: Any, _x: Any, _y: Any, _z: Any, _least: Any) -> Any:
    """Generate the comparison of components along the normals with a least one; NaN is not (WH-1)."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        planes = _block(context, builder, signature, arguments)
        along = _dot(builder, planes, arguments)
        return bits(builder, builder.fcmp_ordered(">", along, spread(builder, arguments[5], _WIDTH)), _WIDTH)

    number = types.float64
    return types.int64(wf, types.int64, number, number, number, number), generate


def _trailing(_typing: Any, _mask: Any) -> Any:
    """Generate LLVM's count of the zeros below the lowest bit."""

    def generate(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        return builder.cttz(arguments[0], ir.IntType(1)(1))

    return types.int64(types.int64), generate


_reached_planes: Final[Any] = intrinsic(_reached)
_flat_planes: Final[Any] = intrinsic(_flat)
_trailing_zeros: Final[Any] = intrinsic(_trailing)


@inlined_entry
def near_planes(wf: Array, at: int, count: int, x: float, y: float, z: float, reach: float) -> int:
    """Return a bit for each of the first `count` planes of the block at `at` that a sphere reaches.

    retail: PH-1, SS-1
    """
    mask: int = _reached_planes(wf, at, x, y, z, reach)
    return mask & ((1 << min(count, ABREAST)) - 1)


@inlined_entry
def flat_planes(wf: Array, at: int, ux: float, uy: float, uz: float, least: float) -> int:
    """Return a bit for each plane of the block at `at` that can be walked on.

    retail: WH-1
    """
    mask: int = _flat_planes(wf, at, ux, uy, uz, least)
    return mask


@inlined_entry
def lowest(mask: int) -> int:
    """Return the number of the lowest bit of a mask that is not 0."""
    bit: int = _trailing_zeros(mask)
    return bit


@inlined
def above(bit: int) -> int:
    """Return the mask of all bits above one."""
    return -(2 << bit)
