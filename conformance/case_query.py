"""From a case's models to a query: the input blocks that FORMAT.md names, floats exactly float32."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from conformance.case_references import check_references
from conformance.case_ticks import body_block, held_inputs, recorded_moves
from conformance.case_world_inputs import world_inputs, world_scene
from conformance.effort import check_effort
from conformance.fields import FieldError, UnknownOperationError
from conformance.query import Query
from conformance.scenes.model import Pose
from conformance.schema.frames import PlaceModel, PoseModel
from conformance.schema.movement_queries import CallQuery, TransitionQuery
from conformance.schema.own_queries import (
    CountStepsQuery,
    EntryQuery,
    PlaceBodyQuery,
    TransitionalPositionQuery,
)
from conformance.schema.query import RawQuery
from conformance.schema.values import INSERT_TYPES, OBJECT_STATES, Strictly
from conformance.schema.walk_queries import BodyWalkQuery, WalkQuery
from conformance.schema.world_queries import CrossCellsQuery, ObjectTransitionQuery, TerrainBlockQuery
from conformance.source import Fault, parse_path, quoted
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.case_scene import SceneMaker
    from conformance.scenes.model import Cell
    from conformance.schema.case import CaseModel
    from conformance.source import DocPath

WORLD_OPS: Final[Mapping[str, str]] = MappingProxyType(
    {"transition": "world_transition", "walk": "world_walk"}
)
"""What an op of a scene of cells is called in a world."""


def asked_op(case: CaseModel) -> str:
    """Return the operation that a case asks: in a world some have another name."""
    return WORLD_OPS.get(case.query.op, case.query.op) if world_scene(case) else case.query.op


def make_query(case: CaseModel, maker: SceneMaker) -> Query | None:
    """Make the query that a case asks; what is wrong with it is noted as faults of the maker.

    Returns
    -------
    Query or None
        None if there are faults.
    """
    if isinstance(case.query, RawQuery):
        return _raw_query(case, case.query, maker)
    world = world_scene(case)
    inputs = world_inputs(case.query, world, maker) if world else _scene_inputs(case, maker)
    if isinstance(case.query, WalkQuery | BodyWalkQuery):
        inputs |= _walk_inputs(case.query, maker)
    elif not isinstance(
        case.query, TerrainBlockQuery | CrossCellsQuery
    ):  # whose keys are made with the world
        inputs |= _block(case.query, maker, ("query",))
        inputs.pop("op")
    if isinstance(case.query, PlaceBodyQuery):
        inputs["body"] = body_block(case.query.body, inputs.pop("start"))
        inputs.setdefault("cell", None)
    if case.mover is not None:
        mover = _block(case.mover, maker, ("mover",))
        if "weenie" in mover:
            mover["weenie"] = dict.fromkeys(mover["weenie"], 1)
        inputs["mover"] = mover | {"ethereal": OBJECT_STATES["ethereal"] if mover["ethereal"] else 0}
    if isinstance(case.query, CallQuery):
        inputs["path"]["insert_type"] = INSERT_TYPES[case.query.path.insert_type]
        if at := inputs.pop("at", None):
            inputs["from"] = inputs["to"] = at
    if isinstance(case.query, TransitionalPositionQuery):
        inputs["insert_type"] = INSERT_TYPES[case.query.insert_type]
    if isinstance(case.query, EntryQuery):
        inputs.setdefault("mover", None)  # nobody
    if isinstance(case.query, TransitionQuery | ObjectTransitionQuery | CountStepsQuery):
        inputs.setdefault("from", None)  # FORMAT.md: null asks for a placement
    maker.faults += check_references(case, maker.geometries)
    if maker.faults:
        return None
    try:
        check_effort(inputs)
    except FieldError as error:
        maker.faults.append(_too_much(error))
        return None
    return Query(asked_op(case), inputs, maker.geometries, case.id)


def _too_much(error: FieldError) -> Fault:
    """Place a mistake in the case's own words: its mover stands beside its query, and segments for ticks."""
    first, *inner = parse_path(error.path)
    path: DocPath = (first, *(inner if first != "ticks" else ()))
    return Fault(path if first == "mover" else ("query", *path), error.found, error.expected)


def _scene_inputs(case: CaseModel, maker: SceneMaker) -> dict[str, Any]:
    if case.scene is None:
        return {}
    if case.scene.geometry is not None:
        geometry = maker.geometry(case.scene.geometry, ("scene", "geometry"))
        return {"geometry": geometry.name if geometry else ""}
    scene = maker.scene(case.scene, ("scene",))
    if case.query.op == "find_collisions":
        return _called_tree(scene.cells, maker)
    return {"cells": [cell.to_record() for cell in scene.cells]}


def _walk_inputs(query: WalkQuery | BodyWalkQuery, maker: SceneMaker) -> dict[str, Any]:
    start = maker.pose(query.start, query.start.cell, ("query", "start")).to_record()
    if isinstance(query, WalkQuery):
        inputs: dict[str, Any] = {"start": start}
        inputs["ticks"], faults = recorded_moves(query)
    else:
        inputs = {"body": body_block(query.body, start)}
        inputs["ticks"], faults = held_inputs(query)
    maker.faults += faults
    return inputs


def _called_tree(cells: tuple[Cell, ...], maker: SceneMaker) -> dict[str, Any]:
    """Return the tree that one collision call is made on: the cell's own, or its only static's."""
    cell = cells[0]
    shapes = (cell.geometry is not None) + len(cell.statics)
    if len(cells) != 1 or shapes > 1:
        found = f"{len(cells)} cells with {shapes} trees in the first"
        maker.faults.append(Fault(("scene", "cells"), found, "one cell with one tree, for find_collisions"))
    if cell.statics:
        static = cell.statics[0]
        called, pose, scale, kind = static.geometry, static.pose, static.scale, "static"
    else:
        called, pose, scale, kind = cell.geometry, cell.pose, 1.0, "cell"  # type: ignore[assignment]
    name = called.name if called else ""
    return {"geometry": name, "pose": pose.to_record(), "scale": scale, "as": kind}


def _block(model: Strictly, maker: SceneMaker, path: DocPath) -> dict[str, Any]:
    """Return a model's values by the keys of the file, without those that are None."""
    keys = {info.alias or name: name for name, info in type(model).model_fields.items()}
    values = {key: getattr(model, name) for key, name in keys.items()}
    return {key: _value(value, maker, (*path, key)) for key, value in values.items() if value is not None}


def _value(value: Any, maker: SceneMaker, path: DocPath) -> Any:
    match value:
        case PoseModel():
            return maker.pose(value, value.cell, path).to_record()
        case PlaceModel():
            return Pose(value.cell, value.origin).to_record()
        case Strictly():
            return _block(value, maker, path)
        case list() | tuple():
            return [_value(item, maker, path) for item in value]
        case _:
            return value


def _raw_query(case: CaseModel, raw: RawQuery, maker: SceneMaker) -> Query | None:
    maker.recorded(case.geometries, ("geometries",))
    if maker.faults:
        return None
    try:
        record = {"op": raw.op, **raw.inputs}
        return query_from_record(record, maker.geometries, label=case.id)
    except KeyError as error:
        known = quoted(maker.geometries) or "(none)"
        fault = Fault(("query", "inputs"), f"the geometry {error.args[0]!r}", f"one of 'geometries': {known}")
    except UnknownOperationError as error:
        hint = f"did you mean {error.nearest!r}?" if error.nearest else ""
        fault = Fault(("query", "op"), f"the op {raw.op!r}", "an op of FORMAT.md", hint)
    except FieldError as error:
        fault = Fault(("query", "inputs", *parse_path(error.path)), error.found, error.expected)
    maker.faults.append(fault)
    return None
