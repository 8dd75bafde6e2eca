"""Records seen as numbers: the same memory, whatever there is of it."""

from __future__ import annotations

import numpy as np
import pytest

from engine.layout import QUERY_DTYPE, QUERY_SIZE
from engine.memory import rows_as_numbers


@pytest.mark.parametrize("count", [0, 1, 3])
def test_records_and_numbers_are_the_same_memory(count: int) -> None:
    """What is written to one is in the other, at the same place."""
    records = np.zeros(count, dtype=QUERY_DTYPE)
    numbers = rows_as_numbers(records)
    assert (numbers.shape, numbers.dtype) == ((count, QUERY_SIZE), np.float64)
    records["num_sphere"] = np.arange(count)
    assert numbers.tobytes() == records.tobytes()
    numbers[:] = 7.0
    assert (records["hits_interior_cell"] == 7.0).all()


def test_some_of_many_records_are_those() -> None:
    """A slice begins where it does."""
    records = np.zeros(5, dtype=QUERY_DTYPE)
    rows_as_numbers(records[2:4])[:] = 1.0
    assert records["num_sphere"].tolist() == [0.0, 0.0, 1.0, 1.0, 0.0]


def test_what_kernels_may_not_write_is_marked() -> None:
    """Records that may only be read, and those that lie askew: so are their numbers."""
    records = np.zeros(1, dtype=QUERY_DTYPE)
    records.setflags(write=False)
    assert not rows_as_numbers(records).flags.writeable
    askew = np.zeros(QUERY_DTYPE.itemsize + 1, dtype=np.uint8)[1:].view(QUERY_DTYPE)
    assert not rows_as_numbers(askew).flags.aligned
