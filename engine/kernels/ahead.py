"""Rows brought near before their turn: a row of results is eleven cache lines that nobody has read yet."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from engine.constants import frozen
from engine.kernels.compile import inlined

if TYPE_CHECKING:
    from engine.kernels.types import Array

LINE: Final = frozen(8)
"""Numbers in a cache line."""
_FOR_WRITING: Final = 1
_STAYS: Final = 3
_DATA: Final = 1
"""What LLVM is told of a place: it will be written to, soon and more than once, and is no code."""


def _hint(_typing: Any, numbers: Any, _place: Any) -> Any:
    """Generate LLVM's prefetch of an element of an array, which may also be beyond its end."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        array = context.make_array(signature.args[0])(context, builder, arguments[0])
        place = builder.bitcast(builder.gep(array.data, [arguments[1]]), ir.IntType(8).as_pointer())
        number = ir.IntType(32)
        kind = ir.FunctionType(ir.VoidType(), [place.type, number, number, number])
        fetch = builder.module.declare_intrinsic("llvm.prefetch", [place.type], kind)
        builder.call(fetch, [place, *(ir.Constant(number, k) for k in (_FOR_WRITING, _STAYS, _DATA))])
        return context.get_dummy_value()

    return types.void(numbers, types.int64), generate


_prefetch: Final[Any] = intrinsic(_hint)


@inlined
def bring_near(rows: Array, i: int, size: int) -> None:
    """Have the i-th row, of `size` numbers, brought near; there need not be one, and nothing changes."""
    for k in range(0, size, LINE):
        _prefetch(rows, size * i + k)
