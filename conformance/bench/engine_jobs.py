"""The engine at work: in calls of so many queries, on so many threads."""

from __future__ import annotations

import inspect
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np

import engine
from conformance.bench.sampling import QUANTUM
from conformance.bench.timing import Answer, Job
from conformance.bench.work import batches, repeated

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from conformance.bench.timing import Maker
    from conformance.bench.work import KernelWork, RowWork

TICKS: Final = 4
"""Ticks of a body in one round."""

STRIKE: Final = "strike"
STEP_DOWN: Final = "step_down"
FIND_COLLISIONS: Final = "find_collisions"
CONTACT_WALK: Final = "contact_walk"
FREE_FLIGHT: Final = "free_flight"
TICK: Final = "tick"
TOUCH: Final = "touch"

ENTRY_POINTS: Final[Mapping[str, str]] = {
    STRIKE: "strike_many",
    STEP_DOWN: "step_down_many",
    FIND_COLLISIONS: "find_collisions_many",
    CONTACT_WALK: "resolve_many",
    FREE_FLIGHT: "resolve_many",
    TICK: "step_many",
    TOUCH: "strike_many",
}
"""Operation to the function of the engine that performs it."""


def has_entry(op: str) -> bool:
    """Tell whether the engine performs an operation in batches."""
    return hasattr(engine, ENTRY_POINTS[op])


def has_threads(op: str) -> bool:
    """Tell whether the engine performs an operation on several threads."""
    return has_entry(op) and "threads" in inspect.signature(_entry(op)).parameters


def engine_maker(op: str, batch: int, threads: int = 1, plan: engine.Plan | None = None) -> Maker:
    """Return the engine as an implementation of an operation.

    Parameters
    ----------
    op : str
        A key of `ENTRY_POINTS`.
    batch : int
        Queries in a call. Work that is shorter is asked several times in the same call.
    threads : int
        In a call.
    plan : engine.Plan, optional
        Which shortcuts it takes; what the engine takes of itself if nothing is said.
    """
    given: dict[str, Any] = {} if threads == 1 else {"threads": threads}
    if plan is not None:
        given["plan"] = plan
    call = partial(_entry(op), **given)
    return {
        STRIKE: partial(_strike_job, call, batch),
        TOUCH: partial(_touch_job, call, batch),
        STEP_DOWN: partial(_step_down_job, call, batch),
        TICK: partial(_tick_job, call, batch),
    }.get(op, partial(_row_job, call, batch))


def _entry(op: str) -> Callable[..., Any]:
    function: Callable[..., Any] = getattr(engine, ENTRY_POINTS[op])
    return function


def _job(calls: Sequence[Callable[[], Any]], count: int, answer: Callable[[Any], Answer]) -> Job:
    return Job(lambda: [call() for call in calls], answer, count)


def _tree_calls(
    function: Callable[..., Any], work: KernelWork, batch: int, arrays: Sequence[Any]
) -> tuple[list[Callable[[], Any]], int]:
    """Return calls of a kernel over slices of arrays, and how many queries they ask."""
    scene, times = work.scene, max(1, batch // len(work))
    long = [repeated(array, times) for array in arrays]
    count = len(work) * times
    cell = scene.world.cell_index(scene.pose.cell)
    calls: list[Callable[[], Any]] = [
        partial(function, scene.world, cell, *(array[first:last] for array in long))
        for first, last in batches(count, batch)
    ]
    return calls, count


def _strike_job(function: Callable[..., Any], batch: int, work: KernelWork) -> Job:
    calls, count = _tree_calls(function, work, batch, (work.spheres, work.movements))

    def answer(done: Any) -> Answer:
        return np.concatenate([np.column_stack(part) for part in done])[: len(work)].astype(np.float64)

    return _job(calls, count, answer)


def _touch_job(function: Callable[..., Any], batch: int, work: KernelWork) -> Job:
    """Make a job of asking which spheres touch: those for which a polygon is found, struck or not."""
    calls, count = _tree_calls(function, work, batch, (work.spheres, work.movements))

    def answer(done: Any) -> Answer:
        polygons = np.concatenate([part[1] for part in done])[: len(work)]
        return (polygons >= 0).astype(np.float64).reshape(-1, 1)

    return _job(calls, count, answer)


def _step_down_job(function: Callable[..., Any], batch: int, work: KernelWork) -> Job:
    arrays = (work.spheres, work.movements, work.ups, work.allowances, work.interps)
    calls, count = _tree_calls(function, work, batch, arrays)

    def answer(done: Any) -> Answer:
        return np.concatenate([np.column_stack(part) for part in done])[: len(work)].astype(np.float64)

    return _job(calls, count, answer)


def _row_job(function: Callable[..., Any], batch: int, work: RowWork) -> Job:
    times = max(1, batch // len(work))
    rows = repeated(work.rows, times)
    calls = [
        partial(function, work.scene.world, rows[first:last]) for first, last in batches(len(rows), batch)
    ]
    return _job(calls, len(rows), lambda done: moved_answer(np.concatenate(done)[: len(work)]))


def _tick_job(function: Callable[..., Any], batch: int, work: RowWork) -> Job:
    times = max(1, batch // len(work))
    rows = repeated(work.rows, times).copy()
    calls = [
        partial(function, work.scene.world, rows[first:last], QUANTUM, TICKS)
        for first, last in batches(len(rows), batch)
    ]
    return _job(calls, len(rows) * TICKS, lambda _: body_answer(rows[: len(work)]))


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
