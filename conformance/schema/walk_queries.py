"""The queries about walks: what moves, from where, and tick by tick how."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar, Final, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema, model_validator

from conformance.effort import MAX_TICKS
from conformance.schema.frames import PoseModel
from conformance.schema.mistakes import mistake
from conformance.schema.movement_queries import MoverQuery
from conformance.schema.mover import SeededPlaneModel, Spheres
from conformance.schema.query_base import Needs, QueryModel
from conformance.schema.values import OBJECT_STATES, Count, Flag, Number, Pair, Strictly, Vec3, named_bits
from conformance.schema.weenies import Weenie
from conformance.source import quoted

if TYPE_CHECKING:
    from collections.abc import Sequence

TRANSIENT_STATES: Final = {"contact": 0x1, "on_walkable": 0x2, "sliding": 0x4, "active": 0x80}
"""Bits of a body's transient state by name (04 1.4); the others are retail's own bookkeeping."""

Times = Annotated[int, Field(strict=True, ge=1)]
Positive = Annotated[Number, Field(gt=0)]


class SegmentModel(Strictly):
    """One way of moving, held for a number of ticks."""

    ways: ClassVar[tuple[str, ...]]
    pace: ClassVar[str]
    """The key that says how fast `toward` goes."""

    toward: Pair | None = Field(None, description="A point [x, y]: level, from where the ticks before lead.")
    still: Times | None = Field(None, description="This many ticks without any input.")
    times: Times | None = Field(None, description="How many ticks; 1 without it.")

    @model_validator(mode="after")
    def _one_way(self) -> SegmentModel:
        given = [key for key in self.ways if getattr(self, key) is not None]
        if len(given) != 1:
            raise mistake(quoted(given) or "no way to move", f"exactly one of {quoted(self.ways)}")
        if (self.toward is None) != (getattr(self, self.pace) is None):
            raise mistake(quoted(self.model_fields_set), f"'toward' and '{self.pace}' together")
        if self.still is not None and self.times is not None:
            raise mistake("both 'still' and 'times'", "'still' with the number of ticks")
        return self

    @property
    def count(self) -> int:
        """How many ticks it is."""
        return self.still or self.times or 1


class MoveModel(SegmentModel):
    """A recorded move: where the tick's target is, from where the mover stands."""

    ways: ClassVar = ("move", "toward", "still")
    pace: ClassVar = "stride"

    move: Vec3 | None = Field(None, description="Metres, in the landblock's frame.")
    stride: Positive | None = Field(None, description="Metres a tick toward the point.")
    yaw: Number | None = Field(None, description="Degrees that the mover faces; without it as before.")
    contact_ok: Flag = Field(1, description="0 to leave the ground.")


class InputModel(SegmentModel):
    """A held input: the velocity that a body is set to in every tick."""

    ways: ClassVar = ("velocity", "local_velocity", "toward", "still")
    pace: ClassVar = "speed"

    velocity: Vec3 | None = Field(None, description="m/s, in the landblock's frame.")
    local_velocity: Vec3 | None = Field(None, description="m/s, in the body's own frame.")
    speed: Positive | None = Field(None, description="m/s toward the point.")
    omega: Vec3 | None = Field(None, description="Rotation that is set in every tick, rad/s.")
    quantum: Positive | None = Field(None, description="Seconds of each tick; without it the query's.")


def _check_ticks(segments: Sequence[SegmentModel]) -> None:
    total = sum(segment.count for segment in segments)
    if total > MAX_TICKS:
        raise mistake(f"{total} ticks", f"at most {MAX_TICKS}", at=("ticks",))


class WalkQuery(MoverQuery):
    """Recorded moves, one transition after the other."""

    needs: ClassVar[Needs] = "scene"
    op: Literal["walk"]
    start: PoseModel
    ticks: Annotated[list[MoveModel], Field(min_length=1)]

    @model_validator(mode="after")
    def _few_ticks(self) -> WalkQuery:
        _check_ticks(self.ticks)
        return self


class BodyModel(Strictly):
    """An object that moves by itself."""

    spheres: Spheres
    state: Annotated[
        int,
        BeforeValidator(named_bits(OBJECT_STATES)),
        WithJsonSchema({"type": "array", "items": {"enum": list(OBJECT_STATES)}}),
    ]
    transient_state: Annotated[
        int,
        BeforeValidator(named_bits(TRANSIENT_STATES)),
        WithJsonSchema({"type": "array", "items": {"enum": list(TRANSIENT_STATES)}}),
    ]
    scale: Positive = 1.0
    step_up_height: Number = Field(0.6, validate_default=True)
    step_down_height: Number = Field(1.5, validate_default=True)
    velocity: Vec3 | None = None
    acceleration: Vec3 | None = Field(None, description="Gravity for a body that starts in the air.")
    friction: Number | None = None
    elasticity: Number | None = None
    movement_manager: Flag = Field(0, description="1: standing still never deactivates the body.")
    contact: SeededPlaneModel | None = Field(None, description="The plane that it stands on.")
    id: Count | None = Field(None, description="Its object id, by which a house admits it.")
    weenie: Weenie | None = Field(None, description="Its flags; nothing for a body without game object.")


class BodyWalkQuery(QueryModel):
    """A body that moves by itself: gravity, friction, transitions, bounces."""

    needs: ClassVar[Needs] = "scene"
    op: Literal["body_walk"]
    body: BodyModel
    start: PoseModel
    quantum: Positive = Field(description="Seconds of a tick.")
    ticks: Annotated[list[InputModel], Field(min_length=1)]

    @model_validator(mode="after")
    def _few_ticks(self) -> BodyWalkQuery:
        _check_ticks(self.ticks)
        return self
