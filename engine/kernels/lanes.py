"""What kernels that compute several numbers side by side are generated of."""

from __future__ import annotations

from typing import Any, Final

from llvmlite import ir

_ELEMENT_BYTES: Final = 8
_INDEX: Final = ir.IntType(32)


def _numbers(width: int) -> Any:
    return ir.VectorType(ir.DoubleType(), width)


def loaded(context: Any, builder: Any, signature: Any, arguments: Any, k: int, width: int) -> Any:
    """Generate the load of the k-th `width` numbers of a block.

    The first two arguments are the array, and where in it the block begins.
    """
    array = context.make_array(signature.args[0])(context, builder, arguments[0])
    place = builder.gep(array.data, [builder.add(arguments[1], arguments[1].type(width * k))])
    return builder.load(builder.bitcast(place, _numbers(width).as_pointer()), align=_ELEMENT_BYTES)


def stored(context: Any, builder: Any, array_type: Any, arguments: Any, numbers: Any) -> None:
    """Generate the store of numbers side by side; the arguments are the array, and where to begin in it."""
    array = context.make_array(array_type)(context, builder, arguments[0])
    place = builder.bitcast(builder.gep(array.data, [arguments[1]]), numbers.type.as_pointer())
    builder.store(numbers, place, align=_ELEMENT_BYTES)


def spread(builder: Any, number: Any, width: int) -> Any:
    """Generate a number in each place."""
    nothing = ir.Constant(_numbers(width), ir.Undefined)
    one = builder.insert_element(nothing, number, _INDEX(0))
    return builder.shuffle_vector(one, one, ir.Constant(ir.VectorType(_INDEX, width), [0] * width))


def bits(builder: Any, flags: Any, width: int) -> Any:
    """Generate an integer whose lowest bits are the flags."""
    return builder.zext(builder.bitcast(flags, ir.IntType(width)), ir.IntType(64))
