"""Plane: a unit normal and a constant."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.enums import Sidedness
from oracle.vector import Vector3, dot_x

if TYPE_CHECKING:
    from oracle.bbox import BBox
    from oracle.position import Position
    from oracle.ray import Ray
    from oracle.ref import Ref

_BOX_CORNERS: Final = ("hhh", "hll", "lhl", "llh", "hhl", "hlh", "lhh")
"""The order in which intersect_box looks at the corners after the lowest (01 6.6)."""


class Plane:
    """The points p with N . p + d = 0, metres; the positive side is the front.

    A plane owns its normal: pass a copy if the vector lives on.
    """

    __slots__ = ("N", "d")

    def __init__(self, N: Vector3, d: float) -> None:
        self.N = N
        self.d = d

    def __repr__(self) -> str:
        return f"Plane({self.N!r}, {self.d!r})"

    @classmethod
    def from_point(cls, normal: Vector3, point: Vector3) -> Plane:
        """Make the plane with this normal through a point.

        retail: Plane::Plane 0x00536A20, 01 6.1.
        """
        return cls(normal.copy(), f32(-dot_x(point, normal)))

    def assign(self, other: Plane) -> None:
        """Copy the four fields of `other`."""
        self.N.assign(other.N)
        self.d = other.d

    def which_side(self, v: Vector3, eps: float) -> Sidedness:
        """Tell on which side a point is; exactly `eps` away is in the plane.

        retail: Plane::which_side 0x00444720, 01 6.2.
        """
        dist = dot_x(v, self.N) + self.d
        if dist > eps:
            return Sidedness.POSITIVE
        if dist < -eps:
            return Sidedness.NEGATIVE
        return Sidedness.IN_PLANE

    def set_height(self, vc: Vector3) -> int:
        """Put a point onto the plane by changing its z; 0 if the plane is vertical.

        retail: Plane::set_height 0x0052F050, 01 6.3.
        """
        if abs(self.N.z) <= EPS:
            return 0
        vc.z = f32(-(((vc.y * self.N.y + vc.x * self.N.x) + self.d) / self.N.z))
        return 1

    def snap_to_plane(self, offset: Vector3) -> None:
        """Give a movement the z that keeps it parallel to the plane, unless the plane is vertical.

        The plane constant cancels algebraically, not numerically.

        retail: Plane::snap_to_plane 0x00509C50, 01 6.4.
        """
        if abs(self.N.z) > EPS:
            s = ((offset.y * self.N.y + offset.x * self.N.x) + self.N.z * 0.0) + self.d
            offset.z = f32((-s) * (1.0 / self.N.z) - (1.0 / self.N.z) * (-self.d))

    def compute_time_of_intersection(self, ray: Ray, time: Ref[float]) -> int:
        """Find where a ray meets the plane; 0 if it is parallel or the plane lies behind.

        `time` is left alone for a parallel ray only.

        retail: Plane::compute_time_of_intersection 0x00538320, 01 6.5.
        """
        v = dot_x(ray.dir, self.N)
        if abs(v) < EPS:
            return 0
        t = (dot_x(ray.pt, self.N) + self.d) * (-1.0 / v)
        time.value = t
        return 1 if t >= 0.0 else 0

    def intersect_box(self, box: BBox) -> Sidedness:
        """Tell on which side a box is.

        retail: Plane::intersect_box 0x005AA170, 01 6.6.
        """
        s = self.which_side(box.min, EPS)
        if s == Sidedness.IN_PLANE:
            return Sidedness.CROSSING
        for corner in _BOX_CORNERS:
            if self.which_side(box.corner(corner), EPS) != s:
                return Sidedness.CROSSING
        return s

    @staticmethod
    def localtoglobal(to: Position, from_: Position, local_plane: Plane) -> Plane:
        """Return a plane of the local space of `from_` in the block coordinates of `to`.

        The representative point is the foot of the perpendicular from the local origin; the rotated
        normal is not renormalised. There is no scale: callers multiply the finished d by it.

        retail: Plane::localtoglobal 0x005AA0A0, 01 PL-1…4.
        """
        N = local_plane.N
        # PL-1
        nd = -local_plane.d
        pt = Vector3(f32(nd * N.x), f32(nd * N.y), f32(nd * N.z))
        # PL-2
        f = from_.frame
        n = Vector3(
            f32((f.m6 * N.z + f.m3 * N.y) + f.m0 * N.x),
            f32((f.m7 * N.z + f.m4 * N.y) + f.m1 * N.x),
            f32((f.m8 * N.z + f.m5 * N.y) + f.m2 * N.x),
        )
        # PL-3
        g = to.localtoglobal(from_, pt)
        # PL-4
        return Plane(n, f32(-dot_x(n, g)))
