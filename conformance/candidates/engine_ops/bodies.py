"""The BODY block of FORMAT.md as a body's row of the engine, and what is written of one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from conformance.candidates.engine_ops.values import floats, position
from engine import layout as at
from engine.body_layout import BODY_DTYPE
from engine.constants import DEFAULT_ELASTICITY, DEFAULT_FRICTION, DEFAULT_STATE
from engine.memory import rows_as_numbers

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.query import Fields
    from engine.kernels.types import Array
    from engine.query import Rows

NOWHERE: Final = {"cell": 0, "origin": (0.0, 0.0, 0.0), "rotation": (1.0, 0.0, 0.0, 0.0)}
"""The position of a body that does not say."""
DEFAULTS: Final[Mapping[str, Any]] = {
    "scale": 1.0,
    "state": DEFAULT_STATE,
    "transient_state": 0,
    "velocity": 0.0,
    "acceleration": 0.0,
    "omega": 0.0,
    "friction": DEFAULT_FRICTION,
    "elasticity": DEFAULT_ELASTICITY,
    "contact_plane": 0.0,
    "sliding_normal": 0.0,
    "colliding_with_environment": 0,
    "id": 0,
}
"""Keys of a BODY that the engine's row calls the same, and what they are if absent."""
WEENIE_BITS: Final = {"impenetrable": 0x80, "player": 0x100, "pk": 0x800, "pklite": 0x1000}
"""Flags of a `weenie` block, as ObjectInfo bits (04, OI-4)."""


class LiveBody:
    """A body of the engine.

    Attributes
    ----------
    rows : ndarray of `engine.body_layout.BODY_DTYPE`
        One record.
    record : record of that type
        The same one, for its fields by name.
    row : ndarray
        The same memory, as kernels see it.
    """

    def __init__(self, block: Mapping[str, Any], cell: int = 0) -> None:
        self.rows: Final[Rows] = np.zeros(1, dtype=BODY_DTYPE)
        self.record: Final[Any] = self.rows[0]
        self.row: Final[Array] = rows_as_numbers(self.rows)[0]
        self.row[: at.POSITION_SIZE] = position(block.get("position", NOWHERE))
        record = self.record
        record["cell"] = cell
        for name, default in DEFAULTS.items():
            record[name] = block.get(name, default)
        record["contact_plane_cell_id"] = block.get("contact_plane_cell", 0)
        record["has_movement_manager"] = block.get("movement_manager", 0)
        record["has_parent"] = block.get("parent", 0)
        if not block.get("no_part_array", 0):
            self._take_parts(block)
        if block.get("weenie") is not None:
            self._take_weenie(block["weenie"])

    def _take_parts(self, block: Mapping[str, Any]) -> None:
        """Take what a body has of its part array; one without has no spheres, and steps nowhere (04 OI-2)."""
        record, spheres = self.record, block.get("spheres", ())
        record["num_sphere"] = len(spheres)
        if spheres:
            record["spheres"][: len(spheres)] = spheres
        for name in ("step_up_height", "step_down_height", "free_heading"):
            record[name] = block.get(name, 0)

    def _take_weenie(self, weenie: Mapping[str, Any]) -> None:
        self.record["has_weenie"] = 1
        self.record["weenie_bits"] = sum(bit for flag, bit in WEENIE_BITS.items() if weenie.get(flag, 0))
        self.record["bypasses_restrictions"] = weenie.get("bypass", 0)

    def numbers(self, *names: str) -> Fields:
        """Write fields of several numbers, named as in the row."""
        return {name: floats(self.record[name]) for name in names}

    def integers(self, *names: str) -> Fields:
        """Write fields of one whole number, named as in the row."""
        return {name: int(self.record[name]) for name in names}

    def pose(self) -> dict[str, Any]:
        """Write where it is as a POSE block."""
        return {"cell": int(self.record["cell_id"]), **self.numbers("origin", "rotation")}
