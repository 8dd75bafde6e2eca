"""Laws of splitting: a way made in two moves instead of one.

Retail makes a move in n = ceil(length / radius) equal steps, each stored as float32, and adds them one after
the other to a float32 position (05, calc_num_steps and FT-12). In empty space a step remembers nothing of the
one before it, so two moves are one, up to those roundings. Near anything else they are not: a contact plane,
a sliding normal and the frames without movement go from one step to the next, and are told to the next *move*
only in part (06, the seed); there is no law.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.floats import to_float32
from conformance.laws.law import Law, unlike
from conformance.laws.translation import ulp
from conformance.query import Query

if TYPE_CHECKING:
    from conformance.laws.law import Ask

CELL: Final = 0xA9B40151
RADIUS: Final = 0.5
"""Metres: a power of two, so that the number of steps is exact."""
GRID: Final = 1.0 / 64.0
STEPS: Final = (2, 4, 8, 16)
"""Powers of two: their reciprocals are exact."""
FARTHEST: Final = 12_000
"""Multiples of `GRID`, from the block's corner: 187.5 m."""
_IDENTITY: Final = [1.0, 0.0, 0.0, 0.0]
_PLACES: Final = st.integers(0, FARTHEST).map(lambda number: number * GRID)
_ANYWHERE: Final = st.floats(0.0, 190.0, width=32, allow_subnormal=False)
_POINTS: Final = st.tuples(_ANYWHERE, _ANYWHERE, st.floats(-8.0, 8.0, width=32, allow_subnormal=False))


def flight(start: Any, end: Any, radius: float = RADIUS) -> Query:
    """Return the move of a ball through a cell in which nothing is."""
    mover = {
        "spheres": [[0.0, 0.0, 0.0, radius]],
        "scale": 1.0,
        "state": 0,
        "step_up_height": 0.5,
        "step_down_height": 1.5,
        "ethereal": 0,
        "step_down": 1,
        "gravity": 1,
    }
    poses = {key: _pose(origin) for key, origin in (("from", start), ("to", end))}
    cell = {"id": CELL, "pose": _pose((0.0, 0.0, 0.0)), "geometry": None}
    inputs = {"cells": [cell], "mover": mover, "seed": {}, "begin_cell": CELL, **poses}
    return Query("transition", inputs)


def _pose(origin: Any) -> dict[str, Any]:
    return {"cell": CELL, "origin": list(origin), "rotation": _IDENTITY}


def _straight_flights() -> st.SearchStrategy[Query]:
    """Flights along an axis of a power of two of steps, from a point of the grid."""

    def make(x: float, y: float, z: float, axis: int, way: float) -> Query:
        end = [x, y, z]
        end[axis] += way * RADIUS
        return flight((x, y, z), end)

    ways = st.sampled_from([sign * steps for steps in STEPS for sign in (1.0, -1.0)])
    return st.builds(make, _PLACES, _PLACES, _PLACES, st.sampled_from((0, 1, 2)), ways)


def halved_exactly(query: Query, ask: Ask) -> str:
    """Halved exactly: half way and then the rest, without a rounding.

    Condition: nothing is in the cell; the way goes along an axis, its length is 2, 4, 8 or 16 times the
    radius, which is a power of two, and it starts on a grid. Steps are then exactly a radius long, sums are
    exact, and both ways lead over the same points: the answer is the same but for its trace, which is that
    of the two halves one after the other.
    """
    start, end = query.inputs["from"]["origin"], query.inputs["to"]["origin"]
    middle = [(a + b) * 0.5 for a, b in zip(start, end, strict=True)]
    whole = ask(query)
    halves = ask(flight(start, middle))
    rest = ask(flight(halves["curr"]["origin"], end))
    joined = {**rest, "trace": halves["trace"] + rest["trace"]}
    return unlike(query.op, whole, joined, "in two halves")


def halved(query: Query, ask: Ask) -> str:
    """Halved: half way and then the rest, from anywhere to anywhere.

    Condition: nothing is in the cell. Of n steps each is rounded once when it is computed and once when it is
    added, by at most half an ULP of the largest coordinate M on the way; so a move of n steps ends at most
    n ULPs of M from its target in each coordinate, and two ways to the same target at most the sum of their
    steps from each other.
    """
    start, end = query.inputs["from"]["origin"], query.inputs["to"]["origin"]
    middle = [to_float32(0.5 * (a + b)) for a, b in zip(start, end, strict=True)]
    whole = ask(query)["curr"]["origin"]
    halves = ask(replace(query, inputs={**query.inputs, "to": _pose(middle)}))["curr"]["origin"]
    rest = ask(replace(query, inputs={**query.inputs, "from": _pose(halves)}))["curr"]["origin"]
    radius = query.inputs["mover"]["spheres"][0][3]
    steps = 2 * math.ceil(math.dist(start, end) / radius) + 2
    allowed = steps * ulp(*start, *end)
    off = max(abs(a - b) for a, b in zip(whole, rest, strict=True))
    return f"{off:.9g} m apart, at most {allowed:.9g} m ({steps} steps)" if not off <= allowed else ""


LAWS: Final = (
    Law("halved exactly", _straight_flights(), halved_exactly),
    Law("halved", st.builds(flight, _POINTS, _POINTS), halved),
)
