"""Checks of coordinates, planes and spheres."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from conformance.scenes.algebra import length
from conformance.scenes.errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from conformance.scenes.model import PlaneData, SphereData

LARGEST: Final = 1e6
"""A coordinate beyond this, metres, is a mistake: the whole map is 49 km wide."""
UNIT_NORMAL: Final = 1e-4
"""How far the length of a plane's normal may be off 1: numbers written with five digits pass."""


def show(numbers: Sequence[float]) -> str:
    """Write numbers as ``(1, 0.5, -2)``, to float32's nine digits."""
    return f"({', '.join(f'{number:.9g}' for number in numbers)})"


def number_errors(numbers: Sequence[float], path: str) -> Iterator[SceneError]:
    """Yield an error for numbers that are not finite or beyond any landblock."""
    if not all(abs(number) <= LARGEST for number in numbers):
        yield SceneError(path, show(numbers), f"finite numbers up to {LARGEST:g}")


def plane_errors(plane: PlaneData, path: str) -> Iterator[SceneError]:
    """Yield what is wrong with a plane ``nx, ny, nz, d``."""
    if not all(math.isfinite(number) for number in plane):
        yield SceneError(path, show(plane), "finite numbers")
    elif abs(length(plane[:3]) - 1.0) > UNIT_NORMAL:
        yield SceneError(path, f"a normal of length {length(plane[:3]):.9g}", f"1 within {UNIT_NORMAL:g}")


def sphere_errors(sphere: SphereData, path: str) -> Iterator[SceneError]:
    """Yield what is wrong with a sphere ``x, y, z, radius``; a radius of 0 is allowed."""
    if not all(math.isfinite(number) for number in sphere):
        yield SceneError(path, show(sphere), "finite numbers")
    elif sphere[3] < 0.0:
        yield SceneError(path, f"radius {sphere[3]:.9g}", "a radius of at least 0")
