"""Plain float64 algebra on points, and the rounding of scene data to float32.

None of this stands in for retail's arithmetic: scenes are input, and what a candidate is given is
rounded once, here, when a scene is made.
"""

from __future__ import annotations

import math
from array import array
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from conformance.scenes.model import Vec3

ORIGIN: Vec3 = (0.0, 0.0, 0.0)


def round_point(point: Iterable[float]) -> Vec3:
    """Round the three coordinates of a point to float32."""
    x, y, z = array("f", point)
    return (x, y, z)


def add(a: Vec3, b: Vec3) -> Vec3:
    """Return ``a + b``."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vec3, b: Vec3) -> Vec3:
    """Return ``a - b``."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(factor: float, a: Vec3) -> Vec3:
    """Return ``factor * a``."""
    return (factor * a[0], factor * a[1], factor * a[2])


def dot(a: Vec3, b: Vec3) -> float:
    """Return ``a . b``."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec3, b: Vec3) -> Vec3:
    """Return ``a x b``."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a: Vec3) -> float:
    """Return ``|a|``."""
    return math.sqrt(dot(a, a))


def cos_sin(degrees: float) -> tuple[float, float]:
    """Return cosine and sine of an angle in degrees, exact at quarter turns.

    A wall turned by 90 degrees stays in its axis plane: no 6e-17 is left to become a vertex.
    """
    quarters, rest = divmod(degrees, 90.0)
    c, s = math.cos(math.radians(rest)), math.sin(math.radians(rest))
    return ((c, s), (-s, c), (-c, -s), (s, -c))[int(quarters) % 4]
