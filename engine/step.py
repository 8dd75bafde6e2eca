"""Ticks: letting time pass for one body, or for many."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from engine.answering import answer
from engine.batch import check_status
from engine.body import body_numbers, given_body
from engine.checks import whole
from engine.constants import CHECK_ETHEREAL_TS, MAX_ELASTICITY, MAX_QUANTUM
from engine.effort import check_tick
from engine.errors import QueryError
from engine.float32 import float32_array
from engine.kernels import program, tick_velocity
from engine.kernels.tick_gates import MAX_TICKS
from engine.layout import VECTOR_SIZE
from engine.plan import FULL_PLAN, Plan

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from engine.kernels.types import Array
    from engine.query import Rows
    from engine.world import World

_CHECK_TICKS: Final = whole()


def step(world: World, body: Any, dt: float, *, plan: Plan = FULL_PLAN) -> Any:
    """Let one tick pass for one body.

    Parameters
    ----------
    world : World
    body : Body or record
        A body as it is before its first tick, or what an earlier tick returned; it is not changed.
    dt : float
        Length of the tick in seconds, rounded to float32; retail's are from 1/30 to 0.2.
    plan : Plan
        Which work may be left out; it changes nothing but ``skipped`` and the counters of work.

    Returns
    -------
    numpy record of `engine.body_layout.BODY_DTYPE`
        The body after the tick: where it is (``origin``, ``rotation``, ``cell_id``), how it moves
        (``velocity``, ``transient_state``, ``contact_plane``), and what the tick did (``outcome``, an
        index in `engine.body_layout.OUTCOMES`).

    Raises
    ------
    QueryError, PoseError
        If the body or the time cannot be simulated.

    Notes
    -----
    retail: CPhysicsObj::UpdateObjectInternal 0x005156B0, UO-1...UO-11
    """
    return step_many(world, given_body(world, body), dt, 1, plan=plan)[0]


def step_many(
    world: World,
    rows: Rows,
    dt: float,
    ticks: int,
    *,
    threads: int = 1,
    plan: Plan = FULL_PLAN,
    coherent: bool = True,
) -> Rows:
    """Let ticks pass for many bodies, each as if it were alone; the rows are changed, and returned.

    `threads` share the bodies, with the same results for any number, and where `coherent` those that are near
    each other tick one after the other (`engine.coherence`).
    If a body's tick fails, its row is left in the middle of that tick, with the reason in ``status``;
    the other bodies have done all of their ticks when the error is raised. See `step`.
    """
    _CHECK_TICKS(ticks, "ticks", QueryError)
    quantum = float(float32_array([dt], (1,), "dt", QueryError)[0])
    if not quantum > 0.0:
        raise QueryError("dt", f"{dt} seconds is not greater than 0")
    given = program.STEP, _ready(rows), np.array([[quantum, float(ticks)]])
    check_tick(rows, quantum)
    if answer(world, program.run, lambda: given, len(rows), threads, plan=plan, coherent=coherent):
        check_status(rows["status"])
    return rows


def update_many(
    world: World,
    rows: Rows,
    now: float,
    *,
    threads: int = 1,
    plan: Plan = FULL_PLAN,
    coherent: bool = True,
) -> Rows:
    """Let time pass up to `now` for many bodies, in ticks as long as retail's; the rows are changed.

    The time since a body's ``update_time`` is divided into ticks of 0.2 seconds and a remainder, which
    waits if it is not longer than 1/30; more than 2 seconds are dropped. See `step_many`.

    Parameters
    ----------
    world : World
    rows : records of `engine.body_layout.BODY_DTYPE`
    now : float
        Seconds, on the clock of ``update_time``; not rounded to float32.
    threads : int
        How many share the bodies; the results are the same for any number.
    plan : Plan
        Which work may be left out.
    coherent : bool
        Whether bodies that are near each other tick one after the other (`engine.coherence`).

    Notes
    -----
    retail: CPhysicsObj::update_object 0x00515D10, QT-1, QT-3...QT-9
    """
    if not math.isfinite(now):
        raise QueryError("now", f"{now} is not a time")
    numbers = _ready(rows)
    check_tick(rows, MAX_QUANTUM)

    def given() -> tuple[int, Array, Array]:
        times = np.zeros((3, int(MAX_TICKS)), dtype=np.float64)
        times[0, 0] = now
        return program.UPDATE, numbers, times

    if answer(world, program.run, given, len(rows), threads, plan=plan, coherent=coherent):
        check_status(rows["status"])
    return rows


def _ready(rows: Rows) -> Array:
    """Return rows as kernels see them, if they can tick."""
    numbers = body_numbers(rows)
    with np.errstate(invalid="ignore"):  # A row that is changed holds any number.
        ethereal = rows["transient_state"].astype(np.int64) & CHECK_ETHEREAL_TS
    for index in np.flatnonzero((ethereal != 0) & (rows["has_parent"] == 0)):
        raise QueryError(f"body {index}", "becoming solid again needs registration in cells (UO-2)")
    return numbers


def set_velocity(rows: Rows, velocities: npt.ArrayLike) -> None:
    """Give each body a velocity in metres per second, global axes, and wake it up.

    The speed is limited to 50; a velocity that is the present one within EPS changes nothing.

    Parameters
    ----------
    rows : records of `engine.body_layout.BODY_DTYPE`
        They are changed.
    velocities : array_like, shape (len(rows), 3)

    Notes
    -----
    retail: CPhysicsObj::set_velocity 0x005113F0, SV-1, SV-2
    """
    _give(tick_velocity.set_velocity, rows, velocities)


def set_local_velocity(rows: Rows, velocities: npt.ArrayLike) -> None:
    """Give each body a velocity in metres per second along its own axes. See `set_velocity`.

    Notes
    -----
    retail: CPhysicsObj::set_local_velocity 0x005114D0, 06 5
    """
    _give(tick_velocity.set_local_velocity, rows, velocities)


def set_elasticity(rows: Rows, elasticity: npt.ArrayLike) -> None:
    """Give each body the part of its speed that it keeps in a bounce, within 0 and 0.1.

    Parameters
    ----------
    rows : records of `engine.body_layout.BODY_DTYPE`
        They are changed.
    elasticity : array_like, shape (len(rows),)

    Notes
    -----
    retail: CPhysicsObj::set_elasticity, 06 1
    """
    body_numbers(rows)
    values = float32_array(elasticity, (len(rows),), "elasticity", QueryError)
    rows["elasticity"] = np.clip(values, 0.0, MAX_ELASTICITY)


def _give(kernel: Callable[..., None], rows: Rows, velocities: npt.ArrayLike) -> None:
    bodies = body_numbers(rows)
    values = float32_array(velocities, (len(bodies), int(VECTOR_SIZE)), "velocities", QueryError)
    for numbers, (x, y, z) in zip(bodies, values, strict=True):
        kernel(numbers, float(x), float(y), float(z))
