"""Spots: places in a site at which something happens, and the target that a mover is aimed at there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.scenes.planes import plane_of
from conformance.strategies.contact import draw_aim, draw_point
from conformance.strategies.meetings import Target
from conformance.strategies.numbers import FLAGS, NEARLY, along, anywhere, grid, pick
from conformance.strategies.obstacles import draw_target
from conformance.strategies.poses import to_world, turned
from conformance.strategies.worlds.land import BLOCK, CELL, land_cell, surface

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.strategies.worlds.sites import Site


@dataclass(frozen=True, slots=True)
class Spot:
    """A target, the landblock in whose frame it is, and the interior cell that it is in or None."""

    target: Target
    block: int
    room: int | None = None

    def cell(self) -> int:
        """Return the id of the cell that the target is in, or at least near."""
        x, y, _ = self.target.center
        return land_cell(self.block, x, y) if self.room is None else self.room


_DEPTHS: Final = st.sampled_from((0.0, 0.0, 0.1, 0.45, 0.9))
"""Depths of water, metres (10 6.5): a mover stands that much lower."""
_HEIGHTS: Final = st.one_of(
    st.tuples(st.just(1.0), NEARLY),
    st.tuples(st.just(1.0), anywhere(-0.5, 0.5)),
    st.tuples(anywhere(-1.0, 3.0), st.just(0.0)),
)
"""Height of a centre over the ground, as a multiple of the radius and an offset."""
_CORNERS: Final = st.integers(0, 8).map(lambda k: k * CELL)
_NEAR_CORNERS: Final = st.tuples(_CORNERS, grid(-1.0, 1.0) | NEARLY).map(sum)
_ANYWHERE: Final = anywhere(0.0, BLOCK)
_ACROSS: Final = _ANYWHERE | _NEAR_CORNERS
_PLACES: Final = st.tuples(_ACROSS, _ACROSS)
_DIAGONALS: Final = st.tuples(_CORNERS, _CORNERS, grid(0.0, CELL), FLAGS).map(
    lambda d: (d[0] + d[2], d[1] + (CELL - d[2] if d[3] else d[2]))
)
_ON_LAND: Final = st.one_of(_PLACES, _DIAGONALS, _PLACES)
_AWAY: Final = st.one_of(
    st.tuples(anywhere(-2.0, 2.0), st.just(0.0)),
    st.tuples(st.sampled_from((1.0, -1.0, 0.0)), NEARLY),
)
"""Distance from a door's plane, as a multiple of the radius and an offset."""
_FLOOR: Final = 0.5


def draw_on_land(draw: st.DrawFn, site: Site, radius: float) -> Spot:
    """Draw a place on the ground: anywhere, at a cell's border, corner or diagonal; in water deep enough."""
    land = pick(draw, site.world["landblocks"])
    x, y = draw(_ON_LAND)
    height, normal = surface(land, x, y)
    multiple, offset = draw(_HEIGHTS)
    lift = radius * multiple + offset - draw(_DEPTHS)
    overlap = max((radius - lift) * normal[2], 0.0)
    return _settled(Spot(Target(normal, (x, y, height + lift), overlap), land["block"]), site)


def draw_in_room(draw: st.DrawFn, site: Site, radius: float) -> Spot:
    """Draw a place at a polygon of a room, half of the time one that faces up."""
    cell = pick(draw, site.world["cells"])
    target = _draw_at(draw, site, cell["geometry"], cell["pose"], radius, floors=bool(draw(FLAGS)))
    return Spot(target, cell["id"] >> 16, cell["id"])


def draw_at_shell(draw: st.DrawFn, site: Site, radius: float) -> Spot:
    """Draw a place at a building's outside."""
    building = pick(draw, site.world["buildings"])
    target = _draw_at(draw, site, building["geometry"], building["pose"], radius, floors=bool(draw(FLAGS)))
    return _settled(Spot(target, building["pose"]["cell"] >> 16), site)


def draw_at_door(draw: st.DrawFn, site: Site, radius: float) -> Spot:
    """Draw a place in a door: on its plane, a radius to either side, or near; in one of its two cells."""
    cell = pick(draw, site.world["cells"])
    portal = pick(draw, cell["portals"])
    target = _draw_across(draw, cell, portal, radius)
    return _settled(Spot(target, cell["id"] >> 16, pick(draw, _sides(site, cell, portal))), site)


def at_outer_door(draw: st.DrawFn, site: Site, radius: float) -> Spot:
    """Draw a place in a door to the outside, of someone outdoors."""
    doors = [(c, p) for c in site.world["cells"] for p in c["portals"] if p["other"] is None]
    cell, portal = pick(draw, doors)
    return _settled(Spot(_draw_across(draw, cell, portal, radius), cell["id"] >> 16), site)


def _draw_across(
    draw: st.DrawFn, cell: Mapping[str, Any], portal: Mapping[str, Any], radius: float
) -> Target:
    """Draw a place on the axis of a door or off it, half of the time standing on its threshold."""
    corners = [tuple(corner) for corner in portal["polygon"]]
    normal = plane_of(corners)[:3]
    multiple, offset = draw(_AWAY)
    threshold = along(draw_point(draw, corners), normal, radius * multiple + offset)
    if abs(normal[2]) < _FLOOR and draw(FLAGS):
        threshold = (*threshold[:2], min(z for _, _, z in corners) + radius)
    facing = turned(cell["pose"]["rotation"], normal)
    return Target(facing, to_world(cell["pose"], threshold, 1.0), radius)


def draw_at_thing(draw: st.DrawFn, site: Site, radius: float) -> Spot:
    """Draw a place at an object."""
    thing = pick(draw, site.world["objects"])
    cell = thing["pose"]["cell"]
    target = draw_target(draw, thing, site.geometries, radius)
    return _settled(Spot(target, cell >> 16, cell if cell in site.rooms else None), site)


_SPOTS: Final[tuple[tuple[tuple[str, ...], Callable[[st.DrawFn, Site, float], Spot]], ...]] = (
    (("landblocks",), draw_on_land),
    (("cells",), draw_in_room),
    (("cells",), draw_at_door),
    (("objects",), draw_at_thing),
    (("landblocks", "buildings"), draw_at_shell),
)
"""What draws a spot, and the parts of a world record that must be there for it."""


def draw_spot(draw: st.DrawFn, site: Site, radius: float) -> Spot:
    """Draw a place at something that the site has."""
    drawers = [drawer for parts, drawer in _SPOTS if all(site.world[part] for part in parts)]
    return pick(draw, drawers)(draw, site, radius)


def draw_indoors(draw: st.DrawFn, site: Site, radius: float) -> Spot:
    """Draw a place in a room or a door."""
    return pick(draw, (draw_at_door, draw_in_room))(draw, site, radius)


def _sides(site: Site, cell: Mapping[str, Any], portal: Mapping[str, Any]) -> tuple[int | None, ...]:
    """Return the cells on the sides of a door that are loaded; None for a land cell."""
    other = portal["other"]
    loaded = site.blocks if other is None else other in site.rooms
    return (cell["id"], other) if loaded else (cell["id"],)


def _settled(spot: Spot, site: Site) -> Spot:
    """Name a place outdoors from the landblock that it is in, if that is loaded."""
    x, y, z = spot.target.center
    east, north = int(x // BLOCK), int(y // BLOCK)
    block = spot.block + (east << 8) + north
    if spot.room is not None or block == spot.block or block not in site.blocks:
        return spot
    center = (x - BLOCK * east, y - BLOCK * north, z)
    return Spot(replace(spot.target, center=center), block)


def _draw_at(
    draw: st.DrawFn, site: Site, geometry: str, pose: Mapping[str, Any], radius: float, *, floors: bool
) -> Target:
    aim = draw_aim(draw, site.geometries[geometry], radius, floors=floors)
    overlap = max(radius - aim.distance, 0.0)
    return Target(turned(pose["rotation"], aim.normal), to_world(pose, aim.center, 1.0), overlap)
