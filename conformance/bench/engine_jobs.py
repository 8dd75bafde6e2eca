"""The engine at work: in calls of so many queries, on so many threads."""

from __future__ import annotations

from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

import numpy as np

import engine
from conformance.bench import ops
from conformance.bench.sampling import QUANTUM
from conformance.bench.settings import LARGE, SMALL
from conformance.bench.timing import Answer, Job, sample_of
from conformance.bench.work import batches

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from conformance.bench.timing import Maker
    from conformance.bench.work import KernelWork, RowWork

TICKS: Final = 4
"""Ticks of a body in one round."""
_NOTHING: Final[Mapping[str, Any]] = MappingProxyType({})


def engine_maker(op: str, batch: int, threads: int = 1, options: Mapping[str, Any] = _NOTHING) -> Maker:
    """Return the engine as an implementation of an operation.

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
    return partial(prepare, partial(function, threads=threads, **options), batch)


def in_calls(op: str, batch: int) -> Maker:
    """Return the engine in calls of so many queries: a sample of them where calls are small."""
    maker = engine_maker(op, batch)
    return maker if batch == LARGE else sample_of(maker, SMALL)


def _calls(function: Callable[..., Any], batch: int, arrays: Sequence[Any]) -> Callable[[], list[Any]]:
    """Return what calls a function with so many rows of the arrays at a time, till all were given."""
    calls = [
        partial(function, *(array[first:last] for array in arrays))
        for first, last in batches(len(arrays[0]), batch)
    ]
    return lambda: [call() for call in calls]


def _tree_calls(
    function: Callable[..., Any], batch: int, work: KernelWork, arrays: Sequence[Any]
) -> Callable[[], list[Any]]:
    scene = work.scene
    return _calls(partial(function, scene.world, scene.world.cell_index(scene.pose.cell)), batch, arrays)


def _strike_job(function: Callable[..., Any], batch: int, work: KernelWork) -> Job:
    run = _tree_calls(function, batch, work, (work.spheres, work.movements))
    return Job(run, kernel_answer, len(work))


def _touch_job(function: Callable[..., Any], batch: int, work: KernelWork) -> Job:
    """Make a job of asking which spheres touch: those for which a polygon is found, struck or not."""

    def answer(done: Any) -> Answer:
        polygons = np.concatenate([part[1] for part in done])
        return (polygons >= 0).astype(np.float64).reshape(-1, 1)

    run = _tree_calls(function, batch, work, (work.spheres, work.movements))
    return Job(run, answer, len(work))


def _step_down_job(function: Callable[..., Any], batch: int, work: KernelWork) -> Job:
    arrays = (work.spheres, work.movements, work.ups, work.allowances, work.interps)
    return Job(_tree_calls(function, batch, work, arrays), kernel_answer, len(work))


def _row_job(function: Callable[..., Any], batch: int, work: RowWork) -> Job:
    run = _calls(partial(function, work.scene.world), batch, [work.rows])
    return Job(run, lambda done: moved_answer(np.concatenate(done)), len(work))


def _tick_job(function: Callable[..., Any], batch: int, work: RowWork) -> Job:
    rows = work.rows.copy()
    tick = partial(function, work.scene.world)
    run = _calls(lambda bodies: tick(bodies, QUANTUM, TICKS), batch, [rows])
    return Job(run, lambda _: body_answer(rows), len(rows), TICKS)


def kernel_answer(done: Any) -> Answer:
    """Return what is compared of calls of a tree: every array that they have returned, side by side."""
    return np.concatenate([np.column_stack(part) for part in done]).astype(np.float64)


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
