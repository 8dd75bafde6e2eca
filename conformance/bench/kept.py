"""Memory for answers that is used again: who asks every tick does not have to get new memory each time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt


class Kept:
    """Arrays of one implementation, kept from round to round."""

    def __init__(self) -> None:
        self._arrays: dict[str, npt.NDArray[Any]] = {}

    def array(self, name: str, shape: tuple[int, ...], dtype: npt.DTypeLike) -> Any:
        """Return the array of a name as it was left; a new one if it is to have another shape or type."""
        kept = self._arrays.get(name)
        if kept is None or kept.shape != shape or kept.dtype != dtype:
            kept = self._arrays[name] = np.zeros(shape, dtype=dtype)
        return kept
