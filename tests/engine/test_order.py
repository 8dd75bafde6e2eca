"""The order of a batch: by place, whatever the numbers are; and only where it pays."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from threading import Thread
from time import sleep
from typing import TYPE_CHECKING

import numpy as np
import pytest
from engine_scenes import CELL, floor_and_wall, world_of
from hypothesis import given, settings
from hypothesis import strategies as st

from engine import layout as of
from engine.body_layout import BODY_DTYPE
from engine.coherence import AS_ASKED, order_of
from engine.constants import ACTIVE_TS
from engine.kernels.order import (
    BODIES,
    BUCKETS,
    CALLS,
    MOVES,
    SMALLEST,
    SPHERES,
    order_all,
)
from engine.kernels.sharing import SHARE_DONE, SHARE_READY, SHARE_REORDERED, SHARE_SORTERS
from engine.kernels.tree_calls import strike_many
from engine.memory import rows_as_numbers
from engine.threads import new_share

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Order
    from engine.query import Rows

COUNT = 2 * int(SMALLEST)
EAST = CELL + 0x01000000
"""A cell of the block to the east of the usual one."""


def order_at(kind: int, rows: Array) -> tuple[Order, Order]:
    """Return the order of rows, and each row's bucket."""
    order, share = np.empty(2 * len(rows) + int(BUCKETS), dtype=np.int32), new_share(len(rows))
    order_all(kind, rows, order, share)
    assert share[SHARE_REORDERED] == len(rows)
    return order[: len(rows)], order[len(rows) : 2 * len(rows)]


def spheres_within(side: float, count: int = COUNT) -> Array:
    """Return spheres at random places of a square, metres."""
    rng = np.random.default_rng(1)
    return np.column_stack([rng.uniform(0.0, side, size=(count, 2)), np.ones(count), np.full(count, 0.5)])


def queries_within(side: float, count: int = COUNT) -> Rows:
    """Return queries that end at random places of a square, by movers that stand on something."""
    rows = np.zeros(count, dtype=of.QUERY_DTYPE)
    rows["end"][:, 0] = CELL
    rows["end"][:, -3:] = spheres_within(side, count)[:, :3]
    rows["contact_plane_valid"] = 1.0
    return rows


def bodies_within(side: float) -> Rows:
    """Return bodies that are active, at random places of a square."""
    rows = np.zeros(COUNT, dtype=BODY_DTYPE)
    rows["cell_id"], rows["transient_state"] = CELL, ACTIVE_TS
    rows["origin"] = spheres_within(side)[:, :3]
    return rows


def test_rows_are_sorted_by_place_and_then_as_they_lie() -> None:
    """Every row once; those of a bucket in the order in which they came."""
    order, own = order_at(SPHERES, spheres_within(60.0))
    assert order.tolist() == np.argsort(own, kind="stable").tolist()
    assert np.unique(own).size > 700


def test_who_is_in_one_bucket_is_near() -> None:
    """Nobody is farther from his neighbour in the order than a few metres, nearly always."""
    spheres = spheres_within(60.0)
    order, own = order_at(SPHERES, spheres)
    apart = np.abs(np.diff(spheres[order, :2], axis=0))
    assert (apart[np.diff(own[order]) == 0] < 2.0).all()
    assert np.median(apart.max(axis=1)) < 3.0


def widest_bucket(kind: int, rows: Array, places: Array) -> float:
    """Return how far from each other those are at most that are in one bucket, along x or y."""
    order, own = order_at(kind, rows)
    apart = np.abs(np.diff(places[order, :2], axis=0)).max(axis=1)
    return float(apart[np.diff(own[order]) == 0].max())


@pytest.mark.parametrize(("side", "width"), [(120.0, 2.0), (240.0, 4.0), (480.0, 8.0), (960.0, 16.0)])
def test_buckets_are_as_wide_as_the_batch_needs(side: float, width: float) -> None:
    """Nobody from the other end is among those that are near."""
    spheres = spheres_within(side, 20 * COUNT)
    assert 0.9 * width < widest_bucket(SPHERES, spheres, spheres) < width


def test_blocks_side_by_side_are_as_wide_as_they_are() -> None:
    """Queries in four landblocks around a corner, 240 metres each way: buckets of 4 metres."""
    rows, places = queries_within(240.0, 20 * COUNT), spheres_within(240.0, 20 * COUNT)
    east, north = (places[:, axis] >= 192.0 for axis in (0, 1))
    rows["end"][:, 0] += 0x01000000 * east + 0x00010000 * north
    rows["end"][:, 5] -= 192.0 * east
    rows["end"][:, 6] -= 192.0 * north
    for kind in (CALLS, MOVES):
        assert 3.6 < widest_bucket(kind, rows_as_numbers(rows), places) < 4.0


def test_one_that_is_lost_widens_no_bucket() -> None:
    """It does not matter which row it is, nor where it is lost."""
    spheres = spheres_within(60.0)
    own = order_at(SPHERES, spheres)[1]
    for lost in range(0, COUNT, 62):
        for where in (-700.0, 700.0, np.inf, np.nan):
            others = spheres.copy()
            others[lost, :2] = where
            found = order_at(SPHERES, others)[1]
            assert np.array_equal(np.delete(found, lost), np.delete(own, lost))


def test_places_far_from_each_other_have_narrow_buckets() -> None:
    """Two dungeons on the map: those of each are as near as if it were alone."""
    spheres, own = spheres_within(60.0), order_at(SPHERES, spheres_within(60.0))[1]
    spheres[::3, 0] += 12_800.0
    assert np.array_equal(order_at(SPHERES, spheres)[1], own)


@pytest.mark.parametrize("z", [-3.9, 0.5, 7.0])
def test_floors_are_kept_apart(z: float) -> None:
    """Four metres are another bucket, also below the block's zero."""
    low, high = spheres_within(60.0), spheres_within(60.0)
    low[:, 2], high[:, 2] = z, z + 4.0
    assert (order_at(SPHERES, low)[1] != order_at(SPHERES, high)[1]).all()


def test_blocks_are_in_one_space() -> None:
    """A query a step beyond the border of a landblock is in the bucket of who is a step before it."""
    rows = queries_within(40.0)
    rows["end"][0, -3:], rows["end"][1, -3:] = (192.5, 30.0, 1.0), (0.5, 30.0, 1.0)
    rows["end"][1, 0] = EAST
    for kind in (CALLS, MOVES):
        assert len(set(order_at(kind, rows_as_numbers(rows))[1][:2].tolist())) == 1


def test_bodies_are_where_they_are() -> None:
    """In the same buckets as queries that end there."""
    queries, bodies = queries_within(40.0), bodies_within(40.0)
    of_queries, of_bodies = (
        order_at(MOVES, rows_as_numbers(queries)),
        order_at(BODIES, rows_as_numbers(bodies)),
    )
    assert np.array_equal(of_queries, of_bodies)


@settings(max_examples=50)
@given(st.lists(st.floats(allow_nan=True, allow_infinity=True), min_size=4, max_size=12))
def test_no_number_is_too_strange(strange: list[float]) -> None:
    """Infinities, NaN and what is larger than any integer are put somewhere: every row keeps its turn."""
    spheres, queries = spheres_within(60.0, int(SMALLEST)), queries_within(60.0)
    spheres[: len(strange), :3] = np.array(strange)[:, np.newaxis]
    queries["end"][: len(strange), -3:] = spheres[: len(strange), :3]
    queries["end"][: len(strange), 0] = strange
    for kind, rows in ((SPHERES, spheres), (CALLS, rows_as_numbers(queries))):
        order = order_of(kind, rows)
        assert np.array_equal(np.sort(order), np.arange(len(rows)))


def test_few_are_answered_as_they_lie() -> None:
    """Sorting them takes longer than it saves."""
    spheres = spheres_within(60.0, int(SMALLEST))
    assert len(order_of(SPHERES, spheres)) == SMALLEST
    assert order_of(SPHERES, spheres[1:]) is AS_ASKED


def test_who_is_near_everybody_is_answered_in_turn() -> None:
    """All within a room are near each other as they lie, for every kind of rows."""
    for kind, rows in ((SPHERES, spheres_within(6.0)), (MOVES, rows_as_numbers(queries_within(6.0)))):
        assert order_of(kind, rows) is AS_ASKED
    for side, turns in ((14.0, 0), (30.0, COUNT)):
        assert len(order_of(CALLS, rows_as_numbers(queries_within(side)))) == turns
    assert len(order_of(MOVES, rows_as_numbers(queries_within(14.0)))) == COUNT
    assert order_of(BODIES, rows_as_numbers(bodies_within(6.0))) is AS_ASKED


def test_what_takes_no_time_is_answered_in_turn() -> None:
    """If most movers are in the air, or most bodies rest; single calls are no flights."""
    rows, bodies = queries_within(60.0), bodies_within(60.0)
    rows["contact_plane_valid"][: COUNT // 4] = 0.0
    bodies["transient_state"][: COUNT // 4] = 0.0
    assert (
        len(order_of(MOVES, rows_as_numbers(rows))) == len(order_of(BODIES, rows_as_numbers(bodies))) == COUNT
    )
    rows["contact_plane_valid"][: 3 * COUNT // 4] = 0.0
    bodies["transient_state"][: 3 * COUNT // 4] = 0.0
    assert order_of(MOVES, rows_as_numbers(rows)) is order_of(BODIES, rows_as_numbers(bodies)) is AS_ASKED
    assert len(order_of(CALLS, rows_as_numbers(rows))) == COUNT


def strike_all(order: Order, share: Ints) -> None:
    """Strike a floor with spheres at random places, in one thread."""
    world, spheres = world_of(floor_and_wall()), spheres_within(60.0)
    struck, polygons = np.empty((2, COUNT), dtype=np.int32)
    arrays = (spheres, -np.ones((COUNT, 3)), struck, polygons)
    strike_many(world.floats, world.ints, world.new_row(), world.tree_of(0), *arrays, order, share)


@pytest.mark.parametrize("lanes", [1, 2])
def test_all_lanes_have_one_order(lanes: int) -> None:
    """Each thread begins in another place of it, as the buckets lie, not as the rows do."""
    order, share = np.empty(2 * COUNT + int(BUCKETS), dtype=np.int32), new_share(COUNT, lanes)
    strike_all(order, share)
    assert order[:COUNT].tolist() == order_at(SPHERES, spheres_within(60.0))[0].tolist()
    assert (share[SHARE_REORDERED], share[SHARE_DONE]) == (COUNT, COUNT)


@pytest.mark.parametrize("threads", [2, 3, 5])
def test_one_thread_sorts_and_the_others_wait(threads: int) -> None:
    """All have the same order when they return, and nobody has made it a second time."""
    spheres, alone = spheres_within(60.0), order_at(SPHERES, spheres_within(60.0))[0]
    for _ in range(20):
        order, share = np.zeros(2 * COUNT + int(BUCKETS), dtype=np.int32), new_share(COUNT)

        def sort(order: Order = order, share: Ints = share) -> bool:
            order_all(SPHERES, spheres, order, share)
            return np.array_equal(order[:COUNT], alone)

        with ThreadPoolExecutor(threads) as others:
            assert all(found.result() for found in [others.submit(sort) for _ in range(threads)])
        assert (share[SHARE_SORTERS], share[SHARE_READY]) == (threads, 1)


def test_who_comes_late_leaves_the_order_as_it_is() -> None:
    """It is not made a second time."""
    order, share = np.zeros(2 * COUNT + int(BUCKETS), dtype=np.int32), new_share(COUNT)
    order[:COUNT] = np.arange(COUNT)[::-1]
    share[SHARE_SORTERS] = share[SHARE_READY] = 1
    strike_all(order, share)
    assert order[:COUNT].tolist() == list(range(COUNT))[::-1]
    assert (share[SHARE_REORDERED], share[SHARE_DONE]) == (0, COUNT)


def test_the_order_is_waited_for() -> None:
    """No row is taken before."""
    order, share = np.arange(2 * COUNT + int(BUCKETS), dtype=np.int32), new_share(COUNT)
    share[SHARE_SORTERS] = 1
    thread = Thread(target=strike_all, args=(order, share))
    thread.start()
    while share[SHARE_SORTERS] == 1 and thread.is_alive():
        sleep(0)
    assert share[SHARE_DONE] == 0
    share[SHARE_READY] = 1
    thread.join()
    assert share[SHARE_DONE] == COUNT
