"""The two clocks that retail keeps in global variables."""

from __future__ import annotations


class Clock:
    """Wall clock and simulated time; seconds, doubles (never rounded to float32).

    Attributes
    ----------
    cur_time : float
        Timer::cur_time: now, the same for a whole frame.
    curr_time : float
        PhysicsTimer::curr_time: the time up to which the current object has been simulated.
    """

    __slots__ = ("cur_time", "curr_time")

    def __init__(self) -> None:
        self.cur_time = 0.0
        self.curr_time = 0.0

    def __repr__(self) -> str:
        return f"Clock({self.cur_time!r}, {self.curr_time!r})"
