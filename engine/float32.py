"""Numbers at the boundary: finite, float32, of the right shape."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from engine.errors import InputError
    from engine.kernels.types import Array


def float32_array(
    values: npt.ArrayLike, shape: tuple[int, ...], where: str, error: type[InputError]
) -> Array:
    """Return numbers as float64 that hold float32 values.

    Parameters
    ----------
    values : array_like
        Finite numbers, not greater than float32's largest.
    shape : tuple of int
        What they have to look like; -1 stands for any length, an empty array fits that too.
    where, error
        What to raise, and where it is, if they do not.
    """
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as cause:
        raise error(where, f"not an array of numbers ({cause})") from cause
    if array.size == 0 and -1 in shape:
        array = array.reshape([0 if n == -1 else n for n in shape])
    if array.ndim != len(shape) or any(n not in (-1, m) for n, m in zip(shape, array.shape, strict=True)):
        expected = tuple("n" if n == -1 else int(n) for n in shape)
        raise error(where, f"shape {array.shape} where {expected} is needed")
    with np.errstate(over="ignore"):
        stored = array.astype(np.float32).astype(np.float64)
    if not np.isfinite(stored).all():
        index = tuple(int(i[0]) for i in np.nonzero(~np.isfinite(stored)))
        raise error(where, f"{array[index]} at {index} is not a finite float32")
    return stored
