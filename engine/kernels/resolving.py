"""Whole transitions from query rows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.kernels.ahead import bring_to_write
from engine.kernels.compile import kernel
from engine.kernels.flight import fly_through
from engine.kernels.query import prepare, report
from engine.kernels.transition import find_valid_position
from engine.layout import RESULT_SIZE

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints


@kernel
def resolve(wf: Array, wi: Ints, s: Array, q: Array, out: Array, next_out: Array) -> None:
    """Answer one query: move, or place, a mover. Meanwhile, have the row of later results brought near.

    retail: what calls CTransition::find_valid_position 0x0050C310, 05 1
    """
    if fly_through(wf, wi, s, q, out, next_out):
        return
    prepare(s, q)
    bring_to_write(next_out, 0, RESULT_SIZE)
    found = find_valid_position(wf, wi, s)
    report(wf, s, out, 1 if found else 0)
