"""From one mapping of a document to a case: checked, built, pinned, varied."""

from __future__ import annotations

import zlib
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from conformance.case import Case
from conformance.case_pins import make_pins
from conformance.case_query import asked_op, make_query
from conformance.case_scene import SceneMaker
from conformance.case_walk_pins import make_walk_pins
from conformance.case_world_inputs import make_scene
from conformance.scenes.poses import moved_queries
from conformance.schema.case import CaseModel, check_parts
from conformance.schema.scene import SceneModel
from conformance.step_outputs import STEP_OF
from conformance.validation import validate, worded

if TYPE_CHECKING:
    from conformance.case import Vary
    from conformance.pins import Pin
    from conformance.query import Query
    from conformance.source import DocPath, Fault, Problem
    from conformance.yaml_source import Document

DEFAULT_POSES: Final = 8
"""Random poses in which a scene case is also run, unless it or the user says otherwise."""
DEFAULT_WALK_POSES: Final = 4
"""The same for a walk, which is many queries in one."""


def load_case(document: Document, below: DocPath, data: Any, vary: Vary) -> tuple[Case | None, list[Problem]]:
    """Make a case of one mapping of a document.

    Parameters
    ----------
    document : Document
        The file; gives the places.
    below : DocPath
        The way to the case in it.
    data : Any
        What is there.
    vary : Vary
        Overrides of the case's own `vary`.

    Returns
    -------
    Case or None
        None if there is a mistake in it.
    list of Problem
        Everything that is wrong with it.
    """
    refused = document.refused_below(below)
    model, faults = validate(CaseModel, data)
    parts = check_parts(data) if isinstance(data, dict) else ()
    faults += [worded((), part.context or {}) for part in parts]
    query: Query | None = None
    pins: tuple[Pin, ...] = ()
    if model is None:
        faults += _scene_faults(data)
    else:
        maker = SceneMaker(model.id)
        query = make_query(model, maker)
        pins, pin_faults = _pins(model, query)
        faults += [*maker.faults, *pin_faults]
    told = (fault for fault in faults if not document.is_refused((*below, *fault.path)))
    case_id = str(data.get("id", "")) if isinstance(data, dict) else ""
    problems = [
        problem.of_case(case_id)
        for problem in (*refused, *(document.problem(fault, below) for fault in told))
    ]
    if problems or model is None or query is None:
        return None, problems
    return _case(document, below, model, (query, *_variants(model, query, vary)), pins), []


def _pins(model: CaseModel, query: Query | None) -> tuple[tuple[Pin, ...], list[Fault]]:
    """Read what is pinned; of a walk with mistakes nothing, because the ticks are not known."""
    op = asked_op(model)
    if op not in STEP_OF:
        return make_pins(op, model.expect)
    return ((), []) if query is None else make_walk_pins(op, model.expect, query)


def _scene_faults(data: Any) -> list[Fault]:
    """Look into the scene of a case that has mistakes elsewhere, so that all are told at once."""
    scene = data.get("scene") if isinstance(data, dict) else None
    model, _ = validate(SceneModel, scene)
    if model is None:
        return []
    maker = SceneMaker("")
    if model.geometry is not None:
        maker.geometry(model.geometry, ("scene", "geometry"))
    elif model.is_world:
        query = data.get("query")
        make_scene(model, str(query.get("op")) if isinstance(query, dict) else "", maker)
    else:
        maker.scene(model, ("scene",))
    return maker.faults


def _case(
    document: Document, below: DocPath, model: CaseModel, queries: tuple[Query, ...], pins: tuple[Pin, ...]
) -> Case:
    return Case(
        id=model.id,
        title=model.title,
        why=" ".join(model.why.split()),
        retail=tuple(model.retail),
        tags=tuple(model.tags),
        location=document.locate((*below, "id"), key=True),
        queries=queries,
        expect=pins,
        source=document.excerpt(below),
        first_line=document.first_line(below),
    )


def _variants(model: CaseModel, query: Query, vary: Vary) -> list[Query]:
    """Return the query in random poses of the world."""
    asked = model.vary
    default = DEFAULT_WALK_POSES if query.op in STEP_OF else DEFAULT_POSES
    count = asked.poses if asked is not None else default
    if vary.poses is not None and count:
        count = vary.poses
    seed = vary.seed if vary.seed is not None else asked.seed if asked is not None else None
    moved = moved_queries(query, count, zlib.crc32(model.id.encode()) if seed is None else seed)
    return [
        replace(variant, label=f"{model.id}[pose {number}]") for number, variant in enumerate(moved, start=1)
    ]
