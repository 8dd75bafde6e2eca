"""A batch and a kernel: threads share the rows, each in a row of state of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from engine.coherence import order_for
from engine.errors import QueryError
from engine.kernels import program
from engine.plan import CHECK_PLAN, NO_PLAN, Plan
from engine.threads import together
from engine.tracing import runnable
from engine.world import CHECK_WORLD

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from engine.kernels.types import Ints
    from engine.world import World


def answer(
    world: World,
    kernel: Callable[..., None],
    arguments: Callable[[], Sequence[Any]],
    count: int,
    threads: int,
    *,
    plan: Plan = NO_PLAN,
    coherent: bool,
) -> int:
    """Have a kernel answer all rows of a batch.

    Parameters
    ----------
    world : World
    kernel
        An entry that takes a world's arrays, a row of state, its own arguments, the order and the share:
        `engine.kernels.program.run`, or one of `engine.kernels.tree_calls`.
    arguments : callable
        Returns its own arguments; each thread calls it once, for what it may not share with others.
    count : int
        How many rows there are.
    threads : int
        How many share them.
    plan : Plan
        Which work may be left out.
    coherent : bool
        Whether rows may be answered in another order than that in which they lie (`engine.coherence`).

    Returns
    -------
    int
        How many rows could not be answered.

    Raises
    ------
    QueryError
        If `world` or `plan` is none, or `threads` is not a number of threads.
    """
    CHECK_WORLD(world, "world", QueryError)
    CHECK_PLAN(plan, "plan", QueryError)
    run = runnable(kernel)
    arrays = world.arrays_for(count, plan) if kernel is program.run else world.arrays
    order = order_for(count, coherent=coherent)

    def work(share: Ints) -> None:
        row = world.take_row(plan)
        run(*arrays, row, *arguments(), order, share)
        world.give_back(row)

    return together(work, count, threads)
