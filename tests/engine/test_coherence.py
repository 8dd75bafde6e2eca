"""Coherent batches: answered out of turn, with the same bytes at the same places."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_scenes import CELL, R, at, mover, triangle, world_of
from hypothesis import given, settings
from hypothesis import strategies as st
from random_moves import random_moves, world_at

from conformance.strategies.worlds.sites import SITES
from engine import (
    Body,
    Move,
    Target,
    UndeterminedError,
    body_rows,
    find_collisions_many,
    find_object_collisions_many,
    resolve_many,
    step_down_many,
    step_many,
    strike_many,
    update_many,
)
from engine import layout as of
from engine.constants import ACTIVE_TS, CONTACT_TS, FLOOR_Z, ON_WALKABLE_TS
from engine.kernels.order import SMALLEST
from engine.probes import count_reordered
from engine.query import move_rows
from engine.tracing import run_by

if TYPE_CHECKING:
    from collections.abc import Callable

    from engine.kernels.types import Array
    from engine.query import Rows

SIDE = 60.0
"""Of the floor that everybody is on, metres."""
WORLD = world_of(triangle(SIDE))
COUNT = 2_400
RNG = np.random.default_rng(3)
PLACES = RNG.uniform((-15.0, -25.0, R - 0.1), (15.0, 5.0, R + 0.1), size=(COUNT, 3)).astype(np.float32)
WAYS = RNG.uniform((-0.3, -0.3, -0.4), (0.3, 0.3, 0.1), size=(COUNT, 3)).astype(np.float32)


def rows_of_walks() -> Rows:
    """Return moves of movers that stand on the floor."""
    rows = np.repeat(move_rows(WORLD, [Move(mover(3), at(0, 0, R), CELL, start=at(0, 0, R))]), COUNT)
    rows["start"][:, -3:], rows["end"][:, -3:] = PLACES, (PLACES + WAYS).astype(np.float32)
    rows["contact_plane_valid"], rows["contact_plane_cell_id"] = 1.0, CELL
    rows["contact_plane"] = (0.0, 0.0, 1.0, 0.0)
    rows["target_cell"], rows["target_object"] = 0, of.NO_OBJECT
    rows["walk_interp"], rows["walkable_allowance"] = 1.0, FLOOR_Z
    return rows


def rows_of_bodies() -> Rows:
    """Return bodies that walk on the floor, and some that fall."""
    state = int(ACTIVE_TS) | int(CONTACT_TS) | int(ON_WALKABLE_TS)
    ground = {"contact_plane": (0.0, 0.0, 1.0, 0.0), "contact_plane_cell": CELL, "transient_state": state}
    one = Body(at(0, 0, R), [(0, 0, 0, R)], has_movement_manager=True, **ground)  # type: ignore[arg-type]
    rows = np.repeat(body_rows(WORLD, [one]), COUNT)
    rows["origin"], rows["velocity"] = PLACES, 4.0 * WAYS
    return rows


def spheres() -> Array:
    """Return spheres at the places of walks."""
    return np.column_stack([PLACES, np.full(COUNT, R)]).astype(np.float64)


def strike(order: Any = slice(None), **options: Any) -> tuple[Any, ...]:
    """Strike with spheres, in an order."""
    return strike_many(WORLD, 0, spheres()[order], WAYS[order], **options)


def step_down(order: Any = slice(None), **options: Any) -> tuple[Any, ...]:
    """Step down with spheres, in an order."""
    ups, ones = np.tile((0.0, 0.0, 1.0), (COUNT, 1)), np.ones(COUNT)
    return step_down_many(WORLD, 0, spheres()[order], WAYS[order], ups, 0.5 * ones, ones, **options)


def walk(order: Any = slice(None), **options: Any) -> tuple[Any, ...]:
    """Walk, in an order."""
    return (resolve_many(WORLD, rows_of_walks()[order], **options),)


def call(order: Any = slice(None), **options: Any) -> tuple[Any, ...]:
    """Call the floor's tree, in an order."""
    return (find_collisions_many(WORLD, rows_of_walks()[order], **options),)


def meet(order: Any = slice(None), **options: Any) -> tuple[Any, ...]:
    """Call the cell, in an order."""
    rows = rows_of_walks()
    rows["target_kind"] = Target.CELL
    return (find_object_collisions_many(WORLD, rows[order], **options),)


def tick(order: Any = slice(None), **options: Any) -> tuple[Any, ...]:
    """Let bodies tick, in an order."""
    return (step_many(WORLD, rows_of_bodies()[order], 0.05, 3, **options),)


def update(order: Any = slice(None), **options: Any) -> tuple[Any, ...]:
    """Update bodies, in an order."""
    return (update_many(WORLD, rows_of_bodies()[order], 0.5, **options),)


OPERATIONS: list[Callable[..., tuple[Any, ...]]] = [strike, step_down, walk, call, meet, tick, update]


def bits(answers: tuple[Any, ...]) -> list[bytes]:
    """Return all answers as their bytes."""
    return [np.ascontiguousarray(answer).tobytes() for answer in answers]


@pytest.mark.parametrize("ask", OPERATIONS)
@pytest.mark.parametrize("threads", [1, 2])
def test_no_bit_depends_on_the_order(ask: Callable[..., tuple[Any, ...]], threads: int) -> None:
    """On and off, counters of work included; and it is taken where it is on."""
    with count_reordered() as off:
        expected = bits(ask(coherent=False))
    with count_reordered() as on:
        assert bits(ask(threads=threads)) == expected
    assert (off.queries, off.batches) == (0, 0)
    assert (on.queries, on.batches) == (COUNT, 1)


@pytest.mark.parametrize("ask", OPERATIONS)
@settings(max_examples=5, deadline=None)
@given(data=st.data())
def test_permuted_batches_have_permuted_answers(ask: Callable[..., tuple[Any, ...]], data: Any) -> None:
    """Whichever way a batch is asked."""
    order = np.random.default_rng(data.draw(st.integers(0, 2**32))).permutation(COUNT)
    assert bits(ask(order)) == bits(tuple(answer[order] for answer in ask()))


@pytest.mark.parametrize("name", sorted(SITES))
def test_random_worlds_are_answered_alike(name: str) -> None:
    """With rooms, land, houses and things; the first undetermined query has the same index."""
    rows = random_moves(name, np.random.default_rng(sorted(SITES).index(name)), 1_500)
    rows["contact_plane_valid"], rows["contact_plane_cell_id"] = 1.0, rows["start"][:, 0]
    rows["contact_plane"] = (0.0, 0.0, 1.0, -1.0)
    rows["contact_plane"][:, 3] = -rows["start"][:, -1]
    with count_reordered() as count:
        on = told(name, rows, coherent=True)
    assert count.queries in (0, len(rows))
    assert on == told(name, rows, coherent=False)


def told(name: str, rows: Rows, *, coherent: bool) -> tuple[str, bytes]:
    """Return what is raised, and all answers as their bytes."""
    try:
        return "", resolve_many(world_at(name), rows, coherent=coherent).tobytes()
    except UndeterminedError as error:
        return str(error), error.results.tobytes()


def test_small_batches_are_answered_as_asked() -> None:
    """Like single queries."""
    with count_reordered() as count:
        resolve_many(WORLD, rows_of_walks()[:100])
    assert count.queries == 0


def test_flights_are_answered_as_asked() -> None:
    """A row that is read out of turn costs more than a flight."""
    rows = rows_of_walks()
    rows["contact_plane_valid"] = 0.0
    with count_reordered() as count:
        resolve_many(WORLD, rows)
    assert count.queries == 0


def test_what_is_recorded_is_in_the_order_asked() -> None:
    """Who runs kernels in place of compiled code is given no other order."""

    class Asked:
        def run(self, kernel: Any, *arguments: Any) -> None:
            *_, order, _share = arguments
            orders.append(len(order))
            kernel(*arguments)

    orders: list[int] = []
    with count_reordered() as count, run_by(Asked()):
        assert bits(walk()) == bits(walk(coherent=False))
    assert (orders, count.queries) == ([0, 0], 0)


def test_counting_ends_with_its_block() -> None:
    """And an inner block has its own count."""
    with count_reordered() as outer:
        strike()
        with count_reordered() as inner:
            strike()
            strike()
    strike()
    assert (outer.batches, inner.batches) == (1, 2)


@pytest.mark.parametrize("threads", [1, 2])
def test_all_threads_have_one_order(threads: int) -> None:
    """In a batch that is just large enough for one, and in one that is one query short of it."""
    for count, expected in ((SMALLEST, SMALLEST), (SMALLEST - 1, 0)):
        with count_reordered() as reordered:
            strike(slice(count), threads=threads)
        assert reordered.queries == expected
