"""Reading an engine's answers: every field there, of its kind, floats rounded to float32.

Nearly all answers are as they should be. They are checked by functions that are made once for each operation
and know neither paths nor messages, and their floats are rounded where they stand, all in one call; what
those functions do not take is read again, with care, to say where and why.
"""

from __future__ import annotations

import functools
import math
import re
import struct
from array import array
from dataclasses import dataclass, field
from itertools import chain
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

    Check: TypeAlias = Callable[[Any, Any, "_Floats"], None]
    """Checks what a block or list holds at a key or index, and notes its floats."""

_NUMBERS: Final = frozenset({float, int})
_BITS32: Final = re.compile(r"0x[0-9a-fA-F]{8}")
_ALL_BITS32: Final = re.compile(rf"(?:{_BITS32.pattern})*")
_LENGTH32: Final = len("0x00000000")
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
        The ``result`` of the reply, as JSON has it. It becomes the answer: floats are put in their places.
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
    answer, floats = [fields], _Floats()
    try:
        _check(op, dialect)(answer, 0, floats)
        floats.settle(dialect)
    except _UNUSUAL:
        return _read_with_care(op, fields, dialect)
    read: Fields = answer[0]
    return read


@dataclass(slots=True)
class _Floats:
    """Where the floats of an answer stand: vectors, float32 values, and bits of float64 values."""

    vectors: list[list[Any]] = field(default_factory=list)
    singles: list[tuple[Any, Any]] = field(default_factory=list)
    doubles: list[tuple[Any, Any]] = field(default_factory=list)

    def settle(self, dialect: Dialect) -> None:
        """Read them, and put them where they stand; if one cannot be read, none is changed."""
        written = [*chain.from_iterable(self.vectors), *(holder[key] for holder, key in self.singles)]
        numbers, at = _SINGLES[dialect](written), 0
        for vector in self.vectors:
            vector[:] = numbers[at : at + len(vector)]
            at += len(vector)
        for (holder, key), number in zip(self.singles, numbers[at:], strict=True):
            holder[key] = number
        for holder, key in self.doubles:
            holder[key] = of_bits(holder[key])


def _read_with_care(op: str, fields: Any, dialect: Dialect) -> Fields:
    shape = outputs_of(op)
    told = map_floats(shape, fields, _bits_at) if dialect == "hex" else fields
    read: Fields = normalise_shape(shape, told, "")
    return read


@functools.cache
def _check(op: str, dialect: Dialect) -> Check:
    return _check_of(outputs_of(op), dialect)


def _check_of(shape: Shape, dialect: Dialect) -> Check:
    match shape:
        case Scalar(kind):
            return _SCALARS[dialect].get(kind, _whole)
        case Vector(components):
            return _vector_check(len(components))
        case Nullable(inner):
            return _nullable_check(_check_of(inner, dialect))
        case Listing(item):
            return _listing_check(_check_of(item, dialect))
        case Block(fields, optional):
            checks = {key: _check_of(inner, dialect) for key, inner in fields.items()}
            return _block_check(checks, fields.keys() - optional)


def _block_check(checks: Mapping[str, Check], required: set[str]) -> Check:
    def check(holder: Any, key: Any, floats: _Floats) -> None:
        block = holder[key]
        if block.__class__ is not dict or not block.keys() >= required:
            raise _UnusualError
        for inner in block:
            checks[inner](block, inner, floats)

    return check


def _listing_check(check_item: Check) -> Check:
    def check(holder: Any, key: Any, floats: _Floats) -> None:
        items = holder[key]
        if items.__class__ is not list:
            raise _UnusualError
        for index in range(len(items)):
            check_item(items, index, floats)

    return check


def _nullable_check(check_inner: Check) -> Check:
    def check(holder: Any, key: Any, floats: _Floats) -> None:
        if holder[key] is not None:
            check_inner(holder, key, floats)

    return check


def _vector_check(count: int) -> Check:
    def check(holder: Any, key: Any, floats: _Floats) -> None:
        vector = holder[key]
        if vector.__class__ is not list or len(vector) != count:
            raise _UnusualError
        floats.vectors.append(vector)

    return check


def _singles(numbers: list[Any]) -> list[float]:
    """Round numbers to float32, all in one call; what is no number is not taken, nor what is too large."""
    if not _NUMBERS.issuperset(map(type, numbers)):
        raise _UnusualError
    rounded = array("f", numbers).tolist()
    if not all(map(math.isfinite, rounded)):
        raise _UnusualError
    return rounded


def _singles_of_bits(texts: list[Any]) -> list[float]:
    if not ({str}.issuperset(map(type, texts)) and {_LENGTH32}.issuperset(map(len, texts))):
        raise _UnusualError
    text = "".join(texts)
    if not _ALL_BITS32.fullmatch(text):
        raise _UnusualError
    return list(struct.unpack(f">{len(texts)}f", bytes.fromhex(text.replace("0x", ""))))


_SINGLES: Final[Mapping[Dialect, Callable[[list[Any]], list[float]]]] = {
    "decimal": _singles,
    "hex": _singles_of_bits,
}


def _single(holder: Any, key: Any, floats: _Floats) -> None:
    floats.singles.append((holder, key))


def _double(holder: Any, key: Any, _floats: _Floats) -> None:
    if holder[key].__class__ is not float:
        raise _UnusualError


def _double_of_bits(holder: Any, key: Any, floats: _Floats) -> None:
    text = holder[key]
    if text.__class__ is not str or not _BITS64.fullmatch(text):
        raise _UnusualError
    floats.doubles.append((holder, key))


def _whole(holder: Any, key: Any, _floats: _Floats) -> None:
    if holder[key].__class__ is not int:
        raise _UnusualError


def _flag(holder: Any, key: Any, _floats: _Floats) -> None:
    flag = holder[key]
    if flag.__class__ is not int or flag not in {0, 1}:
        raise _UnusualError


def _text(holder: Any, key: Any, _floats: _Floats) -> None:
    if holder[key].__class__ is not str:
        raise _UnusualError


def _answer(holder: Any, key: Any, _floats: _Floats) -> None:
    if holder[key].__class__ not in {str, int}:
        raise _UnusualError


_EXACT: Final[Mapping[Kind, Check]] = {
    Kind.FLAG: _flag,
    Kind.ANSWER: _answer,
    **dict.fromkeys(TEXT_KINDS, _text),
}
_SCALARS: Final[Mapping[Dialect, Mapping[Kind, Check]]] = {
    "decimal": {**_EXACT, Kind.FLOAT32: _single, Kind.FLOAT64: _double},
    "hex": {**_EXACT, Kind.FLOAT32: _single, Kind.FLOAT64: _double_of_bits},
}
"""Checks of single values; kinds that are not here are whole numbers."""


def _bits_at(value: Any, kind: Kind, path: str) -> float:
    """Read the bits of a float; a number in their place is a mistake in the engine's dialect."""
    bits = _BITS32 if kind is Kind.FLOAT32 else _BITS64
    if not isinstance(value, str) or not bits.fullmatch(value):
        example = "0x3f800000" if kind is Kind.FLOAT32 else "0x3ff0000000000000"
        raise FieldError(path, repr(value)[:60], f"the bits of a {kind.value}, as in '{example}'")
    return of_bits(value)
