"""Many rows shared by threads: each takes the next few when it is done with the last.

What they share is an array of four integers. A thread takes rows inside compiled code, without the
interpreter's lock, in one step that no other thread can come between.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from numba import types
from numba.extending import intrinsic

from engine.constants import frozen
from engine.kernels.compile import inlined

if TYPE_CHECKING:
    from engine.kernels.types import Ints

SHARE_NEXT: Final = frozen(0)
"""The first row that nobody has taken."""
SHARE_SIZE: Final = frozen(1)
"""How many are taken at a time."""
SHARE_FAILED: Final = frozen(2)
"""How many could not be answered."""
SHARE_DONE: Final = frozen(3)
"""How many have been done with, answered or not: when it is all of them, nobody needs to be waited for."""
SHARE_INTS: Final = frozen(4)


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
def take(share: Ints) -> int:
    """Take the next rows; return the first of them, which may be beyond the last row there is."""
    return add_to(share, SHARE_NEXT, share[SHARE_SIZE])


@inlined
def put_back(share: Ints, done: int, failed: int) -> None:
    """Note how many of the rows that were taken are done with, and how many of them are not answered."""
    add_to(share, SHARE_FAILED, failed)
    add_to(share, SHARE_DONE, done)
