"""Several edges of a polygon at a time: which of them is a point outside of, and how far.

Where a sphere reaches a polygon's plane, its centre is outside of none of the edges, or of any: nobody
foresees at which one a walk around them ends. So `SIDES` edges are computed side by side, each with the
operations, and in the order, of PP-2: each has the bits that it would have alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from numba import types
from numba.extending import intrinsic

from engine.kernels.compile import inlined_entry
from engine.kernels.lanes import bits, loaded, spread
from engine.layout import SIDES

if TYPE_CHECKING:
    from engine.kernels.types import Array

_WIDTH: Final = int(SIDES)


def _outside(_typing: Any, wf: Any, _at: Any, _x: Any, _y: Any, _z: Any, _far: Any) -> Any:
    """Generate the comparisons; NaN is inside (PP-3), and not far."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        x, y, z, nx, ny, nz, squared = (
            loaded(context, builder, signature, arguments, k, _WIDTH) for k in range(7)
        )
        px, py, pz, far = (spread(builder, number, _WIDTH) for number in arguments[2:])
        sx, sy, sz = builder.fsub(px, x), builder.fsub(py, y), builder.fsub(pz, z)
        side = builder.fadd(builder.fmul(sz, nz), builder.fmul(sy, ny))
        side = builder.fadd(side, builder.fmul(sx, nx))
        outside = builder.fcmp_ordered("<", side, side.type([0.0] * _WIDTH))
        beyond = builder.fcmp_ordered(">", builder.fmul(side, side), builder.fmul(squared, far))
        away = bits(builder, builder.and_(outside, beyond), _WIDTH)
        return builder.or_(bits(builder, outside, _WIDTH), builder.shl(away, away.type(_WIDTH)))

    number = types.float64
    return types.int64(wf, types.int64, number, number, number, number), generate


_outside_sides: Final[Any] = intrinsic(_outside)


@inlined_entry
def sides_outside(wf: Array, at: int, x: float, y: float, z: float, far: float) -> int:
    """Return a bit for each edge of the block at `at` that a point is outside of, as PP-3 tells.

    And `SIDES` places above it another, if the square of its distance from the edge is more than `far`.

    retail: PP-2, PP-3
    """
    mask: int = _outside_sides(wf, at, x, y, z, far)
    return mask
