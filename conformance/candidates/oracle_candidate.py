"""The oracle as a candidate: it must agree with the vectors, and is what others are compared with."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_ops import (
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
from conformance.candidates.table import TableCandidate
from oracle.errors import NotPortedError, UndeterminedError
from oracle.write_trace import recording

if TYPE_CHECKING:
    from collections.abc import Callable, Collection
    from contextlib import AbstractContextManager

    from conformance.query import Fields, Query
    from oracle.writes import WriteTrace

OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    **math_ops.OPS,
    **polygon_ops.OPS,
    **bsp_ops.OPS,
    **state_ops.OPS,
    **tick_ops.OPS,
    **gate_ops.OPS,
    **body_walk.OPS,
    **walk_ops.OPS,
    **object_ops.OPS,
    **terrain_ops.OPS,
    **cell_ops.OPS,
    **world_ops.OPS,
    **placement_ops.OPS,
}
"""Every operation that the oracle performs."""


class OracleCandidate(TableCandidate):
    """Answers with the port of retail."""

    name = "oracle"
    operations = OPS
    missing = "not ported yet"
    unable = (NotPortedError, UndeterminedError)

    def recording(self, topics: Collection[str]) -> AbstractContextManager[WriteTrace]:
        """Record what every transition that is made in the block writes."""
        return recording(None, topics)
