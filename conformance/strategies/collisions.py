"""Queries of `find_collisions` over every dispatch path, and of `transition`."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.contact import draw_aim
from conformance.strategies.meetings import SELDOM, Meeting, Target, draw_meeting, draw_probe
from conformance.strategies.movers import (
    ALLOWANCES,
    CONTACT,
    EDGE_SLIDE,
    FREE_ROTATE,
    ON_WALKABLE,
    PATH_CLIPPED,
    PERFECT_CLIP,
    SCALES,
    VIEWER,
)
from conformance.strategies.numbers import FLAGS, along, anywhere, grid, vectors
from conformance.strategies.poses import CELLS, ROTATIONS, draw_pose, to_world, turned
from conformance.strategies.scenes import GEOMETRIES
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.query import Query
    from conformance.scenes.model import Geometry

_GROUNDED: Final = CONTACT | ON_WALKABLE


@dataclass(frozen=True, slots=True)
class Dispatch:
    """What makes a BSP call take one of its paths (03, FC-1 to FC-8).

    Attributes
    ----------
    states : tuple of int
        Mover states that lead there.
    path : Mapping
        The keys of the PATH block that do; the others stay 0.
    floors : bool
        Whether it looks for something to stand on: then most scenes are upright and the aim is a floor.
    """

    states: tuple[int, ...]
    path: Mapping[str, int] = field(default_factory=dict)
    floors: bool = False


DISPATCHES: Final[Mapping[str, Dispatch]] = {
    "placement": Dispatch((0, EDGE_SLIDE, _GROUNDED), {"insert_type": 1}),
    "ethereal": Dispatch((0, _GROUNDED), {"obstruction_ethereal": 1}),
    "initial_placement": Dispatch((0, EDGE_SLIDE), {"insert_type": 2}),
    "check_walkable": Dispatch((_GROUNDED, _GROUNDED | EDGE_SLIDE), {"check_walkable": 1}, floors=True),
    "step_down": Dispatch((0, _GROUNDED, _GROUNDED | EDGE_SLIDE), {"step_down": 1}, floors=True),
    "collide": Dispatch((EDGE_SLIDE, CONTACT | EDGE_SLIDE), {"collide": 1}, floors=True),
    "contact": Dispatch((_GROUNDED | EDGE_SLIDE, _GROUNDED, CONTACT)),
    "path_clipped": Dispatch((PATH_CLIPPED, PATH_CLIPPED | PERFECT_CLIP)),
    "airborne": Dispatch((EDGE_SLIDE, 0)),
}
"""Every path of a BSP call, by the name that tags of the vector files give it."""

_KINDS: Final = st.sampled_from(("cell", "cell", "static"))
_TRANSITION_STATES: Final = st.sampled_from(
    (
        _GROUNDED | EDGE_SLIDE,
        _GROUNDED | EDGE_SLIDE,
        _GROUNDED,
        EDGE_SLIDE,
        0,
        VIEWER | FREE_ROTATE,
        PATH_CLIPPED,
    )
)
_STATIC_STATES: Final = st.sampled_from((0x10001, 0x10001, 0x10005))
"""Static with a BSP; the last one ethereal too (PhysicsState, 08)."""
_WALK_INTERPS: Final = st.sampled_from((1.0, 1.0, 1.0, 0.5)) | anywhere(0.0, 1.0)
_STEP_DOWNS: Final = st.just(0.5) | grid(0.0, 1.5)


@st.composite
def find_collisions(
    draw: st.DrawFn, dispatch: str, geometries: st.SearchStrategy[Geometry] = GEOMETRIES
) -> Query:
    """Generate queries of one BSP call that takes a given path, in one of the geometries."""
    way = DISPATCHES[dispatch]
    geometry = draw(geometries)
    kind = draw(_KINDS)
    scale = 1.0 if kind == "cell" else draw(SCALES)
    floors = way.floors and not draw(SELDOM)
    pose = draw_pose(draw, draw(CELLS), upright=floors)
    met = _draw_encounter(draw, geometry, pose, scale, draw(st.sampled_from(way.states)), floors=floors)
    record = {
        "op": "find_collisions",
        "geometry": geometry.name,
        "pose": pose,
        "scale": scale,
        "as": kind,
        "mover": met.mover,
        "from": met.start,
        "to": met.end,
        "seed": met.seed,
        "path": draw_path(draw, way),
    }
    return query_from_record(record, {geometry.name: geometry})


@st.composite
def transitions(draw: st.DrawFn, geometries: st.SearchStrategy[Geometry] = GEOMETRIES) -> Query:
    """Generate queries of one `find_valid_position` in a cell, some with a static object in it."""
    geometry = draw(geometries)
    cell = draw(CELLS)
    floors = not draw(SELDOM)
    pose = draw_pose(draw, cell, upright=floors)
    met = _draw_encounter(draw, geometry, pose, 1.0, draw(_TRANSITION_STATES), floors=floors)
    known = {geometry.name: geometry}
    block: dict[str, Any] = {"id": cell, "pose": pose, "geometry": geometry.name}
    if draw(FLAGS):
        obstacle = draw(geometries)
        known[obstacle.name] = obstacle
        block["statics"] = [_draw_static(draw, obstacle.name, met.end)]
    record = {
        "op": "transition",
        "cells": [block],
        "mover": met.mover,
        "from": None if draw(SELDOM) else met.start,
        "to": met.end,
        "begin_cell": cell,
        "seed": met.seed,
        "placement_allows_sliding": draw(FLAGS),
    }
    return query_from_record(record, known)


def _draw_static(draw: st.DrawFn, geometry: str, near: dict[str, Any]) -> dict[str, Any]:
    """Draw a STATIC block a little away from a position."""
    origin = along(near["origin"], draw(vectors(2.0)), 1.0)
    pose = {"cell": near["cell"], "origin": origin, "rotation": draw(ROTATIONS)}
    return {"geometry": geometry, "pose": pose, "scale": draw(SCALES), "state": draw(_STATIC_STATES)}


def _draw_encounter(
    draw: st.DrawFn, geometry: Geometry, pose: dict[str, Any], scale: float, state: int, *, floors: bool
) -> Meeting:
    """Draw a mover about to meet a polygon of a posed geometry."""
    probe = draw_probe(draw, state)
    aim = draw_aim(draw, geometry, probe.radius / scale, floors=floors)
    overlap = max(probe.radius - aim.distance * scale, 0.0)
    target = Target(turned(pose["rotation"], aim.normal), to_world(pose, aim.center, scale), overlap)
    return draw_meeting(draw, probe, target, pose["cell"])


def draw_path(draw: st.DrawFn, way: Dispatch) -> dict[str, Any]:
    """Draw the PATH block of a dispatch path: its own keys and the numbers that it reads."""
    path: dict[str, Any] = {
        "insert_type": 0,
        "walk_interp": draw(_WALK_INTERPS),
        "walkable_allowance": draw(ALLOWANCES),
        **way.path,
    }
    if "insert_type" in way.path:
        path |= {"bldg_check": draw(FLAGS), "hits_interior_cell": draw(FLAGS)}
    if "step_down" in way.path:
        path["step_down_amt"] = draw(_STEP_DOWNS)
    return path
