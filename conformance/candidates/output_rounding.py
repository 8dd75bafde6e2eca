"""Rounding of answers: what another number model computed, in the formats that records have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from conformance.fields import outputs_of
from conformance.floats import to_float32
from conformance.shapes import Block, Kind, Listing, Nullable, Scalar, Vector

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields
    from conformance.shapes import Shape


def rounded_outputs(
    op: str,
    fields: Fields,
    number: type | tuple[type, ...] = float,
    narrow: Callable[[Any], float] = to_float32,
) -> Fields:
    """Return an answer whose float32 outputs are float32 values, rounded once, nearest-even.

    Parameters
    ----------
    op : str
        The operation.
    fields : Fields
        Its outputs.
    number : type or tuple of types
        What its numbers are.
    narrow : callable
        Rounds one of them.
    """

    def rounded(shape: Shape, value: Any) -> Any:
        match shape:
            case Nullable(inner):
                return None if value is None else rounded(inner, value)
            case Scalar(Kind.FLOAT32) if isinstance(value, number):
                return narrow(value)
            case Vector() if isinstance(value, list | tuple):
                return [narrow(component) for component in value]
            case Listing(item) if isinstance(value, list | tuple):
                return [rounded(item, each) for each in value]
            case Block(shapes) if isinstance(value, dict):
                return {
                    key: rounded(shapes[key], each) if key in shapes else each for key, each in value.items()
                }
            case _:
                return value

    outputs: Fields = rounded(outputs_of(op), fields)
    return outputs
