"""Probes: how much work queries did, how much shortcuts saved, and how many were answered out of turn.

Every result and every body counts its own work (``nodes_visited``, ..., ``skipped``); here it is added up.
In which order a batch is answered no result can tell; it is counted while somebody asks for it.
"""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from engine import layout as at
from engine.plan import Stage

if TYPE_CHECKING:
    from collections.abc import Iterator

    from engine.kernels.types import Array

WORK_FIELDS: Final = frozenset(
    {"nodes_visited", "polygons_tested", "cells_listed", "objects_tested", "skipped"}
)
"""Fields of results and of bodies that count work: nothing else depends on shortcuts."""


@dataclass(frozen=True, slots=True)
class Work:
    """What one query, or many together, did.

    Attributes
    ----------
    queries : int
        Transitions, or single calls.
    nodes, polygons : int
        Nodes of trees visited, and polygons tested; those of the broad phase included.
    objects, cells : int
        Objects tested, and cells put on the cell list. Bodies do not tell: 0.
    portals, things, grounds, flights, unbounded, unwalked : int
        Shortcuts taken (`engine.plan.Stage`): cell lists of one, objects and houses passed over, grounds
        passed over, sub-steps of free flights, walks through trees without the bounding spheres, and walks
        that were not made.
    """

    queries: int = 0
    nodes: int = 0
    polygons: int = 0
    objects: int = 0
    cells: int = 0
    portals: int = 0
    things: int = 0
    grounds: int = 0
    flights: int = 0
    unbounded: int = 0
    unwalked: int = 0

    def __add__(self, other: Work) -> Work:
        """Return what both did together."""
        return Work(*(getattr(self, f.name) + getattr(other, f.name) for f in fields(Work)))


def work_of(records: Any) -> Work:
    """Add up the work of records.

    Parameters
    ----------
    records : records of `engine.layout.RESULT_DTYPE` or `engine.body_layout.BODY_DTYPE`
        One, or an array of them; of bodies, the work of their last ticks.
    """
    rows = np.atleast_1d(records)
    names = ("nodes_visited", "polygons_tested", "objects_tested", "cells_listed")
    counts = [int(rows[name].sum()) if name in (rows.dtype.names or ()) else 0 for name in names]
    return Work(len(rows), *counts, *(int(n) for n in rows["skipped"].sum(axis=0)))


def without_work(records: Any) -> dict[str, bytes]:
    """Return all that records tell but their work: what no shortcut may change.

    Parameters
    ----------
    records : records of `engine.layout.RESULT_DTYPE` or `engine.body_layout.BODY_DTYPE`
        One, or an array of them.

    Returns
    -------
    dict of str to bytes
        The bits of each field.
    """
    names = (name for name in records.dtype.names if name not in WORK_FIELDS)
    return {name: np.ascontiguousarray(records[name]).tobytes() for name in names}


def work_of_row(row: Array) -> Work:
    """Return the work of the query that a row of state has run last."""
    counters = (at.NODES_VISITED, at.POLYGONS_TESTED, at.OBJECTS_TESTED, at.CELLS_LISTED)
    skipped = row[at.SKIPPED : at.SKIPPED + len(Stage)]
    return Work(1, *(int(row[k]) for k in counters), *(int(n) for n in skipped))


@dataclass(slots=True)
class Reordered:
    """What has been answered in another order than it was asked.

    Attributes
    ----------
    queries : int
        Queries of batches that were reordered, all of them.
    batches : int
        Those batches.
    """

    queries: int = 0
    batches: int = 0


_COUNTING: Final[ContextVar[Reordered | None]] = ContextVar("counting", default=None)


@contextmanager
def count_reordered() -> Iterator[Reordered]:
    """Count what this thread has answered out of turn (`engine.coherence`) inside the block.

    Yields
    ------
    Reordered
        Grows with each batch.
    """
    count = Reordered()
    token = _COUNTING.set(count)
    try:
        yield count
    finally:
        _COUNTING.reset(token)


def note_reordered(queries: int) -> None:
    """Count a batch of which so many queries are answered out of turn."""
    count = _COUNTING.get()
    if count is not None and queries:
        count.queries += queries
        count.batches += 1
