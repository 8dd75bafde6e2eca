"""Walks at random: a mover put near a polygon and driven about, recorded moves or a body by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.contact import draw_aim
from conformance.strategies.movers import EDGE_SLIDE, FREE_ROTATE, draw_mover
from conformance.strategies.numbers import FLAGS, along, anywhere
from conformance.strategies.poses import CELLS, FACINGS, IDENTITY, draw_pose, to_world, turned
from conformance.strategies.scenes import GEOMETRIES
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Query

TICKS: Final = 60
"""Ticks of a walk: two seconds at thirty a second."""
MOST_SEGMENTS: Final = 5
"""Changes of direction; each segment is held for an equal part of the walk."""
ACTIVE: Final = 0x80
"""Bit of a body's transient state: it is moved at all (04 1.4)."""
GRAVITY: Final = (0.0, 0.0, -9.8)
"""Acceleration of a body in the air, m/s^2."""

_STATES: Final = st.sampled_from((EDGE_SLIDE, EDGE_SLIDE, EDGE_SLIDE, 0, FREE_ROTATE))
_BODY_STATES: Final = st.sampled_from((0x400408, 0x400408, 0x400408, 0x408, 0x420408))
"""Reports collisions, has gravity; mostly slides along edges; the last one is inelastic (04 1.5)."""
_SELDOM: Final = st.sampled_from((False, False, False, True))
_LEVEL: Final = st.sampled_from((0.0, 0.0, 0.0, -0.1, 0.1))
_STRIDES: Final = st.tuples(anywhere(-0.25, 0.25), anywhere(-0.25, 0.25), _LEVEL)
"""Moves of a tick, metres: up to about 10 m/s."""
_VELOCITIES: Final = st.tuples(
    anywhere(-6.0, 6.0), anywhere(-6.0, 6.0), st.sampled_from((0.0, 0.0, 3.0, -3.0))
)
_QUANTA: Final = st.sampled_from((1.0 / 30.0, 1.0 / 30.0, 0.2)) | anywhere(0.03125, 0.1875)
"""Seconds of a tick: retail steps by a thirtieth to a fifth."""
_DOWN: Final = (0.0, 0.0, -0.5)
"""The first move, metres: to the ground, if there is one below."""


@st.composite
def walks(draw: st.DrawFn) -> Query:
    """Generate walks of recorded moves."""
    mover = draw_mover(draw, draw(_STATES))
    known, record = _draw_place(draw, mover)
    ticks = [{"move": _DOWN}, *_draw_ticks(draw, _draw_move)]
    walk = {"op": "walk", **record, "mover": mover, "ticks": ticks[:TICKS]}
    return query_from_record(walk, known)


@st.composite
def body_walks(draw: st.DrawFn) -> Query:
    """Generate walks of a body that moves by itself."""
    mover = draw_mover(draw, 0)
    known, record = _draw_place(draw, mover)
    keys = ("spheres", "scale", "step_up_height", "step_down_height")
    body = {
        **{key: mover[key] for key in keys},
        "position": record.pop("start"),
        "state": draw(_BODY_STATES),
        "transient_state": ACTIVE,
        "velocity": draw(_VELOCITIES),
        "acceleration": GRAVITY,
        "movement_manager": draw(FLAGS),
    }
    walk = {"op": "body_walk", **record, "body": body, "ticks": _draw_ticks(draw, _draw_input)}
    return query_from_record(walk, known)


def _draw_place(draw: st.DrawFn, mover: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Draw a cell, and where in it the mover begins: its first sphere near a polygon."""
    geometry = draw(GEOMETRIES)
    cell = draw(CELLS)
    upright = not draw(_SELDOM)
    pose = draw_pose(draw, cell, upright=upright)
    x, y, z, radius = (part * mover["scale"] for part in mover["spheres"][0])
    aim = draw_aim(draw, geometry, radius, floors=upright)
    facing = draw(FACINGS) if draw(_SELDOM) else IDENTITY
    origin = along(to_world(pose, aim.center, 1.0), turned(facing, (x, y, z)), -1.0)
    start = {"cell": cell, "origin": origin, "rotation": facing}
    cells = [{"id": cell, "pose": pose, "geometry": geometry.name}]
    return {geometry.name: geometry}, {"cells": cells, "start": start}


def _draw_ticks(draw: st.DrawFn, draw_tick: Callable[[st.DrawFn], dict[str, Any]]) -> list[dict[str, Any]]:
    """Draw a few ways to move and hold each."""
    segments = draw(st.integers(1, MOST_SEGMENTS))
    held = [draw_tick(draw) for _ in range(segments)]
    return [held[tick * segments // TICKS] for tick in range(TICKS)]


def _draw_move(draw: st.DrawFn) -> dict[str, Any]:
    tick: dict[str, Any] = {"move": draw(_STRIDES)}
    if draw(_SELDOM):
        tick["rotation"] = draw(FACINGS)
    return {**tick, "contact_ok": 0} if draw(_SELDOM) and draw(_SELDOM) else tick


def _draw_input(draw: st.DrawFn) -> dict[str, Any]:
    tick: dict[str, Any] = {"q": draw(_QUANTA)}
    way = draw(st.sampled_from(("set_velocity", "set_velocity", "set_local_velocity", "")))
    if way:
        tick[way] = draw(_VELOCITIES)
    return {**tick, "omega": (0.0, 0.0, draw(anywhere(-2.0, 2.0)))} if draw(_SELDOM) else tick
