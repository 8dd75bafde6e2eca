"""The inputs that a case's world gives: the WORLD block, or the cell and objects of an object call."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from conformance.case_registration import shadow_lists
from conformance.case_world import WorldMaker
from conformance.scenes.terrain import table_heights
from conformance.scenes.validate_objects import object_errors, single_object_errors
from conformance.scenes.world_model import World
from conformance.schema.own_queries import (
    EntryQuery,
    PlaceBodyQuery,
    RegistrationQuery,
    TransitionalPositionQuery,
    VisibleChildQuery,
)
from conformance.schema.world_queries import (
    BuildingTransitQuery,
    CellListQuery,
    CellPointQuery,
    CheckCollisionsQuery,
    CrossCellsQuery,
    LandCollisionsQuery,
    ObjectCallQuery,
    ObjectTransitionQuery,
    OutsideCellsQuery,
    TerrainBlockQuery,
    TransitCellsQuery,
    ValidateWalkableQuery,
)
from conformance.source import Fault, parse_path

if TYPE_CHECKING:
    from conformance.case_scene import SceneMaker
    from conformance.schema.case import CaseModel
    from conformance.schema.query import AnyQuery
    from conformance.schema.scene import SceneModel

_OF_ONE_CELL: Final = (CheckCollisionsQuery, ObjectCallQuery, ObjectTransitionQuery)
_ALWAYS: Final = (
    *_OF_ONE_CELL,
    BuildingTransitQuery,
    CellListQuery,
    CellPointQuery,
    CrossCellsQuery,
    EntryQuery,
    LandCollisionsQuery,
    OutsideCellsQuery,
    PlaceBodyQuery,
    RegistrationQuery,
    TerrainBlockQuery,
    TransitCellsQuery,
    TransitionalPositionQuery,
    ValidateWalkableQuery,
    VisibleChildQuery,
)
"""Queries whose scene is a world, whatever keys it has."""


def world_scene(case: CaseModel) -> SceneModel | None:
    """Return the scene of a case that is made as a world; None for any other."""
    scene = case.scene
    return scene if scene and (scene.is_world or isinstance(case.query, _ALWAYS)) else None


def world_inputs(query: AnyQuery, scene: SceneModel, maker: SceneMaker) -> dict[str, Any]:
    """Make the world of a query; what is wrong with it is noted as faults of the maker."""
    world_maker = WorldMaker(maker, scene)
    if isinstance(query, _OF_ONE_CELL):
        return _one_cell(scene, world_maker, maker)
    world = world_maker.world()
    if isinstance(query, TerrainBlockQuery):
        return _terrain_block(query, world, maker)
    if isinstance(query, CrossCellsQuery):
        return {"world": world.to_record(), **_crossing(query, world_maker, maker)}
    if isinstance(query, RegistrationQuery):
        return {"world": world.to_record()}
    if maker.faults:
        return {}
    shadow = shadow_lists(world, scene, maker)
    return {"world": replace(world, shadow=shadow).to_record()}


def make_scene(scene: SceneModel, op: str, maker: SceneMaker) -> None:
    """Make the world of a case that has other mistakes, for the faults that are noted."""
    if op in {"check_collisions", "object_call", "object_transition"}:
        _one_cell(scene, WorldMaker(maker, scene), maker)
    else:
        WorldMaker(maker, scene).world()


def _one_cell(scene: SceneModel, world_maker: WorldMaker, maker: SceneMaker) -> dict[str, Any]:
    """Return the cell of an object call and the objects, which are its shadow list as they are written."""
    cells = scene.cells or []
    others = [key for key in ("terrain", "doorways", "buildings") if getattr(scene, key)]
    if len(cells) != 1 or others or cells[0].portals:
        maker.fault(
            ("scene",), "more than a cell and objects", "one cell without portals, for an object call"
        )
        return {}
    if not scene.objects:
        maker.fault(("scene",), "no object", "'objects', for an object call")
    pose = maker.pose(cells[0].pose, cells[0].id, ("scene", "cells", 0, "pose"))
    model, place = cells[0].geometry, ("scene", "cells", 0, "geometry")
    geometry = None if model is None else maker.geometry(model, place)
    objects = [world_maker.object(thing, ("scene", "objects", n)) for n, thing in enumerate(scene.objects)]
    for error in object_errors(World(maker.case_id, objects=tuple(objects))):
        maker.faults.append(Fault(("scene", *parse_path(error.path)), error.found, error.expected))
    name = None if geometry is None else geometry.name
    cell = {"id": cells[0].id, "pose": pose.to_record(), "geometry": name}
    return {"cell": cell, "objects": [thing.to_record() for thing in objects]}


def _terrain_block(query: TerrainBlockQuery, world: World, maker: SceneMaker) -> dict[str, Any]:
    for block in world.landblocks:
        if block.block == query.block:
            return block.to_record() | _heights_again(query, maker)
    known = ", ".join(f"0x{block.block:04X}" for block in world.landblocks)
    maker.fault(("query", "block"), f"the landblock 0x{query.block:04X}", f"one of the scene's: {known}")
    return {}


def _heights_again(query: TerrainBlockQuery, maker: SceneMaker) -> dict[str, Any]:
    rows = query.heights_again
    if rows is None:
        return {}
    heights = maker.attempt(lambda: table_heights(rows, as_map=False), ("query", "heights_again"))
    return {"heights_again": list(heights or ())}


def _crossing(query: CrossCellsQuery, world_maker: WorldMaker, maker: SceneMaker) -> dict[str, Any]:
    """Return the object that a query registers, and how."""
    thing = world_maker.object(query.object, ("query", "object"))
    for error in single_object_errors(thing, "query.object"):
        maker.faults.append(Fault(parse_path(error.path), error.found, error.expected))
    if query.object.registered is not None:
        maker.fault(("query", "object", "registered"), "the cells", "nothing: they are what is asked")
    inputs: dict[str, Any] = {"object": thing.to_record(), "static": query.static}
    if query.sorting_sphere is not None:
        inputs["sorting_sphere"] = list(query.sorting_sphere)
    return inputs
