"""Restrictions of cells compiled (09, 3.1)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from engine import layout as at
from engine.errors import WorldError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from engine.cells import Restriction
    from engine.compiling.cells import CellNumbers
    from engine.compiling.storage import Storage
    from engine.kernels.types import Ints


def write_restrictions(
    storage: Storage, numbers: CellNumbers, restrictions: Mapping[int, Restriction]
) -> Ints:
    """Write what restricts cells; return of each cell where its record begins, or `NO_RESTRICTION`.

    Cells that share a Restriction, as those of a house do, share its record.
    """
    found = np.full(len(numbers.ids), at.NO_RESTRICTION, dtype=np.int64)
    written: dict[int, int] = {}
    for cell_id, restriction in restrictions.items():
        index = numbers.index(cell_id)
        if index == at.NO_CELL:
            raise WorldError(f"restrictions, {cell_id:#010x}", "is not a cell of the world")
        if id(restriction) not in written:
            written[id(restriction)] = storage.add_ints(_record(restriction))
        found[index] = written[id(restriction)]
    return found


def _record(restriction: Restriction) -> list[int]:
    ids = sorted(restriction.admits)
    return [int(restriction.is_known), len(ids), *ids]
