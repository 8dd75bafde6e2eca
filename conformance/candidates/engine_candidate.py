"""The fast engine as a candidate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.engine_ops import (
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
from engine.errors import OutdoorsError

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
"""Every operation that the engine performs."""


class EngineCandidate(TableCandidate):
    """Answers with the compiled engine."""

    name = "engine"
    operations = OPS
    missing = "not in the engine yet"
    unable = (OutdoorsError,)

    def reason(self, error: Exception) -> str:
        """Say why a query is skipped: without the particulars, which would be counted apart."""
        del error
        return "needs the landscape"
