"""Where an error stops being small: the last severity up to which it is within a limit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.stress.findings import Findings

LIMITS: Final = (0.001, 0.01)
"""A millimetre and a centimetre, in metres."""
EVERYWHERE: Final = "all"
"""What is said of a limit that no severity breaks."""
LIMITED: Final = (
    "contact_metres",
    "position_metres",
    "effect_metres",
    "plane_off_metres",
    "height_metres",
    "astray_metres",
)
"""Quantities that are lengths which a player would notice."""


@dataclass(frozen=True, slots=True)
class Limit:
    """How far a model stays within a limit.

    Attributes
    ----------
    family, sweep, model, quantity : str
        What.
    limit : float
        Metres.
    holds_to : float or None
        The last severity up to which no larger value was seen; None if not even the first is within.
    fails_at : float or None
        The first severity with a larger value; None if there is none.
    """

    family: str
    sweep: str
    model: str
    quantity: str
    limit: float
    holds_to: float | None
    fails_at: float | None

    @property
    def words(self) -> str:
        """How far it holds: a severity, ``all`` of them, or ``none``."""
        if self.fails_at is None:
            return EVERYWHERE
        return "none" if self.holds_to is None else f"{self.holds_to:g}"


def limits(findings: Findings, models: tuple[str, ...]) -> Iterator[Limit]:
    """Yield the limits of every sweep that has such a quantity."""
    for family in findings.families:
        for sweep in findings.sweeps(family):
            for model in models:
                for quantity in LIMITED:
                    curve = findings.curve(family, sweep, model, quantity)
                    for limit in LIMITS if curve else ():
                        yield _limit(family, sweep, model, quantity, limit, curve)


def _limit(
    family: str, sweep: str, model: str, quantity: str, limit: float, curve: list[tuple[float, float]]
) -> Limit:
    holds_to = fails_at = None
    for severity, value in curve:
        if not value <= limit:
            fails_at = severity
            break
        holds_to = severity
    return Limit(family, sweep, model, quantity, limit, holds_to, fails_at)
