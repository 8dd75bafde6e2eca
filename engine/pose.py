"""Poses: given as plain numbers, checked, and kept as rows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from engine import layout as at
from engine.constants import EPS5
from engine.errors import PoseError
from engine.float32 import float32_array
from engine.kernels.frame import frame_cache

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.kernels.types import Array


@dataclass(frozen=True, slots=True)
class Pose:
    """A rigid pose in a landblock.

    Attributes
    ----------
    cell : int
        Cell id; its high 16 bits name the landblock.
    origin : sequence of float
        x, y, z in metres, in the landblock's frame.
    rotation : sequence of float
        Quaternion w, x, y, z of unit length; not normalised further.
    """

    cell: int
    origin: Sequence[float] = (0.0, 0.0, 0.0)
    rotation: Sequence[float] = (1.0, 0.0, 0.0, 0.0)


def pose_row(pose: Pose, where: str) -> Array:
    """Return a checked pose as numbers: cell id, quaternion w x y z, origin x y z.

    Raises
    ------
    PoseError
        If it is not finite, or its rotation not of unit length as retail counts it
        (retail: Frame::IsValid 0x00534ED0, 01 4.3).
    """
    if not 0 <= pose.cell <= 0xFFFF_FFFF:
        raise PoseError(where, f"cell id {pose.cell} is not a 32-bit number")
    origin = float32_array(pose.origin, (3,), f"{where}, origin", PoseError)
    quaternion = float32_array(pose.rotation, (4,), f"{where}, rotation", PoseError)
    w, x, y, z = (float(c) for c in quaternion)
    length = float(np.float32(((z * z + y * y) + x * x) + w * w))
    if abs(length - 1.0) > EPS5:
        raise PoseError(f"{where}, rotation", f"squared length {length} is not 1 within {EPS5:.4g}")
    return np.concatenate(([float(pose.cell)], quaternion, origin))


def position_row(pose: Pose, where: str) -> Array:
    """Return a checked pose with its matrix, as kernels read it (`engine.layout.POSITION_SIZE` numbers)."""
    row = pose_row(pose, where)
    position = np.zeros(at.POSITION_SIZE, dtype=np.float64)
    position[0] = row[0]
    position[at.QUATERNION : at.QUATERNION + at.QUATERNION_SIZE] = row[1:5]
    position[at.ORIGIN :] = row[5:]
    frame_cache(position, 0)
    return position
