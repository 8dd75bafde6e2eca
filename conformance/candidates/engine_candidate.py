"""The fast engine as a candidate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.engine_ops import (
    body_walk,
    bsp_ops,
    cell_ops,
    gate_ops,
    math_ops,
    object_ops,
    placement_ops,
    polygon_ops,
    state_ops,
    terrain_ops,
    tick_ops,
    walk_ops,
    world_ops,
)
from conformance.candidates.engine_ops.not_askable import NotAskableError
from conformance.candidates.table import TableCandidate
from engine.errors import UndeterminedError
from engine.tracing import recording

if TYPE_CHECKING:
    from collections.abc import Callable, Collection
    from contextlib import AbstractContextManager

    from conformance.query import Fields, Query
    from engine.tracing_writes import WriteTrace

OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    **math_ops.OPS,
    **polygon_ops.OPS,
    **bsp_ops.OPS,
    **state_ops.OPS,
    **object_ops.OPS,
    **tick_ops.OPS,
    **gate_ops.OPS,
    **placement_ops.OPS,
    **terrain_ops.OPS,
    **cell_ops.OPS,
    **world_ops.OPS,
    **body_walk.OPS,
    **walk_ops.OPS,
}
"""Every operation that the engine performs."""


class EngineCandidate(TableCandidate):
    """Answers with the compiled engine."""

    name = "engine"
    operations = OPS
    missing = "the engine does not offer it"
    unable = (UndeterminedError, NotAskableError)

    def recording(self, topics: Collection[str]) -> AbstractContextManager[WriteTrace]:
        """Run the kernels in the block interpreted, and record what their transitions write."""
        return recording(topics)
