"""Rows brought near before their turn: a row of results is eleven cache lines that nobody has read yet.

What is going to be written has to be taken from all other processors' caches. What is only read must not:
they may be reading it, too, and a processor may write it back to memory as if it had been changed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from engine.constants import frozen
from engine.kernels.compile import inlined

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints

LINE: Final = frozen(8)
"""Numbers in a cache line."""
_READ: Final = 0
_WRITTEN: Final = 1
"""What LLVM is told that will be done with a place,"""
_DATA: Final = 1
"""and that it is no code."""
_FIRST: Final = 3
"""How LLVM numbers the first cache."""


def _hint(use: int) -> Any:
    """Return the intrinsic that has an element of an array brought near, to be read or written."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        array = context.make_array(signature.args[0])(context, builder, arguments[0])
        place = builder.bitcast(builder.gep(array.data, [arguments[1]]), ir.IntType(8).as_pointer())
        number = ir.IntType(32)
        kind = ir.FunctionType(ir.VoidType(), [place.type, number, number, number])
        fetch = builder.module.declare_intrinsic("llvm.prefetch", [place.type], kind)
        builder.call(fetch, [place, *(ir.Constant(number, k) for k in (use, _FIRST, _DATA))])
        return context.get_dummy_value()

    def prefetch(_typing: Any, numbers: Any, _place: Any) -> Any:
        """Tell Numba about LLVM's prefetch."""
        return types.void(numbers, types.int64), generate

    return intrinsic(prefetch)


_to_read: Final[Any] = _hint(_READ)
_to_write: Final[Any] = _hint(_WRITTEN)


@inlined
def bring_near(rows: Array | Ints, first: int, count: int) -> None:
    """Have so many of an array's numbers, from the first on, brought into the first cache, to be read."""
    for k in range(0, count, LINE):
        _to_read(rows, first + k)
    if count % LINE != 1:
        _to_read(rows, first + count - 1)


@inlined
def bring_to_write(rows: Array | Ints, first: int, count: int) -> None:
    """Have so many brought into the first cache, to be written."""
    for k in range(0, count, LINE):
        _to_write(rows, first + k)
    if count % LINE != 1:
        _to_write(rows, first + count - 1)
