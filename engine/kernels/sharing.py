"""Many rows shared by threads: each begins with rows of its own, and then helps the others with theirs.

Rows are cut into lanes, one for each thread, of rows that are answered one after the other: so each thread
has its own part of space. The first thread may have to put them in order before. A thread takes the next few
rows of its lane when it is done with the last, and when there are none left, those of the other lanes. What
they share is an array of integers; rows are taken inside compiled code, without the interpreter's lock, in
one step that no other thread can come between.
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
SHARE_SORTERS: Final = frozen(5)
"""How many threads have asked whether to put them in order: the first does."""
SHARE_READY: Final = frozen(6)
"""1 when rows may be taken, if they are put in order before."""
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
def is_first(share: Ints) -> bool:
    """Say, once, that the thread is the first, and has to call `make_ready`."""
    return add_to(share, SHARE_SORTERS, 1) == 0


@inlined
def make_ready(share: Ints) -> None:
    """Let those in that wait; they see what the thread has written."""
    add_to(share, SHARE_READY, 1)


@inlined
def wait_until_ready(share: Ints) -> None:
    """Wait, awake, until rows may be taken: hardly longer than it takes to fall asleep and be woken."""
    while add_to(share, SHARE_READY, 0) == 0:
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
