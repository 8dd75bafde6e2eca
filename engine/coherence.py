"""In which order the queries of a batch are answered: near each other in space, near each other in time.

Answers land where they were asked for, and each is what it would be alone: nobody can tell the order but by
the clock. What is read of the world is still in the processor's caches when the next query reads it, and its
branches go as they went a moment ago.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine.kernels import order as kernels
from engine.threads import sharing
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
    order, own = np.empty((2, len(rows)), dtype=np.int32)
    buckets = np.empty(_BUCKETS, dtype=np.int32)
    return order if kernels.order_all(kind, rows, order, own, buckets) else AS_ASKED


def order_for(count: int, threads: int, *, coherent: bool) -> Order:
    """Return room for the order of a batch, which is made while it is answered.

    Each thread puts the part that it begins with in order itself: nobody waits, and threads do not write
    beside each other (`engine.kernels.sharing`). While writes are recorded the order is that in which rows
    lie: who reads the record reads it in that order.

    Parameters
    ----------
    count : int
        How many rows there are.
    threads : int
        How many share them.
    coherent : bool
        Whether there may be another order than that in which the rows lie.

    Raises
    ------
    QueryError
        If `threads` is not a number of threads.
    """
    lanes = sharing(count, threads)
    if not coherent or count < _SMALLEST * lanes or is_recording():
        return AS_ASKED
    return np.empty(2 * count + lanes * _BUCKETS, dtype=np.int32)
