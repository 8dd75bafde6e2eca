"""Asking: one query or many, in one world."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from engine import layout as at
from engine.answering import answer
from engine.body_layout import MAX_RECORDS, STATUS_CROWDED
from engine.constants import MAX_STEPS
from engine.errors import CrowdedError, QueryError, RecursionBoundError, UndeterminedError
from engine.given import room
from engine.kernels import program
from engine.memory import rows_as_numbers
from engine.object_call import ObjectCall, object_rows
from engine.plan import CALL_PLAN, FULL_PLAN, Plan, of_calls
from engine.query import CollisionCall, Move, collision_rows, move_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine.query import Rows
    from engine.world import World


_STRANGE: Final = "it names a cell or an object that this world doesn't have, or too many spheres or records"
_ENDLESS: Final = f"more than {MAX_STEPS} steps, or a first sphere too small to be put down"


def resolve(world: World, move: Move, *, plan: Plan = FULL_PLAN) -> Any:
    """Move, or put down, one mover.

    Parameters
    ----------
    world : World
    move : Move
    plan : Plan
        Which work may be left out; it changes no result.

    Returns
    -------
    numpy record of `engine.layout.RESULT_DTYPE`
        ``result`` is 1 if the mover got somewhere (``curr``), 0 if there was no movement. Cells are
        given by their index in ``world.cell_ids``; one of -1 says that the mover has left the world.

    Raises
    ------
    QueryError, PoseError
        If the move cannot be asked about.
    UndeterminedError
        If it depends on what is not known of retail.

    Notes
    -----
    retail: CTransition::find_valid_position 0x0050C310, documents 04 and 05
    """
    return resolve_many(world, [move], plan=plan)[0]


def resolve_many(
    world: World,
    moves: Sequence[Move] | Rows,
    *,
    threads: int = 1,
    plan: Plan = FULL_PLAN,
    coherent: bool = True,
    out: Rows | None = None,
) -> Rows:
    """Move, or put down, many movers, each as if it were alone.

    Parameters
    ----------
    world : World
    moves : sequence of Move, or records of `engine.layout.QUERY_DTYPE`
        Rows are made by `engine.query.move_rows`; of their numbers only those that name cells, objects and
        spheres are looked at again, and how many steps they take.
    threads : int
        How many share them; the results are the same for any number.
    plan : Plan
        Which work may be left out; it changes no result.
    coherent : bool
        Whether those that are near each other are answered one after the other (`engine.coherence`); the
        results are the same, and in the same order.
    out : records of `engine.layout.RESULT_DTYPE`, optional
        Where to write the results: as many, contiguous. What it saves `engine.given` says.

    Returns
    -------
    records of `engine.layout.RESULT_DTYPE`
        See `resolve`; in the order of `moves`. `out`, if it is given.

    Raises
    ------
    QueryError, PoseError
        If a move cannot be asked about, or `out` cannot take the results.
    UndeterminedError
        After all have been answered; it holds the results.
    """
    rows = moves if isinstance(moves, np.ndarray) else move_rows(world, moves)
    return _run(program.RESOLVE, world, rows, threads, plan, coherent=coherent, out=out)


def find_collisions(world: World, call: CollisionCall) -> Any:
    """Test one mover against one tree, with a given state of its path.

    Returns
    -------
    numpy record of `engine.layout.RESULT_DTYPE`
        ``result`` is a TransitionState (`engine.constants.STATE_NAMES`).

    Raises
    ------
    QueryError, PoseError
        If it cannot be asked about.
    UndeterminedError
        If it depends on what is not known of retail.

    Notes
    -----
    retail: BSPTREE::find_collisions 0x0053A440 and BSPTREE::placement_insert 0x00539960
    """
    return find_collisions_many(world, [call])[0]


def find_collisions_many(
    world: World,
    calls: Sequence[CollisionCall] | Rows,
    *,
    threads: int = 1,
    plan: Plan = CALL_PLAN,
    coherent: bool = True,
    out: Rows | None = None,
) -> Rows:
    """Make many collision calls, each as if it were alone; results in the same order.

    `calls` are CollisionCall objects, or rows made by `engine.query.collision_rows`.
    What `threads`, `plan`, `coherent` and `out` are, `resolve_many` says; of the plan only `Stage.BOUNDS`
    and `Stage.WALKS` concern single calls. See `find_collisions`.
    """
    rows = calls if isinstance(calls, np.ndarray) else collision_rows(world, calls)
    return _run(program.COLLIDE, world, rows, threads, of_calls(plan), coherent=coherent, out=out)


def find_object_collisions(world: World, call: ObjectCall) -> Any:
    """Test one mover against obstacles, with a given state of its path.

    Returns
    -------
    numpy record of `engine.layout.RESULT_DTYPE`
        ``result`` is a TransitionState (`engine.constants.STATE_NAMES`).

    Raises
    ------
    QueryError, PoseError
        If it cannot be asked about.
    UndeterminedError
        If it depends on what is not known of retail.

    Notes
    -----
    retail: CPhysicsObj::FindObjCollisions 0x0050F050, documents 07 and 08
    """
    return find_object_collisions_many(world, [call])[0]


def find_object_collisions_many(
    world: World,
    calls: Sequence[ObjectCall] | Rows,
    *,
    threads: int = 1,
    plan: Plan = CALL_PLAN,
    coherent: bool = True,
    out: Rows | None = None,
) -> Rows:
    """Make many calls of obstacles, each as if it were alone; results in the same order.

    `calls` are ObjectCall objects, or rows made by `engine.object_call.object_rows`.
    What `threads`, `plan`, `coherent` and `out` are, `resolve_many` says; of the plan only `Stage.BOUNDS`
    and `Stage.WALKS` concern single calls. See `find_object_collisions`.
    """
    rows = calls if isinstance(calls, np.ndarray) else object_rows(world, calls)
    return _run(program.MEET, world, rows, threads, of_calls(plan), coherent=coherent, out=out)


def _run(
    job: int, world: World, rows: Rows, threads: int, plan: Plan, *, coherent: bool, out: Rows | None
) -> Rows:
    if rows.dtype != at.QUERY_DTYPE:
        raise QueryError("rows", "not of engine.layout.QUERY_DTYPE")
    if rows.ndim != 1:
        raise QueryError("rows", f"shape {rows.shape} where one row for each query is needed")
    # Of rows that may only be read Numba would compile everything once more.
    # What it has to be it is, as a rule: for NumPy to find that out takes a tenth of a call of one query.
    plain = rows if rows.flags.carray else np.require(rows, requirements=("C", "W"))
    queries = rows_as_numbers(plain)
    results = room(out, at.RESULT_DTYPE, (len(rows),), [queries], "out")
    given = job, queries, rows_as_numbers(results)
    if answer(world, program.run, lambda: given, len(rows), threads, plan=plan, coherent=coherent):
        check_status(results["status"], results)
    return results


def check_status(status: Any, results: Rows | None = None) -> None:
    """Raise the error that the status of any query stands for.

    Parameters
    ----------
    status : array of float
        ``status`` of result rows.
    results : records, optional
        Those rows, for an error that leaves the others valid.

    Raises
    ------
    CrowdedError, QueryError, RecursionBoundError, UndeterminedError
        The last only if there is none of the others.
    """
    failed = np.flatnonzero(status != at.STATUS_OK)
    for index in failed:
        if status[index] == STATUS_CROWDED:
            raise CrowdedError(f"body {index} has touched more than {MAX_RECORDS} objects within a second")
        if status[index] == at.STATUS_STRANGE:
            raise QueryError(f"row {index}", _STRANGE)
        if status[index] == at.STATUS_ENDLESS:
            raise QueryError(f"row {index}", _ENDLESS)
        if status[index] != at.STATUS_UNDETERMINED:
            raise RecursionBoundError(f"query {index}: status {int(status[index])}")
    if len(failed):
        raise UndeterminedError(int(failed[0]), results)
