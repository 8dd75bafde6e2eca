"""Primitives that one stands on or bumps into: box, pillar, ramp, stairs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from conformance.scenes.algebra import cos_sin
from conformance.scenes.errors import SceneError
from conformance.scenes.parameters import count as whole
from conformance.scenes.parameters import finite, positive, sizes
from conformance.scenes.rectangles import Rectangle

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.scenes.polygons import Shape

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
WEST, SOUTH = (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)

STEEPEST = 90.0
"""A ramp is less steep than a wall, degrees."""


def box(*, size: Sequence[float]) -> Shape:
    """Return a solid box that faces outwards.

    Parameters
    ----------
    size : (float, float, float)
        Extent along x, y, z in metres; its base is centred on the origin at z = 0.

    Returns
    -------
    Shape
        Bottom, top, then the walls at +y, -y, +x, -x: six polygons.
    """
    w, d, h = sizes(size, 3, "box.size")
    x, y = w / 2, d / 2
    faces = (
        Rectangle((-x, -y, 0.0), Y, X, d, w),
        Rectangle((-x, -y, h), X, Y, w, d),
        Rectangle((x, y, 0.0), WEST, Z, w, h),
        Rectangle((-x, -y, 0.0), X, Z, w, h),
        Rectangle((x, -y, 0.0), Y, Z, d, h),
        Rectangle((-x, y, 0.0), SOUTH, Z, d, h),
    )
    return [polygon for face in faces for polygon in face.whole()]


def pillar(*, radius: float, height: float, sides: int = 8, capped: bool = True) -> Shape:
    """Return a regular prism that faces outwards, standing on z = 0 about the z axis.

    Parameters
    ----------
    radius : float
        From the axis to an edge, metres.
    height : float
        Metres.
    sides : int
        Number of side faces; four of them are parallel to the axes.
    capped : bool
        Whether it has a bottom and a top; without them it runs from a floor to a ceiling.
    """
    radius, height = positive(radius, "pillar.radius"), positive(height, "pillar.height")
    turn = 360.0 / whole(sides, "pillar.sides", 3)
    ring = [cos_sin((i + 0.5) * turn) for i in range(sides)]
    low = [(radius * c, radius * s, 0.0) for c, s in ring]
    high = [(x, y, height) for x, y, _ in low]
    shape: Shape = [(low[i - 1], low[i], high[i], high[i - 1]) for i in range(sides)]
    if capped:
        shape += [tuple(reversed(low)), tuple(high)]
    return shape


def ramp(
    *,
    width: float,
    run: float,
    degrees: float | None = None,
    rise: float | None = None,
    normal_z: float | None = None,
    solid: bool = False,
) -> Shape:
    """Return a slope that climbs along +y from the line y = 0, z = 0, centred on x = 0.

    Parameters
    ----------
    width, run : float
        Extent along x and, level, along y, metres.
    degrees, rise, normal_z : float, optional
        How steep, exactly one of: the angle, the height gained over the run in metres, or the z of the
        unit normal (retail walks where it is at least 0.66417414).
    solid : bool
        Whether the wedge under the slope is closed with back, bottom and sides.

    Raises
    ------
    SceneError
        Not exactly one steepness, or one that is flat or a wall.
    """
    w, run = positive(width, "ramp.width") / 2, positive(run, "ramp.run")
    h = _rise(run, {"degrees": degrees, "rise": rise, "normal_z": normal_z})
    shape: Shape = [((-w, 0.0, 0.0), (w, 0.0, 0.0), (w, run, h), (-w, run, h))]
    if solid:
        shape += [
            *_back_and_bottom(w, run, h),
            ((w, 0.0, 0.0), (w, run, 0.0), (w, run, h)),
            ((-w, run, h), (-w, run, 0.0), (-w, 0.0, 0.0)),
        ]
    return shape


def stairs(*, width: float, rise: float, run: float, count: int, solid: bool = False) -> Shape:
    """Return steps that climb along +y from the line y = 0, z = 0, centred on x = 0.

    Parameters
    ----------
    width : float
        Extent along x, metres.
    rise, run : float
        Height and depth of one step, metres.
    count : int
        Number of steps.
    solid : bool
        Whether the block under the steps is closed with back, bottom and sides.

    Returns
    -------
    Shape
        Riser and tread of each step from the bottom up, then the closing polygons.
    """
    w = positive(width, "stairs.width") / 2
    rise, run = positive(rise, "stairs.rise"), positive(run, "stairs.run")
    shape: Shape = []
    sides: Shape = []
    for i in range(whole(count, "stairs.count", 1)):
        y, z, top = i * run, i * rise, (i + 1) * rise
        shape += Rectangle((-w, y, z), X, Z, 2 * w, rise).whole()
        shape += Rectangle((-w, y, top), X, Y, 2 * w, run).whole()
        sides += Rectangle((w, y, 0.0), Y, Z, run, top).whole()
        sides += Rectangle((-w, y + run, 0.0), SOUTH, Z, run, top).whole()
    return shape + sides + _back_and_bottom(w, count * run, count * rise) if solid else shape


def _back_and_bottom(w: float, run: float, h: float) -> Shape:
    back = Rectangle((w, run, 0.0), WEST, Z, 2 * w, h)
    bottom = Rectangle((-w, 0.0, 0.0), Y, X, run, 2 * w)
    return back.whole() + bottom.whole()


def _rise(run: float, steepness: dict[str, float | None]) -> float:
    given = {name: value for name, value in steepness.items() if value is not None}
    if len(given) != 1:
        found = ", ".join(given) or "no steepness"
        raise SceneError("ramp", found, "exactly one of degrees, rise, normal_z")
    ((name, value),) = given.items()
    path = f"ramp.{name}"
    if name == "rise":
        return positive(value, path)
    limit = STEEPEST if name == "degrees" else 1.0
    if not 0.0 < finite(value, path) < limit:
        raise SceneError(path, repr(value), f"a number between 0 and {limit:g}, both excluded")
    if name == "degrees":
        c, s = cos_sin(value)
        return run * s / c
    return run * math.sqrt(1.0 - value * value) / value
