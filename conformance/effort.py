"""How much work a query asks for at most: retail has no limit, so a tiny sphere would walk for years.

Retail makes a move in steps of a sphere's radius (05, calc_num_steps) and looks for a free place in rings
of balls (05, find_placement_pos); neither has an upper bound. What is far beyond any game is refused before
anybody is asked.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

from conformance.fields import FieldError
from conformance.floats import to_float32
from oracle.constants import BLOCK_EDGE

if TYPE_CHECKING:
    from collections.abc import Mapping

MAX_STEPS: Final = 200_000
"""Steps of one move; a human (radius 0.48 m) crosses the whole map, 49 km, by its diagonal in 145,000."""
MAX_TICKS: Final = 200_000
"""Ticks of a walk: nearly two hours at 30 a second."""
MAX_SPEED: Final = 50.0
"""m/s: retail's bodies are never faster (06, MAX_VELOCITY)."""
SPECK: Final = 9.999999747378752e-05
"""Metres: smallest radius (a float32) of what is put down. The rings about it are a radius apart, up to 2 m,
and hold pi * (2 / radius)^2 places (05, PP-2…5); mostly one of the first is free, but where none is, a speck
tries them all, which takes hours."""
_BYTE: Final = 0xFF


def check_effort(inputs: Mapping[str, Any]) -> None:
    """Check that a query is not beyond anybody's patience, and that who moves has a radius to make steps of.

    Parameters
    ----------
    inputs : Mapping
        A query's input blocks, as FORMAT.md describes them.

    Raises
    ------
    FieldError
        For too many ticks, a mover or body without a radius, or a move or placement of too many steps.
    """
    ticks = inputs.get("ticks") or ()
    if len(ticks) > MAX_TICKS:
        raise FieldError("ticks", f"{len(ticks)} ticks", f"at most {MAX_TICKS}")
    body, mover = inputs.get("body"), inputs.get("mover")
    if body is not None:
        radius = _radius(body, "body")
        for index, tick in enumerate(ticks):
            _check(f"ticks[{index}].q", tick.get("q", 0.0) * MAX_SPEED, radius)
    if mover is None:
        return
    radius = _radius(mover, "mover")
    for index, tick in enumerate(ticks):
        _check(f"ticks[{index}].move", math.hypot(*tick.get("move", ())), radius)
    start, end = inputs.get("from"), inputs.get("to")
    if isinstance(start, dict) and isinstance(end, dict):
        _check("to", _distance(start, end), radius)
    elif isinstance(end, dict) and not radius >= SPECK:
        raise FieldError(
            "mover.spheres", f"the radius {radius:.6g} m", f"at least {SPECK:.6g} to put it down"
        )


def _radius(block: Mapping[str, Any], name: str) -> float:
    """Return the radius of the first sphere, metres; infinite if there is none to go by.

    A way is divided by it (05, NS-5), and it is never 0 (01, NM-9a).
    """
    spheres = block.get("spheres") or ()
    size: float = spheres[0][3] * block.get("scale", 1.0) if spheres else math.inf
    if not to_float32(size) > 0.0:
        raise FieldError(
            f"{name}.spheres", f"a first sphere of radius {size:.6g} m", "a radius greater than 0"
        )
    return size


def _distance(start: Mapping[str, Any], end: Mapping[str, Any]) -> float:
    blocks = [pose["cell"] >> 16 for pose in (start, end)]
    east = (blocks[1] >> 8) - (blocks[0] >> 8)
    north = (blocks[1] & _BYTE) - (blocks[0] & _BYTE)
    offset = [b - a for a, b in zip(start["origin"], end["origin"], strict=True)]
    return math.hypot(offset[0] + BLOCK_EDGE * east, offset[1] + BLOCK_EDGE * north, offset[2])


def _check(path: str, distance: float, radius: float) -> None:
    if distance > MAX_STEPS * radius:
        found = f"{distance:.6g} m with a sphere of radius {radius:.6g} m"
        raise FieldError(path, found, f"a move of at most {MAX_STEPS} radii")
