"""Arrays that begin where a cache line does, and records seen as numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

CACHE_LINE: Final = 128
"""Bytes: 64 on x86, up to that elsewhere."""


def aligned(size: int, dtype: npt.DTypeLike) -> npt.NDArray[Any]:
    """Return an array, not initialised, that shares no cache line with anything else.

    A record of 64 bytes in it is in one line and not in two, and what other threads write beside it does
    not take its lines away.

    Parameters
    ----------
    size : int
        Numbers of 8 bytes.
    dtype : data type
        Of 8 bytes.
    """
    room = np.empty(8 * size + 2 * CACHE_LINE, dtype=np.uint8)
    first = -room.ctypes.data % CACHE_LINE
    return room[first : first + 8 * size].view(dtype)


def rows_as_numbers(records: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """Return records as kernels see them: the same memory, one row of numbers for each.

    Parameters
    ----------
    records : ndarray, shape (n,)
        Contiguous; of nothing but numbers of 8 bytes.

    Returns
    -------
    ndarray of float64, shape (n, numbers of a record)
        Made of the memory at once: a view, given another shape, takes twice as long.
    """
    return np.ndarray((len(records), records.dtype.itemsize // 8), np.float64, records)
