"""Whether numbers are within a limit: all of a batch, in one pass over them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.kernels.compile import entry

if TYPE_CHECKING:
    from engine.kernels.types import Array


# They are counted, not asked for the first: that several of them are compared at a time.
@entry
def all_within(numbers: Array, most: float) -> bool:
    """Say whether no number is NaN, or farther from 0 than `most`; `numbers` has shape (n,)."""
    beyond = 0
    for i in range(len(numbers)):
        beyond += not abs(numbers[i]) <= most
    return beyond == 0
