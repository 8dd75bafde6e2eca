"""Comparisons of document 05 that only a whole move decides: steps at their limits, and moves too short."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, Final

from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.polygons import place
from conformance.scenes.primitives import floor
from conformance.scenes.solids import box
from conformance.strategies.human import HUMAN, MOVER, RADIUS
from conformance.stress.comparisons.base import Comparison
from conformance.stress.moves import CELL, IDENTITY, ON_GROUND, pose
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.query import Fields, Query
    from conformance.scenes.model import Geometry, Vec3

STEP: Final = 0.5
"""Height of the step, metres."""
_BALL: Final = ((0.0, 0.0, RADIUS, RADIUS),)
"""The only sphere of a mover that is stepped down without halves."""
_PROBE_AXES: Final = ("step_down_height (m)", "end y (m)")
_HEIGHT_AXES: Final = ("step_down_height (m)", "end x (m)")
SHARE: Final = 4
"""What the edge of the squares is divided by: a whole move takes a thousand times as long as one call."""


@cache
def _step() -> Geometry:
    """Make a floor with a block that is one step high."""
    shape = floor(size=(8.0, 8.0)) + place(box(size=(2.0, 4.0, STEP))[1:], (2.0, 0.0, 0.0), 0.0)
    return build("step", shape, style=TreeStyle.BOTH, kind="stress")


@cache
def _ledge() -> Geometry:
    """Make a floor with a larger one below it, deeper than a sphere's radius and not as deep as two."""
    shape = floor(size=(4.0, 4.0)) + place(floor(size=(10.0, 10.0)), (0.0, 0.0, -0.75), 0.0)
    return build("ledge", shape, style=TreeStyle.BOTH, kind="stress")


def _probe(limit: float, y: float, spheres: Sequence[Sequence[float]]) -> Query:
    """Go out over the rim of a floor: what is below is felt for, by the step's height or by less."""
    geometry = _ledge()
    record: dict[str, Any] = {
        "op": "transition",
        "cells": [{"id": CELL, "pose": pose(IDENTITY, (0.0, 0.0, 0.0)), "geometry": geometry.name}],
        "mover": {**MOVER, "spheres": spheres, "state": 0x203, "step_down_height": limit},
        "from": pose(IDENTITY, (1.99, -0.2, 0.0)),
        "to": pose(IDENTITY, (2.38, y, 0.0)),
        "begin_cell": CELL,
        "seed": {"contact": {"plane": [0.0, 0.0, 1.0, 0.0], "cell": CELL, "is_water": 0}},
    }
    return query_from_record(record, {geometry.name: geometry})


def _probe_of_one(limit: float, y: float) -> Query:
    return _probe(limit, y, _BALL)


def _probe_of_two(limit: float, y: float) -> Query:
    return _probe(limit, y, HUMAN)


def _goes_out(fields: Fields) -> bool:
    return bool(fields["curr"]["origin"][0] > 2.3)


def _move(start: Vec3, end: Vec3, height: float, **mover: Any) -> Query:
    plane = {"plane": [0.0, 0.0, 1.0, -height], "cell": CELL, "is_water": 0}
    record: dict[str, Any] = {
        "op": "transition",
        "cells": [{"id": CELL, "pose": pose(IDENTITY, (0.0, 0.0, 0.0)), "geometry": _step().name}],
        "mover": {**MOVER, "spheres": HUMAN, "state": ON_GROUND, **mover},
        "from": pose(IDENTITY, start),
        "to": pose(IDENTITY, end),
        "begin_cell": CELL,
        "seed": {"contact": plane, "last_known": plane},
    }
    return query_from_record(record, {_step().name: _step()})


def _up(limit: float, x: float) -> Query:
    return _move((0.4, 0.1, 0.0), (x, 0.1, 0.0), 0.0, step_up_height=limit)


def _down(limit: float, x: float) -> Query:
    start, end = (1.3, 0.1, STEP), (x, 0.1, STEP)
    return _move(start, end, STEP, step_down_height=limit, state=0x103)


def _short(x: float, y: float) -> Query:
    return _move((-2.0, 0.1, 0.0), (x, y, 0.0), 0.0)


def _one_sphere(limit: float, x: float) -> Query:
    return _off_the_block(x, step_down_height=limit, state=0x103, spheres=_BALL)


def _two_spheres(limit: float, x: float) -> Query:
    return _off_the_block(x, step_down_height=limit, state=0x103)


def _off_the_block(x: float, **mover: Any) -> Query:
    return _move((1.3, 0.1, STEP), (x, 0.1, STEP), STEP, **mover)


def _stopped(height: float, x: float) -> Query:
    """Be stopped at the block's edge over a last known plane at a height: near enough it is stood upon."""
    return _move((0.85, 0.1, STEP), (x, 0.1, STEP), height, step_down_height=1.2, spheres=_BALL)


def _is_up(fields: Fields) -> bool:
    return bool(fields["curr"]["origin"][2] > STEP / 2)


def _is_down(fields: Fields) -> bool:
    return bool(fields["contact_plane"]["valid"])


def _has_moved(fields: Fields) -> bool:
    return bool(fields["curr"]["origin"][0] > -2.0)


def _goes_in_halves(fields: Fields) -> bool:
    """Two steps down one after the other."""
    return "D1D" in fields["trace"]


MOVES: Final = (
    Comparison(
        "step up at its limit",
        "05 step_up",
        ("step_up_height (m)", "end x (m)"),
        _up,
        _is_up,
        (0.3, 0.8),
        0.7,
        SHARE,
    ),
    Comparison(
        "step down at its limit",
        "05 step_down",
        ("step_down_height (m)", "end x (m)"),
        _down,
        _is_down,
        (0.1, 0.8),
        0.4,
        SHARE,
    ),
    Comparison(
        "step down of one sphere", "05 TI-18", _HEIGHT_AXES, _one_sphere, _is_down, (0.9, 1.0), 0.4, SHARE
    ),
    Comparison(
        "step down in halves", "05 TI-19", _HEIGHT_AXES, _two_spheres, _goes_in_halves, (0.9, 1.0), 0.4, SHARE
    ),
    Comparison(
        "last known plane near enough",
        "05 VT-5",
        ("height (m)", "end x (m)"),
        _stopped,
        _is_down,
        (0.49, 0.5),
        0.45,
        SHARE,
    ),
    Comparison(
        "probe of one sphere", "05 WK-5", _PROBE_AXES, _probe_of_one, _goes_out, (0.9, 1.0), -0.24, SHARE
    ),
    Comparison(
        "probe of two spheres", "05 WK-5", _PROBE_AXES, _probe_of_two, _goes_out, (0.9, 1.0), -0.24, SHARE
    ),
    Comparison(
        "move too short", "05 FT-9", ("end x (m)", "end y (m)"), _short, _has_moved, (-2.0, -1.9), 0.1, SHARE
    ),
)
"""Squares of these are smaller."""
