"""Reading an engine's answers: every field there, of its kind, floats rounded to float32.

Nearly all answers are as they should be. They are read by functions that are made once for each operation
and know neither paths nor messages; what those do not take is read again, with care, to say where and why.
"""

from __future__ import annotations

import functools
import math
import re
import struct
from array import array
from typing import TYPE_CHECKING, Any, Final

from conformance.fields import FieldError, normalise_shape, outputs_of
from conformance.protocol.dialects import map_floats
from conformance.protocol.spellings import of_bits
from conformance.shapes import TEXT_KINDS, Block, Kind, Listing, Nullable, Scalar, Vector

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import TypeAlias

    from conformance.protocol.dialects import Dialect
    from conformance.query import Fields
    from conformance.shapes import Shape

    Reader: TypeAlias = Callable[[Any], Any]

_NUMBERS: Final = frozenset({float, int})
_BITS32: Final = re.compile(r"0x[0-9a-fA-F]{8}")
_BITS64: Final = re.compile(r"0x[0-9a-fA-F]{16}")


class _UnusualError(Exception):
    """A value that is wrong, or right in a rare way (``"nan"``)."""


_UNUSUAL: Final = (_UnusualError, KeyError, OverflowError)
"""What reading ends with besides: an unknown key, a whole number that no float holds."""


def read_outputs(op: str, fields: Any, dialect: Dialect) -> Fields:
    """Read an answer of an engine.

    Parameters
    ----------
    op : str
        What was asked.
    fields : object
        The ``result`` of the reply, as JSON has it.
    dialect : {"decimal", "hex"}
        How the engine writes floats.

    Returns
    -------
    Fields
        As `conformance.query` describes them.

    Raises
    ------
    FieldError
        For a field that is unknown, missing or of another kind; it says where.
    """
    try:
        read: Fields = _reader(op, dialect)(fields)
    except _UNUSUAL:
        read = _read_with_care(op, fields, dialect)
    return read


def _read_with_care(op: str, fields: Any, dialect: Dialect) -> Fields:
    shape = outputs_of(op)
    told = map_floats(shape, fields, _bits_at) if dialect == "hex" else fields
    read: Fields = normalise_shape(shape, told, "")
    return read


@functools.cache
def _reader(op: str, dialect: Dialect) -> Reader:
    return _reader_of(outputs_of(op), dialect)


def _reader_of(shape: Shape, dialect: Dialect) -> Reader:
    match shape:
        case Scalar(kind):
            return _SCALARS[dialect].get(kind, _whole)
        case Vector(components):
            return _vector_reader(len(components), dialect)
        case Nullable(inner):
            read = _reader_of(inner, dialect)
            return lambda value: None if value is None else read(value)
        case Listing(item):
            return _listing_reader(_reader_of(item, dialect))
        case Block(fields, optional):
            readers = {key: _reader_of(inner, dialect) for key, inner in fields.items()}
            return _block_reader(readers, fields.keys() - optional)


def _block_reader(readers: Mapping[str, Reader], required: set[str]) -> Reader:
    def read(value: Any) -> Fields:
        if value.__class__ is not dict or not value.keys() >= required:
            raise _UnusualError
        return {key: readers[key](item) for key, item in value.items()}

    return read


def _listing_reader(read_item: Reader) -> Reader:
    def read(value: Any) -> list[Any]:
        if value.__class__ is not list:
            raise _UnusualError
        return [read_item(item) for item in value]

    return read


def _vector_reader(count: int, dialect: Dialect) -> Reader:
    read_items = {"decimal": _singles, "hex": _singles_of_bits}[dialect]

    def read(value: Any) -> list[float]:
        if value.__class__ is not list or len(value) != count:
            raise _UnusualError
        return read_items(value)

    return read


def _singles(numbers: list[Any]) -> list[float]:
    """Round numbers to float32, all in one call; what is no number is not taken, nor what is too large."""
    if not _NUMBERS.issuperset(map(type, numbers)):
        raise _UnusualError
    rounded = array("f", numbers).tolist()
    if not math.isfinite(sum(rounded)):
        raise _UnusualError
    return rounded


def _singles_of_bits(texts: list[Any]) -> list[float]:
    for text in texts:
        if text.__class__ is not str or not _BITS32.fullmatch(text):
            raise _UnusualError
    digits = "".join([text[2:] for text in texts])
    return list(struct.unpack(f">{len(texts)}f", bytes.fromhex(digits)))


def _single(value: Any) -> float:
    return _singles([value])[0]


def _double(value: Any) -> float:
    if value.__class__ is not float:
        raise _UnusualError
    number: float = value
    return number


def _single_of_bits(value: Any) -> float:
    return _singles_of_bits([value])[0]


def _double_of_bits(value: Any) -> float:
    if value.__class__ is not str or not _BITS64.fullmatch(value):
        raise _UnusualError
    return of_bits(value)


def _whole(value: Any) -> int:
    if value.__class__ is not int:
        raise _UnusualError
    number: int = value
    return number


def _flag(value: Any) -> int:
    if value.__class__ is not int or value not in {0, 1}:
        raise _UnusualError
    flag: int = value
    return flag


def _text(value: Any) -> str:
    if value.__class__ is not str:
        raise _UnusualError
    text: str = value
    return text


def _answer(value: Any) -> int | str:
    return _text(value) if value.__class__ is str else _whole(value)


_EXACT: Final[Mapping[Kind, Reader]] = {
    Kind.FLAG: _flag,
    Kind.ANSWER: _answer,
    **dict.fromkeys(TEXT_KINDS, _text),
}
_SCALARS: Final[Mapping[Dialect, Mapping[Kind, Reader]]] = {
    "decimal": {**_EXACT, Kind.FLOAT32: _single, Kind.FLOAT64: _double},
    "hex": {**_EXACT, Kind.FLOAT32: _single_of_bits, Kind.FLOAT64: _double_of_bits},
}
"""Readers of single values; kinds that are not here are whole numbers."""


def _bits_at(value: Any, kind: Kind, path: str) -> float:
    """Read the bits of a float; a number in their place is a mistake in the engine's dialect."""
    bits = _BITS32 if kind is Kind.FLOAT32 else _BITS64
    if not isinstance(value, str) or not bits.fullmatch(value):
        example = "0x3f800000" if kind is Kind.FLOAT32 else "0x3ff0000000000000"
        raise FieldError(path, repr(value)[:60], f"the bits of a {kind.value}, as in '{example}'")
    return of_bits(value)
