"""The scene of a query as polygons in one frame: cells, objects, buildings, land."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from conformance.report.values import format_cell
from conformance.scenes.algebra import add, scale
from conformance.scenes.rotations import rotate, rows_from_quaternion
from conformance.scenes.world_model import SIDE_CELLS, SIDE_VERTICES
from oracle.land_block_struct import cuts_sw_to_ne

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from conformance.query import Query
    from conformance.scenes.model import Vec3

Corners: TypeAlias = "tuple[Vec3, ...]"

BLOCK_METRES: Final = 192.0
"""Length of a landblock's edge (10 1)."""
_CELL_METRES: Final = BLOCK_METRES / SIDE_CELLS
FARTHEST: Final = 1e9
"""How far from the origin something is drawn, metres; retail's land is 49 km wide."""
_ROUND: Final = 16
"""Sides that a circle is drawn with."""
_RINGS: Final = 8
"""Rings that a sphere is drawn with."""


@dataclass(frozen=True, slots=True)
class Solid:
    """Something that movers collide with.

    Attributes
    ----------
    name : str
        What it is, as people read it; nothing of a case's own text.
    geometry : str
        The name that answers call its geometry by; empty where it has none.
    polygons : tuple of tuple of Vec3
        Corners, metres, in the frame of the view; a polygon's number is its index.
    """

    name: str
    geometry: str
    polygons: tuple[Corners, ...]


@dataclass(frozen=True, slots=True)
class Frame:
    """The frame of a view: that of one landblock.

    Attributes
    ----------
    cell : int
        A cell of the landblock, or 0 for a query in a geometry's own frame.
    """

    cell: int

    def offset(self, cell: int) -> Vec3:
        """Return where another cell's landblock lies, metres; cells of no landblock lie in the view's."""
        if not cell >> 16 or not self.cell >> 16:
            return (0.0, 0.0, 0.0)
        east = (cell >> 24) - (self.cell >> 24)
        north = (cell >> 16 & 0xFF) - (self.cell >> 16 & 0xFF)
        return (east * BLOCK_METRES, north * BLOCK_METRES, 0.0)

    def place(self, pose: Mapping[str, Any], points: Iterable[Any], factor: float = 1.0) -> Corners:
        """Return local points of a POSE in the view's frame."""
        rotation = tuple(pose["rotation"])
        rows = rows_from_quaternion(rotation if any(rotation) else (1.0, 0.0, 0.0, 0.0))
        origin = add(tuple(pose["origin"]), self.offset(pose["cell"]))
        return tuple(add(rotate(rows, scale(factor, tuple(point))), origin) for point in points)


def solids_of(query: Query, frame: Frame) -> list[Solid]:
    """Return everything in a query that has a shape; what is too far away is left out."""
    return [one for one in _all(query, frame) if all(map(is_drawable, one.polygons))]


def is_drawable(points: Iterable[Iterable[float]]) -> bool:
    """Tell whether points are near enough to be drawn; NaN is nowhere."""
    return all(abs(number) <= FARTHEST for point in points for number in point)


def sphere_polygons(centre: Vec3, radius: float) -> tuple[Corners, ...]:
    """Return a sphere as quadrangles about the z axis."""
    levels = [math.pi * (ring / _RINGS - 0.5) for ring in range(_RINGS + 1)]
    rings = [_circle(centre, radius * math.cos(level), radius * math.sin(level)) for level in levels]
    return tuple(_between(rings[i], rings[i + 1], side) for i in range(_RINGS) for side in range(_ROUND))


def _all(query: Query, frame: Frame) -> Iterator[Solid]:
    inputs = query.inputs
    if isinstance(inputs.get("world"), dict):
        yield from _world(query, inputs["world"], frame)
    for cell in (*inputs.get("cells", ()), inputs.get("cell")):
        if isinstance(cell, dict):
            yield from _cell(query, cell, frame)
    for thing in (*inputs.get("objects", ()), inputs.get("object")):
        if isinstance(thing, dict):
            yield from _object(query, thing, frame)
    if isinstance(inputs.get("geometry"), str):
        yield from _geometry(query, "geometry", inputs, inputs.get("pose"), frame)
    if "block" in inputs and "heights" in inputs:
        yield _land(inputs, frame)


def _world(query: Query, world: Mapping[str, Any], frame: Frame) -> Iterator[Solid]:
    yield from (_land(block, frame) for block in world["landblocks"])
    for cell in world["cells"]:
        yield from _cell(query, cell, frame)
    for building in world["buildings"]:
        yield from _geometry(query, "building", building, building["pose"], frame)
    for thing in world["objects"]:
        yield from _object(query, thing, frame)


def _cell(query: Query, cell: Mapping[str, Any], frame: Frame) -> Iterator[Solid]:
    name = f"cell {format_cell(cell['id'])}"
    yield from _geometry(query, name, cell, cell["pose"], frame)
    for static in cell.get("statics", ()):
        yield from _geometry(query, f"static object in {name}", static, static["pose"], frame)


def _object(query: Query, thing: Mapping[str, Any], frame: Frame) -> Iterator[Solid]:
    name = f"object {format_cell(thing['id'])}"
    pose, factor = thing["pose"], thing.get("scale", 1.0)
    for part in thing.get("parts", ()):
        placed = {"scale": factor, **part}
        yield from _geometry(query, name, placed, part.get("pose") or pose, frame)
    for x, y, z, radius in thing.get("spheres", ()):
        (centre,) = frame.place(pose, [(x, y, z)], factor)
        yield Solid(name, "", sphere_polygons(centre, radius * factor))
    for x, y, z, radius, height in thing.get("cylspheres", ()):
        (low,) = frame.place(pose, [(x, y, z)], factor)
        yield Solid(name, "", _cylinder(low, radius * factor, height * factor))


def _geometry(
    query: Query, name: str, held: Mapping[str, Any], pose: Mapping[str, Any] | None, frame: Frame
) -> Iterator[Solid]:
    geometry = query.geometries.get(held.get("geometry") or "")
    if geometry is None:
        return
    factor = held.get("scale", 1.0)
    local = [geometry.corners(index) for index in range(len(geometry.polygons))]
    placed = local if pose is None else [frame.place(pose, corners, factor) for corners in local]
    yield Solid(name, geometry.name, tuple(placed))


def _land(block: Mapping[str, Any], frame: Frame) -> Solid:
    number, heights = block["block"], block["heights"]
    corner = frame.offset(number << 16)
    east, north = (number >> 8) * SIDE_CELLS, (number & 0xFF) * SIDE_CELLS

    def vertex(i: int, j: int) -> Vec3:
        return add(corner, (i * _CELL_METRES, j * _CELL_METRES, heights[i * SIDE_VERTICES + j]))

    triangles: list[Corners] = []
    for i in range(SIDE_CELLS):
        for j in range(SIDE_CELLS):
            sw, se, ne, nw = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
            straight = cuts_sw_to_ne(east + i, north + j)
            triangles += [(sw, se, ne), (sw, ne, nw)] if straight else [(sw, se, nw), (se, ne, nw)]
    return Solid(f"landblock 0x{number:04X}", "", tuple(triangles))


def _cylinder(low: Vec3, radius: float, height: float) -> tuple[Corners, ...]:
    bottom, top = _circle(low, radius, 0.0), _circle(low, radius, height)
    sides = tuple(_between(bottom, top, side) for side in range(_ROUND))
    return (*sides, tuple(reversed(bottom)), top)


def _circle(centre: Vec3, radius: float, up: float) -> Corners:
    angles = [2.0 * math.pi * side / _ROUND for side in range(_ROUND)]
    return tuple(add(centre, (radius * math.cos(a), radius * math.sin(a), up)) for a in angles)


def _between(below: Corners, above: Corners, side: int) -> Corners:
    after = (side + 1) % _ROUND
    return (below[side], below[after], above[after], above[side])
