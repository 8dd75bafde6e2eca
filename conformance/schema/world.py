"""The models of what makes a scene a world: terrain, portals and doorways, buildings, objects."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Final, Literal, TypeAlias

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    Strict,
    WithJsonSchema,
    WrapValidator,
    model_validator,
)

from conformance.schema.frames import PoseModel
from conformance.schema.geometry import GeometryModel
from conformance.schema.mistakes import mistake
from conformance.schema.primitives import OpeningModel
from conformance.schema.values import (
    OBJECT_STATES,
    CellId,
    Flag,
    Number,
    Sphere,
    Strictly,
    Vec3,
    named_bits,
)
from conformance.schema.weenies import Weenie
from conformance.source import describe, nearest, quoted

OUTDOORS: Final = "outdoors"
"""Where a portal leads that leads to no cell."""
ALL: Final = "all"
"""A stab list of every other cell of the scene."""
TERRAIN_FORMS: Final = ("flat", "formula", "heights", "map")


def _block_id(value: int) -> int:
    if not 0 <= value <= 0xFFFF:
        raise mistake(f"the number {value}", "a landblock of 16 bits, such as 0xA9B4")
    return value


def _cell_or_outdoors(value: Any, handler: Any) -> Any:
    if isinstance(value, str):
        if value != OUTDOORS:
            raise mistake(describe(value), f"a cell id, or '{OUTDOORS}'", nearest(value, [OUTDOORS]))
        return None
    return handler(value)


def _ids_or_all(value: Any, handler: Any) -> Any:
    if isinstance(value, str):
        if value != ALL:
            raise mistake(describe(value), f"'{ALL}', or a list of cell ids", nearest(value, [ALL]))
        return ALL
    return handler(value)


BlockId: TypeAlias = Annotated[int, Strict(), AfterValidator(_block_id)]
Vertex: TypeAlias = Annotated[
    tuple[Annotated[int, Field(ge=0, le=8)], Annotated[int, Field(ge=0, le=8)]], Field(strict=False)
]
"""i and j of a height point, 0 to 8."""
Rows: TypeAlias = list[list[Number]]
if TYPE_CHECKING:
    OtherCell: TypeAlias = int | None
    Stab: TypeAlias = list[int] | Literal["all"]
else:
    OtherCell = Annotated[
        CellId,
        WrapValidator(_cell_or_outdoors),
        WithJsonSchema({"anyOf": [{"type": "integer"}, {"const": OUTDOORS}]}),
    ]
    Stab = Annotated[
        list[CellId],
        WrapValidator(_ids_or_all),
        WithJsonSchema({"anyOf": [{"type": "array", "items": {"type": "integer"}}, {"const": ALL}]}),
    ]
"""`OtherCell` is a cell id, None for `OUTDOORS`; `Stab` a list of ids, or `ALL`."""
Cylsphere: TypeAlias = Annotated[tuple[Number, Number, Number, Number, Number], Field(strict=False)]
"""x, y, z of the low point, radius, height; metres."""
ObjectState: TypeAlias = Annotated[
    int,
    BeforeValidator(named_bits(OBJECT_STATES)),
    WithJsonSchema({"type": "array", "items": {"enum": list(OBJECT_STATES)}}),
]
ObjectId: TypeAlias = Annotated[int, Strict(), Field(ge=1, le=0xFFFF_FFFF)]


class AreaModel(Strictly):
    """Height points of one terrain type."""

    from_: Vertex = Field(alias="from", description="[i, j], the south-western point.")
    to: Vertex = Field(description="[i, j], the north-eastern point.")
    type: Annotated[int, Field(ge=0, le=31)] = Field(description="0 to 31; 16 to 20 are water.")

    @model_validator(mode="after")
    def _forwards(self) -> AreaModel:
        if self.from_[0] > self.to[0] or self.from_[1] > self.to[1]:
            raise mistake(f"from {list(self.from_)} to {list(self.to)}", "'from' south-west of 'to'")
        return self


class TerrainModel(Strictly):
    """The ground of some landblocks, all of them loaded."""

    blocks: Annotated[list[BlockId], Field(min_length=1)] = Field(description="Such as [0xA9B4, 0xA9B5].")
    flat: Number | None = Field(None, description="One height for all points, metres.")
    formula: str | None = Field(
        None,
        description="Height in x and y, metres in the frame of the scene's `landblock`, and the point's i"
        " and j of 0 to 8; + - * / ( ) min max abs floor.",
    )
    heights: Rows | None = Field(
        None, description="heights[i][j], i from west to east, j from south to north."
    )
    map: Rows | None = Field(None, description="Nine rows as on a map: north first, each from west to east.")
    areas: list[AreaModel] = Field(default_factory=list, description="Terrain types; later ones win.")
    side_cell_count: Literal[8, 4, 2, 1] = Field(
        8, description="Less than 8: loaded with less detail, so nobody collides with it."
    )

    @model_validator(mode="after")
    def _one_form(self) -> TerrainModel:
        given = [form for form in TERRAIN_FORMS if getattr(self, form) is not None]
        if len(given) != 1:
            raise mistake(quoted(given) or "no heights", f"exactly one of {quoted(TERRAIN_FORMS)}")
        return self


class PortalModel(Strictly):
    """One portal of a cell, as retail holds it."""

    to: OtherCell = Field(description="The cell that it leads to, or 'outdoors'.")
    polygon: Annotated[list[Vec3], Field(min_length=3)] = Field(description="Corners in cell space, metres.")
    side: Literal[0, 1] | None = Field(
        None, description="0: the polygon faces into the cell; 1: out of it. Without it: as its volume tells."
    )
    other_portal: Annotated[int, Field(ge=-0x8000, lt=0x8000)] | None = Field(
        None, description="Index of the portal that leads back; without it the first that does, or 0."
    )
    loaded: Literal[False] | None = Field(None, description="false for a cell that is not in the scene.")


class DoorwayModel(OpeningModel):
    """An opening in the first cell's room, cut on both sides, with the portals of both cells."""

    between: Annotated[
        tuple[CellId, OtherCell], Field(strict=False, description="A cell, and its neighbour or 'outdoors'.")
    ]


class BuildingPortalModel(Strictly):
    """A door of a building: a portal of the cell behind it."""

    cell: CellId
    portal: Annotated[int, Field(ge=-0x8000, lt=0x8000)] = Field(description="Its index in that cell.")


def _building_portal(value: Any, handler: Any) -> Any:
    return value if isinstance(value, int) and not isinstance(value, bool) else handler(value)


if TYPE_CHECKING:
    DoorOfBuilding: TypeAlias = BuildingPortalModel | int
else:
    DoorOfBuilding = Annotated[
        BuildingPortalModel,
        WrapValidator(_building_portal, json_schema_input_type=BuildingPortalModel | CellId),
    ]


class BuildingModel(Strictly):
    """A building: its shell outdoors and the cells behind its doors."""

    pose: PoseModel
    geometry: GeometryModel | None = Field(description="null for a building without a shell.")
    portals: list[DoorOfBuilding] = Field(
        default_factory=list, description="A cell id: all its portals that lead outdoors."
    )
    landblock: BlockId | None = Field(
        None, description="Whose file lists it; in another than its origin's retail drops the building."
    )


class PartModel(Strictly):
    """A BSP shape of an object."""

    geometry: GeometryModel | None
    pose: PoseModel | None = Field(None, description="Its own global pose; without it the object's.")
    scale: Annotated[Number, Field(gt=0)] | None = Field(None, description="Without it the object's.")
    physics: bool = Field(True, description="false: without a physics tree; the geometry gives its box.")
    drawing_sphere: Sphere | None = Field(None, description="Of a part without physics, in its own space.")
    flat: bool = Field(False, description="true: always drawn as a flat picture.")


class ObjectModel(Strictly):
    """Something that movers collide with."""

    id: ObjectId
    pose: PoseModel
    scale: Annotated[Number, Field(gt=0)] = 1.0
    state: ObjectState
    weenie: Weenie | None = Field(
        None, description="Its flags; [] for a weenie without any, nothing for an object without weenie."
    )
    parts: list[PartModel] = Field(default_factory=list)
    cylspheres: list[Cylsphere] = Field(default_factory=list)
    spheres: list[Sphere] = Field(default_factory=list)
    parent: Flag = Field(0, description="1: it hangs on another object.")
    part_array: bool = Field(True, description="false: without shapes, whatever is listed.")
    attached: list[ObjectId] = Field(default_factory=list, description="The objects that hang on it.")
    registered: list[CellId] | None = Field(
        None, description="The cells that it is tested in; without it those where retail registers it."
    )


class RestrictionModel(Strictly):
    """Cells that only some players may enter: those of a house."""

    cells: Annotated[list[CellId], Field(min_length=1)]
    admits: list[ObjectId] = Field(default_factory=list, description="The ids of those who may.")
    known: bool = Field(True, description="false: the restriction object is not there; nobody may.")
