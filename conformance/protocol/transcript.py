"""What an engine is sent to be asked one query, from the handshake to the stop."""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance.protocol.messages import VERSION, line_of
from conformance.protocol.scenes import SceneSlots, run_line, scene_line

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.protocol.dialects import Dialect
    from conformance.query import Query


def messages_of(query: Query, dialect: Dialect) -> Iterator[bytes]:
    """Yield the lines of a session that asks one query.

    Parameters
    ----------
    query : Query
    dialect : {"decimal", "hex"}
        The only one that is offered to the engine.

    Raises
    ------
    RecursionError
        If a tree of its scene is nested too deeply for JSON.
    """
    yield line_of({"cmd": "start", "seq": 0, "version": VERSION, "floats": [dialect]})
    seq = 1
    scene, _ = SceneSlots().find(query)
    if scene is not None:
        yield scene_line(scene, seq, dialect)
        seq += 1
    yield run_line(query, scene, seq, dialect)
    yield line_of({"cmd": "stop", "seq": seq + 1})
