"""Many rows shared by threads: each begins with rows of its own, and then helps the others with theirs.

Rows are cut into lanes, one for each thread, of rows that are answered one after the other: so each thread
has its own part of space. Before the first is taken all may have to be put in order, in stages that threads
do together. A thread takes the next few rows of its lane when it is done
with the last, and when there are none left, those of the other lanes. What they share is an array of
integers; rows are taken inside compiled code, without the interpreter's lock, in one step that no other
thread can come between.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from numba import types
from numba.extending import intrinsic

from engine.constants import frozen
from engine.kernels.compile import inlined

if TYPE_CHECKING:
    from engine.kernels.types import Ints

SHARE_JOINED: Final = frozen(0)
"""How many threads have begun."""
SHARE_LANES: Final = frozen(1)
"""How many lanes there are."""
SHARE_FAILED: Final = frozen(2)
"""How many could not be answered."""
SHARE_DONE: Final = frozen(3)
"""How many have been done with, answered or not: when it is all of them, nobody needs to be waited for."""
SHARE_REORDERED: Final = frozen(4)
"""How many have been put in another order than they lie in (`engine.kernels.order`)."""
SHARE_STAGES: Final = frozen(5)
"""Where the counters of the first stage are (`take_part`)."""
STAGE_INTS: Final = frozen(2)
"""Counters of a stage: the parts of it that somebody has taken, and those that are done."""
STAGE_DONE: Final = frozen(1)
LANE_INTS: Final = frozen(16)
"""Integers of a lane, and of what is before the first: two cache lines, since they are fetched in pairs."""
LANE_NEXT: Final = frozen(0)
"""The first row of the lane that nobody has taken."""
LANE_END: Final = frozen(1)
"""The row behind its last."""
PARTS: Final = frozen(4)
"""A turn is one of so many parts of what is left in a lane, so that nobody is waited for with much to do."""
FEWEST: Final = frozen(4)
MOST: Final = frozen(256)
"""Rows of a turn, at least and at most: fewer are not worth the way back, more gain nothing."""


def _addition(_typing: Any, numbers: Any, _place: Any, _amount: Any) -> Any:
    """Generate LLVM's atomic addition to an element of an array of integers.

    Who sees it sees also what the thread had written before.
    """

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        array = context.make_array(signature.args[0])(context, builder, arguments[0])
        place = builder.gep(array.data, [arguments[1]])
        return builder.atomic_rmw("add", place, arguments[2], "seq_cst")

    return types.int64(numbers, types.int64, types.int64), generate


_atomic_add: Final[Any] = intrinsic(_addition)


@inlined
def add_to(numbers: Ints, place: int, amount: int) -> int:
    """Add to a number that others add to as well; return what it was before."""
    before: int = _atomic_add(numbers, place, amount)
    return before


@inlined
def join(share: Ints) -> int:
    """Begin; return the number of one's own lane."""
    return add_to(share, SHARE_JOINED, 1) % share[SHARE_LANES]


@inlined
def lane_after(share: Ints, own: int, k: int) -> int:
    """Return where the k-th lane after one's own lies in the share."""
    return LANE_INTS * (1 + (own + k) % share[SHARE_LANES])


@inlined
def take_part(share: Ints, stage: int) -> int:
    """Take a part of a stage, which is work that has to be done before any row may be taken.

    Returns
    -------
    int
        Which part; there is none left if there are not so many.
    """
    return add_to(share, SHARE_STAGES + STAGE_INTS * stage, 1)


@inlined
def end_part(share: Ints, stage: int) -> None:
    """Note that a part of a stage is done; who has waited for it sees what the thread has written."""
    add_to(share, SHARE_STAGES + STAGE_INTS * stage + STAGE_DONE, 1)


@inlined
def wait_for(share: Ints, stage: int, parts: int) -> None:
    """Wait, awake, until all parts of a stage are done: less long than it takes to fall asleep."""
    while add_to(share, SHARE_STAGES + STAGE_INTS * stage + STAGE_DONE, 0) < parts:
        pass


@inlined
def take(share: Ints, lane: int) -> tuple[int, int]:
    """Take the next rows of a lane; return the first and the end of them: there are none if it is not beyond.

    If others take some while it is looked up how many are left, this turn is a little longer.
    """
    end = share[lane + LANE_END]
    turn = max(min((end - share[lane + LANE_NEXT]) // PARTS, MOST), FEWEST)
    first = add_to(share, lane + LANE_NEXT, turn)
    return first, min(first + turn, end)


@inlined
def put_back(share: Ints, done: int, failed: int) -> None:
    """Note how many of the rows that were taken are done with, and how many of them are not answered."""
    if failed:
        add_to(share, SHARE_FAILED, failed)
    add_to(share, SHARE_DONE, done)
