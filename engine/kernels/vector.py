"""AC1Legacy::Vector3 (01, 2) and the usual order of a dot product (01, 1.2)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import EPS
from engine.kernels.compile import entry, inlined
from engine.kernels.indexing import unsigned
from engine.kernels.rounding import f32
from engine.layout import MATRIX, ORIGIN, QUATERNION

if TYPE_CHECKING:
    from engine.kernels.types import Array, Quaternion, Sphere, Vector


@inlined
def dot_x(ax: float, ay: float, az: float, bx: float, by: float, bz: float) -> float:
    """Dot product in a register, x term added last.

    retail: 01 1.2
    """
    return (ay * by + az * bz) + ax * bx


@entry
def normalize_check_small(x: float, y: float, z: float) -> tuple[bool, float, float, float]:
    """Normalise a vector unless it is shorter than EPS; say whether it was.

    retail: AC1Legacy::Vector3::normalize_check_small 0x00452460, 01 2.3
    """
    m = math.sqrt((x * x + y * y) + z * z)
    if m < EPS:
        return True, x, y, z
    inv = 1.0 / m
    return False, f32(inv * x), f32(inv * y), f32(inv * z)


@inlined
def centre(sphere: Sphere) -> Vector:
    """Return where a sphere is."""
    x, y, z, _ = sphere
    return x, y, z


@inlined
def load(a: Array, at: int) -> Vector:
    """Read three consecutive numbers."""
    i = unsigned(at)
    return a[i], a[i + 1], a[i + 2]


@inlined
def store(a: Array, at: int, x: float, y: float, z: float) -> None:
    """Write three consecutive numbers, already rounded."""
    i = unsigned(at)
    a[i] = x
    a[i + 1] = y
    a[i + 2] = z


@inlined
def load_four(a: Array, at: int) -> Quaternion:
    """Read a quaternion, a plane, or a sphere."""
    i = unsigned(at)
    return a[i], a[i + 1], a[i + 2], a[i + 3]


@inlined
def store_four(a: Array, at: int, four: Quaternion) -> None:
    """Write a quaternion, a plane, or a sphere."""
    a[unsigned(at)] = four[0]
    store(a, at + 1, four[1], four[2], four[3])


@inlined
def copy_vector(a: Array, at: int, b: Array, source: int) -> None:
    """Copy three consecutive numbers: a struct assignment."""
    x, y, z = load(b, source)
    store(a, at, x, y, z)


@inlined
def copy_four(a: Array, at: int, b: Array, source: int) -> None:
    """Copy a quaternion, a plane, or a sphere: a struct assignment."""
    store_four(a, at, load_four(b, source))


@inlined
def copy_position(a: Array, at: int, b: Array, source: int) -> None:
    """Copy a position: a struct assignment.

    Number by number, because its parts were written so a moment ago: a block that is read before all of
    its parts have reached the cache has to wait for them.
    """
    cell = b[unsigned(source)]
    w = b[unsigned(source + QUATERNION)]
    qx, qy, qz = load(b, source + QUATERNION + 1)
    xx, xy, xz = load(b, source + MATRIX)
    yx, yy, yz = load(b, source + MATRIX + 3)
    zx, zy, zz = load(b, source + MATRIX + 6)
    ox, oy, oz = load(b, source + ORIGIN)
    a[unsigned(at)] = cell
    a[unsigned(at + QUATERNION)] = w
    store(a, at + QUATERNION + 1, qx, qy, qz)
    store(a, at + MATRIX, xx, xy, xz)
    store(a, at + MATRIX + 3, yx, yy, yz)
    store(a, at + MATRIX + 6, zx, zy, zz)
    store(a, at + ORIGIN, ox, oy, oz)


@inlined
def copy_place(a: Array, at: int, b: Array, source: int) -> None:
    """Copy all of a position but its matrix, for whom nobody asks for that."""
    a[unsigned(at)] = b[unsigned(source)]
    copy_four(a, at + QUATERNION, b, source + QUATERNION)
    copy_vector(a, at + ORIGIN, b, source + ORIGIN)


@inlined
def copy(a: Array, at: int, b: Array, source: int, size: int) -> None:
    """Copy a block of `size` consecutive numbers."""
    for i in range(size):
        a[at + i] = b[source + i]
