"""Output fields: reading them into exact numbers, finding them by either spelling of their path."""

from __future__ import annotations

import difflib
import math
import re
from enum import Enum
from typing import TYPE_CHECKING, Any, Final

from conformance.floats import to_float32
from conformance.outputs import OUTPUTS
from conformance.shapes import (
    FLOAT_KINDS,
    STEP_END,
    TEXT_KINDS,
    Block,
    Kind,
    Listing,
    Nullable,
    Place,
    Scalar,
    Vector,
)
from conformance.step_outputs import STEP_OUTPUTS

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.query import Fields
    from conformance.shapes import Shape

_NOT_FINITE: Final = {"nan": float("nan"), "inf": float("inf"), "-inf": float("-inf")}
_EXPECTED: Final = {kind: f"{kind.value}, a whole number" for kind in (Kind.BITS, Kind.MOVER_BITS)}
"""What is said to be expected of kinds that are not one thing: `a flag`, but `bits`."""
_TOKEN: Final = re.compile(r"\[(\d+)\]|\.?([A-Za-z_]\w*)")

_STEP: Final = re.compile(rf"^(\w+) (\d+){STEP_END}")
"""A step as people read it: ``tick 17: ``; its list has the plural's name."""


class Missing(Enum):
    """The value of a field that is not there, which is not the same as null."""

    MISSING = "(absent)"

    def __str__(self) -> str:
        return self.value


MISSING: Final = Missing.MISSING


class UnknownOperationError(ValueError):
    """An operation that ``vectors/FORMAT.md`` does not have.

    Attributes
    ----------
    op : str
        The unknown name.
    nearest : str or None
        The most similar operation that exists.
    """

    def __init__(self, op: str) -> None:
        self.op = op
        self.nearest = _nearest(op, OUTPUTS)
        super().__init__(f"unknown operation {op!r}{_hint(self.nearest)}")


class UnknownFieldError(ValueError):
    """A path that names no output field of its operation; `nearest` is the most similar that does."""

    def __init__(self, op: str, path: str) -> None:
        self.path = path
        self.nearest = _nearest(path, field_names(op))
        super().__init__(f"{op} has no output field {path!r}{_hint(self.nearest)}")


class FieldError(ValueError):
    """A value that does not have the shape of its field: where, what was found, what was expected."""

    def __init__(self, path: str, found: str, expected: str) -> None:
        self.path = path
        self.found = found
        self.expected = expected
        super().__init__(f"{path or 'expect'}: found {found}, expected {expected}")


def outputs_of(op: str) -> Block:
    """Return the shape of what an operation, or a step of a walk, answers; raises `UnknownOperationError`."""
    block = OUTPUTS.get(op) or STEP_OUTPUTS.get(op)
    if block is None:
        raise UnknownOperationError(op)
    return block


def field_names(op: str) -> list[str]:
    """List the readable names of an operation's fields; an item of a list reads ``[0]``."""
    return [place.name for place, _ in _leaves(outputs_of(op), Place())]


def locate(op: str, path: str) -> tuple[Place, Shape]:
    """Find a field by its path, written as in records or as read by people.

    ``contact_plane.plane[3]`` and ``contact_plane.d`` are the same field, and so are ``ticks[17].cp[3]`` and
    ``tick 17: contact_plane.d``. The path may also end at a whole
    vector, list or block.

    Raises
    ------
    UnknownOperationError, UnknownFieldError
    """
    written = _STEP.sub(r"\1s[\2].", path)
    tokens = [index or key for index, key in _TOKEN.findall(written)]
    complete = _TOKEN.sub("", written) == ""
    found = _descend(outputs_of(op), tokens, Place()) if tokens and complete else None
    if found is None:
        raise UnknownFieldError(op, path)
    return found


def canonical_path(op: str, path: str) -> str:
    """Return the path of a field as written in records; raises like `locate`."""
    return locate(op, path)[0].path


def kind_of(op: str, path: str) -> Kind:
    """Tell what kind of value a path leads to, `Kind.BLOCK` for more than one; raises like `locate`."""
    return kind_of_shape(locate(op, path)[1])


def kind_of_shape(shape: Shape) -> Kind:
    """Return the kind of a single value, or `Kind.BLOCK`."""
    match shape:
        case Scalar(kind):
            return kind
        case Nullable(inner):
            return kind_of_shape(inner)
        case _:
            return Kind.BLOCK


def field_at(fields: Fields, op: str, path: str) -> Any:
    """Return the value at a path, or `MISSING` where the candidate gave none; raises like `locate`."""
    value: Any = fields
    for index, key in _TOKEN.findall(canonical_path(op, path)):
        if key and isinstance(value, dict):
            value = value.get(key, MISSING)
        elif index and isinstance(value, list | tuple) and int(index) < len(value):
            value = value[int(index)]
        else:
            return MISSING
    return value


def normalise(op: str, fields: Mapping[str, Any]) -> Fields:
    """Read an `expect` block: floats rounded to float32, ``"nan"`` and ``"inf"`` turned into numbers.

    Raises
    ------
    UnknownOperationError
        For an operation that does not exist.
    FieldError
        For a field that is unknown, missing or of another kind.
    """
    block: Fields = normalise_shape(outputs_of(op), fields, "")
    return block


def normalise_shape(shape: Shape, value: Any, path: str) -> Any:
    """Read one value of a shape; see `normalise`."""
    match shape:
        case Scalar(kind):
            return _scalar(kind, value, path)
        case Vector(components):
            items = _list(value, path, len(components))
            return [_float32(item, f"{path}[{i}]") for i, item in enumerate(items)]
        case Nullable(inner):
            return None if value is None else normalise_shape(inner, value, path)
        case Listing(item):
            return [normalise_shape(item, v, f"{path}[{i}]") for i, v in enumerate(_list(value, path))]
        case Block():
            return _block(shape, value, path)


def _block(block: Block, value: Any, path: str) -> Fields:
    if not isinstance(value, dict):
        raise FieldError(path, _describe(value), "a block of fields")
    prefix = f"{path}." if path else ""
    for key in value:
        if key not in block.fields:
            raise FieldError(prefix + key, "an unknown field", f"one of {', '.join(block.fields)}")
    for key in block.fields:
        if key not in value and key not in block.optional:
            raise FieldError(prefix + key, "nothing", "a value")
    return {key: normalise_shape(block.fields[key], item, prefix + key) for key, item in value.items()}


def _list(value: Any, path: str, length: int | None = None) -> list[Any]:
    if not isinstance(value, list) or (length is not None and len(value) != length):
        raise FieldError(path, _describe(value), "a list" if length is None else f"{length} numbers")
    return value


def _scalar(kind: Kind, value: Any, path: str) -> Any:
    if kind is Kind.FLOAT32:
        return _float32(value, path)
    if kind is Kind.FLOAT64:
        return read_number(value, path)
    if fits(kind, value):
        return value
    raise FieldError(path, _describe(value), _EXPECTED.get(kind, f"a {kind.value}"))


def fits(kind: Kind, value: Any) -> bool:
    """Tell whether a value is of a kind; any number is a float, a flag is 0 or 1 (or a bool)."""
    if kind in FLOAT_KINDS:
        return isinstance(value, int | float) and not isinstance(value, bool)
    if kind in TEXT_KINDS:
        return isinstance(value, str)
    if kind is Kind.ANSWER:
        return isinstance(value, int | str)
    if kind is Kind.FLAG:
        return isinstance(value, int) and value in {0, 1}
    return isinstance(value, int) and not isinstance(value, bool)


def read_number(value: Any, path: str) -> float:
    """Read a number of a record as float64, ``"nan"``, ``"inf"`` and ``"-inf"`` included.

    Raises
    ------
    FieldError
        For anything else.
    """
    if isinstance(value, str) and value in _NOT_FINITE:
        return _NOT_FINITE[value]
    if not fits(Kind.FLOAT64, value):
        raise FieldError(path, _describe(value), "a number")
    try:
        return float(value)
    except OverflowError:
        raise FieldError(path, "a number beyond float64", "a number") from None


def single_precision(number: float, path: str) -> float:
    """Round to float32; raises `FieldError` for a finite number that no float32 is near."""
    rounded = to_float32(number)
    if math.isinf(rounded) and math.isfinite(number):
        raise FieldError(path, f"the number {number!r}", "a number that fits in a float32")
    return rounded


def _float32(value: Any, path: str) -> float:
    return single_precision(value if value.__class__ is float else read_number(value, path), path)


def _describe(value: Any) -> str:
    text = repr(value)
    shown = text if len(text) <= 60 else text[:57] + "..."
    return f"{shown} ({type(value).__name__})"


def _descend(shape: Shape, tokens: list[str], place: Place) -> tuple[Place, Shape] | None:
    if isinstance(shape, Nullable):
        return (place, shape) if not tokens else _descend(shape.inner, tokens, place)
    if not tokens:
        return place, shape
    match shape:
        case Block(fields, _, silent):
            key = _key_of(shape, tokens[0])
            if key in fields:
                return _descend(fields[key], tokens[1:], place.key(key, shape))
            inner = (_descend(fields[key], tokens, place.key(key, shape)) for key in silent)
            return next((found for found in inner if found), None)
        case Vector(components):
            return _component(shape, ".".join(tokens), components, place)
        case Listing(item) if tokens[0].isdigit():
            return _descend(item, tokens[1:], place.item(int(tokens[0]), shape))
        case _:
            return None


def _key_of(block: Block, name: str) -> str:
    """Return the key of a field by its readable name, or what was given."""
    return next((key for key, shown in block.names.items() if shown == name and key in block.fields), name)


def _component(
    vector: Vector, token: str, names: tuple[str, ...], place: Place
) -> tuple[Place, Shape] | None:
    known = {**{name: i for i, name in enumerate(names)}, **{str(i): i for i in range(len(names))}}
    if token not in known:
        return None
    return place.component(known[token], vector), Scalar(Kind.FLOAT32)


def _leaves(shape: Shape, place: Place) -> Iterator[tuple[Place, Kind]]:
    match shape:
        case Scalar(kind):
            yield place, kind
        case Vector(components):
            yield from ((place.component(i, shape), Kind.FLOAT32) for i in range(len(components)))
        case Nullable(inner):
            yield from _leaves(inner, place)
        case Listing(item):
            yield from _leaves(item, place.item(0, shape))
        case Block(fields):
            for key, inner in fields.items():
                yield from _leaves(inner, place.key(key, shape))


def _nearest(name: str, names: Mapping[str, object] | list[str]) -> str | None:
    return next(iter(difflib.get_close_matches(name, names, n=1)), None)


def _hint(nearest: str | None) -> str:
    return f" (did you mean {nearest!r}?)" if nearest else ""
