"""Running one query in a world: a transition with shortcuts, and again without, for its trace.

A trace tells of every call of a tree, so that a row which keeps one takes no shortcut (`engine.plan`).
Both runs have to give the same answer: every transition of the suite tests every shortcut.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from conformance.candidates.engine_ops.probing import note_work
from conformance.candidates.engine_ops.rows import numbers_of
from conformance.candidates.engine_ops.state_block import trace_text
from engine import layout as at
from engine.batch import check_status
from engine.coherence import AS_ASKED
from engine.kernels import program
from engine.plan import FULL_PLAN
from engine.probes import WORK_FIELDS
from engine.threads import new_share
from engine.tracing import runnable

if TYPE_CHECKING:
    import numpy.typing as npt

    from engine.world import World

TRACE_CAPACITY: Final = 1024
"""Room for a trace at first; it grows when a trace turns out to be longer."""


class ShortcutError(Exception):
    """A shortcut has changed an answer: `field`, what it is with shortcuts, and without."""

    def __init__(self, field: str, short: Any, full: Any) -> None:
        self.field = field
        super().__init__(f"with shortcuts {field} is {short}, without {full}")


def run(job: int, world: World, row: Any) -> tuple[Any, str]:
    """Run a query, as a job of `engine.kernels.program`, and return its result record and its trace."""
    result, trace, _ = run_noting(job, world, row)
    return result, trace


def run_noting(job: int, world: World, row: Any) -> tuple[Any, str, list[int]]:
    """Run a query; return its result record, its trace, and the objects it touched, by their indices.

    Raises
    ------
    ShortcutError
        If shortcuts change the answer.
    """
    short = _run_with_shortcuts(world, row) if job == program.RESOLVE else None
    capacity = TRACE_CAPACITY
    while True:
        state = world.new_row(trace_capacity=capacity)
        result = np.zeros(1, dtype=at.RESULT_DTYPE)
        numbers, answer = numbers_of(row).reshape(1, -1), result.view(np.float64).reshape(1, -1)
        runnable(program.run)(world.floats, world.ints, state, job, numbers, answer, AS_ASKED, new_share(1))
        check_status(result["status"])
        trace = trace_text(state, world.ints)
        if trace is not None:
            note_work(state)
            touched = world.touched(state)
            if short is not None:
                demand_same_answer(short[0], result[0])
                demand_same("touched", short[1], touched)
            return result[0], trace, touched
        capacity = int(state[at.TRACE_LENGTH])


def _run_with_shortcuts(world: World, row: Any) -> tuple[Any, list[int]]:
    """Run a transition as large batches do; return its result record, and the objects it touched.

    The world is prepared for it, so that every transition tests what shortcuts look up, too.
    """
    world.prepare()
    state = world.new_row(plan=FULL_PLAN)
    result = np.zeros(1, dtype=at.RESULT_DTYPE)
    query, answer = (numbers.reshape(1, -1) for numbers in (numbers_of(row), result.view(np.float64)))
    program.run(world.floats, world.ints, state, program.RESOLVE, query, answer, AS_ASKED, new_share(1))
    note_work(state)
    check_status(result["status"])
    return result[0], world.touched(state)


def demand_same_answer(short: Any, full: Any) -> None:
    """Demand that two records of results, or of bodies, are the same but for counters of work.

    Raises
    ------
    ShortcutError
        Naming the first field that differs in a bit.
    """
    if _answer_bytes(short) == _answer_bytes(full):  # nearly always, and at once
        return
    for name in short.dtype.names:
        if name not in WORK_FIELDS and short[name].tobytes() != full[name].tobytes():
            raise ShortcutError(name, short[name], full[name])


def _answer_bytes(record: Any) -> bytes:
    """Return what a record holds beside counters of work and the gaps between its fields."""
    return np.frombuffer(record.tobytes(), np.uint8)[_answer_places(record.dtype)].tobytes()


@functools.cache
def _answer_places(dtype: np.dtype[np.void]) -> npt.NDArray[np.bool_]:
    """Tell of each byte of a record whether it belongs to the answer."""
    places = np.zeros(dtype.itemsize, dtype=np.bool_)
    for name, (field, offset, *_) in (dtype.fields or {}).items():
        places[offset : offset + field.itemsize] = name not in WORK_FIELDS
    return places


def demand_same(field: str, short: Any, full: Any) -> None:
    """Demand the same of what is compared as it is; raises `ShortcutError`."""
    if short != full:
        raise ShortcutError(field, short, full)
