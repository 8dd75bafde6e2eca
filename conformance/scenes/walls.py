"""Primitives for walls: plain, and with an opening."""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance.scenes.parameters import finite, not_negative, positive
from conformance.scenes.rectangles import Rectangle
from conformance.scenes.solids import SOUTH, WEST, X, Y, Z

if TYPE_CHECKING:
    from conformance.scenes.model import Vec3
    from conformance.scenes.polygons import Shape


def wall(*, length: float, height: float) -> Shape:
    """Return a wall in the plane y = 0 that faces +y: along x, centred, from z = 0 up; metres."""
    length, height = positive(length, "wall.length"), positive(height, "wall.height")
    return Rectangle((length / 2, 0.0, 0.0), WEST, Z, length, height).whole()


def doorway(
    *,
    length: float,
    height: float,
    door_width: float,
    door_height: float,
    offset: float = 0.0,
    sill: float = 0.0,
    thickness: float = 0.0,
) -> Shape:
    """Return a wall as `wall` makes it, with an opening.

    Parameters
    ----------
    length, height : float
        The wall's extent, metres.
    door_width, door_height : float
        The opening's extent, metres.
    offset : float
        Where the opening's middle is along x, metres.
    sill : float
        The opening's lower edge above z = 0, metres; above 0 it is a window.
    thickness : float
        With 0 the wall is one sheet that faces +y. Otherwise it also has a face at y = -thickness that
        faces -y, and a reveal around the opening; ends and top stay open, they meet other walls.
    """
    length, height = positive(length, "doorway.length"), positive(height, "doorway.height")
    half = positive(door_width, "doorway.door_width") / 2
    middle, low = finite(offset, "doorway.offset"), not_negative(sill, "doorway.sill")
    high = low + positive(door_height, "doorway.door_height")
    left, right = (middle - half, 0.0, low), (middle + half, 0.0, high)
    front = Rectangle((length / 2, 0.0, 0.0), WEST, Z, length, height)
    shape = front.around([front.hole_between(left, right, "doorway")])
    depth = not_negative(thickness, "doorway.thickness")
    if depth > 0.0:
        back = Rectangle((-length / 2, -depth, 0.0), X, Z, length, height)
        shape += back.around([back.hole_between(left, right, "doorway")])
        shape += _reveal(left, right, depth, height)
    return shape


def _reveal(left: Vec3, right: Vec3, depth: float, height: float) -> Shape:
    """Return the faces inside an opening, from its front at y = 0 back to y = -depth."""
    (x0, _, z0), (x1, _, z1) = left, right
    shape = Rectangle((x0, -depth, z0), Y, Z, depth, z1 - z0).whole()
    shape += Rectangle((x1, 0.0, z0), SOUTH, Z, depth, z1 - z0).whole()
    if z1 < height:
        shape += Rectangle((x0, -depth, z1), Y, X, depth, x1 - x0).whole()
    if z0 > 0.0:
        shape += Rectangle((x0, -depth, z0), X, Y, x1 - x0, depth).whole()
    return shape
