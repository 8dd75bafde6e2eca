"""The model of a whole case, and of a file of cases."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Literal, TypeAlias

from pydantic import AfterValidator, BeforeValidator, Field, StringConstraints

from conformance.retail_index import CitationError, check_citation
from conformance.schema.mistakes import mistake
from conformance.schema.mover import MoverModel
from conformance.schema.query import MODEL_OF_OP, AnyQuery
from conformance.schema.scene import SceneModel
from conformance.schema.values import Count, Strictly
from conformance.source import describe, quoted

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from pydantic_core import PydanticCustomError

    from conformance.schema.query_base import Needs

SCENE_KEYS: Final[Mapping[Needs, tuple[str, ...]]] = MappingProxyType(
    {
        "cells": ("cells",),
        "geometry": ("geometry",),
        "scene": ("cells", "terrain"),
        "terrain": ("terrain",),
        "": (),
    }
)
"""The keys of a scene of which a query needs one."""
MAX_POSES: Final = 10_000
"""Most random poses of a case; all are made before the first is asked."""
SLUG = r"[a-z0-9]+(-[a-z0-9]+)*"
Slug = Annotated[str, StringConstraints(pattern=f"^{SLUG}$")]
Text = Annotated[str, StringConstraints(min_length=1, strip_whitespace=True)]


def _citation(citation: str) -> str:
    try:
        check_citation(citation)
    except CitationError as error:
        raise mistake(error.found, error.expected, error.hint) from None
    return citation


class VaryModel(Strictly):
    """How a case is also run elsewhere in the world: moved rigidly to random poses."""

    poses: Annotated[Count, Field(le=MAX_POSES)]
    seed: Count | None = Field(None, description="Of the random poses; without it the case's id decides.")


def _vary(value: Any) -> Any:
    if value is False:
        return VaryModel.model_validate({"poses": 0})
    if isinstance(value, VaryModel | dict):
        return value
    raise mistake(describe(value), "false, or a mapping with 'poses'")


Vary: TypeAlias = Annotated[
    VaryModel, BeforeValidator(_vary, json_schema_input_type=VaryModel | Literal[False])
]


class CaseModel(Strictly):
    """One case: a query in a scene, why it is asked, and what retail is known to answer."""

    nullable: ClassVar = frozenset({"mover"})  # nobody, where a query asks about nobody

    id: Slug = Field(description="For life: lower-case words and numbers joined by '-'.")
    title: Text = Field(description="What the case shows, in a line.")
    why: Text = Field(description="What goes wrong in an engine that differs here.")
    retail: Annotated[list[Annotated[str, AfterValidator(_citation)]], Field(min_length=1)] = Field(
        description="'FUNCTION STEPS' of docs/retail, such as 'BSPTREE::step_sphere_down SD-9'."
    )
    tags: list[Slug] = Field(default_factory=list)
    scene: SceneModel | None = None
    mover: MoverModel | None = None
    query: AnyQuery
    expect: dict[str, Any] = Field(
        default_factory=dict,
        description="Pinned outputs that both retail and the candidate must meet: output fields as in"
        " FORMAT.md; a number may be {value, tolerance, unit, reason} or {bits: 0x…}.",
    )
    vary: Vary | None = Field(
        None, description="false, or {poses, seed}; without it, the scene is also run in random poses."
    )
    geometries: list[dict[str, Any]] = Field(
        default_factory=list, description="With `query.inputs`: records of the geometries they name."
    )


def check_parts(data: dict[str, Any]) -> Iterator[PydanticCustomError]:
    """Check that a case has the parts its query works on, and no others, whatever is in them."""
    query = data.get("query")
    if not isinstance(query, dict):
        return
    if "inputs" in query:
        for name in ("scene", "mover"):
            yield from _check_part(data, name, "a query with 'inputs'", needed=False)
    elif isinstance(op := query.get("op"), str) and op in MODEL_OF_OP:
        model = MODEL_OF_OP[op]
        yield from _check_part(data, "scene", op, needed=bool(model.needs))
        yield from _check_part(data, "mover", op, needed=model.mover)
        yield from _check_part(data, "geometries", "a query without 'inputs'", needed=False)
        scene = data.get("scene")
        keys = SCENE_KEYS[model.needs]
        if keys and isinstance(scene, dict) and not any(key in scene for key in keys):
            found = f"a scene with {quoted(scene) or 'nothing'}"
            yield mistake(found, f"a scene with {' or '.join(map(repr, keys))}, for {op}", at=("scene",))
        elif op == "transition" and isinstance(scene, dict):
            yield from _check_begin_cell(query, is_world=SceneModel.is_world_data(scene))


def _check_begin_cell(query: dict[str, Any], *, is_world: bool) -> Iterator[PydanticCustomError]:
    """Check that a transition names its begin cell, which in a world its pose does."""
    if is_world and "begin_cell" in query:
        yield mistake("'begin_cell' in a world", "only 'from', whose cell it is", at=("query", "begin_cell"))
    if not is_world and "begin_cell" not in query:
        yield mistake("no 'begin_cell'", "the key 'begin_cell'", at=("query",))


def _check_part(data: dict[str, Any], name: str, what: str, *, needed: bool) -> Iterator[PydanticCustomError]:
    if needed and name not in data:
        yield mistake(f"no '{name}'", f"the {name} that {what} works on")
    if not needed and name in data:
        yield mistake(f"a {name}", f"none: {what} works without", at=(name,))
