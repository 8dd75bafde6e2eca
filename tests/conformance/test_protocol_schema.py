"""The published JSON Schema of the protocol."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import conformance.protocol
from conformance.cli import main
from conformance.inputs import REQUIRED
from conformance.outputs import OUTPUTS
from conformance.protocol.json_schema import SCHEMA_FILE, protocol_schema, published_schema

if TYPE_CHECKING:
    import pytest

PUBLISHED = Path(conformance.protocol.__file__).with_name(SCHEMA_FILE)


def test_the_published_schema_is_that_of_the_code() -> None:
    """What authors of engines read is what is spoken."""
    published = PUBLISHED.read_text(encoding="utf-8")
    assert published == published_schema()
    assert json.loads(published) == protocol_schema()


def test_every_reference_leads_somewhere() -> None:
    """Into the definitions of the schema itself."""
    text = published_schema()
    definitions = protocol_schema()["$defs"]
    references = {line.split('"')[3] for line in text.splitlines() if '"$ref"' in line}
    assert {f"#/$defs/{name}" for name in ("Reply", "Run", "float32", "SkippedBody")} <= references
    assert {reference.removeprefix("#/$defs/") for reference in references} <= definitions.keys()


def test_every_operation_is_described() -> None:
    """What it is given and what it answers; no other key is allowed."""
    definitions = protocol_schema()["$defs"]
    for op, block in OUTPUTS.items():
        assert list(definitions[f"result.{op}"]["properties"]) == list(block.fields)
        assert definitions[f"result.{op}"]["additionalProperties"] is False
        assert definitions[f"inputs.{op}"]["required"] == list(REQUIRED[op])


def test_a_small_result() -> None:
    """Three float32, by decimals or by bits; flags; what may be null."""
    definitions = protocol_schema()["$defs"]
    result = definitions["result.polygon_hits_sphere_slow"]
    point = {"type": "array", "items": {"$ref": "#/$defs/float32"}, "minItems": 3, "maxItems": 3}
    assert result["properties"]["contact"] == {"anyOf": [{"type": "null"}, point]}
    assert result["properties"]["r"] == {"enum": [0, 1, False, True]}
    assert result["required"] == ["r", "contact"]


def test_the_command_prints_it(capsys: pytest.CaptureFixture[str]) -> None:
    """For engines that check what they are sent."""
    assert main(["serve", "--schema"]) == 0
    assert capsys.readouterr().out == published_schema()
