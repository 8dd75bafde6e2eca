"""What the suite says to an engine, and how an engine introduces itself: the models of protocol v1.

The published JSON Schema is made of these models; `conformance serve` reads messages with them.
"""

from __future__ import annotations

import json
from typing import Annotated, Any, Final, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict, Field, Strict, TypeAdapter

VERSION: Final = 1
"""The version of the protocol that is spoken here."""
MOST_BYTES: Final = 1 << 24
"""Longest line that is read, in bytes: a thousand times what a large answer takes."""

_ENCODER: Final = json.JSONEncoder(separators=(",", ":"), ensure_ascii=False)

Sequence: TypeAlias = Annotated[int, Strict(), Field(ge=0)]
"""The number of a message; its reply repeats it."""
FloatDialect: TypeAlias = Literal["decimal", "hex"]


class _Message(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Start(_Message):
    """The first message: which version the suite speaks, and which floats it can read."""

    cmd: Literal["start"]
    seq: Sequence
    version: Annotated[int, Strict()]
    floats: list[FloatDialect]


class Scene(_Message):
    """Geometry, and perhaps a world, that the runs that follow refer to by `id`.

    A scene under an id that is in use replaces the one that was there.
    """

    cmd: Literal["scene"]
    seq: Sequence
    id: str
    geometries: list[dict[str, Any]]
    """Lines of ``geometries.jsonl``, as FORMAT.md describes them; names are unique within the scene."""
    world: dict[str, Any] | None = None
    """A line of ``worlds.jsonl``; its geometry is that of the scene."""


class Run(_Message):
    """One operation of FORMAT.md to perform."""

    cmd: Literal["run"]
    seq: Sequence
    op: str
    inputs: dict[str, Any]
    """The input blocks of the operation; geometry and world are named, as in vector files."""
    scene: str | None = None
    """Id of the scene that has what the inputs name; absent if they name nothing."""
    label: str = ""
    """The case and pose that ask, for the engine's log."""


class Stop(_Message):
    """The last message: reply, and end with exit status 0."""

    cmd: Literal["stop"]
    seq: Sequence


Message: TypeAlias = Annotated[Start | Scene | Run | Stop, Field(discriminator="cmd")]
MESSAGE: Final[TypeAdapter[Start | Scene | Run | Stop]] = TypeAdapter(Message)


class Capabilities(_Message):
    """The result of `start`: who the engine is and what it can do."""

    version: Annotated[int, Strict()]
    """The version of the protocol that the engine speaks."""
    name: str
    """What the engine is called, its own version included."""
    floats: FloatDialect
    """How floats are written from now on, in both directions."""
    ops: list[str]
    """The operations that it performs; others are not asked."""
    features: list[str]
    """What it understands besides; queries that need another feature are not asked."""


class SkippedBody(_Message):
    """Why an engine does not do what was asked."""

    reason: str


class ErroredBody(_Message):
    """What went wrong while an engine did what was asked."""

    context: str


def line_of(message: dict[str, Any]) -> bytes:
    """Write a message, or a reply, as one line.

    Raises
    ------
    RecursionError
        If it is nested too deeply for JSON.
    """
    return json_text(message).encode("utf-8") + b"\n"


def json_text(value: Any) -> str:
    """Write a message, or a part of one, without a blank in it; raises like `line_of`."""
    return _ENCODER.encode(value)
