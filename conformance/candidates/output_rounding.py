"""Rounding of answers: what another number model computed, in the formats that records have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from conformance.fields import outputs_of
from conformance.floats import to_float32
from conformance.shapes import Block, Kind, Listing, Nullable, Scalar, Vector

if TYPE_CHECKING:
    from conformance.query import Fields
    from conformance.shapes import Shape


def rounded_outputs(op: str, fields: Fields) -> Fields:
    """Return an answer whose float32 outputs are float32 values, rounded once, nearest-even.

    Parameters
    ----------
    op : str
        The operation.
    fields : Fields
        Its outputs; numbers are Python floats.
    """
    rounded: Fields = _rounded(outputs_of(op), fields)
    return rounded


def _rounded(shape: Shape, value: Any) -> Any:
    match shape:
        case Nullable(inner):
            return None if value is None else _rounded(inner, value)
        case Scalar(Kind.FLOAT32) if isinstance(value, float):
            return to_float32(value)
        case Vector() if isinstance(value, list | tuple):
            return [to_float32(component) for component in value]
        case Listing(item) if isinstance(value, list | tuple):
            return [_rounded(item, each) for each in value]
        case Block(fields) if isinstance(value, dict):
            return {
                key: _rounded(fields[key], each) if key in fields else each for key, each in value.items()
            }
        case _:
            return value
