"""The models of the primitives a scene is written with; the shapes are made in `conformance.scenes`."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from conformance.schema.mistakes import mistake
from conformance.schema.values import Number, Pair, Strictly, Vec3
from conformance.source import quoted

Length = Annotated[Number, Field(gt=0)]
Size2 = Annotated[tuple[Length, Length], Field(strict=False)]
Size3 = Annotated[tuple[Length, Length, Length], Field(strict=False)]
MAX_TILES = 64
"""Most tiles of a floor in one direction: 4096 in all."""
MAX_STEPS = 1000
"""Most steps of a staircase."""
MAX_SIDES = 255
"""Most sides of a pillar, whose caps have as many corners: they are counted in a byte (02, 0)."""
Tile = Annotated[int, Field(ge=1, le=MAX_TILES)]
Tiles = Annotated[tuple[Tile, Tile], Field(strict=False)]
Corners = Annotated[list[Vec3], Field(min_length=1)]

PLACEMENT = ("at", "yaw")


class PlacedModel(Strictly):
    """A primitive, where it is made or turned by `yaw` degrees and then moved to `at`."""

    at: Vec3 | None = Field(None, description="Metres to move by, after the turn; with 'yaw'.")
    yaw: Number | None = Field(None, description="Degrees about z, counter-clockwise from above; with 'at'.")

    @model_validator(mode="after")
    def _placed_wholly(self) -> PlacedModel:
        if (self.at is None) != (self.yaw is None):
            raise mistake(
                f"only {quoted(set(PLACEMENT) & self.model_fields_set)}", "both 'at' and 'yaw', or none"
            )
        return self

    def parameters(self) -> dict[str, Any]:
        """Return what the file gives, but for the placement, as the primitive's keyword arguments."""
        return {name: getattr(self, name) for name in self.model_fields_set - {*PLACEMENT}}


class OpeningModel(Strictly):
    """An opening in a side of a room."""

    side: Literal["north", "south", "east", "west", "floor", "ceiling"]
    width: Length
    height: Length
    offset: Number = 0.0
    sill: Number = 0.0


class FloorModel(PlacedModel):
    """A rectangle at z = 0 that faces up, centred on the z axis."""

    size: Size2
    tiles: Tiles = (1, 1)


class CeilingModel(PlacedModel):
    """A rectangle that faces down at z = height."""

    size: Size2
    height: Number
    tiles: Tiles = (1, 1)


class WallModel(PlacedModel):
    """A wall along x in the plane y = 0 that faces +y."""

    length: Length
    height: Length


class DoorwayModel(PlacedModel):
    """A wall with an opening; with a thickness it has both faces and the reveal."""

    length: Length
    height: Length
    door_width: Length
    door_height: Length
    offset: Number = 0.0
    sill: Number = 0.0
    thickness: Number = 0.0


class RoomModel(PlacedModel):
    """A closed box that faces inwards, floor at z = 0, centred on the z axis."""

    size: Size3
    openings: list[OpeningModel] = Field(default_factory=list)


class BoxModel(PlacedModel):
    """A solid box that faces outwards, base at z = 0, centred on the z axis."""

    size: Size3


class PillarModel(PlacedModel):
    """A regular prism that faces outwards, base at z = 0."""

    radius: Length
    height: Length
    sides: Annotated[int, Field(ge=3, le=MAX_SIDES)] = 8
    capped: bool = True


class RampModel(PlacedModel):
    """A slope that climbs along +y from the origin: one of degrees, rise or normal_z."""

    width: Length
    run: Length
    degrees: Number | None = None
    rise: Number | None = None
    normal_z: Number | None = None
    solid: bool = False

    @model_validator(mode="after")
    def _one_slope(self) -> RampModel:
        given = [name for name in ("degrees", "rise", "normal_z") if getattr(self, name) is not None]
        if len(given) != 1:
            raise mistake(quoted(given) or "no slope", "exactly one of 'degrees', 'rise', 'normal_z'")
        return self


class StairsModel(PlacedModel):
    """Steps that climb along +y from the origin; rise and run are those of one step."""

    width: Length
    rise: Length
    run: Length
    count: Annotated[int, Field(ge=1, le=MAX_STEPS)]
    solid: bool = False


class HatchModel(PlacedModel):
    """A floor with a rectangular hole; with a depth the hole has a shaft."""

    size: Size2
    hole: Size2
    middle: Pair = (0.0, 0.0)
    depth: Annotated[Number, Field(ge=0)] = 0.0


class ShapeModel(Strictly):
    """One primitive: its name and its parameters."""

    floor: FloorModel | None = None
    ceiling: CeilingModel | None = None
    wall: WallModel | None = None
    doorway: DoorwayModel | None = None
    room: RoomModel | None = None
    box: BoxModel | None = None
    pillar: PillarModel | None = None
    ramp: RampModel | None = None
    stairs: StairsModel | None = None
    hatch: HatchModel | None = None
    polygons: Annotated[list[Corners], Field(min_length=1)] | None = Field(
        None, description="Corner points of each polygon, counter-clockwise from its front."
    )

    @model_validator(mode="after")
    def _one_primitive(self) -> ShapeModel:
        if len(self.model_fields_set) != 1:
            raise mistake(f"the primitives {quoted(self.model_fields_set)}", "one primitive an item")
        return self

    @property
    def name(self) -> str:
        """Name of the primitive that the file gives."""
        return next(iter(self.model_fields_set))
