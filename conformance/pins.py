"""Pins: outputs that a case states, which retail and the candidate must both give."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from conformance.compare import Tolerance
    from conformance.query import Fields


@dataclass(frozen=True, slots=True, eq=False)
class Ticks:
    """The ticks of a walk for which a pin holds.

    Attributes
    ----------
    first, last : int
        Their indices, both included.
    start : Fields
        What the mover is before tick 0 (`conformance.step_outputs.start_of`).
    """

    first: int
    last: int
    start: Fields

    def __contains__(self, tick: int) -> bool:
        return self.first <= tick <= self.last


@dataclass(frozen=True, slots=True)
class Pin:
    """One pinned output.

    Attributes
    ----------
    path : str
        The field, ``contact_plane.d`` or ``contact_plane.plane[3]``.
    value : object
        What it must be: a number, a name, None, or a whole list or mapping.
    tolerance : Tolerance or None
        How far a number may be off; None pins it exactly.
    ticks : Ticks or None
        For a walk: `path` is then a field of `conformance.step_outputs.STEP_OUTPUTS`, pinned in these ticks.
    count : int or None
        For a list: `path` must have so many items; those items have pins of their own, and `value` is for
        messages.
    """

    path: str
    value: Any
    tolerance: Tolerance | None = None
    ticks: Ticks | None = None
    count: int | None = None
