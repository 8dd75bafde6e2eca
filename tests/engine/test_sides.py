"""Edges side by side: each has the bits that it would have alone."""

from __future__ import annotations

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from engine.kernels.sides import sides_outside
from engine.layout import SIDES, SIDES_SIZE
from engine.tracing_interpreter import Interpreter

HOSTILE = (0.0, -0.0, 1.0, 1e-45, 1e30, float("inf"), float("-inf"), float("nan"))
NUMBERS = st.sampled_from(HOSTILE) | st.floats(-2.0, 2.0, width=32)
INTERPRETED = Interpreter({}).function(sides_outside)


@settings(deadline=None)
@given(
    st.lists(NUMBERS, min_size=int(SIDES_SIZE), max_size=int(SIDES_SIZE)),
    st.tuples(NUMBERS, NUMBERS, NUMBERS),
    NUMBERS,
)
@example([0.0] * int(SIDES_SIZE), (1.0, float("inf"), float("nan")), 0.0)
def test_edges_abreast_have_the_bits_of_one(
    numbers: list[float], point: tuple[float, float, float], far: float
) -> None:
    """Outside as PP-3 says it of that edge, and far if its square is more; of an edge of zeros, neither."""
    block = np.array(numbers).reshape(-1, SIDES)
    expected = 0
    with np.errstate(all="ignore"):
        x, y, z = map(np.float64, point)
        for k, (vx, vy, vz, nx, ny, nz, squared) in enumerate(block.T):
            side = ((z - vz) * nz + (y - vy) * ny) + (x - vx) * nx
            expected |= bool(side < 0.0) << k
            expected |= bool(side < 0.0 and side * side > squared * far) << k + int(SIDES)
        floats = np.array([0.5, *numbers])
        interpreted = INTERPRETED(floats, 1, *point, far)
    assert sides_outside(floats, 1, *point, far) == interpreted == expected
