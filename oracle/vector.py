"""AC1Legacy::Vector3, and the orders in which movement adds a dot product."""

from __future__ import annotations

from oracle.arithmetic import atan2, divide, f32, fmod, sqrt
from oracle.constants import DEGREES_PER_RADIAN, EPS, FULL_TURN, HEADING_TURN


class Vector3:
    """Three float32 fields x, y, z.

    Mutable, as in retail: some functions write through a reference to their caller's vector. Assigning
    one vector to another is `assign` (three 32-bit moves), never sharing.
    """

    __slots__ = ("x", "y", "z")

    def __init__(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> None:
        self.x = x
        self.y = y
        self.z = z

    def __repr__(self) -> str:
        return f"Vector3({self.x!r}, {self.y!r}, {self.z!r})"

    def copy(self) -> Vector3:
        """Return a bit copy."""
        return Vector3(self.x, self.y, self.z)

    def assign(self, other: Vector3) -> None:
        """Copy the three fields of `other`, bit by bit."""
        self.x = other.x
        self.y = other.y
        self.z = other.z

    def magnitude(self) -> float:
        """Return the length as a register.

        retail: AC1Legacy::Vector3::magnitude 0x004523D0, 01 2.1.
        """
        return sqrt(dot_z(self, self))

    def normalize(self) -> None:
        """Scale to unit length in place, without a guard.

        retail: AC1Legacy::Vector3::normalize 0x00452400, 01 2.2.
        """
        inv = divide(1.0, self.magnitude())
        self.x = f32(inv * self.x)
        self.y = f32(inv * self.y)
        self.z = f32(inv * self.z)

    def normalize_check_small(self) -> int:
        """Normalise in place unless shorter than EPS; 1 means too small, unchanged.

        retail: AC1Legacy::Vector3::normalize_check_small 0x00452460, 01 2.3.
        """
        m = self.magnitude()
        if m < EPS:
            return 1
        inv = 1.0 / m
        self.x = f32(inv * self.x)
        self.y = f32(inv * self.y)
        self.z = f32(inv * self.z)
        return 0

    def divide_by(self, divisor: float) -> None:
        """Multiply in place by the reciprocal, which stays a register (operator/=, 07 0.5)."""
        inv = divide(1.0, divisor)
        self.x = f32(inv * self.x)
        self.y = f32(inv * self.y)
        self.z = f32(inv * self.z)

    def get_heading(self) -> float:
        """Return the heading of the horizontal part, degrees from north clockwise, as a register.

        A vector whose horizontal part is shorter than EPS has heading 0.

        retail: AC1Legacy::Vector3::get_heading 0x004575D0, 01 4.8.
        """
        n = Vector3(self.x, self.y, 0.0)
        if n.normalize_check_small():
            return 0.0
        return fmod(HEADING_TURN - atan2(n.y, n.x) * DEGREES_PER_RADIAN, FULL_TURN)

    def is_zero(self) -> bool:
        """Tell whether each component is within EPS of zero, strictly.

        retail: AC1Legacy::Vector3::is_zero 0x0050E7B0, 01 2.4.
        """
        return abs(self.x) < EPS and abs(self.y) < EPS and abs(self.z) < EPS

    def equals(self, other: Vector3) -> bool:
        """Tell whether each component differs by at most EPS.

        retail: AC1Legacy::Vector3::operator== 0x00509F10, 01 2.5.
        """
        return abs(self.x - other.x) <= EPS and abs(self.y - other.y) <= EPS and abs(self.z - other.z) <= EPS

    def differs(self, other: Vector3) -> bool:
        """Tell whether a component differs by more than EPS; not the opposite of `equals` for a NaN.

        retail: AC1Legacy::Vector3::operator!= 0x0045F9F0, 04 3.
        """
        return abs(self.x - other.x) > EPS or abs(self.y - other.y) > EPS or abs(self.z - other.z) > EPS


def minus(a: Vector3, b: Vector3) -> Vector3:
    """Return the difference, each component stored.

    retail: AC1Legacy::Vector3::operator- 0x004524C0, 07 0.5.
    """
    return Vector3(f32(a.x - b.x), f32(a.y - b.y), f32(a.z - b.z))


def plus(a: Vector3, b: Vector3) -> Vector3:
    """Return the sum, each component stored (operator+, 07 0.5)."""
    return Vector3(f32(a.x + b.x), f32(a.y + b.y), f32(a.z + b.z))


def scaled(factor: float, v: Vector3) -> Vector3:
    """Return a multiple, each component stored; the factor is a float32 (operator*, 07 0.5)."""
    return Vector3(f32(factor * v.x), f32(factor * v.y), f32(factor * v.z))


def dot_x(a: Vector3, b: Vector3) -> float:
    """Dot product in registers, x term last (01 1.2)."""
    return (a.y * b.y + a.z * b.z) + a.x * b.x


def dot_z(a: Vector3, b: Vector3) -> float:
    """Dot product in registers, z term last (01 1.2)."""
    return (a.x * b.x + a.y * b.y) + a.z * b.z
