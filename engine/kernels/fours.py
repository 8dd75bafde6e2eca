"""Four numbers written, or copied, at once.

What a processor has stored waits in a queue until the cache has it, and when that is full, so does the
processor: a row that is written number by number fills most of it. Only what was not written a moment ago
should be copied like this: it would have to wait until all of it is in the cache.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from engine.constants import frozen
from engine.kernels.compile import inlined_entry
from engine.kernels.lanes import loaded, stored

if TYPE_CHECKING:
    from engine.kernels.types import Array

FOUR: Final = frozen(4)
_WIDTH: Final = int(FOUR)


def _put(_typing: Any, numbers: Any, _at: Any, _a: Any, _b: Any, _c: Any, _d: Any) -> Any:
    """Generate a store of four numbers."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        four = ir.Constant(ir.VectorType(ir.DoubleType(), _WIDTH), ir.Undefined)
        for k, number in enumerate(arguments[2:]):
            four = builder.insert_element(four, number, ir.IntType(32)(k))
        stored(context, builder, signature.args[0], arguments[:2], four)
        return context.get_dummy_value()

    number = types.float64
    return types.void(numbers, types.int64, number, number, number, number), generate


def _move(_typing: Any, target: Any, _at: Any, source: Any, _first: Any) -> Any:
    """Generate a load of four numbers, and their store."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        from_source = types.void(*signature.args[2:])
        four = loaded(context, builder, from_source, arguments[2:], 0, _WIDTH)
        stored(context, builder, signature.args[0], arguments[:2], four)
        return context.get_dummy_value()

    return types.void(target, types.int64, source, types.int64), generate


_put_numbers: Final[Any] = intrinsic(_put)
_move_numbers: Final[Any] = intrinsic(_move)


@inlined_entry
def put_four(numbers: Array, at: int, a: float, b: float, c: float, d: float) -> None:
    """Write four consecutive numbers."""
    _put_numbers(numbers, at, a, b, c, d)


@inlined_entry
def move_four(numbers: Array, at: int, source: Array, first: int) -> None:
    """Copy four consecutive numbers."""
    _move_numbers(numbers, at, source, first)
