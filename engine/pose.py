"""Poses: given as plain numbers, checked, and kept as rows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from engine import layout as at
from engine.checks import LARGEST_ID, record, whole
from engine.constants import EPS5
from engine.errors import PoseError
from engine.float32 import float32_array
from engine.kernels.frame import frame_cache

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.errors import InputError
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


_CHECK_FIELDS: Final = record(Pose, cell=whole())


def check_pose(value: Any, where: str, _error: type[InputError]) -> None:
    """Check that something is a pose; the error is a `PoseError`, whatever the pose belongs to."""
    _CHECK_FIELDS(value, where, PoseError)


def pose_row(pose: Pose, where: str) -> Array:
    """Return a checked pose as numbers: cell id, quaternion w x y z, origin x y z.

    Raises
    ------
    PoseError
        If it is not finite, or its rotation not of unit length as retail counts it
        (retail: Frame::IsValid 0x00534ED0, 01 4.3).
    """
    check_pose(pose, where, PoseError)
    origin = float32_array(pose.origin, (3,), f"{where}, origin", PoseError)
    quaternion = float32_array(pose.rotation, (4,), f"{where}, rotation", PoseError)
    w, x, y, z = (float(c) for c in quaternion)
    with np.errstate(over="ignore"):
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


def position_rows(poses: Sequence[Pose], where: Sequence[str]) -> Array:
    """Return `position_row` of many poses: (n, `engine.layout.POSITION_SIZE`) numbers.

    They are checked all at once; if anything is wrong, one by one, to say what and where.
    """
    rows = np.zeros((len(poses), at.POSITION_SIZE), dtype=np.float64)
    try:
        rows[:, 0] = [pose.cell for pose in poses]
        rows[:, at.QUATERNION : at.QUATERNION + at.QUATERNION_SIZE] = _stored([p.rotation for p in poses], 4)
        rows[:, at.ORIGIN :] = _stored([p.origin for p in poses], 3)
        valid = _all_valid(rows)
    except (AttributeError, OverflowError, TypeError, ValueError):
        valid = False
    if not valid:
        for pose, name in zip(poses, where, strict=True):
            pose_row(pose, name)
    numbers = rows.ravel()
    for index in range(len(poses)):
        frame_cache(numbers, index * int(at.POSITION_SIZE))
    return rows


def _stored(vectors: Sequence[Sequence[float]], size: int) -> Array:
    """Return vectors rounded to float32; infinite where they are too large for it."""
    values = np.array(vectors, dtype=np.float64).reshape(len(vectors), size)
    with np.errstate(over="ignore"):
        return values.astype(np.float32).astype(np.float64)


def _all_valid(rows: Array) -> bool:
    """Say whether `pose_row` would accept all of these."""
    w, x, y, z = rows[:, at.QUATERNION : at.QUATERNION + at.QUATERNION_SIZE].T
    with np.errstate(over="ignore"):
        length = (((z * z + y * y) + x * x) + w * w).astype(np.float32).astype(np.float64)
    ids = (rows[:, 0] >= 0) & (rows[:, 0] <= LARGEST_ID) & (rows[:, 0] % 1.0 == 0.0)
    return bool(ids.all() and np.isfinite(rows).all() and (np.abs(length - 1.0) <= EPS5).all())
