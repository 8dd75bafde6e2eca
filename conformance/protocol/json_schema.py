"""The JSON Schema of protocol v1, as it is published for authors of engines."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from pydantic.json_schema import models_json_schema

from conformance.inputs import OPTIONAL, REQUIRED
from conformance.outputs import OUTPUTS
from conformance.protocol.messages import Capabilities, ErroredBody, Run, Scene, SkippedBody, Start, Stop
from conformance.shapes import Block, Kind, Listing, Nullable, Scalar, Vector

if TYPE_CHECKING:
    from conformance.shapes import Shape

SCHEMA_FILE: Final = "protocol.schema.json"
Node: TypeAlias = "dict[str, Any]"
"""A part of a JSON Schema."""

_DEFS: Final = "#/$defs/"
_MODELS: Final = (Start, Scene, Run, Stop, Capabilities, SkippedBody, ErroredBody)
_COMMANDS: Final = (Start, Scene, Run, Stop)
_SCALARS: Final[dict[Kind, Node]] = {
    Kind.FLOAT32: {"$ref": f"{_DEFS}float32"},
    Kind.FLOAT64: {"$ref": f"{_DEFS}float64"},
    Kind.FLAG: {"enum": [0, 1, False, True]},
    Kind.ANSWER: {"type": ["integer", "string"]},
    Kind.STATE: {"type": "string"},
    Kind.TEXT: {"type": "string"},
}
"""Kinds of values; those that are not here are whole numbers."""


def protocol_schema() -> Node:
    """Return the schema: a line that the suite writes, or one that an engine writes.

    ``$defs`` has, besides the messages, what each operation answers (``result.OP``) and is given
    (``inputs.OP``: which keys; FORMAT.md says what stands under them).
    """
    _, models = models_json_schema(
        [(model, "validation") for model in _MODELS], ref_template=f"{_DEFS}{{model}}"
    )
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Conformance protocol, version 1: one line",
        "oneOf": [{"$ref": f"{_DEFS}{model.__name__}"} for model in _COMMANDS] + [{"$ref": f"{_DEFS}Reply"}],
        "$defs": {
            **models["$defs"],
            "Reply": _reply(),
            "float32": _float("a decimal that rounds to the float32", 8),
            "float64": _float("a decimal that rounds to the float64", 16),
            **{f"inputs.{op}": _inputs(op) for op in REQUIRED},
            **{f"result.{op}": _shape(block) for op, block in OUTPUTS.items()},
        },
    }


def published_schema() -> str:
    """Format the schema as it is published in ``protocol.schema.json``."""
    return json.dumps(protocol_schema(), indent=1, ensure_ascii=False) + "\n"


def _reply() -> Node:
    """Return the schema of a reply: `seq`, and exactly one body."""
    bodies = {
        "result": {"type": "object", "description": "to start: Capabilities; to run: result.OP; else {}"},
        "skipped": {"$ref": f"{_DEFS}SkippedBody"},
        "errored": {"$ref": f"{_DEFS}ErroredBody"},
    }
    return {
        "type": "object",
        "properties": {"seq": {"type": "integer", "minimum": 0}, **bodies},
        "required": ["seq"],
        "oneOf": [{"required": [name]} for name in bodies],
        "additionalProperties": False,
    }


def _float(meaning: str, digits: int) -> Node:
    return {
        "description": f"{meaning}; or its bits, if the handshake says so",
        "anyOf": [
            {"type": "number"},
            {"enum": ["nan", "inf", "-inf"]},
            {"type": "string", "pattern": f"^0x[0-9a-fA-F]{{{digits}}}$"},
        ],
    }


def _inputs(op: str) -> Node:
    keys = (*REQUIRED[op], *OPTIONAL.get(op, ()))
    return {
        "type": "object",
        "properties": dict.fromkeys(keys, True),
        "required": list(REQUIRED[op]),
        "additionalProperties": False,
    }


def _shape(shape: Shape) -> Node:
    match shape:
        case Scalar(kind):
            return _SCALARS.get(kind, {"type": "integer"})
        case Nullable(inner):
            return {"anyOf": [{"type": "null"}, _shape(inner)]}
        case Vector(components):
            count = len(components)
            item = _SCALARS[Kind.FLOAT32]
            return {"type": "array", "items": item, "minItems": count, "maxItems": count}
        case Listing(item):
            return {"type": "array", "items": _shape(item)}
        case Block(fields):
            return {
                "type": "object",
                "properties": {key: _shape(inner) for key, inner in fields.items()},
                "required": [key for key in fields if key not in shape.optional],
                "additionalProperties": False,
            }
