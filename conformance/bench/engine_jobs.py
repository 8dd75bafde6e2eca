"""The engine at work: in calls of so many queries, on so many threads."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

import numpy as np

import engine
from conformance.bench import ops
from conformance.bench.kept import Kept
from conformance.bench.sampling import QUANTUM
from conformance.bench.settings import LARGE, SMALL
from conformance.bench.timing import Answer, Job, sample_of
from conformance.bench.work import batches
from engine.layout import RESULT_DTYPE

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from conformance.bench.timing import Maker
    from conformance.bench.work import KernelWork, RowWork

TICKS: Final = 4
"""Ticks of a body in one round."""
_NOTHING: Final[Mapping[str, Any]] = MappingProxyType({})


def engine_maker(op: str, batch: int, threads: int = 1, options: Mapping[str, Any] = _NOTHING) -> Maker:
    """Return the engine as an implementation of an operation, with memory of its own for the results.

    Parameters
    ----------
    op : str
        Of `conformance.bench.ops`.
    batch : int
        Queries in a call, at most.
    threads : int
        In a call.
    options : mapping
        What else the engine's function is told by name.
    """
    function, prepare = _JOBS[op]
    return partial(prepare, partial(function, threads=threads, **options), batch, Kept())


def in_calls(op: str, batch: int) -> Maker:
    """Return the engine in calls of so many queries: a sample of them where calls are small."""
    maker = engine_maker(op, batch)
    return maker if batch == LARGE else sample_of(maker, SMALL, LARGE)


def _all_of(calls: Sequence[Callable[[], Any]]) -> Callable[[], None]:
    def run() -> None:
        for call in calls:
            call()

    return run


def _tree_job(
    function: Callable[..., Any], batch: int, work: KernelWork, given: Sequence[Any], out: Sequence[Any]
) -> Job:
    """Make a job of calls of the cell's tree; all arrays have a row for each query."""
    ask = partial(function, work.scene.world, work.scene.world.cell_index(work.scene.pose.cell))
    calls = [
        partial(ask, *(array[first:last] for array in given), out=tuple(array[first:last] for array in out))
        for first, last in batches(len(work), batch)
    ]
    return Job(_all_of(calls), lambda _: np.column_stack(out).astype(np.float64), len(work))


def _strike_job(function: Callable[..., Any], batch: int, kept: Kept, work: KernelWork) -> Job:
    out = [kept.array(name, (len(work),), np.int32) for name in ("struck", "polygons")]
    return _tree_job(function, batch, work, (work.spheres, work.movements), out)


def _touch_job(function: Callable[..., Any], batch: int, kept: Kept, work: KernelWork) -> Job:
    """Make a job of asking which spheres touch: those for which a polygon is found, struck or not."""
    job = _strike_job(function, batch, kept, work)
    return replace(job, answer=lambda done: (job.answer(done)[:, 1:] >= 0.0).astype(np.float64))


def _step_down_job(function: Callable[..., Any], batch: int, kept: Kept, work: KernelWork) -> Job:
    given = (work.spheres, work.movements, work.ups, work.allowances, work.interps)
    count = len(work)
    centers = kept.array("centers", (count, 3), np.float64)
    interps = kept.array("interps", (count,), np.float64)
    polygons = kept.array("polygons", (count,), np.int32)
    return _tree_job(function, batch, work, given, (centers, interps, polygons))


def _row_job(function: Callable[..., Any], batch: int, kept: Kept, work: RowWork) -> Job:
    results = kept.array("results", (len(work),), RESULT_DTYPE)
    calls = [
        partial(function, work.scene.world, work.rows[first:last], out=results[first:last])
        for first, last in batches(len(work), batch)
    ]
    return Job(_all_of(calls), lambda _: moved_answer(results), len(work))


def _tick_job(function: Callable[..., Any], batch: int, kept: Kept, work: RowWork) -> Job:
    rows = kept.array("bodies", work.rows.shape, work.rows.dtype)
    rows[:] = work.rows
    calls = [
        partial(function, work.scene.world, rows[first:last], QUANTUM, TICKS)
        for first, last in batches(len(rows), batch)
    ]
    return Job(_all_of(calls), lambda _: body_answer(rows), len(rows), TICKS)


def moved_answer(results: Any) -> Answer:
    """Return what is compared of result rows: outcome, place, contact plane, normals that count."""
    columns = [
        results["result"],
        *results["check"].T,
        *results["curr"].T,
        results["contact_plane_valid"],
        *(results["contact_plane"] * results["contact_plane_valid"][:, np.newaxis]).T,
        results["collision_normal_valid"],
        *(results["collision_normal"] * results["collision_normal_valid"][:, np.newaxis]).T,
        results["walkable"],
    ]
    return np.column_stack(columns) + 0.0


def body_answer(rows: Any) -> Answer:
    """Return what is compared of bodies: place, velocity, transient state."""
    columns = [*rows["origin"].T, *rows["rotation"].T, *rows["velocity"].T, rows["transient_state"]]
    return np.column_stack(columns)


_JOBS: Final[Mapping[str, tuple[Callable[..., Any], Callable[..., Job]]]] = {
    ops.STRIKE: (engine.strike_many, _strike_job),
    ops.TOUCH: (engine.strike_many, _touch_job),
    ops.STEP_DOWN: (engine.step_down_many, _step_down_job),
    ops.FIND_COLLISIONS: (engine.find_collisions_many, _row_job),
    ops.CONTACT_WALK: (engine.resolve_many, _row_job),
    ops.FREE_FLIGHT: (engine.resolve_many, _row_job),
    ops.TICK: (engine.step_many, _tick_job),
}
"""Operation to the function of the engine that performs it, and what makes a job of calling it."""
