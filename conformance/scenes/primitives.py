"""Primitives: scenes without listing vertices.

Each is a plain function from metres and degrees to a `Shape`. A shape faces the side one is on: rooms
inwards, objects outwards. `conformance.scenes.polygons.place` puts it somewhere; a cell's geometry is
the sum of several.
"""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final, TypeVar

from conformance.scenes.errors import SceneError
from conformance.scenes.parameters import finite, not_negative, pair, point, positive, sizes, whole_pair
from conformance.scenes.rectangles import Rectangle
from conformance.scenes.solids import SOUTH, WEST, X, Y, Z, box, pillar, ramp, stairs
from conformance.scenes.walls import doorway, wall

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from conformance.scenes.model import Vec3
    from conformance.scenes.polygons import Shape

T = TypeVar("T")
SIDES: Final = ("floor", "ceiling", "north", "south", "east", "west")
"""Faces of a room in the order of its polygons; north is +y, east is +x."""


@dataclass(frozen=True, slots=True)
class Opening:
    """A rectangular opening in a room.

    Attributes
    ----------
    side : str
        ``north`` (+y), ``south`` (-y), ``east`` (+x), ``west`` (-x), ``floor`` or ``ceiling``.
    width, height : float
        Metres. In a floor or ceiling: the extent along x and along y.
    offset : float
        Where its middle is along x (in an east or west wall: along y), metres from the room's middle.
    sill : float
        Its lower edge above the floor, metres. In a floor or ceiling: where its middle is along y.
    """

    side: str
    width: float
    height: float
    offset: float = 0.0
    sill: float = 0.0


def floor(*, size: Sequence[float], tiles: Sequence[int] = (1, 1)) -> Shape:
    """Return a floor at z = 0, centred on the origin, that faces up.

    Parameters
    ----------
    size : (float, float)
        Extent along x and y, metres.
    tiles : (int, int)
        Number of polygons along x and y.
    """
    w, d = sizes(size, 2, "floor.size")
    nx, ny = whole_pair(tiles, "floor.tiles")
    return Rectangle((-w / 2, -d / 2, 0.0), X, Y, w, d).tiled(nx, ny)


def ceiling(*, size: Sequence[float], height: float, tiles: Sequence[int] = (1, 1)) -> Shape:
    """Return a ceiling at z = `height`, centred on the z axis, that faces down.

    Parameters
    ----------
    size : (float, float)
        Extent along x and y, metres.
    height : float
        Metres above z = 0.
    tiles : (int, int)
        Number of polygons along x and y.
    """
    w, d = sizes(size, 2, "ceiling.size")
    nx, ny = whole_pair(tiles, "ceiling.tiles")
    return Rectangle((-w / 2, -d / 2, finite(height, "ceiling.height")), Y, X, d, w).tiled(ny, nx)


def room(*, size: Sequence[float], openings: Sequence[Opening] = ()) -> Shape:
    """Return a box-shaped room that faces inwards, its floor at z = 0 centred on the origin.

    Parameters
    ----------
    size : (float, float, float)
        Extent along x, y, z in metres.
    openings : sequence of Opening
        Doors, windows, hatches.

    Returns
    -------
    Shape
        Floor, ceiling, then the walls at +y, -y, +x, -x; a face with openings is several polygons.

    Raises
    ------
    SceneError
        An opening has no such side or reaches beyond it.
    """
    faces = room_faces(size)
    for i, opening in enumerate(openings):
        if opening.side not in faces:
            raise SceneError(f"room.openings[{i}].side", repr(opening.side), f"one of {', '.join(SIDES)}")
    shape: Shape = []
    for side in SIDES:
        holes = [
            faces[side].hole_between(*opening_corners(opening, f"room.openings[{i}]"), f"room.openings[{i}]")
            for i, opening in enumerate(openings)
            if opening.side == side
        ]
        shape += faces[side].around(holes) if holes else faces[side].whole()
    return shape


def room_faces(size: Sequence[float]) -> dict[str, Rectangle]:
    """Return the sides of a room by name, in the order of `SIDES`, facing inwards; see `room`."""
    w, d, h = sizes(size, 3, "room.size")
    x, y = w / 2, d / 2
    return {
        "floor": Rectangle((-x, -y, 0.0), X, Y, w, d),
        "ceiling": Rectangle((-x, -y, h), Y, X, d, w),
        "north": Rectangle((-x, y, 0.0), X, Z, w, h),
        "south": Rectangle((x, -y, 0.0), WEST, Z, w, h),
        "east": Rectangle((x, y, 0.0), SOUTH, Z, d, h),
        "west": Rectangle((-x, -y, 0.0), Y, Z, d, h),
    }


def opening_corners(opening: Opening, path: str) -> tuple[Vec3, Vec3]:
    """Return two opposite corners of an opening, over its side of a room about the origin; metres."""
    half = positive(opening.width, f"{path}.width") / 2
    tall = positive(opening.height, f"{path}.height")
    middle, sill = finite(opening.offset, f"{path}.offset"), finite(opening.sill, f"{path}.sill")
    if opening.side in {"floor", "ceiling"}:
        return (middle - half, sill - tall / 2, 0.0), (middle + half, sill + tall / 2, 0.0)
    if opening.side in {"north", "south"}:
        return (middle - half, 0.0, sill), (middle + half, 0.0, sill + tall)
    return (0.0, middle - half, sill), (0.0, middle + half, sill + tall)


def hatch(
    *, size: Sequence[float], hole: Sequence[float], middle: Sequence[float] = (0.0, 0.0), depth: float = 0.0
) -> Shape:
    """Return a floor as `floor` makes it, with a hole in it.

    Parameters
    ----------
    size, hole : (float, float)
        Extent of floor and hole along x and y, metres.
    middle : (float, float)
        Where the hole's middle is, metres.
    depth : float
        How far the four walls of a shaft go down from the hole's edge, metres; with 0 there are none.
    """
    w, d = sizes(size, 2, "hatch.size")
    hole_w, hole_d = sizes(hole, 2, "hatch.hole")
    x, y = pair(middle, "hatch.middle")
    low, high = (x - hole_w / 2, y - hole_d / 2, 0.0), (x + hole_w / 2, y + hole_d / 2, 0.0)
    face = Rectangle((-w / 2, -d / 2, 0.0), X, Y, w, d)
    shape = face.around([face.hole_between(low, high, "hatch.hole")])
    deep = not_negative(depth, "hatch.depth")
    if deep > 0.0:
        shaft = (
            Rectangle((low[0], high[1], -deep), X, Z, hole_w, deep),
            Rectangle((high[0], low[1], -deep), WEST, Z, hole_w, deep),
            Rectangle((high[0], high[1], -deep), SOUTH, Z, hole_d, deep),
            Rectangle((low[0], low[1], -deep), Y, Z, hole_d, deep),
        )
        shape += [polygon for side in shaft for polygon in side.whole()]
    return shape


def explicit(*, polygons: Sequence[Sequence[Sequence[float]]]) -> Shape:
    """Return polygons listed by their corner points, metres, counter-clockwise seen from the front."""
    shape: Shape = []
    for i, corners in enumerate(polygons):
        shape.append(tuple(point(corner, f"polygons[{i}][{k}]") for k, corner in enumerate(corners)))
    return shape


PRIMITIVES: Final[Mapping[str, Callable[..., Shape]]] = MappingProxyType(
    {
        "floor": floor,
        "ceiling": ceiling,
        "wall": wall,
        "doorway": doorway,
        "room": room,
        "box": box,
        "pillar": pillar,
        "ramp": ramp,
        "stairs": stairs,
        "hatch": hatch,
        "polygons": explicit,
    }
)
"""The primitives by the names that cases call them."""


def make(name: str, parameters: Mapping[str, Any]) -> Shape:
    """Make a primitive from plain data, as a case file holds it.

    Parameters
    ----------
    name : str
        A name in `PRIMITIVES`.
    parameters : mapping
        Its arguments; a room's openings may be mappings with the fields of `Opening`.

    Raises
    ------
    SceneError
        No such primitive; a parameter that it does not have, or lacks; a bad value.
    """
    if name not in PRIMITIVES:
        raise SceneError(name, "no such primitive", f"one of {', '.join(PRIMITIVES)}")
    primitive = PRIMITIVES[name]
    arguments = dict(parameters)
    if "openings" in arguments:
        arguments["openings"] = [
            opening if isinstance(opening, Opening) else _call(Opening, opening, f"{name}.openings[{i}]")
            for i, opening in enumerate(arguments["openings"])
        ]
    return _call(primitive, arguments, name)


def _call(function: Callable[..., T], arguments: Mapping[str, Any], path: str) -> T:
    """Call a function by keyword; arguments it does not take, or lacks, are errors of the scene."""
    known = inspect.signature(function).parameters
    for argument in arguments:
        if argument not in known:
            raise SceneError(f"{path}.{argument}", "an unknown parameter", f"one of {', '.join(known)}")
    for parameter in known.values():
        if parameter.default is parameter.empty and parameter.name not in arguments:
            raise SceneError(path, f"no {parameter.name}", f"{parameter.name} to be given")
    return function(**arguments)
