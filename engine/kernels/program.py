"""Everything that batches ask for, in one compiled program.

Moves, calls and ticks have nearly all of their code in common. As entries of their own each would link,
optimise and load that code anew; here it is done once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine.body_layout import B_RECORDS, B_STATUS, BODY_SIZE
from engine.constants import frozen
from engine.kernels.ahead import bring_near, bring_to_write
from engine.kernels.approach import NO_STEPS, STEPS, approach, approach_flight, is_huge, is_large
from engine.kernels.collisions import collide
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.object_calls import meet
from engine.kernels.order import BODIES, CALLS, MOVES, put_in_order, turn
from engine.kernels.plan import allows
from engine.kernels.resolving import resolve
from engine.kernels.sharing import SHARE_LANES, SHARE_REORDERED, join, lane_after, put_back, take
from engine.kernels.strangers import (
    is_strange_body,
    is_strange_collision,
    is_strange_meeting,
    is_strange_move,
)
from engine.kernels.tick import step
from engine.kernels.tick_gates import update
from engine.kernels.tick_placement import place
from engine.layout import (
    COLLISION_INFO_SIZE,
    PLAN_FLIGHT,
    PLAN_WALKS,
    Q_BEGIN_CELL,
    Q_COLLISION_INFO,
    Q_TARGET_CELL,
    QUERY_SIZE,
    R_STATUS,
    RESULT_SIZE,
    STATUS_OK,
    STATUS_STRANGE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Order

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

AHEAD: Final = frozen(2)
"""How many moves before its turn a row is brought near: a free flight is over before its rows have come. What
it looks up of a huge world is brought near as early, and its row earlier still.

The row of results is brought when half of the work before is done: more than a dozen lines at a time, and the
processor waits for the first of them."""
FAR_AHEAD: Final = frozen(4)
"""The same for the rows of calls and bodies, and of flights through a huge world; and before the first step
of an approach reads it, if there is one (`engine.kernels.approach`)."""
_OF_MOVES: Final = frozen(Q_COLLISION_INFO + COLLISION_INFO_SIZE)
"""Numbers of a query's row that a move reads: the rest is for single calls."""


@kernel
def _refuse(out: Array) -> float:
    """Answer a row that its world cannot: with nothing but a status, which is returned."""
    for k in range(RESULT_SIZE):
        out[k] = 0.0
    out[R_STATUS] = STATUS_STRANGE
    return out[R_STATUS]


@inlined
def _do(wf: Array, wi: Ints, s: Array, job: int, rows: Array, out: Array, i: int) -> float:
    """Do a job for one row; return its status."""
    if job == COLLIDE:
        if is_strange_collision(wi, rows[i]):
            return _refuse(out[i])
        collide(wf, wi, s, rows[i], out[i])
    elif job == MEET:
        if is_strange_meeting(wi, rows[i]):
            return _refuse(out[i])
        meet(wf, wi, s, rows[i], out[i])
    else:
        if is_strange_body(wi, rows[i]):
            rows[i, B_STATUS] = STATUS_STRANGE
        elif job == STEP:
            step(wf, wi, s, rows[i], out[0, 0], out[0, 1])
        elif job == PLACE:
            place(wf, wi, s, rows[i], out[i])
        else:
            update(wf, wi, s, rows[i], out[0, 0], out[1], out[2])
        return rows[i, B_STATUS]
    return out[i, R_STATUS]


@inlined
def _bring(job: int, rows: Array, i: int) -> None:
    """Have a row brought near: of a body, what is before the objects it has touched."""
    if job in (COLLIDE, MEET):
        bring_near(rows, QUERY_SIZE * i, QUERY_SIZE)
    elif job != PLACE:
        bring_to_write(rows, BODY_SIZE * i, B_RECORDS)


@inlined
def _approaches(wf: Array, wi: Ints, s: Array, job: int, share: Ints) -> bool:
    """Say whether what rows look up of lattices is brought near ahead of their turn.

    Moves that have not been sorted mostly fly, and look nothing up; or they are few.
    """
    looks_up = job == COLLIDE or (job == RESOLVE and share[SHARE_REORDERED] != 0)
    return looks_up and is_large(wf, wi) and allows(s, PLAN_WALKS)


@kernel
def _resolve_some(
    wf: Array,
    wi: Ints,
    s: Array,
    rows: Array,
    out: Array,
    order: Order,
    first: int,
    end: int,
    last: int,
    fly: bool,
) -> int:
    """Answer some moves; return how many could not be. A loop of their own spares them the other jobs.

    `end`: of those that are answered now; `last`: of those that are brought near; `fly`: whether it pays to
    bring near what flights look up.
    """
    failed = 0
    for k in range(first, end):
        i, later = turn(order, k), turn(order, min(k + AHEAD, last - 1))
        if fly:
            bring_near(rows, QUERY_SIZE * turn(order, min(k + FAR_AHEAD, last - 1)), _OF_MOVES)
            approach_flight(wf, wi, rows[later])
        else:
            bring_near(rows, QUERY_SIZE * later, _OF_MOVES)
        if is_strange_move(wi, rows[i]):
            _refuse(out[i])
        else:
            resolve(wf, wi, s, rows[i], out[i], out[later])
        failed += out[i, R_STATUS] != STATUS_OK
    return failed


@kernel
def _resolve_approached(
    wf: Array, wi: Ints, s: Array, rows: Array, out: Array, order: Order, first: int, last: int
) -> int:
    """Answer some moves, and bring near what they look up; return how many could not be answered.

    A loop of its own spares free flights what it carries along.
    """
    failed = 0
    steps = NO_STEPS
    for k in range(first, last):
        bring_near(rows, QUERY_SIZE * turn(order, min(k + STEPS + AHEAD, last - 1)), _OF_MOVES)
        coming = rows[turn(order, min(k + STEPS, last - 1))]
        steps = approach(wf, wi, coming, coming[Q_BEGIN_CELL], steps)
        failed += _resolve_some(wf, wi, s, rows, out, order, k, k + 1, last, False)
    return failed


@inlined
def _kind_of(job: int) -> int:
    """Return by what the rows of a job are put in order."""
    if job == RESOLVE:
        return MOVES
    return CALLS if job in (COLLIDE, MEET) else BODIES


# Not inlined: LLVM would make a copy of everything for each job.
@kernel
def _do_some(
    wf: Array,
    wi: Ints,
    s: Array,
    job: int,
    rows: Array,
    out: Array,
    order: Order,
    first: int,
    last: int,
    approaches: bool,
) -> int:
    """Do a job for some rows; return for how many it failed."""
    if job == RESOLVE and approaches:
        return _resolve_approached(wf, wi, s, rows, out, order, first, last)
    if job == RESOLVE:
        flies = is_huge(wf, wi) and allows(s, PLAN_FLIGHT)
        return _resolve_some(wf, wi, s, rows, out, order, first, last, last, flies)
    failed = 0
    steps = NO_STEPS
    ahead = FAR_AHEAD + STEPS if approaches else FAR_AHEAD
    for k in range(first, last):
        _bring(job, rows, turn(order, min(k + ahead, last - 1)))
        if approaches:
            coming = rows[turn(order, min(k + STEPS, last - 1))]
            steps = approach(wf, wi, coming, coming[Q_TARGET_CELL], steps)
        failed += _do(wf, wi, s, job, rows, out, turn(order, k)) != STATUS_OK
    return failed


@entry
def run(wf: Array, wi: Ints, s: Array, job: int, rows: Array, out: Array, order: Order, share: Ints) -> None:
    """Do a job for rows that are taken from a share, one after the other, in one row of state.

    `order` has room for which row has which turn (`engine.kernels.order.put_in_order`); none: as they lie.
    `out` gets a row of results for each query; what it is for bodies, `STEP`, `UPDATE` and `PLACE` say.
    """
    own = join(share)
    put_in_order(_kind_of(job), rows, order, share)
    approaches = _approaches(wf, wi, s, job, share)
    for k in range(share[SHARE_LANES]):
        lane = lane_after(share, own, k)
        first, last = take(share, lane)
        while first < last:
            failed = _do_some(wf, wi, s, job, rows, out, order, first, last, approaches)
            put_back(share, last - first, failed)
            first, last = take(share, lane)
