"""A case's query: one model for each op that cases ask, chosen by its ``op``, or a raw record."""

from __future__ import annotations

import functools
import operator
import typing
from typing import TYPE_CHECKING, Annotated, Any, Final, TypeAlias

from pydantic import BeforeValidator, Discriminator, Field, Tag

from conformance.outputs import OUTPUTS
from conformance.schema import (
    geometry_queries,
    math_queries,
    movement_queries,
    own_queries,
    walk_queries,
    world_queries,
)
from conformance.schema.mistakes import mistake
from conformance.schema.query_base import QueryModel
from conformance.schema.values import Strictly
from conformance.source import describe, nearest


class RawQuery(Strictly):
    """A vector record's op and inputs as they are; they name the case's geometries."""

    op: str
    inputs: dict[str, Any] = Field(description="Input blocks of the op (FORMAT.md).")


def ops_of(model: type[QueryModel]) -> tuple[str, ...]:
    """Return the ops that a model describes; none for a base of models."""
    return typing.get_args(model.model_fields["op"].annotation)


def _models(module: Any) -> list[type[QueryModel]]:
    """Return the models that a module defines, not those that it imports."""
    members = [m for m in vars(module).values() if isinstance(m, type) and m.__module__ == module.__name__]
    return [m for m in members if issubclass(m, QueryModel) and ops_of(m)]


QUERY_MODELS: Final = (
    *_models(math_queries),
    *_models(geometry_queries),
    *_models(movement_queries),
    *_models(walk_queries),
    *_models(world_queries),
    *_models(own_queries),
)

MODEL_OF_OP: Final = {op: model for model in QUERY_MODELS for op in ops_of(model)}


def _check_kind(value: Any) -> Any:
    """Check that a model can be chosen."""
    if not isinstance(value, dict):
        raise mistake(describe(value), "a mapping with an 'op'")
    if "op" not in value:
        raise mistake("no 'op'", "the key 'op'")
    op, known = value["op"], OUTPUTS if "inputs" in value else MODEL_OF_OP
    if not isinstance(op, str) or op not in known:
        expected = "an op of FORMAT.md"
        if isinstance(op, str) and op in OUTPUTS:
            expected = f"an op of {', '.join(sorted(MODEL_OF_OP))}, or 'inputs' with those of its record"
        raise mistake(
            f"the op {op!r}" if isinstance(op, str) else describe(op),
            expected,
            nearest(str(op), known),
            at=("op",),
        )
    return value


def _kind(value: Any) -> str:
    if isinstance(value, Strictly):
        return type(value).__name__
    return RawQuery.__name__ if "inputs" in value else MODEL_OF_OP[value["op"]].__name__


def _tagged(model: type[Strictly]) -> Any:
    return Annotated[model, Tag(model.__name__)]


if TYPE_CHECKING:
    AnyQuery: TypeAlias = QueryModel | RawQuery
else:
    _ANY_MODEL = functools.reduce(operator.or_, map(_tagged, (*QUERY_MODELS, RawQuery)))
    AnyQuery = Annotated[_ANY_MODEL, Discriminator(_kind), BeforeValidator(_check_kind)]
