"""Indices that compiled code doesn't have to check.

Numba takes a signed index that may be negative as one from the end, which costs a comparison and a
selection at every access. Of an unsigned 32-bit number it knows that it isn't, also after a constant
has been added.
"""

from __future__ import annotations

import numpy as np

from engine.kernels.compile import inlined


@inlined
def unsigned(index: int) -> int:
    """Return an index, or offset, that is at least 0 and less than 2**32, as unsigned."""
    return np.uint32(index)  # type: ignore[return-value]  # kernels calculate with it as with an int
