"""Queries of cells: lists, transit, containment, registration."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.meetings import SELDOM
from conformance.strategies.movers import SCALES
from conformance.strategies.numbers import FLAGS, along, grid, pick, vectors
from conformance.strategies.obstacles import draw_obstacle
from conformance.strategies.poses import FACINGS
from conformance.strategies.world_queries import DRAWN_THING, sites_with, world_query
from conformance.strategies.worlds.land import CELL, CELLS_PER_SIDE
from conformance.strategies.worlds.sites import site
from conformance.strategies.worlds.spots import at_outer_door, draw_indoors, draw_spot
from conformance.strategies.worlds.things import HAS_BSP, thing_geometries

if TYPE_CHECKING:
    from conformance.query import Query
    from conformance.scenes.model import Vec3
    from conformance.strategies.worlds.sites import Site
    from conformance.strategies.worlds.spots import Spot

CELL_OPS: Final = (
    "find_cell_list",
    "find_transit_cells",
    "check_building_transit",
    "point_in_cell",
    "cross_cells",
    "add_all_outside_cells",
    "land_find_terrain_poly",
)

_RADII: Final = st.just(0.48) | grid(0.0625, 2.0) | st.sampled_from((13.0, 30.0))
"""Radii of spheres, metres: one that is wider than a land cell, too."""
_COUNTS: Final = st.sampled_from((1, 1, 2, 0))
_HEADROOM: Final = 0.875
"""Height of a mover's second sphere over its first, metres."""
_PORTALS: Final = st.sampled_from((0, 0, 0, 1, -1))
"""Which portal of a room a building's portal leads to; a negative one leads nowhere (09 4.4)."""
_ARRAYS: Final = st.sampled_from((0, 1, 2))
_NUDGES: Final = st.just((0.0, 0.0, 0.0)) | vectors(1.0)
_LAND_CELLS: Final = CELLS_PER_SIDE * CELLS_PER_SIDE


@st.composite
def cell_queries(draw: st.DrawFn, op: str) -> Query:
    """Generate queries of one operation on cells, at doors, walls, borders and houses."""
    needs = {
        "check_building_transit": ("cells",),
        "land_find_terrain_poly": ("landblocks",),
        "find_transit_cells": (),
    }
    place = site(pick(draw, sites_with(*needs.get(op, ()))))
    radius = draw(_RADII)
    spot = _draw_spot(draw, op, place, radius)
    inputs = _INPUTS[op](draw, place, spot, radius)
    return world_query({"op": op, "world": place.name, **inputs}, place.world, place)


def _draw_spot(draw: st.DrawFn, op: str, place: Site, radius: float) -> Spot:
    """Draw a place: half of the time indoors; what is registered stands before a house's door, too."""
    if op == "cross_cells" and place.world["buildings"] and place.blocks and draw(FLAGS):
        return at_outer_door(draw, place, radius)
    indoors = draw(FLAGS) and place.rooms
    return draw_indoors(draw, place, radius) if indoors else draw_spot(draw, place, radius)


def _draw_position(draw: st.DrawFn, spot: Spot, radius: float) -> dict[str, Any]:
    """Draw a position, and the spheres of what is there: none, one, or one above the other."""
    x, y, z = spot.target.center
    count = draw(_COUNTS)
    return {
        "position": {"cell": spot.cell(), "origin": (x, y, z - radius), "rotation": draw(FACINGS)},
        "spheres": [[x, y, z + k * _HEADROOM, radius] for k in range(count)],
    }


def _find_cell_list(draw: st.DrawFn, place: Site, spot: Spot, radius: float) -> dict[str, Any]:
    inputs = _draw_position(draw, spot, radius) | {"do_not_load": draw(FLAGS)}
    if draw(SELDOM) and draw(SELDOM):
        inputs["position"]["cell"] = (spot.cell() & ~0xFFFF) + pick(draw, (0x1FF, 0xFFFF, 0))
    del place
    return inputs


def _find_transit_cells(draw: st.DrawFn, place: Site, spot: Spot, radius: float) -> dict[str, Any]:
    """Ask a cell at the spot, sometimes another one, with some ids in the array already."""
    near = list(dict.fromkeys((spot.cell(), *sorted(place.rooms))))
    cell = pick(draw, near) if draw(SELDOM) else spot.cell()
    array = near[: draw(_ARRAYS)]
    return {"cell": _loaded(place, cell), **_draw_position(draw, spot, radius), "array": array}


def _check_building_transit(draw: st.DrawFn, place: Site, spot: Spot, radius: float) -> dict[str, Any]:
    rooms = sorted(place.rooms)
    cell = spot.room if spot.room is not None and draw(FLAGS) else pick(draw, rooms)
    return {"cell": cell, "portal_id": draw(_PORTALS), **_draw_position(draw, spot, radius)}


def _point_in_cell(draw: st.DrawFn, place: Site, spot: Spot, radius: float) -> dict[str, Any]:
    del radius
    return {"cell": _loaded(place, spot.cell()), "point": _draw_point(draw, spot)}


def _cross_cells(draw: st.DrawFn, place: Site, spot: Spot, radius: float) -> dict[str, Any]:
    """Ask where an object at the spot is registered; those without cylinders have a sorting sphere."""
    thing = draw_obstacle(draw, DRAWN_THING, _loaded(place, spot.cell()), spot.target.center)
    if draw(FLAGS):
        thing = {**thing, "state": thing["state"] | HAS_BSP, "parts": _draw_parts(draw)}
    inputs = {"object": thing, "static": draw(FLAGS)}
    return inputs | ({"sorting_sphere": [*draw(_NUDGES), radius]} if draw(FLAGS) else {})


def _draw_parts(draw: st.DrawFn) -> list[dict[str, Any]]:
    """Draw the parts of an object: one that is missing, too."""
    names = [None, *thing_geometries()]
    return [{"geometry": pick(draw, names), "scale": draw(SCALES)} for _ in range(1 + draw(FLAGS))]


def _add_all_outside_cells(draw: st.DrawFn, place: Site, spot: Spot, radius: float) -> dict[str, Any]:
    del place
    return _draw_position(draw, spot, radius)


def _land_find_terrain_poly(draw: st.DrawFn, place: Site, spot: Spot, radius: float) -> dict[str, Any]:
    """Ask the land cell of the point, sometimes a neighbour, so that borders belong to both."""
    del radius
    block = spot.block if spot.block in place.blocks else min(place.blocks)
    x, y, _ = point = _draw_point(draw, spot)
    column, row = (min(max(int(v // CELL) - draw(FLAGS), 0), CELLS_PER_SIDE - 1) for v in (x, y))
    return {"cell": block << 16 | column * CELLS_PER_SIDE + row + 1, "point": point}


def _draw_point(draw: st.DrawFn, spot: Spot) -> Vec3:
    return along(spot.target.center, draw(_NUDGES), 1.0)


def _loaded(place: Site, cell: int) -> int:
    """Return a cell, or one that is loaded in its stead."""
    if cell in place.rooms or (cell >> 16 in place.blocks and 0 < cell & 0xFFFF <= _LAND_CELLS):
        return cell
    return min(place.rooms, default=(min(place.blocks, default=0) << 16) + 1)


_INPUTS: Final = {
    "find_cell_list": _find_cell_list,
    "find_transit_cells": _find_transit_cells,
    "check_building_transit": _check_building_transit,
    "point_in_cell": _point_in_cell,
    "cross_cells": _cross_cells,
    "add_all_outside_cells": _add_all_outside_cells,
    "land_find_terrain_poly": _land_find_terrain_poly,
}
