"""The JSON Schema of case files: published for editors, and asked which keys a place allows."""

from __future__ import annotations

import functools
import json
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from conformance.schema.case import CaseModel

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from pydantic import BaseModel

SCHEMA_FILE: Final = "case.schema.json"
Node: TypeAlias = "dict[str, Any]"
"""A part of a JSON Schema."""
_DEFS: Final = "#/$defs/"


@functools.cache
def model_schema(model: type[BaseModel]) -> dict[str, Any]:
    """Return the schema of one model, by the keys of the file."""
    return model.model_json_schema(by_alias=True)


def file_schema() -> dict[str, Any]:
    """Return the schema of a file: one case, or several under ``cases``."""
    case = dict(model_schema(CaseModel))
    definitions = {**case.pop("$defs"), "CaseModel": case}
    one = {"$ref": f"{_DEFS}CaseModel"}
    several = {
        "type": "object",
        "properties": {"cases": {"type": "array", "items": one, "minItems": 1}},
        "required": ["cases"],
        "additionalProperties": False,
    }
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Conformance cases",
        "if": {"required": ["cases"]},
        "then": several,
        "else": one,
        "$defs": definitions,
    }


def published_schema() -> str:
    """Format the file schema as it is published in ``case.schema.json``."""
    return json.dumps(file_schema(), indent=1, ensure_ascii=False) + "\n"


def allowed_keys(model: type[BaseModel], location: Sequence[str | int]) -> list[str]:
    """Return the keys that a mapping may have.

    Parameters
    ----------
    model : type
        The model that the whole is checked against.
    location : sequence
        The way to the mapping, as pydantic gives it: keys, indices and names of chosen models.
    """
    whole = model_schema(model)
    definitions = whole.get("$defs", {})
    nodes = [whole]
    for part in location:
        nodes = [inner for node in nodes for inner in _step(node, part, definitions)]
    options = (option for node in nodes for option in _options(node, definitions))
    return list(dict.fromkeys(key for option in options for key in option.get("properties", ())))


def _step(node: Node, part: str | int, definitions: Node) -> Iterator[Node]:
    if part in definitions:
        yield definitions[part]
        return
    for option in _options(node, definitions):
        inner = option.get("items") if isinstance(part, int) else option.get("properties", {}).get(part)
        if isinstance(inner, dict):
            yield inner


def _options(node: Node, definitions: Node) -> Iterator[Node]:
    """Yield what a schema node may be, references and alternatives resolved."""
    if "$ref" in node:
        yield from _options(definitions[node["$ref"].removeprefix(_DEFS)], definitions)
    for option in (*node.get("anyOf", ()), *node.get("oneOf", ())):
        yield from _options(option, definitions)
    if "properties" in node or "items" in node:
        yield node
