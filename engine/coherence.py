"""In which order the queries of a batch are answered: near each other in space, near each other in time.

Answers land where they were asked for, and each is what it would be alone: nobody can tell the order but by
the clock. What is read of the world is still in the processor's caches when the next query reads it, and its
branches go as they went a moment ago.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine.kernels import order as kernels
from engine.kernels.sharing import SHARE_REORDERED
from engine.threads import new_share
from engine.tracing import is_recording

if TYPE_CHECKING:
    from engine.kernels.types import Array, Order

AS_ASKED: Final[Order] = np.empty(0, dtype=np.int32)
"""What stands for the order in which rows lie."""
_SMALLEST: Final = int(kernels.SMALLEST)
_BUCKETS: Final = int(kernels.BUCKETS)


def order_of(kind: int, rows: Array) -> Order:
    """Return the order in which a batch is best answered.

    Parameters
    ----------
    kind : int
        What its rows are: `SPHERES`, `CALLS`, `MOVES` or `BODIES` of `engine.kernels.order`.
    rows : ndarray of float64, shape (n, size)
        Contiguous, and writable, though nothing is written.

    Returns
    -------
    ndarray of int32
        Which row is the first, the second ...; of shape (0,) if they are best answered as they lie: there
        are few of them, most take less time than it takes to read a row out of turn, or all are near each
        other.
    """
    if len(rows) < _SMALLEST:
        return AS_ASKED
    order, share = _room(len(rows)), new_share(len(rows))
    kernels.order_all(kind, rows, order, share)
    return order[: len(rows)] if share[SHARE_REORDERED] else AS_ASKED


def order_for(count: int, *, coherent: bool) -> Order:
    """Return room for the order of a batch, which is made while it is answered.

    It is one for all threads, and each begins at another place of it: so the next query is as near as if
    there were one thread, and each thread needs only its part of the world in its caches. While writes are
    recorded the order is that in which rows lie: who reads the record reads it in that order.

    Parameters
    ----------
    count : int
        How many rows there are.
    coherent : bool
        Whether there may be another order than that in which the rows lie.
    """
    return AS_ASKED if not coherent or count < _SMALLEST or is_recording() else _room(count)


def _room(count: int) -> Order:
    """Return room for the order of so many rows, and for sorting them."""
    return np.empty(2 * count + _BUCKETS, dtype=np.int32)
