"""Entries of a trace of writes as lines, whoever has recorded them: the shape that `trace_lines` reads."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Final, Protocol, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

NO_CALL: Final = "no BSP call"
"""Stands for the result where no call of a tree was running."""

_FEWEST_DECIMALS: Final = 3
_MOST_DECIMALS: Final = 9
"""Decimals of a line's numbers; beyond, the shortest decimals that read back as the same number."""

Value: TypeAlias = "int | str | tuple[float, ...] | None"


class Call(Protocol):
    """A call of a tree, for its result."""

    @property
    def result(self) -> str:
        """The name of the state it returned."""
        ...


class Entry(Protocol):
    """A write or a call, as `oracle.writes` and `engine.tracing_writes` define them."""

    @property
    def topic(self) -> str:
        """The tag of the line."""
        ...

    @property
    def label(self) -> str:
        """The field."""
        ...

    @property
    def before(self) -> Value:
        """Its value before."""
        ...

    @property
    def after(self) -> Value:
        """Its value after."""
        ...

    @property
    def caller(self) -> str:
        """The function of retail that wrote it."""
        ...

    @property
    def transition(self) -> int:
        """The number of the transition."""
        ...

    @property
    def call(self) -> Call | None:
        """The call of a tree around it."""
        ...

    @property
    def foot(self) -> tuple[float, ...] | None:
        """The mover's lowest point, metres."""
        ...


def line_of(entry: Entry, *, with_foot: bool = False) -> str:
    """Write an entry, with as many decimals as it takes to see the change, at least three."""
    show = _SHOWN.get(entry.label, _plain)
    decimals: list[int | None] = [*range(_FEWEST_DECIMALS, _MOST_DECIMALS + 1), None]
    pairs = [(show(entry.before, n), show(entry.after, n)) for n in decimals]
    before, after = next((pair for pair in pairs if pair[0] != pair[1]), pairs[-1])
    line = f"[{entry.topic}] {entry.label}: {before} -> {after} caller={entry.caller}"
    if not with_foot or entry.foot is None:
        return line
    return f"{line} foot=({','.join(_number(v, _FEWEST_DECIMALS) for v in entry.foot)})"


def summarise(entries: Iterable[Entry]) -> dict[tuple[str, str], Counter[str]]:
    """Count entries by topic and caller, and these by the resulting state of the call around them."""
    counts: dict[tuple[str, str], Counter[str]] = {}
    for entry in entries:
        result = NO_CALL if entry.call is None else entry.call.result
        counts.setdefault((entry.topic, entry.caller), Counter())[result] += 1
    return counts


def _number(value: float, decimals: int | None) -> str:
    return repr(value) if decimals is None else f"{value:.{decimals}f}"


def _short(value: float, decimals: int | None) -> str:
    text = _number(value, decimals)
    return text.rstrip("0").rstrip(".") if decimals is not None and "." in text else text


def _numbers(value: Value) -> Sequence[float]:
    return value if isinstance(value, tuple) else ()


def _normal(value: Value, decimals: int | None) -> str:
    return f"n=({','.join(_short(v, decimals) for v in _numbers(value)[:3])})"


def _plane(value: Value, decimals: int | None) -> str:
    return f"{_normal(value, decimals)} D={_number(_numbers(value)[3], decimals)}"


def _plain(value: Value, _decimals: int | None) -> str:
    return str(value)


def _cell(value: Value, _decimals: int | None) -> str:
    return f"0x{value:08X}" if isinstance(value, int) else "none"


def _bits(value: Value, _decimals: int | None) -> str:
    return f"0x{value:X}" if isinstance(value, int) else str(value)


def _polygon(value: Value, _decimals: int | None) -> str:
    return "none" if value is None else f"polygon {value}"


_SHOWN: Final[dict[str, Callable[[Value, int | None], str]]] = {
    "ContactPlane": _plane,
    "ContactPlaneCellId": _cell,
    "LastKnownContactPlane": _plane,
    "LastKnownContactPlaneCellId": _cell,
    "Walkable": _polygon,
    "SlidingNormal": _normal,
    "State": _bits,
    "CurrCell": _cell,
}
"""How the values of a field are written, with a number of decimals; None for as many as it takes."""
