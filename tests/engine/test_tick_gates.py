"""Which time is simulated, and in which ticks."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from engine_bodies import ACTIVE, f32, row_of, walker
from engine_scenes import CELL, R, at

from engine.kernels.tick_gates import MAX_TICKS, RESET, RUN, WAIT, frame_gate, near_player, object_gate
from engine.pose import position_row

TICK = 0.2


def ticks_of(record: Any, row: Any, now: float) -> list[float]:
    """Let a body's clock show a time, and return the ticks up to then."""
    record["clock"] = now
    quanta, times = np.zeros((2, int(MAX_TICKS)))
    count = object_gate(row, quanta, times)
    assert (times[:count] > 0.0).all()
    return [float(q) for q in quanta[:count]]


def test_frames_are_at_least_a_thirtieth_of_a_second_apart() -> None:
    """A shorter time goes on, a clock that goes back is followed, and nothing is carried over."""
    assert frame_gate(1.0, 1.0 + 1.0 / 31.0) == (WAIT, 1.0)
    assert frame_gate(1.0, 1.5) == (RUN, 1.5)
    assert frame_gate(1.0, 0.5) == (RESET, 0.5)
    assert frame_gate(0.0, 1.0 / 30.0)[0] == RUN


@pytest.mark.parametrize(
    ("elapsed", "ticks", "simulated"),
    [
        (0.0001, [], 0.0001),
        (0.001, [f32(0.001)], 0.001),
        (0.2, [f32(TICK)], 0.2),
        (0.21, [f32(TICK)], 0.2),
        (0.3, [f32(TICK), f32(0.3 - TICK)], 0.3),
        (2.0, [f32(TICK)] * 10, 2.0),
        (2.5, [], 2.5),
    ],
)
def test_time_is_divided_into_ticks(elapsed: float, ticks: list[float], simulated: float) -> None:
    """A remainder not longer than a thirtieth waits; what is longer than two seconds is dropped."""
    record, row = row_of(walker())
    assert ticks_of(record, row, elapsed) == pytest.approx(ticks, abs=1e-6)
    assert record["update_time"] == pytest.approx(simulated, abs=1e-12)


def test_the_length_of_a_tick_is_a_float32_and_the_time_is_not() -> None:
    """Lengths are rounded one by one; times add up in float64."""
    record, row = row_of(walker())
    assert ticks_of(record, row, 0.5) == [f32(TICK), f32(TICK), f32((0.5 - TICK) - TICK)]
    assert record["update_time"] == (TICK + TICK) + ((0.5 - TICK) - TICK)


def test_what_cannot_move_is_put_to_sleep() -> None:
    """A body with a parent, a frozen one, and one in no cell."""
    for change in ({"has_parent": 1}, {"state": 0x1000000}, {"cell": -1}):
        record, row = row_of(walker())
        for name, value in change.items():
            record[name] = value
        assert ticks_of(record, row, 0.1) == []
        assert record["transient_state"] == 0
        assert math.isnan(near_player(row, position_row(at(0, 0, 0), "player"), True))


def test_far_from_the_player_objects_rest() -> None:
    """96 metres, and only if the maintainer is active; waking up starts at the present time."""
    record, row = row_of(walker(transient_state=0))
    record["clock"] = 3.0
    assert near_player(row, position_row(at(96.0, 0, R), "player"), True) == 96.0
    assert (record["transient_state"], record["update_time"]) == (ACTIVE, 3.0)
    assert near_player(row, position_row(at(97.0, 0, R), "player"), False) == 97.0
    assert record["transient_state"] == ACTIVE
    assert near_player(row, position_row(at(97.0, 0, R), "player"), True) == 97.0
    assert (record["cell_id"], record["transient_state"]) == (CELL, 0)
