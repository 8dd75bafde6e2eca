"""Rigid motions in a landblock's frame, of everything that has a place or a direction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from conformance.floats import to_float32
from conformance.scenes.algebra import ORIGIN, add, dot, round_point
from conformance.scenes.model import Pose
from conformance.scenes.rotations import multiply, rotate, round_quaternion, rows_from_quaternion

if TYPE_CHECKING:
    from conformance.scenes.model import PlaneData, Quaternion, Vec3


@dataclass(frozen=True, slots=True)
class Transform:
    """A rigid motion in a landblock's frame: turn about its origin, then move.

    Attributes
    ----------
    rotation : Quaternion
        ``w, x, y, z``, float32.
    translation : Vec3
        Metres, float32.
    """

    rotation: Quaternion
    translation: Vec3

    @property
    def label(self) -> str:
        """Write the motion for messages, as numbers that make it again."""
        rotation = ", ".join(f"{part:.9g}" for part in self.rotation)
        translation = ", ".join(f"{part:.9g}" for part in self.translation)
        return f"turned [{rotation}] moved [{translation}]"


IDENTITY: Final = Transform((1.0, 0.0, 0.0, 0.0), ORIGIN)


def move_direction(transform: Transform, direction: Vec3) -> Vec3:
    """Turn a direction; float32."""
    return round_point(rotate(rows_from_quaternion(transform.rotation), direction))


def move_point(transform: Transform, point: Vec3) -> Vec3:
    """Turn and move a point, metres; rounded to float32 once."""
    turned = rotate(rows_from_quaternion(transform.rotation), point)
    return round_point(add(turned, transform.translation))


def move_plane(transform: Transform, plane: PlaneData) -> PlaneData:
    """Turn and move a plane; its offset belongs to the normal as rounded to float32."""
    nx, ny, nz, d = plane
    x, y, z = move_direction(transform, (nx, ny, nz))
    return (x, y, z, to_float32(d - dot((x, y, z), transform.translation)))


def move_rotation(transform: Transform, rotation: Quaternion) -> Quaternion:
    """Turn what already has a rotation; normalised, float32."""
    return round_quaternion(multiply(transform.rotation, rotation))


def move_pose(transform: Transform, pose: Pose) -> Pose:
    """Turn and move a pose; it keeps its cell."""
    return Pose(pose.cell, move_point(transform, pose.origin), move_rotation(transform, pose.rotation))
