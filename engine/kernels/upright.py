"""Movers that stand upright: turned about the z axis only, with their spheres on it, as nearly all are.

Half of what retail computes of them is products with 0, which it adds. Here those are left out; what is
returned has the bits that it would have with them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import EPS
from engine.kernels.compile import inlined
from engine.kernels.frame import normalising
from engine.kernels.rounding import f32
from engine.kernels.vector import load, load_four
from engine.layout import Q_END, Q_NUM_SPHERE, Q_SPHERES, Q_START, QUATERNION, SPHERE_SIZE

if TYPE_CHECKING:
    from engine.kernels.types import Array, Quaternion, Vector


@inlined
def is_upright(q: Array) -> bool:
    """Say whether a query is about an upright mover, at its begin and at its end, that hardly turns.

    Where both rotations are that near, Frame::interpolate_rotation goes straight from one to the other.
    """
    bw, bx, by, bz = load_four(q, Q_START + QUATERNION)
    ew, ex, ey, ez = load_four(q, Q_END + QUATERNION)
    x, y, _ = load(q, Q_SPHERES)
    ux, uy, _ = load(q, Q_SPHERES + SPHERE_SIZE)
    return (
        (bx == 0.0 and by == 0.0 and ex == 0.0 and ey == 0.0)
        and (x == 0.0 and y == 0.0)
        and ((ux == 0.0 and uy == 0.0) or q[Q_NUM_SPHERE] < 2.0)
        and 1.0 - (bw * ew + bz * ez) <= EPS
    )


@inlined
def held_upright(begin: Quaternion, end: Quaternion) -> Quaternion:
    """Return the rotation of such a mover at the end of its way, normalised.

    The begin's has no weight there, and the end's all; but it decides the sign of a zero. One of x or y
    keeps its sign: it is divided by what is positive.

    retail: Frame::interpolate_rotation 0x00535390, 01 4.8; Frame::set_rotate 0x00535080, 01 4.4
    """
    fw, fx, fy, fz = begin
    tw, tx, ty, tz = end
    w, z = f32(0.0 * fw + tw), f32(tz + fz * 0.0)
    inv = normalising(w, 0.0, 0.0, z)
    return f32(w * inv), fx * 0.0 + tx, fy * 0.0 + ty, f32(z * inv)


@inlined
def is_off_zero(place: Vector) -> bool:
    """Say whether no coordinate of a place is 0, whose sign the products with 0 would decide."""
    return place[0] != 0.0 and place[1] != 0.0 and place[2] != 0.0


@inlined
def placed_upright(place: Vector, z: float) -> Vector:
    """Return the centre of a sphere that is so high on the axis of an upright mover at a place off zero.

    retail: SPHEREPATH::cache_global_sphere 0x0050C810, 04 4, form B
    """
    return place[0], place[1], f32(z + place[2])
