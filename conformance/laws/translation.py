"""The law of translation: a whole scene moved by powers of two.

Retail answers a BSP call in the frame of its cell or part. If all coordinates lie on a grid so coarse that
no sum on the way there is rounded, the call sees the same bits wherever the scene stands, so every decision,
every normal and every local distance is the same to the bit. Only what is taken back to the landblock's
frame is rounded, once where it is stored: it may be off by an ULP of its own magnitude, which grows with the
way that the scene was moved. That is why the law is one of single calls: in a transition the rounded position
goes into the next call, and a decision may turn over.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.laws.law import Law, unlike
from conformance.laws.square import square_calls

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.laws.law import Ask
    from conformance.query import Fields, Query

GRID: Final = 1.0 / 256.0
"""Metres; a float32 holds its multiples up to 65,536 m."""
OFFSETS: Final = tuple(sign * 2.0**power for power in (0, 3, 8, 12, 14) for sign in (1.0, -1.0))
"""Metres along each axis."""
SINGLE_CALLS: Final = ("ethereal", "check_walkable", "step_down", "collide", "path_clipped", "airborne")
"""The paths of a BSP call on which no rounded position is asked about again."""
_TELLING: Final = ("step_down", "collide")
"""Those that take a place and a plane back to the landblock: asked as often as all the others together."""
_ASKED: Final = (*SINGLE_CALLS, *_TELLING)
_PLANES: Final = ("contact_plane", "last_known_contact_plane")
_MOVED: Final = ("check", "curr")
_SIGNIFICAND: Final = 24


def translated(query: Query, ask: Ask) -> str:
    """Move the scene and the mover by a power of two along each axis.

    Condition: one BSP call of the paths of `SINGLE_CALLS`; origins and spheres' centres are multiples of
    `GRID` and stay below 65,536 m; nothing is turned; normals look along the axes; the scale is 1, because
    retail multiplies a finished plane's constant by it, translation included. Then only positions and planes'
    constants may differ from the moved ones, by one ULP of the larger of the two places.
    """
    way = _way(query)
    first, second = ask(query), ask(_moved(query, way))
    expected = _taken(first, way)
    return unlike(query.op, expected, _within_an_ulp(expected, second, first), f"moved by {way}")


def on_grid(query: Query) -> Query:
    """Return a query whose coordinates are multiples of `GRID`."""
    inputs: dict[str, Any] = {**query.inputs, "scale": 1.0}
    for key in ("pose", "from", "to"):
        inputs[key] = {**inputs[key], "origin": [_rounded(part) for part in inputs[key]["origin"]]}
    spheres = [[*map(_rounded, center), radius] for *center, radius in inputs["mover"]["spheres"]]
    inputs["mover"] = {**inputs["mover"], "spheres": spheres, "scale": 1.0}
    return replace(query, inputs=inputs)


def _way(query: Query) -> tuple[float, float, float]:
    """Choose a way to move, by the query itself: a law asks nothing but its query."""
    x, y, z = (round(part / GRID) for part in query.inputs["to"]["origin"])
    return OFFSETS[x % len(OFFSETS)], OFFSETS[y % len(OFFSETS)], OFFSETS[z % len(OFFSETS)]


def _rounded(number: float) -> float:
    return round(number / GRID) * GRID


def _moved(query: Query, way: Sequence[float]) -> Query:
    inputs = dict(query.inputs)
    for key in ("pose", "from", "to"):
        inputs[key] = _along(inputs[key], way)
    inputs["seed"] = {
        key: _plane_along(value, way) if isinstance(value, dict) else value
        for key, value in inputs["seed"].items()
    }
    return replace(query, inputs=inputs)


def _taken(fields: Fields, way: Sequence[float]) -> Fields:
    taken = dict(fields)
    for name in _MOVED:
        taken[name] = _along(fields[name], way)
    for name in _PLANES:
        if "plane" in fields[name]:
            taken[name] = _plane_along(fields[name], way)
    taken["global_spheres"] = [_sum(center, way) for center in fields["global_spheres"]]
    return taken


def _along(pose: Any, way: Sequence[float]) -> dict[str, Any]:
    return {**pose, "origin": _sum(pose["origin"], way)}


def _plane_along(contact: Any, way: Sequence[float]) -> dict[str, Any]:
    *normal, d = contact["plane"]
    return {**contact, "plane": [*normal, d - sum(n * part for n, part in zip(normal, way, strict=True))]}


def _sum(point: Sequence[float], way: Sequence[float]) -> list[float]:
    return [part + more for part, more in zip(point, way, strict=True)]


def _within_an_ulp(moved: Fields, found: Fields, unmoved: Fields) -> Fields:
    """Return what was found with rounded numbers as they were moved, where they are within one ULP of that.

    The number and its moved twin were both rounded, to half an ULP of their own: together at most one of the
    larger.
    """
    snapped = dict(found)
    for name in _MOVED:
        numbers = (fields[name]["origin"] for fields in (moved, found, unmoved))
        snapped[name] = {**found[name], "origin": _snapped(*numbers)}
    for name in _PLANES:
        if "plane" in found[name] and "plane" in moved[name]:
            constants = ([fields[name]["plane"][3]] for fields in (moved, found, unmoved))
            snapped[name] = {**found[name], "plane": [*found[name]["plane"][:3], *_snapped(*constants)]}
    centers = zip(*(fields["global_spheres"] for fields in (moved, found, unmoved)), strict=True)
    snapped["global_spheres"] = [_snapped(*center) for center in centers]
    return snapped


def _snapped(moved: Sequence[float], found: Sequence[float], unmoved: Sequence[float]) -> list[float]:
    numbers = zip(moved, found, unmoved, strict=True)
    return [a if abs(a - b) <= ulp(b, c) else b for a, b, c in numbers]


def ulp(*numbers: float) -> float:
    """Return the distance between neighbouring float32 at the largest of some numbers."""
    return math.ldexp(1.0, math.frexp(max(map(abs, numbers)))[1] - _SIGNIFICAND)


LAWS: Final = (
    Law(
        "translation",
        st.one_of([square_calls(call) for call in _ASKED]).map(on_grid),
        translated,
        multiple=4.0,  # one call in fourteen finds something to stand on
    ),
)
