"""Integers read by the byte, where each holds eight small numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from engine.constants import frozen
from engine.kernels.compile import inlined_entry

if TYPE_CHECKING:
    from engine.kernels.types import Ints

BYTES: Final = frozen(8)
"""In an integer."""
_BYTE: Final = ir.IntType(8)


def _loaded(_typing: Any, numbers: Any, _place: Any) -> Any:
    """Generate the load of a byte."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        array = context.make_array(signature.args[0])(context, builder, arguments[0])
        first = builder.bitcast(array.data, _BYTE.as_pointer())
        byte = builder.load(builder.gep(first, [arguments[1]]))
        return builder.zext(byte, ir.IntType(64))

    return types.int64(numbers, types.int64), generate


_load_byte: Final[Any] = intrinsic(_loaded)


@inlined_entry
def octet(numbers: Ints, place: int) -> int:
    """Return a byte of an array of 64-bit integers, the lowest of each first.

    To shift it out of its integer takes four times the instructions. All machines that Numba compiles for
    keep the lowest byte of an integer first.
    """
    byte: int = _load_byte(numbers, place)
    return byte
