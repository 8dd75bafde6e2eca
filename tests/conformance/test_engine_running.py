"""Two runs of a query, with shortcuts and without, must agree."""

from __future__ import annotations

import numpy as np
import pytest

from conformance.candidates.engine_ops.running import ShortcutError, demand_same_answer
from engine import layout as at
from engine.probes import WORK_FIELDS

ANSWER_FIELDS = [name for name in at.RESULT_DTYPE.names if name not in WORK_FIELDS]
assert ANSWER_FIELDS, "no field of a result is an answer"


def test_the_same_answer_after_more_work_is_the_same() -> None:
    """Counters of work are what shortcuts are for."""
    short, full = np.zeros(1, at.RESULT_DTYPE), np.zeros(1, at.RESULT_DTYPE)
    for name in WORK_FIELDS.intersection(at.RESULT_DTYPE.names):
        full[name] = 7
    demand_same_answer(short[0], full[0])


@pytest.mark.parametrize("name", ANSWER_FIELDS)
def test_each_field_of_an_answer_is_compared(name: str) -> None:
    """And named, with both values."""
    short, full = np.zeros(1, at.RESULT_DTYPE), np.zeros(1, at.RESULT_DTYPE)
    full[name] = 1
    with pytest.raises(ShortcutError, match=f"^with shortcuts {name} is ") as raised:
        demand_same_answer(short[0], full[0])
    assert raised.value.field == name


def test_bits_are_compared() -> None:
    """The sign of zero included."""
    short, full = np.zeros(1, at.RESULT_DTYPE), np.zeros(1, at.RESULT_DTYPE)
    name = next(name for name in ANSWER_FIELDS if at.RESULT_DTYPE[name].base.kind == "f")
    full[name] = -0.0
    with pytest.raises(ShortcutError, match=f"^with shortcuts {name} is .*0.0.*, without .*-0.0"):
        demand_same_answer(short[0], full[0])
