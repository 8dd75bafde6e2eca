"""Every field of an answer as a row: what differs first, then what is equal."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from conformance.fields import MISSING, fits, kind_of_shape, outputs_of
from conformance.floats import bits32, bits64, decimal32, is_float32
from conformance.report.ticks import tick_of
from conformance.report.values import format_ulps, format_value
from conformance.shapes import Block, Kind, Listing, Nullable, Place, Scalar, Vector

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from conformance.compare import Difference
    from conformance.query import Fields
    from conformance.shapes import Shape

MOST_EQUAL: Final = 300
"""Equal fields shown; a landblock has thousands."""


@dataclass(frozen=True, slots=True)
class Value:
    """A value as people read it, and its bits; no bits where it is no number."""

    text: str
    bits: str = ""


_UNKNOWN: Final = Value("")


@dataclass(frozen=True, slots=True)
class Row:
    """One field.

    Attributes
    ----------
    name : str
        As people read it.
    retail, candidate : Value
        The expected value and the given one.
    differs : bool
        Whether that is a failure.
    distance : str
        ULPs, where there is such a distance.
    note : str
        What the values alone do not show.
    """

    name: str
    retail: Value
    candidate: Value
    differs: bool = False
    distance: str = ""
    note: str = ""


@dataclass(frozen=True, slots=True)
class _Leaf:
    place: Place
    kind: Kind
    value: Any


def differing_rows(found: Sequence[Difference]) -> list[Row]:
    """Return a row for each field that differs, in the order of FORMAT.md."""
    return [
        Row(
            difference.name,
            shown(difference.kind, difference.retail),
            shown(difference.kind, difference.candidate),
            differs=True,
            distance=format_ulps(difference),
            note=", ".join(
                text
                for text in (
                    difference.note,
                    f"allowed {difference.tolerance}" if difference.tolerance else "",
                )
                if text
            ),
        )
        for difference in found
    ]


def other_rows(
    op: str, answer: Fields, found: Sequence[Difference], columns: tuple[bool, bool] = (True, True)
) -> list[Row]:
    """Return a row for each field of an answer that does not differ.

    Parameters
    ----------
    op : str
        The operation.
    answer : Fields
        Of one of the two.
    found : sequence of Difference
        What differs. Of a walk, only the tick that these are of is shown; without differences, the last.
    columns : tuple of (bool, bool)
        Whether it is what was expected, and whether it is what was given: both, where the two are equal. One
        of them stays empty where there is no other answer, or only some fields are pinned.
    """
    below = tuple(difference.path for difference in found)
    tick = tick_of(found)
    rows = []
    for leaf in _leaves(outputs_of(op), answer, Place(), tick):
        if not any(_is_within(leaf.place.path, path) for path in below):
            value = shown(leaf.kind, leaf.value)
            expected, given = (value if known else _UNKNOWN for known in columns)
            rows.append(Row(leaf.place.name, expected, given))
    return rows


def shown(kind: Kind, value: Any) -> Value:
    """Write a value: floats as the shortest decimal that reads back, and their bits."""
    if value is not MISSING and value is not None and fits(kind, value):
        match kind:
            case Kind.FLOAT32:
                text = decimal32(value) if is_float32(value) else repr(float(value))
                return Value(text, f"0x{bits32(value):08X}")
            case Kind.FLOAT64:
                return Value(repr(float(value)), f"0x{bits64(value):016X}")
            case Kind.CELL:
                return Value(str(value), f"0x{value:08X}")
            case _:
                pass
    return Value(format_value(kind, value))


def _is_within(path: str, other: str) -> bool:
    return path == other or path.startswith((f"{other}.", f"{other}["))


def _leaves(shape: Shape, value: Any, place: Place, tick: int | None) -> Iterator[_Leaf]:
    """Yield the single values of an answer in the order of FORMAT.md; of a walk those of one tick."""
    match shape:
        case Nullable(inner) if value is not None:
            yield from _leaves(inner, value, place, tick)
        case Vector(components) if isinstance(value, list | tuple) and len(value) == len(components):
            for i, component in enumerate(value):
                yield _Leaf(place.component(i, shape), Kind.FLOAT32, component)
        case Listing(item) if isinstance(value, list | tuple):
            indices: Sequence[int] = range(len(value))
            if shape.step and value:
                indices = [len(value) - 1] if tick is None else [tick] if tick < len(value) else []
            for i in indices:
                yield from _leaves(item, value[i], place.item(i, shape), None)
        case Block(fields) if isinstance(value, dict):
            for key, inner in fields.items():
                if key in value:
                    yield from _leaves(inner, value[key], place.key(key, shape), tick)
        case Scalar(kind):
            yield _Leaf(place, kind, value)
        case _:
            yield _Leaf(place, kind_of_shape(shape), value)
