"""What animation and steering do to a moving object: the places where a tick asks them.

The documents do not specify these parts of the client; the tick without them is that of a thing that only
physics moves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from oracle.frame import Frame


class MovementManager:
    """The steering of an object; that it has one keeps the object active while it stands (06 PH-2).

    Retail's own replaces the velocity of a walking creature that leaves the ground; this one lets it fall
    as it is. A subclass may do otherwise.
    """

    __slots__ = ()

    def leave_ground(self) -> None:
        """Hear that the object no longer stands on a walkable (06 OW-2, WB-9)."""

    def hit_ground(self) -> None:
        """Hear that the object now stands on a walkable (06 OW-2)."""


class PositionManager(Protocol):
    """Interpolation, stickiness and constraints, in this order (06 UPI-3)."""

    def adjust_offset(self, offset: Frame, quantum: float) -> None:
        """Change the movement of a tick in place: local axes, metres; `quantum` in seconds."""
