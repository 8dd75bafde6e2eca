"""The table from cell ids to cells, as `engine.kernels.cell_ids` reads it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from engine.kernels.cell_ids import FREE, id_slot

if TYPE_CHECKING:
    from collections.abc import Mapping

    from engine.kernels.types import Ints


def id_table(indices: Mapping[int, int]) -> Ints:
    """Return a table of ids and their indices, at most a quarter full.

    Parameters
    ----------
    indices : Mapping of int to int
        The index of each environment cell by its id, and of each landblock's first land cell by the id
        of the block with the low word 0.
    """
    size = 4
    while size < 4 * len(indices):
        size *= 2
    table = np.full((size, 2), FREE, dtype=np.int64)
    for cell_id, index in indices.items():
        slot = id_slot(cell_id, size - 1)
        while table[slot, 0] != FREE:
            slot = (slot + 1) & (size - 1)
        table[slot] = cell_id, index
    return table.ravel()
