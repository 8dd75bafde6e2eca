"""The small values of a case file: numbers, vectors, ids, flags, names of states.

Numbers are decimals in the file; the value meant is the float32 nearest to the decimal.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Literal, TypeAlias

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    Strict,
    WithJsonSchema,
    model_validator,
)

from conformance.floats import to_float32
from conformance.schema.mistakes import mistake
from conformance.source import describe, nearest, quoted

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

MOVER_STATES: Final = {
    "contact": 0x1,
    "on_walkable": 0x2,
    "viewer": 0x4,
    "path_clipped": 0x8,
    "free_rotate": 0x10,
    "perfect_clip": 0x40,
    "impenetrable": 0x80,
    "player": 0x100,
    "edge_slide": 0x200,
    "ignore_creatures": 0x400,
    "pk": 0x800,
    "pklite": 0x1000,
}
"""Bits of OBJECTINFO's state by name (retail: ObjectInfoEnum, 04 §1.3)."""

OBJECT_STATES: Final = {
    "static": 0x1,
    "ethereal": 0x4,
    "report_collisions": 0x8,
    "ignore_collisions": 0x10,
    "missile": 0x40,
    "align_path": 0x100,
    "path_clipped": 0x200,
    "gravity": 0x400,
    "lighting_on": 0x800,
    "particle_emitter": 0x1000,
    "hidden": 0x4000,
    "has_physics_bsp": 0x10000,
    "inelastic": 0x20000,
    "report_collisions_as_environment": 0x200000,
    "edge_slide": 0x400000,
    "sledding": 0x800000,
    "frozen": 0x1000000,
}
"""Bits of an object's state by name (retail: PhysicsState, 04 1.5, 08 1.)."""

INSERT_TYPES: Final = {"transition": 0, "placement": 1, "initial_placement": 2}
"""SPHEREPATH's insert types by name (04 §1.2)."""


class Strictly(BaseModel):
    """A mapping of a case file: no other keys, no conversions between types.

    A key that may be left out is not written with null: what is not there has no key. `nullable` names the
    few where null means something else.
    """

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, populate_by_name=False)
    nullable: ClassVar[frozenset[str]] = frozenset()

    @model_validator(mode="before")
    @classmethod
    def _no_nulls(cls, data: Any) -> Any:
        for name, field in cls.model_fields.items() if isinstance(data, dict) else ():
            key = field.alias or name
            if key in data and data[key] is None and not field.is_required() and key not in cls.nullable:
                raise mistake(describe(None), "a value, or no such key", at=(key,))
        return data


def _float32(value: float) -> float:
    rounded = to_float32(value)
    if math.isinf(rounded):
        raise mistake(f"the number {value!r}", "a number that fits in a float32")
    return rounded


def _flag(value: Any) -> int:
    if isinstance(value, bool) or (isinstance(value, int) and value in (0, 1)):
        return int(value)
    raise mistake(describe(value), "true, false, 1 or 0")


def named_bits(states: Mapping[str, int]) -> Callable[[Any], int]:
    """Return what reads a list of state names as bits."""

    def read(value: Any) -> int:
        if not isinstance(value, list):
            raise mistake(describe(value), "a list of state names", "[] for none")
        bits = 0
        for index, name in enumerate(value):
            if not isinstance(name, str) or name not in states:
                hint = nearest(str(name), states)
                raise mistake(describe(name), f"one of {quoted(states)}", hint, at=(index,))
            bits |= states[name]
        return bits

    return read


def _cell_id(value: int) -> int:
    if not 0 < value <= 0xFFFF_FFFF:
        raise mistake(f"the number {value}", "a cell id from 0x00000001 to 0xFFFFFFFF")
    return value


Number: TypeAlias = Annotated[float, Strict(), AfterValidator(_float32)]
"""A float32; the unit is the field's."""
Count: TypeAlias = Annotated[int, Strict(), Field(ge=0, le=0xFFFF_FFFF)]
"""An id, an index, or how many; 32 bits."""
Vec3: TypeAlias = Annotated[tuple[Number, Number, Number], Field(strict=False)]
"""x, y, z."""
Pair: TypeAlias = Annotated[tuple[Number, Number], Field(strict=False)]
Quaternion: TypeAlias = Annotated[tuple[Number, Number, Number, Number], Field(strict=False)]
"""w, x, y, z."""
Plane: TypeAlias = Annotated[tuple[Number, Number, Number, Number], Field(strict=False)]
"""nx, ny, nz, d with n . p + d = 0."""
Sphere: TypeAlias = Annotated[tuple[Number, Number, Number, Number], Field(strict=False)]
"""x, y, z, radius in metres."""
Rows: TypeAlias = Annotated[tuple[Vec3, Vec3, Vec3], Field(strict=False)]
"""Images of the local x, y and z axis: the rows of retail's m0…m8."""
CellId: TypeAlias = Annotated[int, Strict(), AfterValidator(_cell_id)]
Flag: TypeAlias = Annotated[
    int, BeforeValidator(_flag), WithJsonSchema({"anyOf": [{"type": "boolean"}, {"enum": [0, 1]}]})
]
StateBits: TypeAlias = Annotated[
    int,
    BeforeValidator(named_bits(MOVER_STATES)),
    WithJsonSchema({"type": "array", "items": {"enum": list(MOVER_STATES)}, "uniqueItems": True}),
]
InsertType: TypeAlias = Literal["transition", "placement", "initial_placement"]
