"""The models of what is pinned otherwise than by a field's value alone: free numbers, ticks of walks."""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator, ConfigDict, Field, model_validator

from conformance.schema.mistakes import mistake
from conformance.schema.values import Count, Number, Strictly
from conformance.source import quoted

FREEDOM = frozenset({"value", "tolerance", "unit", "inclusive", "reason"})


class FreeNumberModel(Strictly):
    """A number with a tolerance, its exact float32 bits, or both."""

    value: Number | None = None
    tolerance: Annotated[float, Field(gt=0)] | None = None
    unit: str | None = Field(None, min_length=1, description="The field's own unit (m), or ulp.")
    inclusive: bool | None = None
    reason: str | None = Field(None, min_length=1)
    bits: Annotated[int, Field(ge=0, le=0xFFFF_FFFF)] | None = None

    @model_validator(mode="after")
    def _whole(self) -> FreeNumberModel:
        given = self.model_fields_set - {"bits"}
        if given != FREEDOM and (given or self.bits is None):
            expected = f"{quoted(sorted(FREEDOM))} together, or 'bits'"
            raise mistake(f"only {quoted(sorted(self.model_fields_set))}", expected)
        return self


class StepModel(Strictly):
    """Fields of a tick; which there are, and what they take, is checked where they are read."""

    model_config = ConfigDict(extra="allow")

    @model_validator(mode="after")
    def _pins_something(self) -> StepModel:
        if not self.model_extra:
            raise mistake("no field", "at least one field of a tick, such as 'on_walkable'")
        return self


class AtModel(StepModel):
    """What is known at one tick."""

    tick: Count = Field(description="Index of the tick, from 0.")


class AlwaysModel(StepModel):
    """What is known at every tick of a walk, or of a part of it."""

    from_: Count = Field(0, alias="from", description="The first tick.")
    to: Count | None = Field(None, description="The last tick; without it the walk's last.")

    @model_validator(mode="after")
    def _forwards(self) -> AlwaysModel:
        if self.to is not None and self.to < self.from_:
            raise mistake(f"from {self.from_} to {self.to}", "a part of the walk that does not end before")
        return self


def _listed(value: Any) -> Any:
    return [value] if isinstance(value, dict) else value


Always: TypeAlias = Annotated[list[AlwaysModel], Field(min_length=1), BeforeValidator(_listed)]


class WalkExpectModel(Strictly):
    """What is pinned of a walk: single ticks, and invariants."""

    at: list[AtModel] = Field(default_factory=list)
    always: Always = Field(default_factory=list)
