"""The blocks of a query's inputs as the oracle's values, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from oracle.arithmetic import f32
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.position import Position
from oracle.ray import Ray
from oracle.ref import Ref
from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


def vector(values: Sequence[float]) -> Vector3:
    """Make a vector of x, y, z."""
    x, y, z = values
    return Vector3(f32(x), f32(y), f32(z))


def sphere(values: Sequence[float]) -> Sphere:
    """Make a sphere of x, y, z, radius."""
    return Sphere(vector(values[:3]), f32(values[3]))


def plane(values: Sequence[float]) -> Plane:
    """Make a plane of nx, ny, nz, d."""
    return Plane(vector(values[:3]), f32(values[3]))


def frame(rotation: Sequence[float], origin: Sequence[float] = (0.0, 0.0, 0.0)) -> Frame:
    """Make a frame of w, x, y, z as they are, and of an origin."""
    w, x, y, z = rotation
    return Frame.unpack(vector(origin), f32(w), f32(x), f32(y), f32(z))


def position(pose: Mapping[str, Any]) -> Position:
    """Make a position of a POSE block."""
    return Position(int(pose["cell"]), frame(pose["rotation"], pose["origin"]))


def ray_of(inputs: Mapping[str, Any]) -> Ray:
    """Make the ray of a query's `point` and `direction`."""
    return Ray(vector(inputs["point"]), vector(inputs["direction"]))


def untouched() -> Ref[Any]:
    """Make an output that may be left alone, which is then null."""
    return Ref(None)


def xyz(v: Vector3) -> list[float]:
    """Return a vector's components."""
    return [v.x, v.y, v.z]


def nxyzd(p: Plane) -> list[float]:
    """Return a plane's normal and constant."""
    return [*xyz(p.N), p.d]


def matrix(f: Frame) -> list[float]:
    """Return m0 … m8."""
    return [f.m0, f.m1, f.m2, f.m3, f.m4, f.m5, f.m6, f.m7, f.m8]


def quaternion(f: Frame) -> list[float]:
    """Return w, x, y, z."""
    return [f.qw, f.qx, f.qy, f.qz]


def point_or_null(point: Ref[Vector3 | None]) -> list[float] | None:
    """Return an output point, which may not have been written."""
    return None if point.value is None else xyz(point.value)
