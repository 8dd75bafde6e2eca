"""The ticks of a walk about its first difference, and what a tick is called."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from conformance.floats import decimal32
from conformance.report.values import format_cell, format_point
from conformance.tick_names import TICK_NAMES

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from conformance.compare import Difference
    from conformance.query import Fields

BEFORE: Final = 2
"""Ticks shown before the one that differs."""
_TICK: Final = re.compile(r"ticks\[(\d+)\]")
_ENDED: Final = "(the walk has ended)"


def step_id(case_id: str, tick: int) -> str:
    """Return the id of a tick of a case, which is as stable as the case's own."""
    return f"{case_id}#{tick}"


def tick_of(found: Sequence[Difference]) -> int | None:
    """Return the tick of a walk's first difference; None if it is not that of a tick."""
    match = _TICK.match(found[0].path) if found else None
    return int(match[1]) if match else None


def ticks_around(found: Sequence[Difference], *answers: tuple[str, Fields]) -> tuple[str, ...]:
    """Write the ticks that lead to a walk's first difference.

    Parameters
    ----------
    found : sequence of Difference
        Those of the first tick that differs.
    answers : tuples of (str, Fields)
        Whose walks to show; ticks in which they are equal are shown once.

    Returns
    -------
    tuple of str
        Two ticks before, and the tick; empty if the difference is not that of a tick.
    """
    at = tick_of(found)
    if at is None:
        return ()
    lines = []
    for index in range(max(0, at - BEFORE), at + 1):
        told = {who: _told(fields["ticks"], index) for who, fields in answers}
        if len(set(told.values())) == 1:
            lines.append(f"  tick {index}: {next(iter(told.values()))}")
        else:
            lines += [f"  tick {index}: {who}: {text}" for who, text in told.items()]
    return tuple(lines)


def _told(ticks: Sequence[Fields], index: int) -> str:
    """Write a tick with the names that people read."""
    if index >= len(ticks):
        return _ENDED
    return ", ".join(f"{TICK_NAMES.get(key, key)} {_value(key, v)}" for key, v in ticks[index].items())


def _value(key: str, value: Any) -> str:
    if key.endswith("cell"):
        return format_cell(value)
    if isinstance(value, float):
        return decimal32(value)
    return format_point(value) if isinstance(value, list) else str(value) or '""'
