"""Encounters with objects and houses that aimed queries seldom draw (those with polygons: `encounters`)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.human import MOVER, RADIUS
from conformance.strategies.meetings import draw_meeting, draw_probe
from conformance.strategies.movers import (
    CONTACT,
    EDGE_SLIDE,
    ON_WALKABLE,
    PATH_CLIPPED,
    PERFECT_CLIP,
    draw_identity,
)
from conformance.strategies.numbers import FLAGS, along, anywhere, grid, pick, unit
from conformance.strategies.obstacles import LEVEL, UP
from conformance.strategies.poses import CELLS, IDENTITY, ORIGINS, ROTATIONS
from conformance.strategies.restricted_houses import movers_at_restricted_cells
from conformance.strategies.world_queries import world_query
from conformance.strategies.worlds.furniture import FIRST_THING
from conformance.strategies.worlds.sites import site
from conformance.strategies.worlds.spots import at_outer_door
from conformance.strategies.worlds.things import GRAVITY, STATIC
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from conformance.query import Query
    from conformance.scenes.model import Vec3

_BORDER_SITES: Final = ("border-house", "corner-house")
_BALLS: Final = grid(0.5, 2.0)
_LEANS: Final = st.tuples(grid(-0.5, 0.5), grid(-0.5, 0.5))
"""How far off the middle of a ball one lands, as a multiple of its radius."""
_FALLS: Final = anywhere(0.0625, 1.0)
_DRUMS: Final = grid(0.0625, 0.75)
_INTO: Final = grid(0.0, 0.375)
_DOOR_RADII: Final = st.sampled_from((0.48, 0.25, 1.0))
_TIP: Final = 0.25
"""Radius of an arrow, metres."""
_GAPS: Final = anywhere(0.0, 1.25)
"""How far it stays from the rim, as a multiple of its radius."""
_LAMPS: Final = grid(0.125, 0.5)
"""Radii of what hangs in the air, and heights, metres."""
_HANGING: Final = grid(1.25, 2.0)
"""How high it hangs, metres: a human's second sphere reaches from 0.87 to 1.83."""
_FAMILIES: Final = st.sampled_from(("spheres", "cylspheres"))
_HEAD_STATES: Final = st.sampled_from(
    (CONTACT | ON_WALKABLE | EDGE_SLIDE, CONTACT | EDGE_SLIDE, EDGE_SLIDE, PERFECT_CLIP)
)
_ROOM_OPS: Final = st.sampled_from(("find_cell_list", "world_transition"))


@st.composite
def houses_across_a_border(draw: st.DrawFn) -> Query:
    """Generate cell lists and transitions at an outer door of a house that stands on a border."""
    place = site(pick(draw, _BORDER_SITES))
    if draw(_ROOM_OPS) == "find_cell_list":
        radius = draw(_DOOR_RADII)
        spot = at_outer_door(draw, place, radius)
        position = {"cell": spot.cell(), "origin": spot.target.center, "rotation": IDENTITY}
        inputs: dict[str, Any] = {"position": position, "spheres": [[*spot.target.center, radius]]}
        return world_query({"op": "find_cell_list", "world": place.name, **inputs}, place.world, place)
    probe = draw_probe(draw, CONTACT | ON_WALKABLE | EDGE_SLIDE)
    spot = at_outer_door(draw, place, probe.radius)
    met = draw_meeting(draw, probe, spot.target, spot.cell())
    record = {
        "op": "world_transition",
        "world": place.name,
        "mover": met.mover | draw_identity(draw, ()),
        "from": met.start,
        "to": met.end,
        "seed": met.seed,
    }
    return world_query(record, place.world, place)


@st.composite
def landings_on_a_ball(draw: st.DrawFn) -> Query:
    """Generate falls onto a sphere, on its top or beside it."""
    ball = draw(_BALLS)
    thing = _draw_thing(draw, "spheres", [0.0, 0.0, 0.0, ball])
    dx, dy = draw(_LEANS)
    height = (ball * ball * max(1.0 - dx * dx - dy * dy, 0.0)) ** 0.5
    foot = along(thing["pose"]["origin"], (dx * ball, dy * ball, height), 1.0)
    fall = draw(_FALLS)
    return _object_transition(thing, EDGE_SLIDE, along(foot, UP, 0.5 * fall), along(foot, UP, -0.5 * fall))


@st.composite
def steps_onto_a_drum(draw: st.DrawFn) -> Query:
    """Generate walks against a low cylinder of an object that is turned."""
    radius, height = draw(_BALLS), draw(_DRUMS)
    thing = _draw_thing(draw, "cylspheres", [0.0, 0.0, 0.0, radius, height])
    origin = thing["pose"]["origin"]
    inside = draw(_INTO)
    end = along(origin, (0.0, radius + RADIUS - inside, 0.0), 1.0)
    start = along(end, (0.0, inside + draw(_INTO), 0.0), 1.0)
    return _object_transition(thing, CONTACT | ON_WALKABLE | EDGE_SLIDE, start, end)


@st.composite
def heads_against_something(draw: st.DrawFn) -> Query:
    """Generate movements whose second sphere alone meets a ball or a drum that hangs in the air."""
    size, height = draw(_LAMPS), draw(_HANGING)
    shape = [0.0, 0.0, height, size]
    family = draw(_FAMILIES)
    thing = _draw_thing(draw, family, shape if family == "spheres" else [*shape, draw(_LAMPS)])
    thing["pose"]["rotation"] = IDENTITY
    away, inside = draw(LEVEL), draw(_INTO)
    end = along(thing["pose"]["origin"], away, size + RADIUS - inside)
    start = along(end, away, inside + draw(_INTO))
    return _object_transition(thing, draw(_HEAD_STATES), start, end)


@st.composite
def arrows_over_a_rim(draw: st.DrawFn) -> Query:
    """Generate perfectly clipped movers that come aslant over the rim of a cylinder, from above or below."""
    radius, height = draw(_BALLS), draw(_DRUMS)
    thing = _draw_thing(draw, "cylspheres", [0.0, 0.0, 0.0, radius, height])
    away, (aside, steep) = draw(LEVEL), draw(_LEANS)
    above = draw(FLAGS)
    rim = along(along(thing["pose"]["origin"], away, radius), UP, height * above)
    aslant = unit((away[0] + aside, away[1] - aside, (1.0 if above else -1.0) + steep))
    end = along(rim, aslant, _TIP * draw(_GAPS))
    start = along(end, aslant, 2.0 * _TIP + draw(_FALLS))
    query = _object_transition(thing, PATH_CLIPPED | PERFECT_CLIP, start, end)
    mover = {**query.inputs["mover"], "spheres": [[0.0, 0.0, 0.0, _TIP]]}
    return replace(query, inputs={**query.inputs, "mover": mover})


WORLD_ENCOUNTERS: Final = {
    "house across a border": houses_across_a_border(),
    "landing on a ball": landings_on_a_ball(),
    "step onto a drum": steps_onto_a_drum(),
    "head against something": heads_against_something(),
    "arrow over a rim": arrows_over_a_rim(),
    "restricted cell": movers_at_restricted_cells(),
}
"""Every kind of encounter, by what happens in it."""


def _draw_thing(draw: st.DrawFn, family: str, shape: list[float]) -> dict[str, Any]:
    pose = {"cell": draw(CELLS), "origin": draw(ORIGINS), "rotation": draw(ROTATIONS)}
    state = STATIC if draw(FLAGS) else GRAVITY
    return {"id": FIRST_THING, "pose": pose, "scale": 1.0, "state": state, family: [shape]}


def _object_transition(thing: dict[str, Any], state: int, start: Vec3, end: Vec3) -> Query:
    """Write a transition of an upright human past an object in an empty cell."""
    cell = thing["pose"]["cell"]
    ground = {"plane": [0.0, 0.0, 1.0, -start[2]], "cell": cell, "is_water": 0}
    record = {
        "op": "object_transition",
        "cell": {"id": cell, "pose": thing["pose"] | {"rotation": IDENTITY}, "geometry": None},
        "objects": [thing],
        "mover": MOVER | {"state": state},
        "from": {"cell": cell, "origin": start, "rotation": IDENTITY},
        "to": {"cell": cell, "origin": end, "rotation": IDENTITY},
        "seed": {"contact": ground, "last_known": ground} if state & CONTACT else {},
    }
    return query_from_record(record, {})
