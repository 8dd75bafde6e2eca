"""BBox: an axis-aligned box."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Iterable

    from oracle.position import Position

_CORNERS: Final = ("lll", "llh", "lhl", "lhh", "hll", "hlh", "hhl", "hhh")
"""The eight corners; their order does not matter to the boxes around them (09 8)."""


class BBox:
    """The two extreme corners of a box, metres."""

    __slots__ = ("max", "min")

    def __init__(self, min_corner: Vector3, max_corner: Vector3) -> None:
        self.min = min_corner
        self.max = max_corner

    def __repr__(self) -> str:
        return f"BBox({self.min!r}, {self.max!r})"

    @classmethod
    def around(cls, points: Iterable[Vector3]) -> BBox:
        """Return the smallest box that holds points; there must be one at least."""
        first, *others = points
        box = cls(first.copy(), first.copy())
        for point in others:
            box._reach(point)
        return box

    def _reach(self, point: Vector3) -> None:
        """Grow until the point is inside (strict comparisons, 09 8)."""
        low, high = self.min, self.max
        low.x, high.x = min(low.x, point.x), max(high.x, point.x)
        low.y, high.y = min(low.y, point.y), max(high.y, point.y)
        low.z, high.z = min(low.z, point.z), max(high.z, point.z)

    def corner(self, which: str) -> Vector3:
        """Return a corner by three letters, ``l`` (low) or ``h`` (high) for each of x, y, z."""
        return Vector3(
            self.max.x if which[0] == "h" else self.min.x,
            self.max.y if which[1] == "h" else self.min.y,
            self.max.z if which[2] == "h" else self.min.z,
        )

    def local_to_local(self, from_pos: Position, to_pos: Position) -> BBox:
        """Return the box around this box of the space of `from_pos`, in the space of `to_pos`.

        retail: BBox::LocalToLocal 0x005B1E60, 09 8.
        """
        return BBox.around(to_pos.localtolocal(from_pos, self.corner(which)) for which in _CORNERS)

    def local_to_global(self, from_pos: Position, to_pos: Position) -> BBox:
        """Return the box around this box of the space of `from_pos`, in the block of `to_pos`.

        retail: BBox::LocalToGlobal 0x005B2120, 09 8.
        """
        return BBox.around(to_pos.localtoglobal(from_pos, self.corner(which)) for which in _CORNERS)
