"""The store to a float32 field: the only rounding that retail's arithmetic has besides the register's.

And what bounds are enlarged by because of it.
"""

from __future__ import annotations

import numpy as np

from engine.constants import BOUND_ROUNDING, BOUND_SLACK
from engine.kernels.compile import entry, inlined


@entry
def f32(x: float) -> float:
    """Round to float32 once, nearest-even, and load it again.

    retail: NM-3
    """
    return np.float64(np.float32(x))


@inlined
def slack(x: float, y: float, z: float) -> float:
    """Return how much farther than computed a ball at a point may reach, metres.

    `engine.kernels.broad` derives it.
    """
    return BOUND_SLACK + BOUND_ROUNDING * (abs(x) + abs(y) + abs(z))
