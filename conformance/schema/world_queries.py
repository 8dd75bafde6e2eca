"""The queries of part 2 of FORMAT.md: objects, land, cell lists, coordinates of the map; keys as there."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, TypeAlias

from pydantic import Field

from conformance.schema.frames import PlaceModel, PoseModel
from conformance.schema.movement_queries import CallQuery, MoverQuery
from conformance.schema.mover import SeedModel
from conformance.schema.query_base import Needs, QueryModel
from conformance.schema.values import CellId, Flag, Number, Plane, Sphere, Vec3
from conformance.schema.world import BlockId, ObjectModel, Rows

AnyId: TypeAlias = Annotated[int, Field(ge=0, le=0xFFFF_FFFF)]
"""Any 32 bits, also those that are no cell's."""
Coordinate: TypeAlias = Annotated[int, Field(ge=-0x8000_0000, le=0x7FFF_FFFF)]
Spheres: TypeAlias = Annotated[list[Sphere], Field(max_length=2)]
"""None to two spheres in the frame of the position's landblock."""


class ObjectCallQuery(CallQuery):
    """One collision call on the scene's objects, in the scene's only cell."""

    needs: ClassVar[Needs] = "cells"
    op: Literal["object_call"]
    function: Literal["sphere", "cylsphere", "object", "cell_objects", "cell"]
    is_creature: Flag | None = None


class ObjectTransitionQuery(MoverQuery):
    """One find_valid_position among the scene's objects, in the scene's only cell."""

    needs: ClassVar[Needs] = "cells"
    op: Literal["object_transition"]
    from_: PoseModel | None = Field(alias="from", description="null for a placement.")
    to: PoseModel
    seed: SeedModel = SeedModel()
    placement_allows_sliding: Flag = 1


class CheckCollisionsQuery(MoverQuery):
    """Whether the mover, where it is, overlaps the first of the scene's objects."""

    needs: ClassVar[Needs] = "cells"
    op: Literal["check_collisions"]
    from_: PoseModel = Field(alias="from", description="Where the mover is.")


class TimeOfCollisionQuery(QueryModel):
    """When two spheres touch."""

    op: Literal["find_time_of_collision"]
    movement: Vec3
    disp: Vec3
    radsum: Number


class LandCollisionsQuery(CallQuery):
    """The terrain of one land cell, called alone."""

    needs: ClassVar[Needs] = "terrain"
    op: Literal["land_find_env_collisions"]
    cell: CellId


class ValidateWalkableQuery(CallQuery):
    """A sphere against a plane of the ground."""

    needs: ClassVar[Needs] = "terrain"
    op: Literal["land_validate_walkable"]
    cell: CellId
    sphere: Sphere
    plane: Plane
    is_water: Flag
    water_depth: Number


class SceneQuery(QueryModel):
    """A query of a world without a mover."""

    needs: ClassVar[Needs] = "scene"


class CellPointQuery(SceneQuery):
    """Ask a cell about a point in the frame of its landblock; a land cell also for triangle and water."""

    op: Literal["point_in_cell", "land_find_terrain_poly"]
    cell: CellId
    point: Vec3


class OutsideCellsQuery(SceneQuery):
    """List the land cells that spheres touch."""

    op: Literal["add_all_outside_cells"]
    position: PlaceModel
    spheres: Spheres


class CellListQuery(SceneQuery):
    """List the cells that spheres touch, and choose the one they are in."""

    op: Literal["find_cell_list"]
    position: PlaceModel
    spheres: Spheres
    do_not_load: Flag = 0
    without_path: Flag = Field(0, description="1: no path is told of interior cells.")


class TransitCellsQuery(SceneQuery):
    """List the cells that spheres reach from one cell."""

    op: Literal["find_transit_cells"]
    cell: CellId
    position: PlaceModel
    spheres: Spheres
    array: list[CellId] | None = Field(None, description="Cells that are listed already.")


class BuildingTransitQuery(SceneQuery):
    """Ask whether spheres reach an interior cell through a building's door."""

    op: Literal["check_building_transit"]
    cell: CellId
    portal_id: Annotated[int, Field(ge=-0x8000, lt=0x8000)]
    position: PlaceModel
    spheres: Spheres


class CrossCellsQuery(SceneQuery):
    """List the cells that an object is registered in."""

    op: Literal["cross_cells"]
    object: ObjectModel
    static: Flag
    sorting_sphere: Sphere | None = None


class TerrainBlockQuery(QueryModel):
    """Construct a landblock of the scene: cuts, planes, water."""

    needs: ClassVar[Needs] = "terrain"
    op: Literal["terrain_block"]
    block: BlockId
    heights_again: Rows | None = Field(
        None, description="heights[i][j] with which it is constructed a second time."
    )


class TerrainSplitQuery(QueryModel):
    """Cut the cells of a landblock."""

    op: Literal["terrain_split"]
    block: BlockId


class CellIdQuery(QueryModel):
    """Read an id."""

    op: Literal["landdefs_gid_to_lcoord", "landdefs_blockid_to_lcoord", "landdefs_inbound_valid_cellid"]
    cell: AnyId


class LcoordQuery(QueryModel):
    """Make an id of map coordinates."""

    op: Literal["landdefs_lcoord_to_gid"]
    x: Coordinate
    y: Coordinate


class OutsidePointQuery(QueryModel):
    """Find the land cell of a point."""

    op: Literal["landdefs_get_outside_lcoord", "landdefs_adjust_to_outside"]
    cell: AnyId
    point: Vec3


class MapOffsetQuery(QueryModel):
    """The offset between the landblocks of two ids."""

    op: Literal["landdefs_get_block_offset"]
    from_cell: AnyId
    to_cell: AnyId
