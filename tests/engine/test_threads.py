"""Threads: the same bytes for any number of them."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier, Lock, current_thread, main_thread
from threading import enumerate as enumerate_threads
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_scenes import CELL, R, at, floor_and_wall, mover, world_of

from engine import (
    Body,
    CollisionCall,
    ContactPlane,
    Move,
    PathState,
    QueryError,
    Seed,
    body_rows,
    find_collisions_many,
    resolve_many,
    step_many,
    strike_many,
    update_many,
)
from engine.kernels.sharing import (
    LANE_END,
    LANE_NEXT,
    SHARE_DONE,
    SHARE_FAILED,
    SHARE_LANES,
    join,
    lane_after,
    take,
)
from engine.threads import new_share, together
from engine.tracing import recording
from engine.tracing_interpreter import Interpreter

if TYPE_CHECKING:
    from collections.abc import Iterator

    from engine.kernels.types import Ints

LOCK = Lock()
INTERPRETER = Interpreter({})
GROUND = ContactPlane((0, 0, 1, 0), CELL)
MOVES = [
    Move(mover(3), at(0.1 * i, 0.5, R), CELL, start=at(0.1 * i - 0.3, 0, R), seed=Seed(GROUND, GROUND))
    for i in range(11)
]
CALLS = [CollisionCall(move, path=PathState(walkable_allowance=0.5, walk_interp=1.0)) for move in MOVES]
BODIES = [Body(at(0.0, 0.0, R + 0.1 * i), [(0, 0, 0, R)], velocity=(0.5 * i, 0, -1)) for i in range(5)]


@pytest.mark.parametrize("threads", [2, 3, 64])
def test_queries_are_answered_as_by_one_thread(threads: int) -> None:
    """Each part has a state of its own."""
    world = world_of(floor_and_wall())
    assert resolve_many(world, MOVES, threads=threads).tobytes() == resolve_many(world, MOVES).tobytes()
    many = find_collisions_many(world, CALLS, threads=threads)
    assert many.tobytes() == find_collisions_many(world, CALLS).tobytes()


@pytest.mark.parametrize("threads", [2, 5])
def test_bodies_move_as_with_one_thread(threads: int) -> None:
    """For ticks of a given length, and up to a given time."""
    world = world_of(floor_and_wall())
    one, many = (body_rows(world, BODIES) for _ in range(2))
    step_many(world, one, 0.1, 3)
    step_many(world, many, 0.1, 3, threads=threads)
    assert one.tobytes() == many.tobytes()
    update_many(world, one, 1.0)
    update_many(world, many, 1.0, threads=threads)
    assert one.tobytes() == many.tobytes()


def taken(share: Ints) -> Iterator[slice]:
    """Take queries from a share as kernels do, until there are none."""
    with LOCK:
        own = INTERPRETER.function(join)(share)
    for k in range(int(share[SHARE_LANES])):
        lane = INTERPRETER.function(lane_after)(share, own, k)
        while True:
            with LOCK:
                first, last = INTERPRETER.function(take)(share, lane)
            if first >= last:
                break
            yield slice(int(first), int(last))
            with LOCK:
                share[SHARE_DONE] += last - first


@pytest.mark.parametrize(("count", "threads"), [(0, 1), (1, 1), (10, 3), (64, 64)])
def test_a_share_is_cut_into_lanes(count: int, threads: int) -> None:
    """One for each thread; each begins where the one before ends, and they differ by one query at most."""
    share = new_share(count, threads)
    lanes = [INTERPRETER.function(lane_after)(share, 0, k) for k in range(threads)]
    bounds = [(int(share[lane + LANE_NEXT]), int(share[lane + LANE_END])) for lane in lanes]
    assert [first for first, _ in bounds] == [0, *(end for _, end in bounds[:-1])]
    assert bounds[-1][1] == count
    assert {end - first for first, end in bounds} <= {count // threads, count // threads + 1}


def test_everything_is_taken_once() -> None:
    """Whatever the number of queries and threads."""
    for count in (0, 1, 5, 16, 5000):
        for threads in (1, 2, 3, 7):
            done = np.zeros(count, dtype=int)

            def work(share: Ints, done: np.ndarray = done) -> None:
                for some in taken(share):
                    done[some] += 1

            assert together(work, count, threads) == 0
            assert (done == 1).all()


def test_kernels_take_everything_once() -> None:
    """With more queries than are taken at a time, by as many threads as there are helpers, and by more."""
    rng = np.random.default_rng(3)
    spheres = np.column_stack([rng.uniform(-1.0, 1.0, size=(5000, 3)), np.full(5000, R)])
    world, ways = world_of(floor_and_wall()), rng.normal(size=(5000, 3))
    one = strike_many(world, 0, spheres, ways)
    assert len(np.unique(one[1])) == 3
    for threads in (2, 5):
        many = strike_many(world, 0, spheres, ways, threads=threads)
        assert all(np.array_equal(mine, theirs) for mine, theirs in zip(many, one, strict=True))


def test_what_cannot_be_answered_is_counted() -> None:
    """By all threads together."""
    count = 100

    def work(share: Ints) -> None:
        for some in taken(share):
            with LOCK:
                share[SHARE_FAILED] += some.stop - some.start

    assert [together(work, count, threads) for threads in (1, 3)] == [count, count]


def test_an_error_in_a_thread_is_raised() -> None:
    """Not swallowed with the thread; of two, either."""

    def fail(_share: Ints) -> None:
        raise ArithmeticError("0")

    with pytest.raises(ArithmeticError, match="0"):
        together(fail, 4, 2)


def test_an_error_of_a_helper_is_raised() -> None:
    """Of one that has taken queries, which nobody else will do."""
    barrier = Barrier(2)

    def work(share: Ints) -> None:
        first = next(taken(share)).start
        barrier.wait(timeout=60)
        if current_thread() is not main_thread():
            raise ArithmeticError(first)
        share[SHARE_DONE] += 1

    with pytest.raises(ArithmeticError):
        together(work, 2, 2)


def test_several_callers_at_a_time() -> None:
    """They share the helpers, and nobody's pieces are left out, done twice, or done after the return."""
    size, callers = 500, 8

    def call(_: int) -> bool:
        done = np.zeros(size, dtype=int)

        def work(share: Ints) -> None:
            for some in taken(share):
                done[some] += 1

        together(work, size, 3)
        return bool((done == 1).all())

    with ThreadPoolExecutor(callers) as others:
        assert all(others.map(call, range(20 * callers)))


def test_helpers_are_kept_for_the_next_batch() -> None:
    """No call starts more of them than there are processors."""
    barrier = Barrier(2)

    def meet(_share: Ints) -> None:
        barrier.wait(timeout=60)

    for _ in range(20):
        together(meet, 2, 2)
    helpers = [thread for thread in enumerate_threads() if thread.name.startswith("engine")]
    assert 1 <= len(helpers) <= (os.cpu_count() or 1)


def test_while_writes_are_recorded_there_is_one_thread() -> None:
    """The recorder belongs to the calling thread, and the lines keep their order."""
    world = world_of(floor_and_wall())
    texts = []
    for threads in (1, 3):
        with recording() as trace:
            resolve_many(world, MOVES[:2], threads=threads)
        texts.append(repr(trace))
    shares: list[Ints] = []
    with recording():
        together(shares.append, 4, 2)
    assert [share[SHARE_LANES] for share in shares] == [1]


@pytest.mark.parametrize("threads", [0, -1, 1.0, None])
def test_what_is_no_number_of_threads_is_refused(threads: Any) -> None:
    """Whole numbers of NumPy are numbers, too."""
    world = world_of(floor_and_wall())
    with pytest.raises(QueryError, match="threads"):
        resolve_many(world, MOVES, threads=threads)
    assert resolve_many(world, MOVES, threads=np.int64(2)).tobytes() == resolve_many(world, MOVES).tobytes()
