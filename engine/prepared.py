"""One query asked again and again, without building rows anew."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NoReturn

import numpy as np

from engine import layout as at
from engine.batch import check_status
from engine.coherence import AS_ASKED
from engine.errors import QueryError
from engine.kernels import program
from engine.kernels.sharing import LANE_INTS, LANE_NEXT
from engine.memory import rows_as_numbers
from engine.plan import CHECK_PLAN, FULL_PLAN, Plan, of_calls
from engine.query import CollisionCall, Move, collision_rows, move_rows
from engine.threads import new_share
from engine.tracing import runnable
from engine.world import CHECK_WORLD

if TYPE_CHECKING:
    from engine.world import World

_NEXT: Final = int(LANE_INTS + LANE_NEXT)


class Prepared:
    """A query with rows of its own: asking it costs little more than the answer.

    It keeps the arrays that the world has when it is made, and does not count its runs: call `World.prepare`
    before, if what that makes is to be used.

    Parameters
    ----------
    world : World
    query : Move or CollisionCall
    plan : Plan
        Which work may be left out; it changes no result. Of a call, that of `CALL_PLAN` at most.

    Attributes
    ----------
    query : numpy record of `engine.layout.QUERY_DTYPE`
        May be changed between two runs, field by field, with numbers that are float32. Nothing is
        checked again.
    result : numpy record of `engine.layout.RESULT_DTYPE`
        The last answer, overwritten by the next.

    Raises
    ------
    QueryError, PoseError
        If it cannot be asked about.

    Examples
    --------
    >>> from engine import Cell, Leaf, Move, Mover, Pose, Prepared, Shape, World
    >>> floor = Shape([(-5, -5, 0), (5, -5, 0), (0, 5, 0)], [(0, 1, 2)], Leaf((0, 0, 0, 10), (0,)))
    >>> world = World([Cell(0x01000100, Pose(0x01000100), floor)])
    >>> mover = Mover([(0, 0, 0.5, 0.5)], step_down_height=1.5)
    >>> ends = Pose(0x01000100, (0, 0, 1)), Pose(0x01000100, (0, 0, 0.75))
    >>> fall = Prepared(world, Move(mover, ends[1], 0x01000100, start=ends[0]))
    >>> float(fall.run()["curr"][7])
    0.75
    >>> fall.query["end"][7] = 0.5
    >>> float(fall.run()["curr"][7])
    0.5
    """

    def __init__(self, world: World, query: Move | CollisionCall, *, plan: Plan = FULL_PLAN) -> None:
        CHECK_WORLD(world, "world", QueryError)
        CHECK_PLAN(plan, "plan", QueryError)
        if isinstance(query, Move):
            rows, job = move_rows(world, [query]), program.RESOLVE
        else:
            rows, job, plan = collision_rows(world, [query]), program.COLLIDE, of_calls(plan)
        results = np.zeros(1, dtype=at.RESULT_DTYPE)
        answers = rows_as_numbers(results)
        self.query: Final[Any] = rows[0]
        self.result: Final[Any] = results[0]
        self._numbers: Final = answers[0]
        self._share: Final = new_share(1)
        self._arguments: Final = (
            *world.arrays,
            world.new_row(plan=plan),
            job,
            rows_as_numbers(rows),
            answers,
            AS_ASKED,
            self._share,
        )

    def __reduce__(self) -> NoReturn:
        """Refuse to be copied or pickled: a copy's `result` would not be where its kernel writes."""
        raise TypeError("a Prepared query cannot be copied or pickled; prepare another one")

    def run(self) -> Any:
        """Ask, and return `result`.

        Raises
        ------
        QueryError, RecursionBoundError, UndeterminedError
            As `engine.resolve`, the first for a `query` that has been changed to one that cannot be asked.
        """
        self._share[_NEXT] = 0
        runnable(program.run)(*self._arguments)
        if self._numbers[at.R_STATUS] != at.STATUS_OK:
            check_status(self._numbers[at.R_STATUS : at.R_STATUS + 1])
        return self.result
