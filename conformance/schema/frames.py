"""The models of where something is and how it is turned."""

from __future__ import annotations

from typing import Final

from pydantic import Field, model_validator

from conformance.schema.mistakes import mistake
from conformance.schema.values import CellId, Number, Quaternion, Rows, Strictly, Vec3
from conformance.source import quoted

ROTATIONS: Final = ("yaw", "quaternion", "matrix")


class FrameModel(Strictly):
    """Where something is and how it is turned: an origin and exactly one form of rotation."""

    origin: Vec3 = Field(description="Metres, in the landblock's frame.")
    yaw: Number | None = Field(None, description="Degrees about z, counter-clockwise seen from above.")
    quaternion: Quaternion | None = Field(None, description="w, x, y, z; of unit length.")
    matrix: Rows | None = Field(None, description="Images of the local x, y and z axis; rigid.")

    @model_validator(mode="after")
    def _one_rotation(self) -> FrameModel:
        given = [name for name in ROTATIONS if getattr(self, name) is not None]
        if len(given) != 1:
            found = f"the rotations {quoted(given)}" if given else "no rotation"
            raise mistake(found, f"exactly one of {quoted(ROTATIONS)}", "`yaw: 0` for no turn")
        return self


class PoseModel(FrameModel):
    """A place in the world: the cell whose landblock the origin is in, origin and rotation."""

    cell: CellId = Field(description="Cell id; its high 16 bits name the landblock.")


class PlaceModel(Strictly):
    """A place without a turn: the cell whose landblock the origin is in, and the origin."""

    cell: CellId
    origin: Vec3 = Field(description="Metres, in the landblock's frame.")
