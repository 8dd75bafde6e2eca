"""Encounters that aimed queries almost never draw: each is a scene of its own, with numbers at random.

They stand for mistakes that real ports have made and that need several things at once to show: the rim of
a bounding sphere, the far side of a corner, a normal that leans, a head under a beam.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.inputs import REQUIRED
from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.polygons import place
from conformance.scenes.primitives import make
from conformance.scenes.records import geometry_from_record
from conformance.strategies.collisions import transitions
from conformance.strategies.human import MOVER
from conformance.strategies.math_queries import mover_queries
from conformance.strategies.movers import CONTACT, EDGE_SLIDE, ON_WALKABLE
from conformance.strategies.numbers import EPS, FLAGS, grid, vectors
from conformance.strategies.poses import CELLS, IDENTITY, draw_pose, to_world, turned
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from conformance.query import Query
    from conformance.scenes.model import Geometry, Vec3
    from conformance.scenes.polygons import Shape

_HALF: Final = 9.0
"""Half the edge of a floor, metres."""
_BEAM_FROM: Final = 1.1
"""Lower edge of a beam: above the feet, in the way of the head; metres."""
_STATIC_WITH_BSP: Final = 0x10001

_RIM_OPS: Final = st.sampled_from(
    ("bsp_sphere_intersects_poly", "bsp_sphere_intersects_solid", "bsp_hits_walkable", "bsp_find_walkable")
)
_CORNER_OPS: Final = st.sampled_from(("polygon_check_walkable", "polygon_check_small_walkable"))
_RIMS: Final = st.sampled_from((0.5, 1.0, 1.5, 2.0))
_RIM_RADII: Final = grid(0.25, 0.75)
_GAPS: Final = st.sampled_from((0.0, 0.25, 0.5, 0.75, 1.5, -0.5))
"""Squared gaps between two spheres, multiples of EPS: retail lets those below 1 meet."""
_BACKS: Final = grid(0.05, 0.4)
_AHEADS: Final = grid(0.5, 0.75)
_ASIDES: Final = st.sampled_from((0.0, 0.0, 0.125))
_SEEDED: Final = mover_queries("adjust_offset") | transitions()
_NORMALS: Final = vectors(1.0)


@st.composite
def rim_queries(draw: st.DrawFn) -> Query:
    """Generate tree queries of a sphere at the rim of a leaf's bounding sphere, over a floor beyond it."""
    rim, radius = draw(_RIMS), draw(_RIM_RADII)
    reach = rim + radius
    distance = (reach * reach + draw(_GAPS) * EPS) ** 0.5
    inputs: dict[str, Any] = {
        "sphere": [distance, 0.0, 0.0, radius],
        "movement": [0.0, 0.0, -1.0],
        "up": [0.0, 0.0, 1.0],
        "center_check": draw(FLAGS),
        "walkable_allowance": 0.66417414,
        "walk_interp": 1.0,
    }
    geometry = _floor_beyond(rim)
    op = draw(_RIM_OPS)
    given = {key: inputs[key] for key in REQUIRED[op] if key != "geometry"}
    return query_from_record({"op": op, "geometry": geometry.name, **given}, {geometry.name: geometry})


@st.composite
def corner_queries(draw: st.DrawFn) -> Query:
    """Generate walkable checks of a sphere that is outside two edges of a floor, near their corner."""
    floor = _floor_beyond(draw(_RIMS))
    center = [_HALF + draw(_BACKS), _HALF + draw(_BACKS), draw(_RIM_RADII)]
    given = {"poly": 0, "sphere": [*center, draw(_RIM_RADII)], "up": [0.0, 0.0, 1.0]}
    return query_from_record({"op": draw(_CORNER_OPS), "geometry": floor.name, **given}, {floor.name: floor})


@st.composite
def leaning_normals(draw: st.DrawFn) -> Query:
    """Generate offsets and transitions that are seeded with a sliding normal that is not level."""
    query = draw(_SEEDED)
    seed = {**query.inputs["seed"], "sliding": list(draw(_NORMALS))}
    return replace(query, inputs={**query.inputs, "seed": seed})


@st.composite
def backs_to_the_wall(draw: st.DrawFn) -> Query:
    """Generate transitions that leave a wall, overlapped from behind, towards a beam at head height."""
    pose = draw_pose(draw, draw(CELLS), upright=True)
    alley, beam = _alley(draw(_BACKS)), _beam(draw(_AHEADS))
    static = {"geometry": beam.name, "pose": pose, "scale": 1.0, "state": _STATIC_WITH_BSP}
    ground = {"plane": [0.0, 0.0, 1.0, -pose["origin"][2]], "cell": pose["cell"], "is_water": 0}
    record = {
        "op": "transition",
        "cells": [_cell(pose, alley) | {"statics": [static]}],
        "mover": {**MOVER, "state": CONTACT | ON_WALKABLE | EDGE_SLIDE},
        "from": _standing(pose, (0.0, 0.0, 0.0)),
        "to": _standing(pose, (draw(_ASIDES), draw(_BACKS), 0.0)),
        "begin_cell": pose["cell"],
        "seed": {"contact": ground, "last_known": ground},
    }
    return query_from_record(record, {alley.name: alley, beam.name: beam})


@st.composite
def jumps_under_a_beam(draw: st.DrawFn) -> Query:
    """Generate walks that land, leave the plane they stand on, and hit their head."""
    pose = draw_pose(draw, draw(CELLS), upright=True)
    room = _floor_and_beam(draw(_AHEADS))
    forward = turned(pose["rotation"], (draw(_ASIDES), 0.5, 0.0))
    record = {
        "op": "walk",
        "cells": [_cell(pose, room)],
        "mover": {**MOVER, "state": EDGE_SLIDE},
        "start": _standing(pose, (0.0, 0.0, draw(_BACKS))),
        "ticks": [
            {"move": [0.0, 0.0, -0.5]},
            {"move": [forward[0], forward[1], draw(_BACKS)], "contact_ok": 0},
            {"move": [forward[0], forward[1], 0.0]},
        ],
    }
    return query_from_record(record, {room.name: room})


ENCOUNTERS: Final = {
    "rim of a bounding sphere": rim_queries(),
    "past a corner": corner_queries(),
    "leaning normal": leaning_normals(),
    "back to the wall": backs_to_the_wall(),
    "jump under a beam": jumps_under_a_beam(),
}
"""Every kind of encounter, by what happens in it."""


def _standing(pose: dict[str, Any], point: Vec3) -> dict[str, Any]:
    """Write the POSE of an upright mover at a point of a posed geometry."""
    return {"cell": pose["cell"], "origin": to_world(pose, point, 1.0), "rotation": IDENTITY}


def _cell(pose: dict[str, Any], geometry: Geometry) -> dict[str, Any]:
    return {"id": pose["cell"], "pose": pose, "geometry": geometry.name}


@cache
def _floor_beyond(rim: float) -> Geometry:
    """Make a floor in a leaf whose bounding sphere does not reach its corners."""
    corners = [[-_HALF, -_HALF, 0.0], [_HALF, -_HALF, 0.0], [_HALF, _HALF, 0.0], [-_HALF, _HALF, 0.0]]
    leaf = {"leaf": 0, "solid": 0, "sphere": [0.0, 0.0, 0.0, rim], "polys": [0]}
    record = {"name": f"rim-{rim}", "vertices": corners, "polygons": [{"v": [0, 1, 2, 3]}], "bsp": leaf}
    return geometry_from_record(record, "rim")


@cache
def _alley(back: float) -> Geometry:
    """Make a floor with a wall behind the mover, facing the way it goes."""
    wall = place(make("wall", {"length": _HALF, "height": 3.0}), at=(0.0, -back, 0.0), yaw=0.0)
    return build(f"alley-{back}", [*_floor(), *wall], style=TreeStyle.BOTH, kind="encounter")


@cache
def _beam(ahead: float) -> Geometry:
    return build(f"beam-{ahead}", _beam_shape(ahead), style=TreeStyle.BOTH, kind="encounter")


@cache
def _floor_and_beam(ahead: float) -> Geometry:
    shape = [*_floor(), *_beam_shape(ahead)]
    return build(f"floor-beam-{ahead}", shape, style=TreeStyle.BOTH, kind="encounter")


def _floor() -> Shape:
    return make("floor", {"size": (2 * _HALF, 2 * _HALF)})


def _beam_shape(ahead: float) -> Shape:
    """Make a wall ahead of the mover, facing it, that begins above its feet."""
    wall = make("wall", {"length": _HALF, "height": 2.0})
    return place(wall, at=(0.0, ahead, _BEAM_FROM), yaw=180.0)
