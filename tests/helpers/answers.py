"""Help for tests of comparison: a full answer of any shape, and a smallest change to each of its values."""

from __future__ import annotations

import copy
import math
from typing import TYPE_CHECKING, Any

from conformance.floats import next_float32
from conformance.shapes import Block, Kind, Listing, Nullable, Place, Scalar, Vector

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.shapes import Shape

SAMPLES: dict[Kind, Any] = {
    Kind.FLOAT32: 0.5,
    Kind.FLOAT64: 0.1,
    Kind.FLAG: 0,
    Kind.COUNT: 3,
    Kind.STATE: "OK",
    Kind.MOVER_BITS: 0x203,
    Kind.BITS: 0x81,
    Kind.CELL: 0xA9B40150,
    Kind.POLYGON: 7,
    Kind.TEXT: "K1",
    Kind.ANSWER: 1,
}


def full_answer(shape: Shape) -> Any:
    """Return a value of a shape with every optional field there and one item in every list."""
    match shape:
        case Scalar(kind):
            return SAMPLES[kind]
        case Vector(components):
            return [0.25 + i for i in range(len(components))]
        case Nullable(inner):
            return full_answer(inner)
        case Listing(item):
            return [full_answer(item)]
        case Block(fields):
            return {key: full_answer(inner) for key, inner in fields.items()}


def changed(kind: Kind, value: Any) -> Any:
    """Return the nearest other value of a kind: one ULP up, the other flag, another name."""
    match kind:
        case Kind.FLOAT32:
            return next_float32(value) if math.isfinite(value) else 0.0
        case Kind.FLOAT64:
            return math.nextafter(value, math.inf)
        case Kind.FLAG:
            return 1 - value
        case Kind.STATE:
            return "SLID" if value != "SLID" else "OK"
        case Kind.TEXT:
            return f"{value}1"
        case Kind.ANSWER:
            return "skip" if isinstance(value, int) else 1
        case _:
            return value + 1


def single_changes(shape: Shape, answer: Any) -> Iterator[tuple[Place, Kind, Any]]:
    """Yield for every single value of an answer: its place, its kind, and the answer with only it changed."""
    for place, kind, path in _values(shape, answer, Place(), ()):
        other = copy.deepcopy(answer)
        holder = other
        for key in path[:-1]:
            holder = holder[key]
        holder[path[-1]] = changed(kind, holder[path[-1]])
        yield place, kind, other


def _values(
    shape: Shape, value: Any, place: Place, path: tuple[Any, ...]
) -> Iterator[tuple[Place, Kind, tuple[Any, ...]]]:
    match shape:
        case Scalar(kind):
            yield place, kind, path
        case Vector():
            for i in range(len(value)):
                yield place.component(i, shape), Kind.FLOAT32, (*path, i)
        case Nullable(inner):
            if value is not None:
                yield from _values(inner, value, place, path)
        case Listing(item):
            for i, v in enumerate(value):
                yield from _values(item, v, place.item(i, shape), (*path, i))
        case Block(fields):
            for key, v in value.items():
                yield from _values(fields[key], v, place.key(key, shape), (*path, key))
