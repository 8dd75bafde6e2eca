"""A world's two arrays while something is appended to them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from engine import layout as at
from engine.memory import aligned

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.kernels.types import Array, Ints


class Growing:
    """What is appended behind so many floats, and so many integers."""

    def __init__(self, num_floats: int, num_ints: int) -> None:
        self._num_floats = num_floats
        self._num_ints = num_ints
        self._floats: list[Array] = []
        self._ints: list[Ints] = []

    def align(self) -> None:
        """Let the next numbers begin where a cache line does."""
        self.add_floats(np.zeros(-self._num_floats % int(at.POLYGON_ALIGNMENT)))

    def add_floats(self, values: Array) -> int:
        """Append numbers; return where they begin."""
        offset = self._num_floats
        self._floats.append(values)
        self._num_floats += len(values)
        return offset

    def add_ints(self, values: Sequence[int] | Ints) -> int:
        """Append integers; return where they begin."""
        offset = self._num_ints
        self._ints.append(np.asarray(values, dtype=np.int64))
        self._num_ints += len(values)
        return offset

    def behind(self, floats: Sequence[Array], ints: Sequence[Ints]) -> tuple[Array, Ints]:
        """Return new arrays: what there was before, and behind it what is appended."""
        all_floats: Array = aligned(self._num_floats, np.float64)
        all_ints: Ints = aligned(self._num_ints, np.int64)
        np.concatenate([*floats, *self._floats], out=all_floats)
        np.concatenate([*ints, *self._ints], out=all_ints)
        return all_floats, all_ints
