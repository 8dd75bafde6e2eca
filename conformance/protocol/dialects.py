"""The two ways in which floats travel: as short decimals, or as their bits."""

from __future__ import annotations

import math
import re
import struct
from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias

import numpy as np

from conformance.fields import FieldError, normalise_shape, outputs_of
from conformance.floats import bits32, bits64
from conformance.inputs import is_float64_input
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
_KEPT: Final = 1 << 16
"""Short decimals that are remembered: most numbers of a scene are sent again and again."""

_short: Final[dict[float, float]] = {}


def write_inputs(value: Any, dialect: Dialect, key: str = "") -> Any:
    """Copy inputs, or a shared record, with each float as the dialect writes it.

    Parameters
    ----------
    value : Any
        Inputs of an operation as `conformance.query` has them: floats are Python floats.
    dialect : {"decimal", "hex"}
        How floats are written; clock times are float64, all others float32.
    key : str
        The key that `value` stands under.
    """
    if isinstance(value, dict):
        return {inner: write_inputs(item, dialect, inner) for inner, item in value.items()}
    write = _double if is_float64_input(key) else _single
    if isinstance(value, list | tuple):
        # Most of what is sent are vectors and indices: they are written here, not one call deeper.
        return [
            write(item, dialect)
            if item.__class__ is float
            else (item if item.__class__ is int else write_inputs(item, dialect, key))
            for item in value
        ]
    return write(value, dialect) if isinstance(value, float) else value


def read_bits(value: Any, key: str = "") -> Any:
    """Copy inputs in which floats are bits, with each float as a number; names are left alone."""
    if isinstance(value, str):
        return value if key in _NAMES or not _BITS.fullmatch(value) else _of_bits(value)
    if isinstance(value, dict):
        return {inner: read_bits(item, inner) for inner, item in value.items()}
    if isinstance(value, list):
        return [read_bits(item, key) for item in value]
    return value


def write_outputs(op: str, fields: Fields, dialect: Dialect) -> Fields:
    """Copy an answer with each float as the dialect writes it."""
    written: Fields = _mapped(
        outputs_of(op),
        fields,
        "",
        lambda value, kind, _path: (
            _single(value, dialect) if kind is Kind.FLOAT32 else _double(value, dialect)
        ),
    )
    return written


def read_outputs(op: str, fields: Any, dialect: Dialect) -> Fields:
    """Read an answer of an engine: every field there, of its kind, floats rounded to float32.

    Raises
    ------
    FieldError
        For a field that is unknown, missing or of another kind; it says where.
    """
    shape = outputs_of(op)
    told = _mapped(shape, fields, "", _bits_at) if dialect == "hex" else fields
    read: Fields = normalise_shape(shape, told, "")
    return read


def shortest(value: float) -> float:
    """Return the float64 that prints as the shortest decimal of a float32.

    The same as `conformance.floats.shortest32`, which needs no NumPy and takes ten times as long.
    """
    known = _short.get(value)
    if known is not None:
        return known
    if value == 0.0 or not math.isfinite(value):
        return value  # the zeros are equal as keys, and differ: they are not remembered
    if len(_short) >= _KEPT:
        _short.clear()
    short = _short[value] = float(str(np.float32(value)))
    return short


def _single(value: float, dialect: Dialect) -> float | str:
    if dialect == "hex":
        return f"0x{bits32(value):08x}"
    short = _short.get(value)  # never one that is not finite
    if short is not None:
        return short
    return shortest(value) if math.isfinite(value) else str(value)


def _double(value: float, dialect: Dialect) -> float | str:
    if dialect == "hex":
        return f"0x{bits64(value):016x}"
    return value if math.isfinite(value) else str(value)


def _of_bits(text: str) -> float:
    digits = text[2:]
    value: float = struct.unpack(">f" if len(digits) == 8 else ">d", bytes.fromhex(digits))[0]
    return value


def _bits_at(value: Any, kind: Kind, path: str) -> float:
    """Read the bits of a float; a number in their place is a mistake in the engine's dialect."""
    digits = 8 if kind is Kind.FLOAT32 else 16
    if not isinstance(value, str) or not _BITS.fullmatch(value) or len(value) != 2 + digits:
        example = "0x3f800000" if kind is Kind.FLOAT32 else "0x3ff0000000000000"
        raise FieldError(path, repr(value)[:60], f"the bits of a {kind.value}, as in '{example}'")
    return _of_bits(value)


def _mapped(shape: Shape, value: Any, path: str, change: Callable[[Any, Kind, str], Any]) -> Any:
    """Copy a value with its floats changed; what does not have the shape is left for the reader."""
    match shape:
        case Scalar(Kind.FLOAT32 | Kind.FLOAT64 as kind):
            return change(value, kind, path)
        case Nullable(inner) if value is not None:
            return _mapped(inner, value, path, change)
        case Vector() if isinstance(value, list | tuple):
            return [change(item, Kind.FLOAT32, f"{path}[{i}]") for i, item in enumerate(value)]
        case Listing(item) if isinstance(value, list | tuple):
            return [_mapped(item, each, f"{path}[{i}]", change) for i, each in enumerate(value)]
        case Block(fields) if isinstance(value, dict):
            dot = f"{path}." if path else ""
            return {
                key: _mapped(fields[key], each, f"{dot}{key}", change) if key in fields else each
                for key, each in value.items()
            }
        case _:
            return value
