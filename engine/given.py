"""Answers in memory that the caller gives, as NumPy's ``out=``.

A batch of 10,000 moves has 6.6 MB of answers. In memory that is new to the process each of them costs
some 170 ns more, as much as a free flight. An allocator that keeps what was freed saves that as well (in
a loop on Linux both are equally fast); given memory is warm whatever the allocator does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from engine.checks import told
from engine.errors import QueryError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt


def room(
    given: Any, dtype: npt.DTypeLike, shape: tuple[int, ...], inputs: Sequence[npt.NDArray[Any]], where: str
) -> npt.NDArray[Any]:
    """Return an array for answers: the given one, if it is one that compiled code can write them to.

    Parameters
    ----------
    given : ndarray or None
        None has a new one made, which is not initialised.
    dtype, shape
        What it has to be.
    inputs : sequence of ndarray
        What is asked, and read while answers are written: they may not lie in the same memory.
    where : str
        What it is, for the error.

    Raises
    ------
    QueryError
        If it has another type or shape, is not contiguous, not aligned or not writable, or overlaps.
    """
    if given is None:
        return np.empty(shape, dtype=dtype)
    if not isinstance(given, np.ndarray):
        raise QueryError(where, f"{told(given)} where an array is needed")
    if given.dtype != dtype or given.shape != shape:
        found, needed = (f"{tuple(s)} of {_name(d)}" for s, d in ((given.shape, given.dtype), (shape, dtype)))
        raise QueryError(where, f"shape {found} where {needed} is needed")
    # Of a record NumPy says that it is aligned wherever it lies; kernels see the numbers in it.
    plain = given.dtype.names is None or not given.flags.c_contiguous
    if not (given if plain else given.view(np.float64)).flags.carray:
        raise QueryError(where, "not contiguous, not aligned, or not writable")
    for one in inputs:
        if np.may_share_memory(given, one):
            raise QueryError(where, "lies in the memory of what is asked")
    return given


def rooms(given: Any, count: int, where: str) -> tuple[Any, ...]:
    """Return as many given arrays as there are answers; as many times None if nothing is given.

    Raises
    ------
    QueryError
        If there are more of them, or fewer.
    """
    if given is None:
        return (None,) * count
    if not isinstance(given, tuple) or len(given) != count:
        raise QueryError(where, f"{told(given)} where a tuple of {count} arrays is needed")
    return given


def _name(dtype: npt.DTypeLike) -> str:
    found = np.dtype(dtype)
    return found.name if found.names is None else f"records of {len(found.names)} fields"
