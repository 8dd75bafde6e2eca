"""The model of collision geometry: primitives with the style of their tree, or a whole record."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from conformance.schema.mistakes import mistake
from conformance.schema.primitives import RoomModel, ShapeModel
from conformance.schema.values import Plane, Strictly, Vec3
from conformance.source import quoted

VOLUMES = ({"room"}, {"low", "high"}, {"planes"})
"""The ways to give the volume of a cell."""


class ContainsModel(Strictly):
    """The volume of a cell, as the planes of its cell BSP: its room's, a box, or the planes themselves."""

    room: Literal[True] | None = Field(None, description="The box of the geometry's first room.")
    low: Vec3 | None = Field(None, description="Lowest corner of a box, cell-local metres.")
    high: Vec3 | None = Field(None, description="Highest corner of a box, cell-local metres.")
    planes: Annotated[list[Plane], Field(min_length=1)] | None = Field(
        None, description="Inward-facing planes, outermost first."
    )

    @model_validator(mode="after")
    def _one_volume(self) -> ContainsModel:
        if self.model_fields_set not in VOLUMES:
            raise wrong_keys(self, "'room', 'low' and 'high', or 'planes'")
        return self


class GeometryModel(Strictly):
    """Collision geometry: shapes for the tree builder, or a whole record with its own tree."""

    shapes: Annotated[list[ShapeModel], Field(min_length=1)] | None = Field(
        None, description="Primitives; their polygons are numbered in this order, from 0."
    )
    tree: Literal["front", "behind", "both"] | None = Field(
        None, description="Which BSP leaf holds a polygon: the one before it, behind it, or both."
    )
    contains: ContainsModel | None = Field(None, description="Volume of a cell; without it, everything.")
    record: dict[str, Any] | None = Field(None, description="A line of a geometry file (FORMAT.md).")

    @model_validator(mode="after")
    def _shapes_or_record(self) -> GeometryModel:
        if self.model_fields_set - {"contains"} not in ({"shapes", "tree"}, {"record"}):
            raise wrong_keys(self, "'shapes' and 'tree', or 'record'")
        if self.record is not None and self.contains is not None:
            raise mistake("'contains' beside 'record'", "'cell_bsp' inside the record")
        if self.contains is not None and self.contains.room and self.room is None:
            raise mistake("no room among the shapes", "'low' and 'high', or 'planes'", at=("contains",))
        return self

    @property
    def room(self) -> RoomModel | None:
        """The first room among the shapes."""
        return next((shape.room for shape in self.shapes or () if shape.room is not None), None)

    def with_room(self, room: RoomModel) -> GeometryModel:
        """Return the geometry with another first room."""
        shapes = list(self.shapes or ())
        index = next(index for index, shape in enumerate(shapes) if shape.room is not None)
        shapes[index] = shapes[index].model_copy(update={"room": room})
        return self.model_copy(update={"shapes": shapes})


def wrong_keys(model: Strictly, expected: str) -> Exception:
    """Return the mistake that a model has not the keys that belong together."""
    given = [name for name in type(model).model_fields if name in model.model_fields_set]
    return mistake(f"the keys {quoted(given)}" if given else "no key", expected)
