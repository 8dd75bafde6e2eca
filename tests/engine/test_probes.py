"""Work is counted, added up, and set beside linear scans."""

from __future__ import annotations

import numpy as np
from engine_scenes import CELL, R, at, floor_and_wall, mover, triangle, world_of

from engine import Move, Plan, resolve, resolve_many
from engine import layout as of
from engine.body_layout import BODY_DTYPE
from engine.linear_scan import scanning
from engine.probes import WORK_FIELDS, Work, without_work, work_of
from engine.query import move_rows

FALL = Move(mover(), at(0.0, 0.0, R - 0.01), CELL, start=at(0.0, 0.0, R + 0.1))
FLIGHT = Move(mover(), at(0.25, 0.0, 3.0), CELL, start=at(0.0, 0.0, 3.0))


def test_work_adds_up() -> None:
    """Field by field."""
    one, two = Work(1, 2, 3, 4, 5, 6, 7, 8, 9, 10), Work(queries=1, flights=1)
    assert one + two == Work(2, 2, 3, 4, 5, 6, 7, 8, 10, 10)


def test_the_work_of_a_batch_is_that_of_its_queries() -> None:
    """Each as if it were alone."""
    world = world_of(triangle())
    together = resolve_many(world, move_rows(world, [FALL, FLIGHT]))
    alone = work_of(resolve(world, FALL)) + work_of(resolve(world, FLIGHT))
    assert work_of(together) == alone
    assert (alone.queries, alone.flights) == (2, 1)


def test_linear_scans_test_every_polygon_of_every_walk() -> None:
    """Of a tree of two polygons; interpreted kernels answer as compiled ones do."""
    world = world_of(floor_and_wall())
    expected = resolve(world, FALL, plan=Plan.none()).tobytes()
    with scanning() as scan:
        assert resolve(world, FALL, plan=Plan.none()).tobytes() == expected
    assert scan.walks > 0
    assert scan.polygons == 2 * scan.walks


def test_what_is_left_without_work_is_every_other_bit() -> None:
    """Of one record and of many; a changed counter is not seen, a sign of zero is."""
    results = np.zeros(3, dtype=of.RESULT_DTYPE)
    left = without_work(results)
    assert set(left) == set(of.RESULT_DTYPE.names) - WORK_FIELDS
    assert set(of.RESULT_DTYPE.names) > WORK_FIELDS
    assert set(BODY_DTYPE.names) > WORK_FIELDS - {"cells_listed", "objects_tested"}
    for name in WORK_FIELDS:
        results[name] = 1.0
    assert without_work(results) == left
    results["walk_interp"][1] = -0.0
    assert without_work(results) != left
    assert without_work(results[0]) == without_work(results[2]) != without_work(results[1])
