"""What a trace of writes holds, and the line that each entry is."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, TypeAlias

from oracle.polygon import Polygon

if TYPE_CHECKING:
    from collections.abc import Callable

CONTACT_PLANE: Final = "cp-write"
LAST_KNOWN_PLANE: Final = "lkp-write"
WALKABLE: Final = "walkable"
SLIDING: Final = "sliding"
STATE: Final = "state"
BSP: Final = "bsp"
TOPICS: Final = (CONTACT_PLANE, LAST_KNOWN_PLANE, WALKABLE, SLIDING, STATE, BSP)
"""What can be traced; each is also the tag of its lines."""

NO_CALL: Final = "no BSP call"
"""Stands for the result where no call of a BSP tree was running."""
UNFINISHED: Final = "unfinished"
"""Stands for the result of a call of a BSP tree that has not returned: it raised an error."""

_FEWEST_DECIMALS: Final = 3
_MOST_DECIMALS: Final = 9
"""Decimals of a line's numbers; beyond, the shortest decimals that read back as the same number."""

Numbers: TypeAlias = tuple[float, ...]
Value: TypeAlias = "int | Numbers | Polygon | None"
"""A field's value: a plane is (x, y, z, d), a normal (x, y, z)."""


@dataclass(frozen=True, slots=True)
class Field:
    """One field of a transition that is watched.

    Attributes
    ----------
    topic : str
        Which of `TOPICS` it belongs to.
    label : str
        How lines call it.
    show : callable
        Writes a value, with a number of decimals; None for as many as it takes.
    """

    topic: str
    label: str
    show: Callable[[Value, int | None], str]


@dataclass(slots=True)
class BspCall:
    """One call of a BSP tree.

    Attributes
    ----------
    letter : str
        The path it takes, as `oracle.trace` writes it.
    caller : str
        The retail function that makes it.
    transition : int
        Number of the transition, from 1 in the order in which they are watched.
    result : str
        Name of the state it returns, `UNFINISHED` until it does.
    """

    letter: str
    caller: str
    transition: int
    result: str = UNFINISHED

    @property
    def topic(self) -> str:
        """The topic, always `BSP`."""
        return BSP

    @property
    def line(self) -> str:
        """The call as one line."""
        return f"[{BSP}] Call: {self.letter} -> {self.result} caller={self.caller}"

    @property
    def line_with_foot(self) -> str:
        """The same: a call has no foot."""
        return self.line


@dataclass(frozen=True, slots=True)
class Write:
    """One change of one field.

    Attributes
    ----------
    field : Field
        Which.
    before, after : Value
        Never the same bits.
    caller : str
        The retail function that made it.
    transition : int
        Number of the transition, from 1 in the order in which they are watched.
    call : BspCall or None
        The innermost call of a BSP tree during which it was made.
    foot : Numbers or None
        The lowest point of the check position's sphere 0 when it began, metres, in the block of the
        check position; None before there is one.
    """

    field: Field
    before: Value
    after: Value
    caller: str
    transition: int
    call: BspCall | None
    foot: Numbers | None

    @property
    def topic(self) -> str:
        """The topic of its field."""
        return self.field.topic

    @property
    def result(self) -> str:
        """The state that the BSP call around it has returned, or `NO_CALL`."""
        return NO_CALL if self.call is None else self.call.result

    @property
    def line(self) -> str:
        """The write as one line, with as many decimals as it takes to see the change, at least three."""
        decimals: list[int | None] = [*range(_FEWEST_DECIMALS, _MOST_DECIMALS + 1), None]
        pairs = [(self.field.show(self.before, n), self.field.show(self.after, n)) for n in decimals]
        before, after = next((pair for pair in pairs if pair[0] != pair[1]), pairs[-1])
        return f"[{self.topic}] {self.field.label}: {before} -> {after} caller={self.caller}"

    @property
    def line_with_foot(self) -> str:
        """The line, and where the mover's foot was, if it was anywhere."""
        if self.foot is None:
            return self.line
        return f"{self.line} foot=({','.join(_number(v, _FEWEST_DECIMALS) for v in self.foot)})"


@dataclass(slots=True)
class WriteTrace:
    """Writes and BSP calls, in the order in which they began.

    Attributes
    ----------
    entries : list of Write or BspCall
        Of the topics that were asked for.
    """

    entries: list[Write | BspCall] = field(default_factory=list)

    def summary(self) -> dict[tuple[str, str], Counter[str]]:
        """Count the entries by topic and caller, and these by the resulting state of the BSP call."""
        counts: dict[tuple[str, str], Counter[str]] = {}
        for entry in self.entries:
            counts.setdefault((entry.topic, entry.caller), Counter())[entry.result] += 1
        return counts


def unchanged(before: Value, after: Value) -> bool:
    """Tell whether two values have the same bits; a polygon is only the same as itself."""
    if isinstance(before, tuple) and isinstance(after, tuple):
        return [v.hex() for v in before] == [v.hex() for v in after]
    return before is after or before == after


def _number(value: float, decimals: int | None) -> str:
    return repr(value) if decimals is None else f"{value:.{decimals}f}"


def _short(value: float, decimals: int | None) -> str:
    text = _number(value, decimals)
    return text.rstrip("0").rstrip(".") if decimals is not None and "." in text else text


def _show_normal(value: Value, decimals: int | None) -> str:
    numbers = value if isinstance(value, tuple) else ()
    return f"n=({','.join(_short(v, decimals) for v in numbers[:3])})"


def _show_plane(value: Value, decimals: int | None) -> str:
    d = value[3] if isinstance(value, tuple) else 0.0
    return f"{_show_normal(value, decimals)} D={_number(d, decimals)}"


def _show_integer(value: Value, _decimals: int | None) -> str:
    return str(value)


def _show_cell(value: Value, _decimals: int | None) -> str:
    return f"0x{value:08X}" if isinstance(value, int) else str(value)


def _show_bits(value: Value, _decimals: int | None) -> str:
    return f"0x{value:X}" if isinstance(value, int) else str(value)


def _show_polygon(value: Value, _decimals: int | None) -> str:
    return f"polygon {value.poly_id}" if isinstance(value, Polygon) else "none"


FIELDS: Final = {
    "contact_plane_valid": Field(CONTACT_PLANE, "ContactPlaneValid", _show_integer),
    "contact_plane": Field(CONTACT_PLANE, "ContactPlane", _show_plane),
    "contact_plane_cell_id": Field(CONTACT_PLANE, "ContactPlaneCellId", _show_cell),
    "contact_plane_is_water": Field(CONTACT_PLANE, "ContactPlaneIsWater", _show_integer),
    "last_known_contact_plane_valid": Field(LAST_KNOWN_PLANE, "LastKnownContactPlaneValid", _show_integer),
    "last_known_contact_plane": Field(LAST_KNOWN_PLANE, "LastKnownContactPlane", _show_plane),
    "last_known_contact_plane_cell_id": Field(LAST_KNOWN_PLANE, "LastKnownContactPlaneCellId", _show_cell),
    "last_known_contact_plane_is_water": Field(
        LAST_KNOWN_PLANE, "LastKnownContactPlaneIsWater", _show_integer
    ),
    "walkable": Field(WALKABLE, "Walkable", _show_polygon),
    "sliding_normal_valid": Field(SLIDING, "SlidingNormalValid", _show_integer),
    "sliding_normal": Field(SLIDING, "SlidingNormal", _show_normal),
    "state": Field(STATE, "State", _show_bits),
}
"""The watched fields of a collision info, a sphere path and an object info, by attribute."""
