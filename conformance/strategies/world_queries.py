"""Queries in a world: whole transitions, and calls of the ground alone."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.inputs import read_block
from conformance.strategies.collisions import DISPATCHES, draw_path
from conformance.strategies.meetings import SELDOM, draw_meeting, draw_probe
from conformance.strategies.movers import (
    CONTACT,
    EDGE_SLIDE,
    FREE_ROTATE,
    IGNORE_CREATURES,
    ON_WALKABLE,
    PATH_CLIPPED,
    PERFECT_CLIP,
    PLAYER,
    VIEWER,
    draw_identity,
)
from conformance.strategies.numbers import DIRECTIONS, FLAGS, NEARLY, anywhere, pick
from conformance.strategies.obstacles import draw_obstacle
from conformance.strategies.worlds.furniture import FIRST_THING
from conformance.strategies.worlds.shadows import registered
from conformance.strategies.worlds.sites import SITES, site
from conformance.strategies.worlds.spots import draw_on_land, draw_spot
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.query import Query
    from conformance.strategies.meetings import Probe
    from conformance.strategies.worlds.sites import Site
    from conformance.strategies.worlds.spots import Spot

LAND_OPS: Final = ("land_find_env_collisions", "land_validate_walkable")
DRAWN_THING: Final = FIRST_THING + 0x1000
"""Id of an object that only one query has."""

_GROUNDED: Final = CONTACT | ON_WALKABLE
_STATES: Final = st.sampled_from(
    (
        _GROUNDED | EDGE_SLIDE,
        _GROUNDED | EDGE_SLIDE | PLAYER,
        _GROUNDED | EDGE_SLIDE,
        EDGE_SLIDE,
        _GROUNDED,
        CONTACT | EDGE_SLIDE,
        _GROUNDED | EDGE_SLIDE | IGNORE_CREATURES,
        VIEWER | FREE_ROTATE,
        PATH_CLIPPED,
        PATH_CLIPPED | PERFECT_CLIP,
        0,
    )
)
_LAND_STATES: Final = st.sampled_from((_GROUNDED | EDGE_SLIDE, _GROUNDED, EDGE_SLIDE, CONTACT, 0, VIEWER))
_LAND_DISPATCHES: Final = st.sampled_from(("contact", "airborne", "step_down", "check_walkable", "placement"))
_DEPTHS: Final = st.sampled_from((0.0, 0.1, 0.45, 0.9))
_UPWARD: Final = DIRECTIONS.map(lambda n: (n[0], n[1], abs(n[2]))) | st.just((0.0, 0.0, 1.0))
_HEIGHTS: Final = st.tuples(anywhere(-1.0, 1.0) | st.just(0.0), NEARLY).map(sum)
_FIRST_ROOM: Final = 0x100
"""Low word of a block's first interior cell."""


@cache
def sites_with(*parts: str) -> tuple[str, ...]:
    """Return the names of the sites whose world has something of each of its parts."""
    return tuple(name for name in SITES if all(site(name).world[part] for part in parts))


@st.composite
def world_transitions(draw: st.DrawFn) -> Query:
    """Generate transitions at everything there is in a world."""
    place = site(pick(draw, SITES))
    probe = draw_probe(draw, draw(_STATES))
    spot = draw_spot(draw, place, probe.radius)
    met = draw_meeting(draw, probe, spot.target, spot.cell())
    world = place.world
    if draw(SELDOM):
        world = with_obstacle(draw, place, spot)
    record = {
        "op": "world_transition",
        "world": place.name,
        "mover": met.mover | draw_identity(draw, [thing["id"] for thing in world["objects"]]),
        "from": None if draw(SELDOM) and draw(SELDOM) else met.start,
        "to": met.end,
        "seed": met.seed,
        "placement_allows_sliding": draw(FLAGS),
    }
    return world_query(record, world, place)


@st.composite
def land_queries(draw: st.DrawFn, op: str) -> Query:
    """Generate calls of a land cell's ground, or of the test of one plane that it ends in."""
    place = site(pick(draw, sites_with("landblocks")))
    way = DISPATCHES[draw(_LAND_DISPATCHES)]
    probe = draw_probe(draw, draw(_LAND_STATES))
    spot = draw_on_land(draw, place, probe.radius)
    met = draw_meeting(draw, probe, spot.target, spot.cell())
    if probe.mover["state"] & VIEWER and draw(FLAGS):
        met.start["cell"] = (met.start["cell"] & ~0xFFFF) + _FIRST_ROOM
    record: dict[str, Any] = {
        "op": op,
        "world": place.name,
        "cell": spot.cell(),
        "mover": met.mover | draw_identity(draw, ()),
        "from": met.start,
        "to": met.end,
        "seed": met.seed,
        "path": draw_path(draw, way),
    }
    if op == "land_validate_walkable":
        record |= _draw_plane(draw, spot, probe)
    return world_query(record, place.world, place)


def world_query(record: Mapping[str, Any], world: Mapping[str, Any], place: Site) -> Query:
    """Read a query's record, its world being a site's or a copy with more in it."""
    return query_from_record(record, place.geometries, worlds={place.name: world})


def with_obstacle(draw: st.DrawFn, place: Site, spot: Spot) -> dict[str, Any]:
    """Draw an object near a spot, and return the site's world with it."""
    thing = read_block(draw_obstacle(draw, DRAWN_THING, spot.cell(), spot.target.center))
    return registered(place.world, place.geometries, thing)


def _draw_plane(draw: st.DrawFn, spot: Spot, probe: Probe) -> dict[str, Any]:
    """Draw a plane under a sphere, about as far below as the water is deep."""
    normal, depth = draw(_UPWARD), draw(_DEPTHS)
    x, y, z = spot.target.center
    foot = (x, y, z - probe.radius + depth + draw(_HEIGHTS))
    plane = [*normal, -sum(n * p for n, p in zip(normal, foot, strict=True))]
    return {
        "sphere": [x, y, z, probe.radius],
        "plane": plane,
        "is_water": draw(FLAGS),
        "water_depth": depth,
    }
