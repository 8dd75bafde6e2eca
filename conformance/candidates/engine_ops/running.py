"""Running one query in a world, with its trace."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from conformance.candidates.engine_ops.rows import numbers_of
from conformance.candidates.engine_ops.state_block import trace_text
from engine import layout as at
from engine.batch import check_status
from engine.kernels import program
from engine.tracing import runnable

if TYPE_CHECKING:
    from engine.world import World

TRACE_CAPACITY: Final = 1024
"""Room for a trace at first; it grows when a trace turns out to be longer."""


def run(job: int, world: World, row: Any) -> tuple[Any, str]:
    """Run a query, as a job of `engine.kernels.program`, and return its result record and its trace."""
    result, trace, _ = run_noting(job, world, row)
    return result, trace


def run_noting(job: int, world: World, row: Any) -> tuple[Any, str, list[int]]:
    """Run a query; return its result record, its trace, and the objects it touched, by their indices."""
    capacity = TRACE_CAPACITY
    while True:
        state = world.new_row(trace_capacity=capacity)
        result = np.zeros(1, dtype=at.RESULT_DTYPE)
        numbers, answer = numbers_of(row).reshape(1, -1), result.view(np.float64).reshape(1, -1)
        runnable(program.run)(world.floats, world.ints, state, job, numbers, answer)
        check_status(result["status"])
        trace = trace_text(state, world.ints)
        if trace is not None:
            return result[0], trace, world.touched(state)
        capacity = int(state[at.TRACE_LENGTH])
