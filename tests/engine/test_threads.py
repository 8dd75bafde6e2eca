"""Threads: the same bytes for any number of them."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier
from threading import enumerate as enumerate_threads

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
    update_many,
)
from engine.threads import in_parts
from engine.tracing import recording

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


def test_parts_cover_everything_once() -> None:
    """Whatever the number of pieces and threads."""
    for count in (0, 1, 5, 16):
        for threads in (1, 2, 3, 7):
            done = np.zeros(count, dtype=int)

            def work(part: slice, done: np.ndarray = done) -> None:
                done[part] += 1

            in_parts(work, count, threads)
            assert (done == 1).all()


def test_no_threads_are_no_number_of_threads() -> None:
    """At least the calling one."""
    with pytest.raises(QueryError, match="threads: 0"):
        resolve_many(world_of(floor_and_wall()), MOVES, threads=0)


def test_an_error_in_a_thread_is_raised() -> None:
    """Not swallowed with the thread; of two, either."""

    def fail(part: slice) -> None:
        raise ArithmeticError(str(part.start))

    with pytest.raises(ArithmeticError, match=r"[01]"):
        in_parts(fail, 4, 2)


def test_several_callers_at_a_time() -> None:
    """They share the helpers, and nobody's pieces are left out, done twice, or done after the return."""
    size, callers = 500, 8

    def call(_: int) -> bool:
        done = np.zeros(size, dtype=int)

        def work(part: slice) -> None:
            done[part] += 1

        in_parts(work, size, 3)
        return bool((done == 1).all())

    with ThreadPoolExecutor(callers) as others:
        assert all(others.map(call, range(20 * callers)))


def test_helpers_are_kept_for_the_next_batch() -> None:
    """No call starts more of them than there are processors."""
    barrier = Barrier(2)

    def meet(_part: slice) -> None:
        barrier.wait(timeout=60)

    for _ in range(20):
        in_parts(meet, 2, 2)
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
    parts: list[slice] = []
    with recording():
        in_parts(parts.append, 4, 2)
    assert parts == [slice(0, 4)]
