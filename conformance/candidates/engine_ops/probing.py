"""Probes inside the engine candidate: the work of its transitions, which it keeps to itself."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from engine import layout as at
from engine.probes import Work, work_of_row

if TYPE_CHECKING:
    from collections.abc import Iterator

    from engine.kernels.types import Array


@dataclass(slots=True)
class Probe:
    """What was done inside a `probing` block.

    Attributes
    ----------
    with_shortcuts, without : Work
        By transitions that could take shortcuts, and by queries that could not.
    """

    with_shortcuts: Work = field(default_factory=Work)
    without: Work = field(default_factory=Work)


_PROBE: Final[ContextVar[Probe | None]] = ContextVar("probe", default=None)


@contextmanager
def probing() -> Iterator[Probe]:
    """Collect the work of the queries that the candidate answers inside the block, in this thread."""
    probe = Probe()
    token = _PROBE.set(probe)
    try:
        yield probe
    finally:
        _PROBE.reset(token)


def note_work(row: Array) -> None:
    """Add the work of the query that a row of state has just run to the probe, if there is one."""
    probe = _PROBE.get()
    if probe is None:
        return
    if row[at.PLAN] != 0.0:
        probe.with_shortcuts += work_of_row(row)
    else:
        probe.without += work_of_row(row)
