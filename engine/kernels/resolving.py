"""Whole transitions from query rows: one, and many."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.kernels.compile import entry, kernel
from engine.kernels.query import prepare, report
from engine.kernels.transition import find_valid_position

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@entry
def resolve(wf: Array, wi: Ints, s: Array, q: Array, out: Array) -> None:
    """Answer one query: move, or place, a mover.

    retail: what calls CTransition::find_valid_position 0x0050C310, 05 1
    """
    _resolve(wf, wi, s, q, out)


@kernel
def _resolve(wf: Array, wi: Ints, s: Array, q: Array, out: Array) -> None:
    """Run one transition, and report."""
    prepare(s, q)
    found = find_valid_position(wf, wi, s)
    report(wf, s, out, 1 if found else 0)


@entry
def resolve_many(wf: Array, wi: Ints, s: Array, queries: Array, out: Array) -> None:
    """Answer many queries, one after the other, in one row of state."""
    for i in range(len(queries)):
        _resolve(wf, wi, s, queries[i], out[i])
