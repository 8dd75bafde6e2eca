"""Ray: what mouse picking tests planes and polygons against."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from oracle.vector import Vector3


class Ray:
    """A point and a direction, in the space of what it is tested against, metres."""

    __slots__ = ("dir", "pt")

    def __init__(self, pt: Vector3, direction: Vector3) -> None:
        self.pt = pt
        self.dir = direction

    def __repr__(self) -> str:
        return f"Ray({self.pt!r}, {self.dir!r})"
