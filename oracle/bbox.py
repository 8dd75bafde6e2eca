"""BBox: an axis-aligned box."""

from __future__ import annotations

from oracle.vector import Vector3


class BBox:
    """The two extreme corners of a box, metres."""

    __slots__ = ("max", "min")

    def __init__(self, min_corner: Vector3, max_corner: Vector3) -> None:
        self.min = min_corner
        self.max = max_corner

    def __repr__(self) -> str:
        return f"BBox({self.min!r}, {self.max!r})"

    def corner(self, which: str) -> Vector3:
        """Return a corner by three letters, ``l`` (low) or ``h`` (high) for each of x, y, z."""
        return Vector3(
            self.max.x if which[0] == "h" else self.min.x,
            self.max.y if which[1] == "h" else self.min.y,
            self.max.z if which[2] == "h" else self.min.z,
        )
