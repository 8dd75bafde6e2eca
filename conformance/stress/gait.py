"""What becomes of a walk: how high the body is above its plane, whether it falls, sticks, or drifts away."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Final

from conformance.exact.errors import rank
from conformance.scenes.algebra import add, dot
from conformance.strategies.human import RADIUS
from conformance.stress.courses import QUANTUM, SETTLED
from conformance.stress.moves import CENTER
from oracle.transient_state import CONTACT_TS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.query import Fields
    from conformance.scenes.model import Vec3
    from conformance.stress.courses import Course

BELOW: Final = 0.1
"""How deep the lower sphere must be in the plane for the body to have fallen through it, metres."""


class Gait:
    """A walk, taken tick by tick; everything is the largest, or counted, until then.

    Parameters
    ----------
    course : Course
        What is walked.
    """

    def __init__(self, course: Course) -> None:
        self._normal, self._constant = course.plane()
        self._course = course
        self._ticks = 0
        self._place: Vec3 | None = None
        self._meant: list[Fraction] | None = None
        self._largest = {"height_metres": 0.0, "contact_metres": 0.0}
        self._counts = dict.fromkeys(("falls", "stuck", "airborne"), 0)

    def take(self, tick: Fields) -> None:
        """Take the next tick."""
        self._ticks += 1
        place: Vec3 = tuple(tick["pos"])
        if self._ticks > SETTLED:
            self._settled(tick, place)
        self._place = place

    def quantities(self) -> dict[str, float]:
        """Return what the walk has come to; nothing but its length before it has settled."""
        told = {"ticks": float(self._ticks)}
        if self._ticks <= SETTLED:
            return told
        return {**self._largest, **{name: float(count) for name, count in self._counts.items()}, **told}

    def _settled(self, tick: Fields, place: Vec3) -> None:
        height = dot(self._normal, add(place, CENTER)) + self._constant - RADIUS
        self._keep("height_metres", abs(height))
        self._counts["falls"] += not height >= -BELOW
        self._counts["stuck"] += self._course.velocity is not None and place == self._place
        self._counts["airborne"] += not tick["ts"] & CONTACT_TS
        if "cp" in tick and dot(tick["cp"][:3], self._normal) > 0.5:
            self._keep("contact_metres", abs(tick["cp"][3] - self._constant))
        if self._course.free:
            self._lead_on(place, tick["v"])

    def _lead_on(self, place: Vec3, velocity: Sequence[float]) -> None:
        """Go on, without rounding, to where velocities lead from the place where the body had settled."""
        if not all(map(math.isfinite, (*place, *velocity))):
            self._keep("astray_metres", math.nan)
            return
        if self._meant is None:
            self._meant = [Fraction(part) for part in place]
            return
        steps = (Fraction(part) * Fraction(QUANTUM) for part in velocity)
        self._meant = [was + step for was, step in zip(self._meant, steps, strict=True)]
        self._keep("astray_metres", math.dist(place, [float(part) for part in self._meant]))

    def _keep(self, name: str, value: float) -> None:
        self._largest[name] = max(self._largest.get(name, 0.0), value, key=rank)
