"""Every comparison of documents 01 to 05 that a query reaches by itself, in the order of the documents."""

from __future__ import annotations

from typing import Final

from conformance.stress.comparisons.base import Comparison
from conformance.stress.comparisons.footing import FOOTING
from conformance.stress.comparisons.ground import GROUND
from conformance.stress.comparisons.moves import MOVES
from conformance.stress.comparisons.placements import PLACEMENTS
from conformance.stress.comparisons.polygons import POLYGONS
from conformance.stress.comparisons.states import STATES
from conformance.stress.comparisons.trees import TREES

__all__ = ["COMPARISONS", "Comparison"]

COMPARISONS: Final = (*POLYGONS, *FOOTING, *TREES, *GROUND, *STATES, *MOVES, *PLACEMENTS)
