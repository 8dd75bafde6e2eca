"""The MOVER, SEED, POSE and path blocks of FORMAT.md as a query row of the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from engine import layout as at

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from engine.kernels.types import Array

PATH_FIELDS: Final = (
    "insert_type",
    "step_down",
    "step_down_amt",
    "walk_interp",
    "walkable_allowance",
    "check_walkable",
    "collide",
    "obstruction_ethereal",
    "bldg_check",
    "hits_interior_cell",
)
"""Keys of the path block, 0 if absent; the query row's fields have the same names."""


def query_row(inputs: Mapping[str, Any], begin_cell: int = at.NO_CELL) -> Any:
    """Return a query of mover, start, end and seed; `begin_cell` is an index in the world.

    The row is a record of `engine.layout.QUERY_DTYPE`.
    """
    row = np.zeros(1, dtype=at.QUERY_DTYPE)[0]
    _take_mover(row, inputs["mover"])
    start = inputs["from"]
    row["has_start"] = start is not None
    if start is not None:
        row["start"] = _pose(start)
    row["end"] = _pose(inputs["to"])
    row["begin_cell"] = begin_cell
    row["target_cell"], row["target_object"] = begin_cell, at.NO_OBJECT
    row["placement_allows_sliding"] = inputs.get("placement_allows_sliding", 1)
    _take_seed(row, inputs.get("seed", {}))
    return row


def take_path(row: Any, path: Mapping[str, Any]) -> None:
    """Give a path block to a query."""
    for name in PATH_FIELDS:
        row[name] = path.get(name, 0)


def numbers_of(row: Any) -> Array:
    """Return a query row as consecutive numbers, which is how kernels read it; they may be written."""
    return np.frombuffer(bytearray(row.tobytes()), dtype=np.float64)


def _pose(pose: Mapping[str, Any]) -> Sequence[float]:
    return [pose["cell"], *pose["rotation"], *pose["origin"]]


def _take_mover(row: Any, mover: Mapping[str, Any]) -> None:
    spheres = mover["spheres"]
    row["num_sphere"] = len(spheres)
    row["spheres"][: len(spheres)] = spheres
    row["may_step_down"] = mover["step_down"]
    for name in ("scale", "state", "step_up_height", "step_down_height", "ethereal", "gravity"):
        row[name] = mover[name]
    for name, key in (("mover_id", "id"), ("mover_missile", "missile"), ("target_id", "target_id")):
        row[name] = mover.get(key, 0)
    row["mover_restricted"] = "weenie" in mover and not mover["weenie"].get("bypass", 0)


def _take_seed(row: Any, seed: Mapping[str, Any]) -> None:
    for key, name in (("contact", "contact_plane"), ("last_known", "last_known_contact_plane")):
        plane = seed.get(key)
        if plane is not None:
            row[f"{name}_valid"] = 1
            row[name] = plane["plane"]
            row[f"{name}_cell_id"] = plane["cell"]
            row[f"{name}_is_water"] = plane["is_water"]
    if seed.get("sliding") is not None:
        row["sliding_normal_valid"] = 1
        row["sliding_normal"] = seed["sliding"]
    row["frames_stationary_fall"] = seed.get("frames_stationary_fall", 0)
