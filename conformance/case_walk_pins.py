"""From the ``expect`` block of a walk to pins: what holds at a tick, and what always holds."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from conformance.case_pins import make_pins
from conformance.pins import Pin, Ticks
from conformance.schema.expect import WalkExpectModel
from conformance.source import Fault
from conformance.step_outputs import STEP_OF, start_of
from conformance.validation import validate

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.query import Query
    from conformance.source import DocPath


def make_walk_pins(op: str, expect: dict[str, Any], query: Query) -> tuple[tuple[Pin, ...], list[Fault]]:
    """Read what is pinned of a walk.

    Parameters
    ----------
    op : str
        One of `conformance.step_outputs.STEP_OF`.
    expect : dict
        ``at`` and ``always``; see `conformance.schema.expect.WalkExpectModel`.
    query : Query
        The walk.

    Returns
    -------
    tuple of Pin
        Each with the ticks that it holds for.
    list of Fault
        Unknown fields, unfitting values, ticks that the walk does not have; paths start at the case.
    """
    model, faults = validate(WalkExpectModel, expect)
    if model is None:
        return (), [replace(fault, path=("expect", *fault.path)) for fault in faults]
    count, start = len(query.inputs["ticks"]), start_of(query)
    pins: list[Pin] = []
    for span in _spans(model, expect, count):
        faults += [
            Fault((*span.path, key), f"the tick {tick}", f"one of the ticks 0 to {count - 1}")
            for key, tick in span.given.items()
            if tick >= count
        ]
        made, wrong = make_pins(STEP_OF[op], span.fields, span.path)
        faults += wrong
        ticks = Ticks(span.first, span.last, start)
        pins += [replace(pin, ticks=ticks) for pin in made]
    return tuple(pins), faults


@dataclass(frozen=True, slots=True)
class _Span:
    """Pinned fields, the ticks that they hold for, and which of these the file gives by which key."""

    path: DocPath
    first: int
    last: int
    given: dict[str, int]
    fields: dict[str, Any]


def _spans(model: WalkExpectModel, expect: dict[str, Any], count: int) -> Iterator[_Span]:
    for index, at in enumerate(model.at):
        yield _Span(("expect", "at", index), at.tick, at.tick, {"tick": at.tick}, at.model_extra or {})
    for index, always in enumerate(model.always):
        listed = isinstance(expect["always"], list)
        path: DocPath = ("expect", "always", index) if listed else ("expect", "always")
        first, last = always.from_, count - 1 if always.to is None else always.to
        given = {"from": first} if always.to is None else {"from": first, "to": last}
        yield _Span(path, first, last, given, always.model_extra or {})
