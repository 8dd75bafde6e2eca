"""Shapes of output fields: what kind of value stands where, and what its parts are called."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Mapping


class Kind(Enum):
    """What a single value is; decides how it is compared, read and printed."""

    FLOAT32 = "float32"
    FLOAT64 = "float64"
    FLAG = "flag"
    """0 or 1."""
    COUNT = "count"
    """A whole number that counts or indexes something."""
    STATE = "state name"
    """The name of a transition state."""
    MOVER_BITS = "mover state bits"
    BITS = "bits"
    CELL = "cell id"
    POLYGON = "polygon index"
    TEXT = "text"
    """A trace or a name."""
    ANSWER = "number or word"
    """A number, or a word where no number fits (`skip`, `untouched`)."""
    BLOCK = "block"
    """Not a single value: a whole vector, list or mapping that is there on one side only."""


STEP_END = ": "
"""What stands between a step and its field in readable names."""

FLOAT_KINDS = frozenset({Kind.FLOAT32, Kind.FLOAT64})
TEXT_KINDS = frozenset({Kind.STATE, Kind.TEXT})


@dataclass(frozen=True, slots=True)
class Scalar:
    """One value."""

    kind: Kind


@dataclass(frozen=True, slots=True)
class Vector:
    """A fixed number of float32 values with a name each."""

    components: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Nullable:
    """A shape that may be null, which is a value of its own: 'not valid', 'none'."""

    inner: Shape


@dataclass(frozen=True, slots=True)
class Listing:
    """Any number of items of one shape.

    `step` is what an item is called if they follow from each other, as the ticks of a walk do: after the
    first that differs the others mean nothing.
    """

    item: Shape
    step: str = ""


@dataclass(frozen=True, slots=True)
class Block:
    """Named fields.

    Attributes
    ----------
    fields : Mapping of str to Shape
        In the order of FORMAT.md.
    optional : frozenset of str
        Fields that a record leaves out when they mean nothing. Presence is compared like a value.
    silent : frozenset of str
        Fields left out of readable names: `contact_plane.plane[3]` reads `contact_plane.d`.
    names : Mapping of str to str
        What fields with a short key are called in readable names: `cp` reads `contact_plane`.
    """

    fields: Mapping[str, Shape]
    optional: frozenset[str] = field(default=frozenset())
    silent: frozenset[str] = field(default=frozenset())
    names: Mapping[str, str] = field(default_factory=dict)


Shape: TypeAlias = Scalar | Vector | Nullable | Listing | Block


@dataclass(frozen=True, slots=True)
class Place:
    """Where a value stands: `path` as written in records, `name` as read by people."""

    path: str = ""
    name: str = ""

    def key(self, key: str, block: Block) -> Place:
        """Return the place of a block's field."""
        shown = self.name if key in block.silent else _dotted(self.name, block.names.get(key, key))
        return Place(_dotted(self.path, key), shown)

    def component(self, index: int, vector: Vector) -> Place:
        """Return the place of a vector's component."""
        return Place(f"{self.path}[{index}]", _dotted(self.name, vector.components[index]))

    def item(self, index: int, listing: Listing) -> Place:
        """Return the place of a list's item; a step reads ``tick 17: ``."""
        name = f"{listing.step} {index}{STEP_END}" if listing.step else f"{self.name}[{index}]"
        return Place(f"{self.path}[{index}]", name)

    def below(self, inner: Place) -> Place:
        """Return a place that is written from here."""
        return Place(_dotted(self.path, inner.path), _dotted(self.name, inner.name))


def _dotted(parent: str, key: str) -> str:
    return f"{parent}.{key}" if parent and not parent.endswith(STEP_END) else parent + key
