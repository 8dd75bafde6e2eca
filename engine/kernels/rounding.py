"""The store to a float32 field: the only rounding that retail's arithmetic has besides the register's."""

from __future__ import annotations

import numpy as np

from engine.kernels.compile import entry


@entry
def f32(x: float) -> float:
    """Round to float32 once, nearest-even, and load it again.

    retail: NM-3
    """
    return np.float64(np.float32(x))
