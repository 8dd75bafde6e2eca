"""What a trace of writes holds: which field changed, from what to what, and by which function of retail."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final, TypeAlias

CONTACT_PLANE: Final = "cp-write"
LAST_KNOWN_PLANE: Final = "lkp-write"
WALKABLE: Final = "walkable"
SLIDING: Final = "sliding"
STATE: Final = "state"
CELL_TRANSIT: Final = "cell-transit"
BSP: Final = "bsp"
TOPICS: Final = (CONTACT_PLANE, LAST_KNOWN_PLANE, WALKABLE, SLIDING, STATE, CELL_TRANSIT, BSP)
"""What can be traced."""

UNFINISHED: Final = "unfinished"
"""Stands for the result of a call that has not returned: it raised an error."""

Value: TypeAlias = int | str | tuple[float, ...] | None
"""A plane is (x, y, z, d), a normal (x, y, z), a polygon or cell its id; None is no polygon, no cell."""


@dataclass(slots=True)
class BspCall:
    """One call of a BSP tree, or of another shape; it reads like a write from its letter to its result.

    Attributes
    ----------
    letter : str
        The path it takes, as in a trace of calls.
    caller : str
        The retail function that makes it.
    transition : int
        Number of the transition, from 1.
    result : str
        Name of the state it returns, `UNFINISHED` until it does.
    """

    letter: str
    caller: str
    transition: int
    result: str = UNFINISHED

    topic = BSP
    label = "Call"
    foot = None

    @property
    def before(self) -> str:
        """The letter."""
        return self.letter

    @property
    def after(self) -> str:
        """The result."""
        return self.result

    @property
    def call(self) -> BspCall:
        """Itself."""
        return self


@dataclass(frozen=True, slots=True)
class Write:
    """One change of one field.

    Attributes
    ----------
    topic : str
        Which of `TOPICS` the field belongs to.
    label : str
        The field, as retail calls it.
    before, after : Value
        A plane or normal is in the coordinates of the block, metres.
    caller : str
        The retail function that made it.
    transition : int
        Number of the transition, from 1.
    call : BspCall or None
        The innermost call of a tree during which it was made.
    foot : tuple of float or None
        The lowest point of the check position's sphere 0 when it began, metres, in the block of the
        check position; None before there is one.
    """

    topic: str
    label: str
    before: Value
    after: Value
    caller: str
    transition: int
    call: BspCall | None
    foot: tuple[float, ...] | None


@dataclass(slots=True)
class WriteTrace:
    """Writes and calls of trees, in the order in which they began.

    Attributes
    ----------
    entries : list of Write or BspCall
        Of the topics that were asked for.
    """

    entries: list[Write | BspCall] = field(default_factory=list)
