"""Walks in a world: through doors, over borders, into things; recorded moves, or a body by itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.meetings import SELDOM, Target
from conformance.strategies.movers import EDGE_SLIDE, FREE_ROTATE, draw_identity, draw_mover
from conformance.strategies.numbers import FLAGS, along, anywhere, grid, pick, unit
from conformance.strategies.poses import IDENTITY
from conformance.strategies.walks import (
    DOWN,
    QUANTA,
    TICKS,
    draw_body,
    draw_input,
    draw_move,
    draw_segments,
    spread,
)
from conformance.strategies.world_queries import with_obstacle, world_query
from conformance.strategies.worlds.sites import SITES, site
from conformance.strategies.worlds.spots import Spot, draw_at_door, draw_spot

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.query import Query
    from conformance.scenes.model import Vec3
    from conformance.strategies.worlds.sites import Site

_STATES: Final = st.sampled_from((EDGE_SLIDE, EDGE_SLIDE, EDGE_SLIDE, 0, FREE_ROTATE))
_APPROACHES: Final = grid(0.5, 4.0)
"""How far from what it is aimed at a walk begins, metres."""
_STRIDES: Final = anywhere(0.0625, 0.25)
"""Level length of a tick's move, metres."""
_DRIFTS: Final = st.tuples(anywhere(-0.25, 0.25), anywhere(-0.25, 0.25))
"""What is added to the direction of a walk, a pure number."""
_SINKS: Final = st.sampled_from((0.0, 0.0, -0.05, -0.1))
"""Downward part of a tick's move, metres."""
_SPEEDS: Final = anywhere(1.0, 6.0)
"""Metres per second."""


@dataclass(frozen=True, slots=True)
class _Tour:
    """A walk's beginning: its site, its world (the site's, or with one more thing), and the way ahead."""

    place: Site
    world: Mapping[str, Any]
    mover: dict[str, Any]
    start: dict[str, Any]
    ahead: Vec3


@st.composite
def world_walks(draw: st.DrawFn) -> Query:
    """Generate walks of recorded moves."""
    tour = _draw_tour(draw)
    stride = draw(_STRIDES)
    onward = {"move": (tour.ahead[0] * stride, tour.ahead[1] * stride, draw(_SINKS))}
    ticks = [{"move": DOWN}, *spread([onward, *draw_segments(draw, draw_move)])]
    mover = tour.mover | draw_identity(draw, [thing["id"] for thing in tour.world["objects"]])
    record = {
        "op": "world_walk",
        "world": tour.place.name,
        "mover": mover,
        "start": tour.start,
        "ticks": ticks[:TICKS],
    }
    return world_query(record, tour.world, tour.place)


@st.composite
def world_body_walks(draw: st.DrawFn) -> Query:
    """Generate walks of a body that moves by itself."""
    tour = _draw_tour(draw)
    speed = draw(_SPEEDS)
    onward = {"q": draw(QUANTA), "set_velocity": tuple(speed * part for part in tour.ahead)}
    record = {
        "op": "body_walk",
        "world": tour.place.name,
        "body": draw_body(draw, tour.mover, tour.start),
        "ticks": spread([onward, *draw_segments(draw, draw_input)]),
    }
    return world_query(record, tour.world, tour.place)


def _draw_tour(draw: st.DrawFn) -> _Tour:
    """Draw a site, a mover, and a way that leads it to a door or anything else."""
    place = site(pick(draw, SITES))
    mover = draw_mover(draw, draw(_STATES))
    x, y, z, radius = (part * mover["scale"] for part in mover["spheres"][0])
    drawer = draw_at_door if draw(FLAGS) and place.rooms else draw_spot
    spot = drawer(draw, place, radius)
    ahead = _draw_ahead(draw, spot)
    begun = along(spot.target.center, ahead, -draw(_APPROACHES))
    start = {
        "cell": place.cell_at(spot.block, begun, otherwise=spot.cell()),
        "origin": along(begun, (x, y, z), -1.0),
        "rotation": IDENTITY,
    }
    world = with_obstacle(draw, place, _ahead_of(spot, begun)) if draw(SELDOM) else place.world
    return _Tour(place, world, mover, start, ahead)


def _draw_ahead(draw: st.DrawFn, spot: Spot) -> Vec3:
    """Draw a level direction against the target's normal, or along it: through a door either way."""
    nx, ny, _ = spot.target.normal
    dx, dy = draw(_DRIFTS)
    sign = pick(draw, (-1.0, 1.0))
    level = unit((sign * nx + dx, sign * ny + dy, 0.0))
    return level if any(level) else (1.0, 0.0, 0.0)


def _ahead_of(spot: Spot, begun: Vec3) -> Spot:
    """Return the middle of the way from where a walk begins to its target."""
    cx, cy, cz = (0.5 * (a + b) for a, b in zip(begun, spot.target.center, strict=True))
    return Spot(Target(spot.target.normal, (cx, cy, cz), 0.0), spot.block, spot.room)
