"""Memory for answers stays the same from round to round."""

from __future__ import annotations

import numpy as np

from conformance.bench.kept import Kept


def test_an_array_is_given_again() -> None:
    """What was written into it is still there."""
    kept = Kept()
    kept.array("answers", (2,), np.int32)[:] = 7
    assert kept.array("answers", (2,), np.int32).tolist() == [7, 7]


def test_another_shape_or_type_is_another_array() -> None:
    """A larger round has room for its answers."""
    kept = Kept()
    first = kept.array("answers", (2,), np.int32)
    larger = kept.array("answers", (3,), np.int32)
    assert (larger.shape, larger.dtype) == ((3,), np.dtype(np.int32))
    assert kept.array("answers", (3,), np.float64).dtype == np.dtype(np.float64)
    assert not np.shares_memory(first, larger)


def test_names_share_no_memory() -> None:
    """Two kinds of answers do not write over each other."""
    kept = Kept()
    assert not np.shares_memory(kept.array("a", (2,), np.int32), kept.array("b", (2,), np.int32))
