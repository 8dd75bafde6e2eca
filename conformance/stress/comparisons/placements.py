"""Comparisons of document 05 that a placement decides: rings around a place that is taken, the way down."""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, Any, Final

from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.primitives import floor
from conformance.scenes.solids import box
from conformance.strategies.human import HUMAN, MOVER, RADIUS
from conformance.stress.comparisons.base import Comparison
from conformance.stress.moves import CELL, IDENTITY, pose
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from conformance.query import Fields, Query
    from conformance.scenes.model import Geometry, Vec3

SHARE: Final = 4
"""As of moves: placements take as long."""
WALL: Final = -3.15
"""x of the middle of a block that is 6 m wide: its near side is 0.15 m from the origin; metres."""
GIANT_WALL: Final = -6.5
MOTE_WALL: Final = -2.9999
"""The same for rings a fifth of a millimetre apart: the origin is in the block."""
STATIC_WITH_BSP: Final = 0x10001
_RADIUS_AXES: Final = ("radius (m)", "x (m)")
_HEIGHT_AXES: Final = ("step_down_height (m)", "x (m)")


@cache
def _block() -> Geometry:
    return build("block", box(size=(6.0, 6.0, 6.0)), style=TreeStyle.BOTH, kind="stress")


@cache
def _floor() -> Geometry:
    return build("ground", floor(size=(10.0, 10.0)), style=TreeStyle.BOTH, kind="stress")


def _put(place: Vec3, cell: dict[str, Any], geometry: Geometry, **mover: Any) -> Query:
    here = {"id": CELL, "pose": pose(IDENTITY, (0.0, 0.0, 0.0)), "geometry": None, **cell}
    record: dict[str, Any] = {
        "op": "transition",
        "cells": [here],
        "mover": {**MOVER, "state": 0, **mover},
        "from": None,
        "to": pose(IDENTITY, place),
        "begin_cell": CELL,
        "seed": {},
        "placement_allows_sliding": 1,
    }
    return query_from_record(record, {geometry.name: geometry})


def _beside(radius: float, x: float, wall: float) -> Query:
    """Put a sphere where the block is: rings about the place are tried."""
    block = {"geometry": _block().name, "pose": pose(IDENTITY, (wall, 0.0, -3.0)), "scale": 1.0}
    cell = {"statics": [{**block, "state": STATIC_WITH_BSP}]}
    return _put((x, 0.0, 0.0), cell, _block(), spheres=[(0.0, 0.0, 0.0, radius)], step_down=0)


def _thin(radius: float, x: float) -> Query:
    return _beside(radius, x, WALL)


def _mote(radius: float, x: float) -> Query:
    return _beside(radius, x, MOTE_WALL)


def _giant(radius: float, x: float) -> Query:
    return _beside(radius, x, GIANT_WALL)


def _one_sphere(limit: float, x: float) -> Query:
    spheres = [(0.0, 0.0, RADIUS, RADIUS)]
    return _put((x, 0.1, 0.8), {"geometry": _floor().name}, _floor(), spheres=spheres, step_down_height=limit)


def _two_spheres(limit: float, x: float) -> Query:
    return _put((x, 0.1, 0.8), {"geometry": _floor().name}, _floor(), spheres=HUMAN, step_down_height=limit)


def _is_down(fields: Fields) -> bool:
    return bool(fields["contact_plane"]["valid"])


def _goes_in_halves(fields: Fields) -> bool:
    """Two steps down one after the other."""
    return "D1D" in fields["trace"]


def _is_off_far(fields: Fields) -> bool:
    """Tell a place on a ring of the usual distances from one on the small rings of what is thin."""
    return bool(fields["curr"]["origin"][0] > 0.1)


def _is_off_by_two(fields: Fields) -> bool:
    """Tell a place on the second ring of a mote from one on the first, which is not farther off than EPS."""
    return bool(fields["result"]) and math.hypot(*fields["curr"]["origin"]) > 3e-4


def _is_put(fields: Fields) -> bool:
    return bool(fields["result"])


PLACEMENTS: Final = (
    Comparison(
        "way down of one sphere", "05 FP-5", _HEIGHT_AXES, _one_sphere, _is_down, (0.9, 1.0), 0.3, SHARE
    ),
    Comparison(
        "way down in halves", "05 FP-5", _HEIGHT_AXES, _two_spheres, _goes_in_halves, (0.9, 1.0), 0.3, SHARE
    ),
    Comparison("rings of the thin", "05 PP-2", _RADIUS_AXES, _thin, _is_off_far, (0.1, 0.2), -0.1, SHARE),
    Comparison("rings of a giant", "05 PP-3", _RADIUS_AXES, _giant, _is_put, (3.9, 4.1), 0.1, SHARE),
    Comparison(
        "rings of a mote", "05 PP-5", _RADIUS_AXES, _mote, _is_off_by_two, (1.99e-4, 2.01e-4), 0.0, SHARE
    ),
)
"""In the order of the document; their squares are smaller."""
