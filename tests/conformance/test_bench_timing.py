"""Implementations that take turns: order, equality, and what is summarised."""

from __future__ import annotations

import gc
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from conformance.bench import timing
from conformance.bench.timing import (
    Answer,
    DisagreementError,
    Job,
    clock,
    comparison,
    demand_equal,
    equal_rows,
    quarter,
    sample_of,
    take_turns,
)

if TYPE_CHECKING:
    from collections.abc import Iterator


@dataclass(frozen=True)
class Numbers:
    """Work that is a number for each query."""

    values: tuple[int, ...]

    def __len__(self) -> int:
        return len(self.values)

    def part(self, first: int, last: int) -> Numbers:
        """Return some of them."""
        return Numbers(self.values[first:last])


class Diary:
    """An implementation that writes down when it works."""

    def __init__(self, name: str, diary: list[tuple[str, Any]]) -> None:
        self.name = name
        self.diary = diary

    def __call__(self, work: Any) -> Job:
        """Make a job that answers with its work."""

        def run() -> Any:
            self.diary.append((self.name, work))
            return work

        return Job(run, lambda done: np.array([[float(done)]]), 1)


def test_everybody_begins_in_turn() -> None:
    """After the warm-up the one who begins moves on; each does the round before once more, then its own."""
    diary: list[tuple[str, Any]] = []
    makers = [Diary("a", diary), Diary("b", diary)]
    times = take_turns(makers, [1, 2, 3], warm_up=0, judge=demand_equal)
    assert "".join(name for name, _ in diary) == "ab" + "aabb" + "bbaa" + "aabb"
    assert [work for _, work in diary] == [0, 0, *[0, 1] * 2, *[1, 2] * 2, *[2, 3] * 2]
    assert [len(each) for each in times] == [3, 3]


def test_the_judge_sees_answers_in_the_order_of_makers() -> None:
    """Whoever begins, the first answer is the first implementation's."""
    seen: list[list[float]] = []

    def maker(answer: float) -> Any:
        return lambda _work: Job(lambda: answer, lambda done: np.array([[done]]), 1)

    def judge(_work: Any, answers: Any) -> None:
        seen.append([float(answer[0, 0]) for answer in answers])

    take_turns([maker(1.0), maker(2.0), maker(3.0)], [0, 0, 0], warm_up=0, judge=judge)
    assert seen == [[1.0, 2.0, 3.0]] * 3


def test_the_collector_rests_while_the_clock_runs() -> None:
    """Garbage is collected before, and the collector is as it was after."""
    states: list[bool] = []

    def maker(_work: Any) -> Job:
        return Job(lambda: states.append(gc.isenabled()), lambda _done: np.zeros((1, 1)), 1)

    take_turns([maker], [0, 0], warm_up=0, judge=demand_equal)
    assert states == [True, False, False, False, False]
    assert gc.isenabled()


def rows(*values: float) -> Answer:
    """Return one column."""
    return np.array([[value] for value in values])


def test_equality_is_of_bits() -> None:
    """Zeros of different sign differ, NaN is itself."""
    same = equal_rows(rows(0.0, math.nan, 1.0), rows(-0.0, math.nan, 1.0))
    assert same.tolist() == [False, True, True]


def test_a_difference_is_named() -> None:
    """The first query that is answered differently is told with both answers."""
    with pytest.raises(DisagreementError, match=r"query 1: \[2\.0\] and \[3\.0\]"):
        demand_equal(None, [rows(1.0, 2.0), rows(1.0, 2.0), rows(1.0, 3.0)])


def test_answers_of_different_shape_differ() -> None:
    """Another number of numbers is a difference."""
    with pytest.raises(DisagreementError, match="shape"):
        demand_equal(None, [rows(1.0), np.array([[1.0, 2.0]])])


def test_no_answers_at_all_are_not_equal() -> None:
    """Nothing has been compared then."""
    with pytest.raises(DisagreementError, match="shape"):
        demand_equal(None, [rows(1.0), np.empty((0, 1))])


def test_a_sample_is_compared_as_far_as_it_goes() -> None:
    """Who was asked some of the queries is held against the first answers of who was asked all."""
    every, some, wrong = rows(1.0, 2.0, 3.0), rows(1.0, 2.0), rows(1.0, 4.0)
    demand_equal(None, [every, some])
    for answers in ([every, wrong], [wrong, every]):
        with pytest.raises(DisagreementError, match="query 1"):
            demand_equal(None, answers)


def test_a_missing_answer_is_noticed() -> None:
    """Who answers less than what was asked is not clocked."""

    def maker(_work: Any) -> Job:
        return Job(lambda: None, lambda _done: rows(1.0), 2)

    with pytest.raises(DisagreementError, match="1 answers to 2 queries"):
        take_turns([maker], [0], warm_up=0, judge=demand_equal)


def test_a_sample_is_of_the_first_queries() -> None:
    """They come in random order; nobody else is asked less for it. Of less work it is as large a share."""
    asked: list[list[int]] = []

    def maker(work: Numbers) -> Job:
        asked.append(list(work.values))
        return Job(lambda: None, lambda _done: np.zeros((len(work), 1)), len(work))

    makers = [maker, sample_of(maker, 4, 8)]
    first, second = Numbers((1, 2, 3, 4, 5, 6, 7, 8)), Numbers((11, 12, 13, 14, 15, 16, 17, 18))
    take_turns(makers, [second], warm_up=first, judge=demand_equal, lead_in=quarter)
    assert asked[:2] == [list(first.values), [1, 2, 3, 4]]
    assert asked[2:4] == [[1, 2], list(second.values)]
    assert asked[4:] == [[1], [11, 12, 13, 14]]


def test_time_is_told_of_one_repeat(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two bodies that tick four times each have taken an eighth of the time for a tick."""
    seconds = iter([1.0, 3.0])
    monkeypatch.setattr(timing, "perf_counter", lambda: next(seconds))
    elapsed, done = clock(Job(lambda: "done", lambda _done: rows(1.0, 2.0), 2, repeats=4))
    assert (elapsed, done) == (0.25e9, "done")


def test_rounds_are_drawn_when_they_come() -> None:
    """Queries of a round need not be kept till the end of the run."""
    diary: list[tuple[str, Any]] = []

    def works() -> Iterator[int]:
        for number in (1, 2):
            diary.append(("drawn", number))
            yield number

    take_turns([Diary("a", diary)], works(), warm_up=0, judge=demand_equal)
    assert diary == [("a", 0), ("drawn", 1), ("a", 0), ("a", 1), ("drawn", 2), ("a", 1), ("a", 2)]


def test_ratio_is_their_time_over_ours() -> None:
    """Ratios are taken round by round before they are summarised."""
    found = comparison([1.0, 2.0, 4.0], [10.0, 10.0, 10.0])
    assert (found.ratio.middle, found.ours.middle, found.theirs.middle) == (5.0, 2.0, 10.0)
    assert found.rounds == 3
