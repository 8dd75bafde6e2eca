"""The oracle as a candidate: it must agree with the vectors, and is what others are compared with."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.oracle_ops import (
    body_walk,
    bsp_ops,
    gate_ops,
    math_ops,
    polygon_ops,
    state_ops,
    tick_ops,
    walk_ops,
)
from conformance.candidates.table import TableCandidate
from oracle.errors import NotPortedError

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query

OPS: Final[dict[str, Callable[[Query], Fields]]] = {
    **math_ops.OPS,
    **polygon_ops.OPS,
    **bsp_ops.OPS,
    **state_ops.OPS,
    **tick_ops.OPS,
    **gate_ops.OPS,
    **body_walk.OPS,
    **walk_ops.OPS,
}
"""Every operation that the oracle performs."""


class OracleCandidate(TableCandidate):
    """Answers with the port of retail."""

    name = "oracle"
    operations = OPS
    missing = "not ported yet"
    unable = (NotPortedError,)
