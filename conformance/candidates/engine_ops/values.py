"""The blocks of a query's inputs as the engine's numbers, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from engine import layout as at
from engine.kernels.frame import frame_cache

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from engine.kernels.types import Array, Vector


def position(pose: Mapping[str, Any]) -> Array:
    """Return a position record of a POSE block: the rotation as it is, and its matrix."""
    row = frame(pose["rotation"], pose["origin"])
    row[0] = pose["cell"]
    return row


def frame(rotation: Sequence[float], origin: Sequence[float] = (0.0, 0.0, 0.0)) -> Array:
    """Return a position record of cell 0: the rotation as it is, and its matrix."""
    row = np.zeros(at.POSITION_SIZE, dtype=np.float64)
    row[at.QUATERNION : at.QUATERNION + at.QUATERNION_SIZE] = rotation
    row[at.ORIGIN :] = origin
    frame_cache(row, 0)
    return row


def vector(values: Sequence[float]) -> Vector:
    """Return x, y, z as floats: a kernel given integers would be compiled for them anew."""
    x, y, z = values
    return float(x), float(y), float(z)


def ball(values: Sequence[float]) -> tuple[float, float, float, float]:
    """Return a sphere's x, y, z and radius as floats."""
    x, y, z, r = values
    return float(x), float(y), float(z), float(r)


def numbers(values: Sequence[float]) -> Array:
    """Return consecutive numbers as an array."""
    return np.array(values, dtype=np.float64)


def floats(values: Array | Sequence[float]) -> list[float]:
    """Return numbers as plain floats."""
    return [float(v) for v in values]


def pose_block(pose: Array) -> dict[str, Any]:
    """Write a POSE block of a pose row: cell id, quaternion, origin."""
    return {"cell": int(pose[0]), "origin": floats(pose[5:8]), "rotation": floats(pose[1:5])}


def point_or_null(x: float, y: float, z: float, *, valid: bool) -> list[float] | None:
    """Write a point that may not have been computed."""
    return [x, y, z] if valid else None
