"""The models of a case's scene: cells, a world of cells and land, or one geometry on its own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Final, TypeAlias

from pydantic import AfterValidator, Field, WrapValidator, model_validator

from conformance.schema.frames import FrameModel
from conformance.schema.geometry import GeometryModel, wrong_keys
from conformance.schema.mistakes import mistake
from conformance.schema.values import CellId, Number, Strictly
from conformance.schema.world import (
    BlockId,
    BuildingModel,
    DoorwayModel,
    ObjectModel,
    PortalModel,
    RestrictionModel,
    Stab,
    TerrainModel,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

WORLD_KEYS: Final = ("landblock", "terrain", "doorways", "buildings", "objects", "restrictions")
"""Keys of a scene that make it a world."""


class StaticModel(Strictly):
    """A static object with one BSP-shaped part, in its cell's landblock."""

    pose: FrameModel
    scale: Annotated[Number, Field(gt=0)] = Field(description="Uniform scale of the part.")
    geometry: GeometryModel


def _id_or_portal(value: Any, handler: Any) -> Any:
    """Let an id stand as it is: in a scene of cells it is all that is known of a portal."""
    return value if isinstance(value, int) and not isinstance(value, bool) else handler(value)


if TYPE_CHECKING:
    CellPortal: TypeAlias = PortalModel | int
else:
    CellPortal = Annotated[
        PortalModel, WrapValidator(_id_or_portal, json_schema_input_type=PortalModel | CellId)
    ]


class CellModel(Strictly):
    """An interior cell."""

    id: CellId = Field(description="Such as 0xA9B40151.")
    pose: FrameModel
    geometry: GeometryModel | None = Field(description="null for a cell without collision geometry.")
    statics: list[StaticModel] = Field(default_factory=list, description="Not in a world: `objects` there.")
    portals: list[CellPortal] = Field(
        default_factory=list,
        description="The cells its portals lead to; in a world each with its polygon.",
    )
    stab: Stab = Field(default_factory=list, description="The cells seen from it: a list, or 'all'.")
    portal_array: bool = Field(True, description="false: the missing array, with which no point is in it.")

    @property
    def placed_portals(self) -> list[PortalModel]:
        """The portals that have a polygon."""
        return [portal for portal in self.portals if isinstance(portal, PortalModel)]


def _check_ids(cells: list[CellModel]) -> list[CellModel]:
    ids = [cell.id for cell in cells]
    for index, cell in enumerate(cells):
        if cell.id in ids[:index]:
            raise mistake(f"the cell id 0x{cell.id:08X} again", "each cell once", at=(index, "id"))
        for place, other, loaded in _neighbours(cell):
            if other is not None and (other in ids) is not loaded:
                if loaded:
                    expected = "a cell of this scene"
                    hint = "" if place[-1] != "to" else "`loaded: false` for a cell that is not loaded"
                    raise mistake(f"a portal to 0x{other:08X}", expected, hint, at=(index, *place))
                found = f"0x{other:08X} with 'loaded: false'"
                raise mistake(found, "a cell that is not in this scene", at=(index, *place))
    return cells


def _neighbours(cell: CellModel) -> Iterator[tuple[tuple[str | int, ...], int | None, bool]]:
    """Yield where the cell of each portal is named, which it is, and whether it should be there."""
    for number, portal in enumerate(cell.portals):
        if isinstance(portal, PortalModel):
            yield ("portals", number, "to"), portal.to, portal.loaded is None
        else:
            yield ("portals", number), portal, True


class SceneModel(Strictly):
    """What a query runs in: cells for movement, a world, or a single geometry for polygons and trees."""

    cells: Annotated[list[CellModel], Field(min_length=1), AfterValidator(_check_ids)] | None = None
    geometry: GeometryModel | None = None
    landblock: BlockId | None = Field(None, description="The landblock in whose frame formulas are written.")
    terrain: list[TerrainModel] = Field(default_factory=list)
    doorways: list[DoorwayModel] = Field(default_factory=list)
    buildings: list[BuildingModel] = Field(default_factory=list)
    objects: list[ObjectModel] = Field(
        default_factory=list, description="In the order in which they are registered, so tested."
    )
    restrictions: list[RestrictionModel] = Field(default_factory=list)

    @property
    def is_world(self) -> bool:
        """Whether it is more than cells whose portals are only named."""
        if self.model_fields_set & {*WORLD_KEYS}:
            return True
        return any(cell.placed_portals or "stab" in cell.model_fields_set for cell in self.cells or ())

    @staticmethod
    def is_world_data(scene: dict[str, Any]) -> bool:
        """Tell the same of data that may have mistakes."""
        cells = scene.get("cells")
        listed = [cell for cell in cells if isinstance(cell, dict)] if isinstance(cells, list) else []
        portals = [cell["portals"] for cell in listed if isinstance(cell.get("portals"), list)]
        placed = any(isinstance(portal, dict) for some in portals for portal in some)
        return placed or bool({*scene} & {*WORLD_KEYS}) or any("stab" in cell for cell in listed)

    @model_validator(mode="after")
    def _one_kind(self) -> SceneModel:
        given = self.model_fields_set
        if "geometry" in given and len(given) > 1:
            raise wrong_keys(self, "either 'geometry' or the others")
        if not given & {"geometry", "cells", "terrain"}:
            raise wrong_keys(self, "'cells', 'terrain', both, or 'geometry'")
        return self

    @model_validator(mode="after")
    def _formulas_have_a_frame(self) -> SceneModel:
        for index, terrain in enumerate(self.terrain):
            if terrain.formula is not None and self.landblock is None:
                where = ("terrain", index, "formula")
                raise mistake("a formula", "'landblock' in the scene, whose frame x and y are in", at=where)
        return self

    @model_validator(mode="after")
    def _cells_of_a_world(self) -> SceneModel:
        if not self.is_world:
            return self
        for index, cell in enumerate(self.cells or ()):
            at = ("cells", index)
            if cell.portals and not cell.portal_array:
                raise mistake(
                    "portals in no array", "'portals', or 'portal_array: false'", at=(*at, "portals")
                )
            if cell.statics:
                raise mistake("'statics' in a world", "'objects' of the scene", at=(*at, "statics"))
            for number, portal in enumerate(cell.portals):
                if not isinstance(portal, PortalModel):
                    where = (*at, "portals", number)
                    found = f"a portal to 0x{portal:08X} without a polygon"
                    raise mistake(found, "'to' and 'polygon' in a world, or a doorway", at=where)
        return self
