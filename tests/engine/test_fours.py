"""Four numbers moved at once: the same bits in the same places, compiled and interpreted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from engine.kernels.fours import move_four, put_four
from engine.tracing_interpreter import Interpreter

if TYPE_CHECKING:
    from collections.abc import Callable

FOUR = (1.0, -0.0, float("nan"), float("-inf"))
INTERPRETER = Interpreter({})
KINDS = ("compiled", "interpreted")


@pytest.mark.parametrize("at", [0, 1, 3])
@pytest.mark.parametrize("put", [put_four, INTERPRETER.function(put_four)], ids=KINDS)
def test_four_numbers_are_put(put: Callable[..., None], at: int) -> None:
    """Wherever they begin; what is beside them stays."""
    numbers = np.arange(8.0)
    expected = numbers.copy()
    expected[at : at + 4] = FOUR
    put(numbers, at, *FOUR)
    assert numbers.tobytes() == expected.tobytes()


@pytest.mark.parametrize("first", [0, 1, 2])
@pytest.mark.parametrize(
    "move", [move_four, INTERPRETER.function(move_four)], ids=["compiled", "interpreted"]
)
def test_four_numbers_are_copied(move: Callable[..., None], first: int) -> None:
    """With all their bits, from any place to any other."""
    source = np.array([7.0, *FOUR, 8.0])
    numbers = np.arange(8.0)
    expected = numbers.copy()
    expected[3:7] = source[first : first + 4]
    move(numbers, 3, source, first)
    assert numbers.tobytes() == expected.tobytes()
