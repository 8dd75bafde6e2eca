"""Plans of houses: rooms, doors between them and to the outside, and the shell around them.

Everything is in the house's frame: its ground floor is at z = 0, north is +y.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Final

from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.cell_planes import box_planes
from conformance.scenes.polygons import flip, place
from conformance.scenes.primitives import Opening, room
from conformance.scenes.rectangles import Rectangle
from conformance.scenes.solids import SOUTH, X, Y, Z, stairs

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.scenes.model import Geometry, Vec3
    from conformance.scenes.polygons import Corners, Shape

_THICK: Final = 0.25
"""Thickness of an outer wall, metres: a door's passage belongs to the room behind it."""
_DOOR: Final = (1.5, 2.25)
"""Width and height of a door, metres."""
_RISE: Final = 0.25
"""Height and depth of a step, metres."""


@dataclass(frozen=True, slots=True)
class Door:
    """An opening: its corners, and the rooms that it joins.

    Attributes
    ----------
    room, other : int
        Indices of rooms; `other` is None for a door to the outside.
    corners : tuple of Vec3
        In the house's frame, metres.
    """

    room: int
    other: int | None
    corners: Corners


@dataclass(frozen=True, slots=True)
class Room:
    """A room: where the middle of its floor is in the house's frame, and its geometry in its own."""

    at: Vec3
    geometry: Geometry


@dataclass(frozen=True, slots=True)
class Plan:
    """A house.

    Attributes
    ----------
    rooms : tuple of Room
        In the order of their cell ids.
    doors : tuple of Door
        In the order of the rooms' portals.
    shell : Geometry or None
        What a building collides with from outside; None for what is underground.
    """

    rooms: tuple[Room, ...]
    doors: tuple[Door, ...]
    shell: Geometry | None = None


def _wall_door(at: Vec3, *, along_x: bool) -> Corners:
    """Return the corners of a door whose threshold has its middle at a point."""
    x, y, z = at
    half, height = _DOOR[0] / 2, _DOOR[1]
    dx, dy = (half, 0.0) if along_x else (0.0, half)
    low, high = z, z + height
    return (
        (x - dx, y - dy, low),
        (x + dx, y + dy, low),
        (x + dx, y + dy, high),
        (x - dx, y - dy, high),
    )


def _floor_door(at: Vec3, width: float, depth: float) -> Corners:
    """Return the corners of a hatch whose middle is at a point, extents along x and y."""
    x, y, z = at
    w, d = width / 2, depth / 2
    return ((x - w, y - d, z), (x + w, y - d, z), (x + w, y + d, z), (x - w, y + d, z))


def _passage(yaw: float, at: Vec3) -> Shape:
    """Return the four faces of a door's passage: outwards is +y turned by `yaw`."""
    half, height = _DOOR[0] / 2, _DOOR[1]
    faces = (
        Rectangle((-half, 0.0, 0.0), X, Y, 2 * half, _THICK),
        Rectangle((-half, 0.0, 0.0), Y, Z, _THICK, height),
        Rectangle((half, _THICK, 0.0), SOUTH, Z, _THICK, height),
        Rectangle((-half, 0.0, height), Y, X, _THICK, 2 * half),
    )
    return place([polygon for face in faces for polygon in face.whole()], at, yaw)


def _steps(at: Vec3, count: int) -> Shape:
    return place(stairs(width=1.25, rise=_RISE, run=_RISE, count=count), at, 0.0)


def _room(name: str, at: Vec3, shape: Shape, low: Vec3, high: Vec3) -> Room:
    """Make a room; `low` and `high` are the corners of the space that counts as inside, in its own frame."""
    return Room(at, build(name, shape, style=TreeStyle.BOTH, kind="room", cell_planes=box_planes(low, high)))


@cache
def _cottage() -> Plan:
    """Hall and parlour, front and back door, stairs to a loft, a hatch to a cellar."""
    door = {"width": _DOOR[0], "height": _DOOR[1]}
    stairwell = {"width": 1.25, "height": 2.25, "offset": -2.25, "sill": 1.0}
    hatch = {"width": 1.25, "height": 1.25, "offset": 1.5, "sill": -1.25}
    hall = room(
        size=(6.0, 5.0, 3.0),
        openings=(Opening("south", **door), Opening("east", **door), Opening("ceiling", **stairwell)),
    )
    parlour = room(
        size=(5.0, 5.0, 3.0),
        openings=(Opening("west", **door), Opening("east", **door), Opening("floor", **hatch)),
    )
    loft = room(size=(6.0, 5.0, 2.5), openings=(Opening("floor", **stairwell),))
    cellar = room(size=(5.0, 5.0, 2.5), openings=(Opening("ceiling", **hatch),))
    shell = room(
        size=(11.5, 5.5, 6.5),
        openings=(Opening("south", **door, offset=-2.5, sill=0.5), Opening("east", **door, sill=0.5)),
    )
    return Plan(
        rooms=(
            _room(
                "hall",
                (-3.0, 0.0, 0.0),
                [*hall, *_passage(180.0, (0.0, -2.5, 0.0)), *_steps((-2.25, -1.0, 0.0), 12)],
                (-3.0, -2.75, 0.0),
                (3.0, 2.5, 3.0),
            ),
            _room(
                "parlour",
                (2.5, 0.0, 0.0),
                [*parlour, *_passage(270.0, (2.5, 0.0, 0.0))],
                (-2.5, -2.5, 0.0),
                (2.75, 2.5, 3.0),
            ),
            _room("loft", (-3.0, 0.0, 3.0), loft, (-3.0, -2.5, 0.0), (3.0, 2.5, 2.5)),
            _room("cellar", (2.5, 0.0, -2.5), cellar, (-2.5, -2.5, 0.0), (2.5, 2.5, 2.5)),
        ),
        doors=(
            Door(0, None, _wall_door((-3.0, -2.75, 0.0), along_x=True)),
            Door(0, 1, _wall_door((0.0, 0.0, 0.0), along_x=False)),
            Door(0, 2, _floor_door((-5.25, 1.0, 3.0), 1.25, 2.25)),
            Door(1, 3, _floor_door((4.0, -1.25, 0.0), 1.25, 1.25)),
            Door(1, None, _wall_door((5.25, 0.0, 0.0), along_x=False)),
        ),
        shell=build(
            "cottage-shell", place(flip(shell), (-0.5, 0.0, -0.5), 0.0), style=TreeStyle.BOTH, kind="shell"
        ),
    )


@cache
def _hut() -> Plan:
    """One room, one door."""
    door = {"width": _DOOR[0], "height": _DOOR[1]}
    inside = room(size=(4.0, 4.0, 3.0), openings=(Opening("south", **door),))
    outside = room(size=(4.5, 4.5, 3.5), openings=(Opening("south", **door),))
    shape = [*inside, *_passage(180.0, (0.0, -2.0, 0.0))]
    return Plan(
        rooms=(_room("hut", (0.0, 0.0, 0.0), shape, (-2.0, -2.25, 0.0), (2.0, 2.0, 3.0)),),
        doors=(Door(0, None, _wall_door((0.0, -2.25, 0.0), along_x=True)),),
        shell=build("hut-shell", flip(outside), style=TreeStyle.FRONT, kind="shell"),
    )


@cache
def _dungeon() -> Plan:
    """Three rooms in a row and one beside the middle one, which is half a metre lower; no way out."""
    door = {"width": _DOOR[0], "height": _DOOR[1]}
    west = room(size=(5.0, 4.0, 3.0), openings=(Opening("east", **door),))
    low = room(
        size=(5.0, 4.0, 3.5),
        openings=(
            Opening("west", **door, sill=0.5),
            Opening("east", **door, sill=0.5),
            Opening("north", **door),
        ),
    )
    east = room(size=(5.0, 4.0, 3.0), openings=(Opening("west", **door),))
    north = room(size=(5.0, 4.0, 3.0), openings=(Opening("south", **door),))
    low_corner, high_corner = (-2.5, -2.0, 0.0), (2.5, 2.0, 3.0)
    return Plan(
        rooms=(
            _room("dungeon-west", (-5.0, 0.0, 0.0), west, low_corner, high_corner),
            _room("dungeon-low", (0.0, 0.0, -0.5), low, low_corner, (2.5, 2.0, 3.5)),
            _room("dungeon-east", (5.0, 0.0, 0.0), east, low_corner, high_corner),
            _room("dungeon-north", (0.0, 4.0, -0.5), north, low_corner, high_corner),
        ),
        doors=(
            Door(0, 1, _wall_door((-2.5, 0.0, 0.0), along_x=False)),
            Door(1, 2, _wall_door((2.5, 0.0, 0.0), along_x=False)),
            Door(1, 3, _wall_door((0.0, 2.0, -0.5), along_x=True)),
        ),
    )


_PLANS: Final = {"cottage": _cottage, "hut": _hut, "dungeon": _dungeon}


def plans() -> Mapping[str, Plan]:
    """Return every plan by its name; they are built once."""
    return {name: make() for name, make in _PLANS.items()}
