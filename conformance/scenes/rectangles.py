"""Axis-parallel rectangles with rectangular holes, cut into convex polygons."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, TypeAlias

from conformance.scenes.algebra import add, dot, scale, subtract
from conformance.scenes.errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.model import Vec3
    from conformance.scenes.polygons import Corners, Shape

EDGE_SNAP: Final = 1e-9
"""How near to an edge a hole's side is meant to be on it, metres: far above float64 rounding, far below
float32's."""

Span: TypeAlias = tuple[float, float]
Hole: TypeAlias = tuple[Span, Span]
"""The u and the v extent of a hole, metres from the rectangle's corner."""


@dataclass(frozen=True, slots=True)
class Rectangle:
    """A rectangle from `corner` along the unit axes `u` and `v`; it faces along ``u x v``.

    Attributes
    ----------
    corner : Vec3
        Metres.
    u, v : Vec3
        Unit vectors at right angles.
    width, height : float
        Extent along u and v, metres.
    """

    corner: Vec3
    u: Vec3
    v: Vec3
    width: float
    height: float

    def point(self, u: float, v: float) -> Vec3:
        """Return the point at `u`, `v` metres from the corner."""
        return add(self.corner, add(scale(u, self.u), scale(v, self.v)))

    def part(self, across: Span, up: Span) -> Corners:
        """Return the part between two u and two v as a polygon."""
        (u0, u1), (v0, v1) = across, up
        return (self.point(u0, v0), self.point(u1, v0), self.point(u1, v1), self.point(u0, v1))

    def whole(self) -> Shape:
        """Return the rectangle as one polygon."""
        return [self.part((0.0, self.width), (0.0, self.height))]

    def tiled(self, across: int, up: int) -> Shape:
        """Return the rectangle as `across` x `up` equal polygons, row by row."""
        us = [self.width * i / across for i in range(across + 1)]
        vs = [self.height * i / up for i in range(up + 1)]
        return [
            self.part((u0, u1), (v0, v1))
            for v0, v1 in itertools.pairwise(vs)
            for u0, u1 in itertools.pairwise(us)
        ]

    def hole_between(self, a: Vec3, b: Vec3, path: str) -> Hole:
        """Return the hole whose opposite corners lie over the points `a` and `b`.

        Raises
        ------
        SceneError
            The hole reaches beyond the rectangle.
        """
        a, b = subtract(a, self.corner), subtract(b, self.corner)
        across, up = (dot(a, self.u), dot(b, self.u)), (dot(a, self.v), dot(b, self.v))
        return (_within(across, self.width, path), _within(up, self.height, path))

    def around(self, holes: Sequence[Hole]) -> Shape:
        """Return what is left of the rectangle around holes, in columns from left to right."""
        cuts = sorted({0.0, self.width, *(u for hole in holes for u in hole[0])})
        shape: Shape = []
        for u0, u1 in itertools.pairwise(cuts):
            blocked = sorted(up for (low, high), up in holes if low < u1 and u0 < high)
            shape += [self.part((u0, u1), span) for span in _free(blocked, self.height)]
        return shape


def _within(ends: Span, limit: float, path: str) -> Span:
    """Return the span in order, its ends snapped to 0 and `limit` where they miss them by rounding."""
    low, high = min(ends), max(ends)
    if low < -EDGE_SNAP or high > limit + EDGE_SNAP:
        raise SceneError(path, f"{low:g} to {high:g} m", f"a hole within 0 to {limit:g} m of its surface")
    return (0.0 if low < EDGE_SNAP else low, limit if high > limit - EDGE_SNAP else high)


def _free(blocked: Sequence[Span], height: float) -> list[Span]:
    """Return the spans of 0 to `height` outside the sorted spans in `blocked`."""
    free, bottom = [], 0.0
    for low, high in blocked:
        if low > bottom:
            free.append((bottom, low))
        bottom = max(bottom, high)
    if bottom < height:
        free.append((bottom, height))
    return free
