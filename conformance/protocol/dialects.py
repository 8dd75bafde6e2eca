"""The two ways in which floats travel: as short decimals, or as their bits."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias

from conformance.fields import outputs_of
from conformance.protocol.spellings import of_bits, spell_double, spell_single
from conformance.shapes import Block, Kind, Listing, Nullable, Scalar, Vector

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields
    from conformance.shapes import Shape

Dialect: TypeAlias = Literal["decimal", "hex"]
"""``decimal``: JSON numbers that round to the float meant. ``hex``: strings with a float's bits."""
DIALECTS: Final[tuple[Dialect, ...]] = ("decimal", "hex")

_BITS: Final = re.compile(r"0x(?:[0-9a-fA-F]{8}|[0-9a-fA-F]{16})")
_NAMES: Final = frozenset({"geometry", "name", "kind", "world", "label"})
"""Keys of texts that people choose, so that one may look like bits."""


def read_bits(value: Any, key: str = "") -> Any:
    """Copy inputs in which floats are bits, with each float as a number; names are left alone."""
    if isinstance(value, str):
        return value if key in _NAMES or not _BITS.fullmatch(value) else of_bits(value)
    if isinstance(value, dict):
        return {inner: read_bits(item, inner) for inner, item in value.items()}
    if isinstance(value, list):
        return [read_bits(item, key) for item in value]
    return value


def write_outputs(op: str, fields: Fields, dialect: Dialect) -> Fields:
    """Copy an answer with each float as the dialect writes it."""
    written: Fields = map_floats(
        outputs_of(op),
        fields,
        lambda value, kind, _path: (
            spell_single(value, dialect) if kind is Kind.FLOAT32 else spell_double(value, dialect)
        ),
    )
    return written


def map_floats(shape: Shape, value: Any, change: Callable[[Any, Kind, str], Any], path: str = "") -> Any:
    """Copy a value of a shape with its floats changed; what does not have the shape is left as it is.

    Parameters
    ----------
    shape : Shape
    value : object
        Floats may be written in any way.
    change : callable
        Given what stands for a float, whether it is a float32 or a float64, and its path.
    path : str
        Where `value` stands.
    """
    match shape:
        case Scalar(Kind.FLOAT32 | Kind.FLOAT64 as kind):
            return change(value, kind, path)
        case Nullable(inner) if value is not None:
            return map_floats(inner, value, change, path)
        case Vector() if isinstance(value, list | tuple):
            return [change(item, Kind.FLOAT32, f"{path}[{i}]") for i, item in enumerate(value)]
        case Listing(item) if isinstance(value, list | tuple):
            return [map_floats(item, each, change, f"{path}[{i}]") for i, each in enumerate(value)]
        case Block(fields) if isinstance(value, dict):
            dot = f"{path}." if path else ""
            return {
                key: map_floats(fields[key], each, change, f"{dot}{key}") if key in fields else each
                for key, each in value.items()
            }
        case _:
            return value
