"""Checks of the numbers that primitives are given."""

from __future__ import annotations

import math
from collections.abc import Sequence

from conformance.scenes.errors import SceneError


def finite(value: float, path: str) -> float:
    """Return `value`, which must be a finite number."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise SceneError(path, repr(value), "a finite number")
    return float(value)


def positive(value: float, path: str) -> float:
    """Return `value`, which must be finite and greater than zero."""
    if finite(value, path) <= 0.0:
        raise SceneError(path, repr(value), "a number greater than 0")
    return float(value)


def not_negative(value: float, path: str) -> float:
    """Return `value`, which must be finite and at least zero."""
    if finite(value, path) < 0.0:
        raise SceneError(path, repr(value), "a number of at least 0")
    return float(value)


def count(value: int, path: str, at_least: int) -> int:
    """Return `value`, which must be a whole number of at least `at_least`."""
    if isinstance(value, bool) or not isinstance(value, int) or value < at_least:
        raise SceneError(path, repr(value), f"a whole number of at least {at_least}")
    return value


def pair(values: Sequence[float], path: str) -> tuple[float, float]:
    """Return two finite numbers."""
    x, y = _numbers(values, 2, path)
    return (x, y)


def point(values: Sequence[float], path: str) -> tuple[float, float, float]:
    """Return three finite numbers."""
    x, y, z = _numbers(values, 3, path)
    return (x, y, z)


def whole_pair(values: Sequence[int], path: str) -> tuple[int, int]:
    """Return two whole numbers of at least 1."""
    if not isinstance(values, Sequence) or len(values) != 2:
        raise SceneError(path, repr(values), "2 whole numbers")
    return (count(values[0], f"{path}[0]", 1), count(values[1], f"{path}[1]", 1))


def sizes(values: Sequence[float], dimensions: int, path: str) -> tuple[float, ...]:
    """Return `dimensions` numbers greater than zero."""
    numbers = _numbers(values, dimensions, path)
    return tuple(positive(value, f"{path}[{i}]") for i, value in enumerate(numbers))


def _numbers(values: Sequence[float], dimensions: int, path: str) -> tuple[float, ...]:
    if not isinstance(values, Sequence) or len(values) != dimensions:
        raise SceneError(path, repr(values), f"{dimensions} numbers")
    return tuple(finite(value, f"{path}[{i}]") for i, value in enumerate(values))
