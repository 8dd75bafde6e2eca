"""Everything that batches ask for, in one compiled program.

Moves, calls and ticks have nearly all of their code in common. As entries of their own each would link,
optimise and load that code anew; here it is done once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine.constants import frozen
from engine.kernels.collisions import collide
from engine.kernels.compile import entry, kernel
from engine.kernels.object_calls import meet
from engine.kernels.resolving import resolve
from engine.kernels.tick import step
from engine.kernels.tick_gates import update
from engine.kernels.tick_placement import place

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints

RESOLVE: Final = frozen(0)
"""Each row is a query: `engine.kernels.resolving.resolve`."""
COLLIDE: Final = frozen(1)
"""Each row is a query: `engine.kernels.collisions.collide`."""
MEET: Final = frozen(2)
"""Each row is a query: `engine.kernels.object_calls.meet`."""
STEP: Final = frozen(3)
"""Each row is a body: `engine.kernels.tick.step`. ``out[0]``: length of a tick, number of ticks."""
UPDATE: Final = frozen(4)
"""Each row is a body: `engine.kernels.tick_gates.update`. ``out[0, 0]``: up to when; ``out[1]`` and
``out[2]``: room for the lengths and the ends of the ticks of one body."""

PLACE: Final = frozen(5)
"""Each row is a body, and each of ``out`` its placement: `engine.kernels.tick_placement.place`."""


@kernel
def _resolve_all(wf: Array, wi: Ints, s: Array, rows: Array, out: Array) -> None:
    for i in range(len(rows)):
        resolve(wf, wi, s, rows[i], out[i])


@entry
def run(wf: Array, wi: Ints, s: Array, job: int, rows: Array, out: Array) -> None:
    """Do a job for many rows, one after the other, in one row of state.

    `out` gets a row of results for each query; what it is for bodies, `STEP`, `UPDATE` and `PLACE` say.
    """
    if job == RESOLVE:
        _resolve_all(wf, wi, s, rows, out)
        return
    for i in range(len(rows)):
        if job == COLLIDE:
            collide(wf, wi, s, rows[i], out[i])
        elif job == MEET:
            meet(wf, wi, s, rows[i], out[i])
        elif job == STEP:
            step(wf, wi, s, rows[i], out[0, 0], out[0, 1])
        elif job == PLACE:
            place(wf, wi, s, rows[i], out[i])
        else:
            update(wf, wi, s, rows[i], out[0, 0], out[1], out[2])
