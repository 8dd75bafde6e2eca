"""What is measured, by name; units are in the headings."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from conformance.exact.errors import rank

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.exact.errors import ErrorSample

HEADINGS: Final = {
    "contact_metres": "D error (m)",
    "contact_ulps": "D error (ULP)",
    "normal_radians": "normal error (rad)",
    "position_metres": "position error (m)",
    "plane_off_metres": "D off the true plane (m)",
    "formula_metres": "D off (1 - s)(n . O) (m)",
    "effect_metres": "away from the unstressed answer (m)",
    "effect_flips": "flips from the unstressed answer",
    "turned_radians": "off the meant rotation (rad)",
    "stretched": "squared length off 1",
    "flips": "flips",
    "other_paths": "other path",
    "answers": "answers",
    "refused": "not answered",
    "undecided": "undecided",
    "differing": "differing from retail",
    "disagreeing": "decisions unlike exact",
    "band_steps": "width of wrong band (steps)",
    "reversals": "reversals in a row",
    "height_metres": "height error (m)",
    "astray_metres": "away from where velocities lead (m)",
    "falls": "ticks below the floor",
    "stuck": "stuck ticks",
    "airborne": "ticks in the air",
    "ticks": "ticks",
}
"""What each quantity is called, with its unit; also the order of columns."""
ERRORS: Final = ("contact_metres", "contact_ulps", "normal_radians", "position_metres")
"""Distances from exact, of answers whose decisions are exact's."""
COUNTED: Final = frozenset({"effect_flips"})
"""Measured values that are 0 or 1 and add up."""
MEDIAN: Final = "_median"
"""What the name of a quantity ends in that is the median, not the largest, of a severity."""


@dataclass(slots=True)
class Tally:
    """The answers of one model at one severity, taken one by one."""

    _values: dict[str, list[float]] = field(default_factory=dict)
    _counts: Counter[str] = field(default_factory=Counter)

    def add(self, sample: ErrorSample) -> None:
        """Take an answer's errors."""
        self._counts.update(answers=1, flips=bool(sample.flips), other_paths=sample.other_path)
        self.note({name: value for name in ERRORS if (value := getattr(sample, name)) is not None})

    def note(self, values: Mapping[str, float]) -> None:
        """Take other measured values of an answer."""
        for name, value in values.items():
            if name in COUNTED:
                self.count(name, int(value))
            else:
                self._values.setdefault(name, []).append(value)

    def count(self, name: str, times: int = 1) -> None:
        """Count something; 0 times makes it known."""
        self._counts[name] += times

    def quantities(self) -> dict[str, float]:
        """Return the largest and the median of each value, NaN being larger than all, and the counts."""
        told: dict[str, float] = {}
        for name, values in self._values.items():
            ranked = sorted(values, key=rank)
            told[name] = ranked[-1]
            told[name + MEDIAN] = (ranked[(len(ranked) - 1) // 2] + ranked[len(ranked) // 2]) / 2.0
        return {**told, **{name: float(count) for name, count in self._counts.items()}}
