"""Frame (01, 4): what a tick does to a frame, and headings of vectors."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from engine.constants import EPS2, RADIAN
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.frame import frame_localtoglobal, frame_set_rotate
from engine.kernels.rounding import f32
from engine.kernels.vector import copy, normalize_check_small, store
from engine.layout import ORIGIN, POSITION_SIZE, QUATERNION

if TYPE_CHECKING:
    from engine.kernels.types import Array


@kernel
def frame_combine_identity(a: Array, to: int, p: int) -> None:
    """Become an identity frame, expressed in another frame: only the rotation is normalised anew.

    An invalid rotation leaves the one that the frame has.

    retail: Frame::combine 0x005122E0, UPI-4
    """
    x, y, z = frame_localtoglobal(a, p, 0.0, 0.0, 0.0)
    q = p + QUATERNION
    qw, qx, qy, qz = a[q], a[q + 1], a[q + 2], a[q + 3]
    store(a, to + ORIGIN, x, y, z)
    frame_set_rotate(
        a,
        to,
        f32(((qw - qx * 0.0) - 0.0 * qy) - 0.0 * qz),
        f32(((qw * 0.0 + 0.0 * qy) + qx) - 0.0 * qz),
        f32(((0.0 * qw - qx * 0.0) + qz * 0.0) + qy),
        f32(((qx * 0.0 + 0.0 * qw) - qy * 0.0) + qz),
    )


@entry
def frame_grotate(a: Array, p: int, x: float, y: float, z: float) -> None:
    """Turn about a global axis through the origin, by the vector's length in radians.

    retail: Frame::grotate 0x005357A0, 06 5
    """
    m = (x * x + y * y) + z * z
    if m < EPS2:
        return
    th = math.sqrt(m)
    inv = f32(1.0 / th)
    h = th * 0.5
    s = math.sin(h)
    c = f32(math.cos(h))
    f = f32((s * x) * inv)
    g = f32((inv * s) * y)
    e = (s * inv) * z
    q = p + QUATERNION
    qw, qx, qy, qz = a[q], a[q + 1], a[q + 2], a[q + 3]
    frame_set_rotate(
        a,
        p,
        f32(((c * qw - f * qx) - g * qy) - e * qz),
        f32(((c * qx + g * qz) + f * qw) - e * qy),
        f32(((c * qy - f * qz) + e * qx) + g * qw),
        f32(((f * qy + c * qz) - g * qx) + e * qw),
    )


@inlined
def set_frame(a: Array, to: int, b: Array, p: int) -> None:
    """Take a frame. A quaternion that is not a number becomes zero; the matrix stays.

    retail: CPhysicsObj::set_frame, WB-4
    """
    copy(a, to + 1, b, p + 1, POSITION_SIZE - 1)
    q, o = to + QUATERNION, to + ORIGIN
    turned = math.isnan(a[q]) or math.isnan(a[q + 1]) or math.isnan(a[q + 2]) or math.isnan(a[q + 3])
    if turned and not (math.isnan(a[o]) or math.isnan(a[o + 1]) or math.isnan(a[o + 2])):
        a[q] = 0.0
        store(a, q + 1, 0.0, 0.0, 0.0)


@kernel
def vector_heading(x: float, y: float) -> float:
    """Return the compass heading of a horizontal vector in a register, degrees; 0 if it is too short.

    retail: AC1Legacy::Vector3::get_heading 0x004575D0, 01 4.8
    """
    small, nx, ny, _ = normalize_check_small(x, y, 0.0)
    if small:
        return 0.0
    return np.fmod(450.0 - math.atan2(ny, nx) * RADIAN, 360.0)
