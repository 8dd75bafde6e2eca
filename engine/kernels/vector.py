"""AC1Legacy::Vector3 (01, 2) and the usual order of a dot product (01, 1.2)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from engine.constants import EPS
from engine.kernels.compile import entry, inlined
from engine.kernels.rounding import f32

if TYPE_CHECKING:
    from engine.kernels.types import Array, Vector


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
def load(a: Array, at: int) -> Vector:
    """Read three consecutive numbers."""
    return a[at], a[at + 1], a[at + 2]


@inlined
def store(a: Array, at: int, x: float, y: float, z: float) -> None:
    """Write three consecutive numbers, already rounded."""
    a[at] = x
    a[at + 1] = y
    a[at + 2] = z


@inlined
def copy(a: Array, at: int, b: Array, source: int, size: int) -> None:
    """Copy `size` consecutive numbers: a struct assignment."""
    for i in range(size):
        a[at + i] = b[source + i]
