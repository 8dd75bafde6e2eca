"""The models of a case's scene: cells with pose, geometry and statics, or one geometry on its own."""

from __future__ import annotations

from typing import Annotated, Any, Final, Literal

from pydantic import AfterValidator, Field, model_validator

from conformance.schema.mistakes import mistake
from conformance.schema.primitives import ShapeModel
from conformance.schema.values import CellId, Number, Plane, Quaternion, Rows, Strictly, Vec3
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


class ContainsModel(Strictly):
    """The volume of a cell, as the planes of its cell BSP: a box, or the planes themselves."""

    low: Vec3 | None = Field(None, description="Lowest corner of a box, cell-local metres.")
    high: Vec3 | None = Field(None, description="Highest corner of a box, cell-local metres.")
    planes: Annotated[list[Plane], Field(min_length=1)] | None = Field(
        None, description="Inward-facing planes, outermost first."
    )

    @model_validator(mode="after")
    def _box_or_planes(self) -> ContainsModel:
        if self.model_fields_set not in ({"low", "high"}, {"planes"}):
            raise _wrong_keys(self, "'low' and 'high', or 'planes'")
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
            raise _wrong_keys(self, "'shapes' and 'tree', or 'record'")
        if self.record is not None and self.contains is not None:
            raise mistake("'contains' beside 'record'", "'cell_bsp' inside the record")
        return self


class StaticModel(Strictly):
    """A static object with one BSP-shaped part, in its cell's landblock."""

    pose: FrameModel
    scale: Annotated[Number, Field(gt=0)] = Field(description="Uniform scale of the part.")
    geometry: GeometryModel


class CellModel(Strictly):
    """An environment cell."""

    id: CellId = Field(description="Such as 0xA9B40151.")
    pose: FrameModel
    geometry: GeometryModel | None = Field(description="null for a cell without collision geometry.")
    statics: list[StaticModel] = Field(default_factory=list)
    portals: list[CellId] = Field(default_factory=list, description="The cells its portals lead to.")


def _check_ids(cells: list[CellModel]) -> list[CellModel]:
    ids = [cell.id for cell in cells]
    for index, cell in enumerate(cells):
        if cell.id in ids[:index]:
            raise mistake(f"the cell id 0x{cell.id:08X} again", "each cell once", at=(index, "id"))
        for number, portal in enumerate(cell.portals):
            if portal not in ids:
                where = (index, "portals", number)
                raise mistake(f"a portal to 0x{portal:08X}", "a cell of this scene", at=where)
    return cells


class SceneModel(Strictly):
    """What a query runs in: cells for movement, a single geometry for polygons and trees."""

    cells: Annotated[list[CellModel], Field(min_length=1), AfterValidator(_check_ids)] | None = None
    geometry: GeometryModel | None = None

    @model_validator(mode="after")
    def _cells_or_geometry(self) -> SceneModel:
        if len(self.model_fields_set) != 1:
            raise _wrong_keys(self, "either 'cells' or 'geometry'")
        return self


def _wrong_keys(model: Strictly, expected: str) -> Exception:
    given = [name for name in type(model).model_fields if name in model.model_fields_set]
    return mistake(f"the keys {quoted(given)}" if given else "no key", expected)
