"""Checks that what a query names is there: polygons of its geometry, cells and landblocks of its scene."""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance.scenes.world_model import SIDE_CELLS, is_interior
from conformance.schema.geometry_queries import BspAdjustToPlaneQuery, PolygonQuery
from conformance.schema.movement_queries import TransitionQuery
from conformance.schema.own_queries import (
    EntryQuery,
    PlaceBodyQuery,
    TransitionalPositionQuery,
    VisibleChildQuery,
)
from conformance.schema.walk_queries import BodyWalkQuery, WalkQuery
from conformance.schema.world_queries import (
    BuildingTransitQuery,
    CellPointQuery,
    LandCollisionsQuery,
    TransitCellsQuery,
    ValidateWalkableQuery,
)
from conformance.source import Fault

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from conformance.scenes.model import Geometry
    from conformance.schema.case import CaseModel
    from conformance.schema.scene import SceneModel
    from conformance.source import DocPath

LAND_CELLS = range(0x1, 0x41)
"""Low words of land cells (10 1.)."""
_OF_A_CELL = (
    CellPointQuery,
    LandCollisionsQuery,
    ValidateWalkableQuery,
    TransitCellsQuery,
    BuildingTransitQuery,
    EntryQuery,
    VisibleChildQuery,
)


def check_references(case: CaseModel, geometries: Mapping[str, Geometry]) -> Iterator[Fault]:
    """Yield the references of a case's query that lead nowhere."""
    query, scene = case.query, case.scene
    if isinstance(query, PolygonQuery | BspAdjustToPlaneQuery) and geometries:
        count = len(next(iter(geometries.values())).polygons)
        if query.poly >= count:
            expected = f"the index of one of its {count} polygons"
            yield Fault(("query", "poly"), f"the number {query.poly}", expected)
    if scene is None:
        return
    for path, cell in _named_cells(query, scene):
        if not is_loaded(cell, scene):
            yield Fault(path, f"the cell 0x{cell:08X}", f"a cell of the scene: {known_cells(scene)}")


def is_loaded(cell: int, scene: SceneModel) -> bool:
    """Tell whether a scene has a cell, interior or of its land."""
    if is_interior(cell):
        return any(one.id == cell for one in scene.cells or ())
    return (cell >> 16 in _detailed_blocks(scene) and cell & 0xFFFF in LAND_CELLS) or any(
        one.id == cell for one in scene.cells or ()
    )


def _named_cells(query: object, scene: SceneModel) -> Iterator[tuple[DocPath, int]]:
    """Yield the cells that must be loaded for a query to have an answer, and where they are named."""
    match query:
        case TransitionQuery(begin_cell=int() as cell):
            yield ("query", "begin_cell"), cell
        case TransitionQuery() if scene.is_world:
            begin, key = (query.to, "to") if query.from_ is None else (query.from_, "from")
            yield ("query", key, "cell"), begin.cell
        case WalkQuery() | BodyWalkQuery():
            yield ("query", "start", "cell"), query.start.cell
        case TransitionalPositionQuery():
            yield ("query", "from", "cell"), query.from_.cell
        case PlaceBodyQuery(cell=int() as cell):
            yield ("query", "cell"), cell
        case _ if isinstance(query, _OF_A_CELL):
            yield ("query", "cell"), query.cell


def known_cells(scene: SceneModel) -> str:
    """Name the cells of a scene for a message."""
    cells = [f"0x{cell.id:08X}" for cell in scene.cells or ()]
    blocks = [f"0x{block:04X}0001 to 0040" for block in _detailed_blocks(scene)]
    return ", ".join([*cells, *blocks])


def _detailed_blocks(scene: SceneModel) -> list[int]:
    """List the landblocks whose land has all of its cells."""
    detailed = (terrain for terrain in scene.terrain if terrain.side_cell_count == SIDE_CELLS)
    return [block for terrain in detailed for block in terrain.blocks]
