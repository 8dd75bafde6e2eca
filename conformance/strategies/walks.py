"""Walks at random: a mover put near a polygon and driven about, recorded moves or a body by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.strategies.contact import draw_aim
from conformance.strategies.meetings import SELDOM
from conformance.strategies.movers import EDGE_SLIDE, FREE_ROTATE, draw_mover
from conformance.strategies.numbers import FLAGS, along, anywhere, pick
from conformance.strategies.poses import CELLS, FACINGS, IDENTITY, draw_pose, to_world, turned
from conformance.strategies.scenes import GEOMETRIES
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

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
_SEGMENTS: Final = st.integers(1, MOST_SEGMENTS)
_SPINS: Final = anywhere(-2.0, 2.0)
"""Turning speeds, rad/s."""
_LEVEL: Final = st.sampled_from((0.0, 0.0, 0.0, -0.1, 0.1))
_STRIDES: Final = st.tuples(anywhere(-0.25, 0.25), anywhere(-0.25, 0.25), _LEVEL)
"""Moves of a tick, metres: up to about 10 m/s."""
_VELOCITIES: Final = st.tuples(
    anywhere(-6.0, 6.0), anywhere(-6.0, 6.0), st.sampled_from((0.0, 0.0, 3.0, -3.0))
)
QUANTA: Final = st.sampled_from((1.0 / 30.0, 1.0 / 30.0, 0.2)) | anywhere(0.03125, 0.1875)
"""Seconds of a tick: retail steps by a thirtieth to a fifth."""
DOWN: Final = (0.0, 0.0, -0.5)
"""The first move, metres: to the ground, if there is one below."""


@st.composite
def walks(draw: st.DrawFn) -> Query:
    """Generate walks of recorded moves."""
    mover = draw_mover(draw, draw(_STATES))
    known, record = _draw_place(draw, mover)
    ticks = [{"move": DOWN}, *spread(draw_segments(draw, draw_move))]
    walk = {"op": "walk", **record, "mover": mover, "ticks": ticks[:TICKS]}
    return query_from_record(walk, known)


@st.composite
def body_walks(draw: st.DrawFn) -> Query:
    """Generate walks of a body that moves by itself."""
    mover = draw_mover(draw, 0)
    known, record = _draw_place(draw, mover)
    body = draw_body(draw, mover, record.pop("start"))
    ticks = spread(draw_segments(draw, draw_input))
    return query_from_record({"op": "body_walk", **record, "body": body, "ticks": ticks}, known)


def draw_body(draw: st.DrawFn, mover: dict[str, Any], position: dict[str, Any]) -> dict[str, Any]:
    """Draw the BODY of a mover in the air at a position, thrown or at rest."""
    keys = ("spheres", "scale", "step_up_height", "step_down_height")
    return {
        **{key: mover[key] for key in keys},
        "position": position,
        "state": draw(_BODY_STATES),
        "transient_state": ACTIVE,
        "velocity": draw(_VELOCITIES),
        "acceleration": GRAVITY,
        "movement_manager": draw(FLAGS),
    }


def draw_segments(draw: st.DrawFn, draw_tick: Callable[[st.DrawFn], dict[str, Any]]) -> list[dict[str, Any]]:
    """Draw a few ways to move."""
    return [draw_tick(draw) for _ in range(draw(_SEGMENTS))]


def spread(held: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the ticks of a walk that holds each way to move for an equal part of it."""
    return [held[tick * len(held) // TICKS] for tick in range(TICKS)]


def draw_move(draw: st.DrawFn) -> dict[str, Any]:
    """Draw a tick of recorded moves; seldom it turns, or leaves the ground."""
    tick: dict[str, Any] = {"move": draw(_STRIDES)}
    if draw(SELDOM):
        tick["rotation"] = draw(FACINGS)
    return {**tick, "contact_ok": 0} if draw(SELDOM) and draw(SELDOM) else tick


def draw_input(draw: st.DrawFn) -> dict[str, Any]:
    """Draw a tick of a body: its length, and mostly a velocity."""
    tick: dict[str, Any] = {"q": draw(QUANTA)}
    way = pick(draw, ("set_velocity", "set_velocity", "set_local_velocity", ""))
    if way:
        tick[way] = draw(_VELOCITIES)
    return {**tick, "omega": (0.0, 0.0, draw(_SPINS))} if draw(SELDOM) else tick


def _draw_place(draw: st.DrawFn, mover: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Draw a cell, and where in it the mover begins: its first sphere near a polygon."""
    geometry = draw(GEOMETRIES)
    cell = draw(CELLS)
    upright = not draw(SELDOM)
    pose = draw_pose(draw, cell, upright=upright)
    x, y, z, radius = (part * mover["scale"] for part in mover["spheres"][0])
    aim = draw_aim(draw, geometry, radius, floors=upright)
    facing = draw(FACINGS) if draw(SELDOM) else IDENTITY
    origin = along(to_world(pose, aim.center, 1.0), turned(facing, (x, y, z)), -1.0)
    start = {"cell": cell, "origin": origin, "rotation": facing}
    cells = [{"id": cell, "pose": pose, "geometry": geometry.name}]
    return {geometry.name: geometry}, {"cells": cells, "start": start}
