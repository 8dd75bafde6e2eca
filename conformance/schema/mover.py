"""The models of what moves, what it remembers, and the flags of its path."""

from __future__ import annotations

from typing import Annotated, Any, Final, Literal, TypeAlias

from pydantic import BeforeValidator, Field

from conformance.schema.mistakes import mistake
from conformance.schema.values import (
    CellId,
    Count,
    Flag,
    InsertType,
    Number,
    Plane,
    Sphere,
    StateBits,
    Strictly,
    Vec3,
)
from conformance.source import describe, nearest, quoted

MOVER_PRESETS: Final = {
    "one-sphere": ((0.0, 0.0, 0.0, 0.48),),
    "two-spheres": ((0.0, 0.0, 0.475, 0.48), (0.0, 0.0, 1.35, 0.48)),
}
"""Spheres by preset: a single one about the object's origin, and the two of a human (metres)."""


def _spheres(value: Any) -> Any:
    if not isinstance(value, str):
        return value
    if value not in MOVER_PRESETS:
        expected = f"one of {quoted(MOVER_PRESETS)}, or a list of spheres"
        raise mistake(describe(value), expected, nearest(value, MOVER_PRESETS))
    return [*MOVER_PRESETS[value]]


Spheres: TypeAlias = Annotated[
    list[Sphere],
    Field(
        min_length=1,
        max_length=2,
        description="'one-sphere', 'two-spheres', or one or two [x, y, z, radius].",
    ),
    BeforeValidator(_spheres),
]
"""What of a mover collides, in object space, metres."""


class MoverModel(Strictly):
    """What moves: its spheres in object space, its state, its step heights in metres."""

    spheres: Spheres
    state: StateBits
    scale: Annotated[Number, Field(gt=0)] = 1.0
    step_up_height: Number = Field(0.6, validate_default=True)
    step_down_height: Number = Field(1.5, validate_default=True)
    ethereal: Flag = 0
    step_down: Flag = Field(1, description="0 for a missile, which never looks for ground.")
    gravity: Flag = 1
    id: Count | None = Field(None, description="Its own object id; an object with that id is not tested.")
    missile: Flag | None = None
    target_id: Count | None = Field(None, description="The object that a missile is aimed at.")
    weenie: list[Literal["bypass"]] | None = Field(
        None, description="Its game object, with 'bypass' above house restrictions; nothing without one."
    )


class SeededPlaneModel(Strictly):
    """A contact plane that a query starts with."""

    plane: Plane
    cell: CellId
    is_water: Flag


class SeedModel(Strictly):
    """What the mover remembers from before."""

    contact: SeededPlaneModel | None = None
    last_known: SeededPlaneModel | None = None
    sliding: Vec3 | None = None
    frames_stationary_fall: Count | None = None


class PathModel(Strictly):
    """Fields of SPHEREPATH set before a call; as in FORMAT.md a missing one is 0."""

    insert_type: InsertType = "transition"
    step_down: Flag = 0
    step_down_amt: Number = Field(0.0, description="Metres.")
    walk_interp: Number = 0.0
    walkable_allowance: Number = Field(0.0, description="Smallest normal z of a walkable.")
    check_walkable: Flag = 0
    collide: Flag = 0
    obstruction_ethereal: Flag = 0
    bldg_check: Flag = 0
    hits_interior_cell: Flag = 0
