"""Plane (01, 6): a normal and a constant, N . p + d = 0."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.constants import EPS
from engine.kernels.compile import entry
from engine.kernels.frame import rotate_x_last
from engine.kernels.position import position_localtoglobal
from engine.kernels.rounding import f32

if TYPE_CHECKING:
    from engine.kernels.types import Array


@entry
def snap_to_plane(w: Array, at: int, x: float, y: float, z: float) -> float:
    """Return the z that puts an offset on a plane through the origin, or z if the plane is vertical.

    retail: Plane::snap_to_plane 0x00509C50, 01 6.4
    """
    nx, ny, nz, d = w[at], w[at + 1], w[at + 2], w[at + 3]
    if abs(nz) > EPS:
        side = ((y * ny + x * nx) + nz * 0.0) + d
        return f32((-side) * (1.0 / nz) - (1.0 / nz) * (-d))
    return z


@entry
def plane_localtoglobal(
    cell: float, a: Array, p: int, w: Array, at: int
) -> tuple[float, float, float, float]:
    """Take a plane, local to a position, into the block coordinates of a cell.

    The plane's point is the foot of the perpendicular from the local origin; nothing is renormalised.

    retail: Plane::localtoglobal 0x005AA0A0, PL-1...PL-4
    """
    nd = -w[at + 3]
    px, py, pz = f32(nd * w[at]), f32(nd * w[at + 1]), f32(nd * w[at + 2])
    nx, ny, nz = rotate_x_last(a, p, w[at], w[at + 1], w[at + 2])
    gx, gy, gz = position_localtoglobal(cell, a, p, px, py, pz)
    return nx, ny, nz, f32(-((nz * gz + ny * gy) + nx * gx))
