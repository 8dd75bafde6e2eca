"""Frame (01, 4): a pose's quaternion, its cached float32 matrix, its origin.

A frame lies inside a position record: its quaternion at ``p + QUATERNION``, matrix at ``p + MATRIX``,
origin at ``p + ORIGIN``.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from engine.constants import DEGREE, EPS, EPS5, RADIAN
from engine.kernels.compile import entry, inlined, inlined_entry, kernel
from engine.kernels.indexing import unsigned
from engine.kernels.rounding import f32
from engine.kernels.vector import load, load_four, normalize_check_small, store, store_four
from engine.layout import MATRIX, ORIGIN, QUATERNION

if TYPE_CHECKING:
    from engine.kernels.types import Array, Matrix, Quaternion, Vector


@inlined
def matrix_of(rotation: Quaternion) -> Matrix:
    """Return the float32 matrix of a quaternion.

    retail: Frame::cache 0x00534DF0, 01 4.2
    """
    w, x, y, z = rotation
    x2 = x + x
    y2 = y + y
    z2 = z + z
    wx, wy, wz = w * x2, w * y2, w * z2
    xx, xy, xz = x * x2, x * y2, x * z2
    yy, yz, zz = y * y2, y * z2, z * z2
    return (
        *(f32((1.0 - yy) - zz), f32(xy + wz), f32(xz - wy)),
        *(f32(xy - wz), f32((1.0 - xx) - zz), f32(yz + wx)),
        *(f32(xz + wy), f32(yz - wx), f32((1.0 - xx) - yy)),
    )


@entry
def frame_cache(a: Array, p: int) -> None:
    """Derive the float32 matrix from the quaternion.

    retail: Frame::cache 0x00534DF0, 01 4.2
    """
    m = unsigned(p + MATRIX)
    xx, xy, xz, yx, yy, yz, zx, zy, zz = matrix_of(load_four(a, p + QUATERNION))
    store(a, m, xx, xy, xz)
    store(a, m + 3, yx, yy, yz)
    store(a, m + 6, zx, zy, zz)


@inlined
def normalising(w: float, x: float, y: float, z: float) -> float:
    """Return what makes a quaternion one of unit length.

    retail: Frame::set_rotate 0x00535080, 01 4.4
    """
    return 1.0 / math.sqrt(((w * w + x * x) + y * y) + z * z)


@inlined
def normalised(rotation: Quaternion) -> Quaternion:
    """Return a quaternion of unit length, as float32.

    retail: Frame::set_rotate 0x00535080, 01 4.4
    """
    w, x, y, z = rotation
    inv = normalising(w, x, y, z)
    return f32(w * inv), f32(x * inv), f32(y * inv), f32(z * inv)


@inlined
def is_unit(rotation: Quaternion) -> bool:
    """Say whether nothing of a quaternion is NaN, and it is of unit length within EPS*5.

    retail: Frame::IsValid 0x00534ED0, 01 4.3
    """
    w, x, y, z = rotation
    n = f32(((z * z + y * y) + x * x) + w * w)
    return not (math.isnan(n) or abs(n - 1.0) > EPS5)


@inlined
def _frame_is_valid(a: Array, p: int) -> bool:
    """Say whether nothing is NaN and the quaternion is of unit length within EPS*5.

    retail: Frame::IsValid 0x00534ED0, 01 4.3
    """
    o = unsigned(p + ORIGIN)
    if math.isnan(a[o]) or math.isnan(a[o + 1]) or math.isnan(a[o + 2]):
        return False
    return is_unit(load_four(a, p + QUATERNION))


@inlined_entry
def frame_set_rotate(a: Array, p: int, w: float, x: float, y: float, z: float) -> None:
    """Take a normalised rotation, or keep the old one if the new one is not valid.

    retail: Frame::set_rotate 0x00535080, 01 4.4
    """
    old = load_four(a, p + QUATERNION)
    store_four(a, p + QUATERNION, normalised((w, x, y, z)))
    if _frame_is_valid(a, p):
        frame_cache(a, p)
    else:
        store_four(a, p + QUATERNION, old)


@entry
def frame_localtoglobal(a: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Take a point out of the frame.

    retail: Frame::localtoglobal 0x00452620, 01 4.5
    """
    m, o = unsigned(p + MATRIX), unsigned(p + ORIGIN)
    return (
        f32(((a[m + 6] * z + a[m] * x) + a[m + 3] * y) + a[o]),
        f32(((a[m + 7] * z + a[m + 1] * x) + a[m + 4] * y) + a[o + 1]),
        f32(((a[m + 8] * z + a[m + 2] * x) + a[m + 5] * y) + a[o + 2]),
    )


@entry
def frame_localtoglobalvec(a: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Rotate a vector out of the frame, y term last.

    retail: Frame::localtoglobalvec 0x004524F0, 01 4.5
    """
    m = unsigned(p + MATRIX)
    return (
        f32((a[m + 6] * z + a[m] * x) + a[m + 3] * y),
        f32((a[m + 7] * z + a[m + 1] * x) + a[m + 4] * y),
        f32((a[m + 8] * z + a[m + 2] * x) + a[m + 5] * y),
    )


@entry
def frame_globaltolocal(a: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Take a point into the frame; the z row uses the unrounded difference.

    retail: Frame::globaltolocal 0x00452680, 01 4.6
    """
    m, o = unsigned(p + MATRIX), unsigned(p + ORIGIN)
    dx = f32(x - a[o])
    dy = f32(y - a[o + 1])
    dz = z - a[o + 2]
    dz32 = f32(dz)
    return (
        f32((dz32 * a[m + 2] + dx * a[m]) + dy * a[m + 1]),
        f32((dz32 * a[m + 5] + dx * a[m + 3]) + dy * a[m + 4]),
        f32((dz * a[m + 8] + dx * a[m + 6]) + dy * a[m + 7]),
    )


@entry
def frame_globaltolocalvec(a: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Rotate a vector into the frame, y term last.

    retail: Frame::globaltolocalvec 0x00452550, 01 4.5
    """
    m = unsigned(p + MATRIX)
    return (
        f32((a[m + 2] * z + a[m] * x) + a[m + 1] * y),
        f32((a[m + 5] * z + a[m + 3] * x) + a[m + 4] * y),
        f32((a[m + 8] * z + a[m + 6] * x) + a[m + 7] * y),
    )


@inlined
def rotate_x_last(a: Array, p: int, x: float, y: float, z: float) -> Vector:
    """Rotate a vector out of the frame as retail's inlined code does, x term last.

    retail: PL-2, SD-6
    """
    m = unsigned(p + MATRIX)
    return (
        f32((a[m + 6] * z + a[m + 3] * y) + a[m] * x),
        f32((a[m + 7] * z + a[m + 4] * y) + a[m + 1] * x),
        f32((a[m + 8] * z + a[m + 5] * y) + a[m + 2] * x),
    )


@entry
def frame_is_equal(a: Array, p: int, b: Array, r: int) -> bool:
    """Compare origins (not more than EPS apart per axis) and quaternions (less than EPS).

    retail: Frame::is_equal 0x00424C30, 04 3
    """
    for i in range(3):
        if not abs(a[p + ORIGIN + i] - b[r + ORIGIN + i]) <= EPS:
            return False
    for i in range(4):
        if not abs(a[p + QUATERNION + i] - b[r + QUATERNION + i]) < EPS:
            return False
    return True


@inlined
def interpolated(begin: Quaternion, end: Quaternion, t: float) -> Quaternion:
    """Return the float32 rotation between two, spherically where they differ enough; not normalised.

    retail: Frame::interpolate_rotation 0x00535390, 01 4.8
    """
    fw, fx, fy, fz = begin
    tw, tx, ty, tz = end
    c = ((fy * ty + fw * tw) + fx * tx) + fz * tz
    if c < 0.0:
        c = -c
        tw, tx, ty, tz = -tw, -tx, -ty, -tz
    k0, k1 = _interpolation_weights(c, t)
    return f32(k0 * fw + tw * k1), f32(fx * k0 + tx * k1), f32(fy * k0 + ty * k1), f32(tz * k1 + fz * k0)


@inlined_entry
def frame_interpolate_rotation(a: Array, p: int, b: Array, start: int, end: int, t: float) -> None:
    """Set the rotation between those of two frames.

    retail: Frame::interpolate_rotation 0x00535390, 01 4.8
    """
    w, x, y, z = interpolated(load_four(b, start + QUATERNION), load_four(b, end + QUATERNION), t)
    frame_set_rotate(a, p, w, x, y, z)


@kernel
def _interpolation_weights(c: float, t: float) -> tuple[float, float]:
    """Weigh two unit quaternions whose dot product is `c`.

    retail: Frame::interpolate_rotation 0x00535390, 01 4.8
    """
    if 1.0 - c <= EPS:
        return 1.0 - t, t
    om = math.acos(c)
    s = 1.0 / math.sin(om)
    k0 = s * math.sin(om * (1.0 - t))
    k1 = math.sin(t * om) * s
    if k0 < 0.0 or k0 > 1.0 or k1 < 0.0 or k1 > 1.0:
        return 1.0 - t, t
    return k0, k1


@kernel
def frame_euler_set_rotate(a: Array, p: int, x: float, y: float, z: float) -> None:
    """Set the rotation from angles in radians, order 0.

    retail: Frame::euler_set_rotate 0x00535BF0, 01 4.8
    """
    hx = x * 0.5
    hy = y * 0.5
    hz = f32(z * 0.5)
    cx = f32(math.cos(hx))
    cy = f32(math.cos(hy))
    cz = f32(math.cos(hz))
    sx = f32(math.sin(hx))
    sy = math.sin(hy)
    sz = math.sin(hz)
    cc = f32(cz * cx)
    cs = f32(cx * sz)
    sc = f32(sx * cz)
    ss = f32(sz * sx)
    frame_set_rotate(
        a, p, f32(ss * sy + cc * cy), f32(sc * cy - cs * sy), f32(cc * sy + ss * cy), f32(cs * cy - sc * sy)
    )


@entry
def frame_set_vector_heading(a: Array, p: int, x: float, y: float, z: float) -> None:
    """Turn the frame's y axis to a direction; nothing happens for a vector shorter than EPS.

    retail: Frame::set_vector_heading 0x00535DB0, 01 4.8
    """
    small, nx, ny, nz = normalize_check_small(x, y, z)
    if small:
        return
    yaw = f32(-np.fmod(450.0 - math.atan2(ny, nx) * RADIAN, 360.0) * DEGREE)
    pitch = f32((math.asin(nz) * RADIAN) * DEGREE)
    frame_euler_set_rotate(a, p, pitch, 0.0, yaw)


@entry
def frame_set_heading(a: Array, p: int, degrees: float) -> None:
    """Turn the frame's y axis to a compass heading: 0 is +y, 90 is +x.

    retail: Frame::set_heading 0x00535E40, 01 4.8
    """
    m = unsigned(p + MATRIX)
    r = degrees * DEGREE
    frame_set_vector_heading(
        a, p, f32(math.sin(r)), f32(math.cos(r)), f32((a[m + 8] + a[m + 2]) * 0.0 + a[m + 5])
    )


@kernel
def frame_get_vector_heading(a: Array, p: int) -> Vector:
    """Return the frame's y axis.

    retail: Frame::get_vector_heading 0x00535720, 01 4.8
    """
    x, y, z = load(a, p + MATRIX)
    ux, uy, uz = load(a, p + MATRIX + 6)
    vx, vy, vz = load(a, p + MATRIX + 3)
    return f32((ux + x) * 0.0 + vx), f32((uy + y) * 0.0 + vy), f32((uz + z) * 0.0 + vz)
