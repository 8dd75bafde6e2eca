"""Bodies for tests of the engine's ticks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from engine_scenes import CELL, R, at, floor_and_wall, world_of

from engine import Body, body_rows
from engine.memory import rows_as_numbers

if TYPE_CHECKING:
    from engine.kernels.types import Array

GRAVITY = float(np.float32(-9.8))
ACTIVE = 0x80
GROUNDED = 0x83
"""Active, in contact, on a walkable."""


def f32(x: float) -> float:
    """Round to float32."""
    return float(np.float32(x))


def walker(x: float = 0.0, y: float = 0.0, z: float = R, **fields: Any) -> Body:
    """Return a body of two spheres, the usual steps and no friction, that is steered."""
    given: dict[str, Any] = {
        "step_up_height": 0.6,
        "step_down_height": 1.5,
        "friction": 0.0,
        "has_movement_manager": True,
    }
    return Body(at(x, y, z), [(0.0, 0.0, 0.0, R), (0.0, 0.0, 0.875, R)], **(given | fields))


def grounded(x: float = 0.0, y: float = 0.0, **fields: Any) -> Body:
    """Return a walker that stands on the floor."""
    floor = {"transient_state": GROUNDED, "contact_plane": (0, 0, 1, 0), "contact_plane_cell": CELL}
    return walker(x, y, R, **(floor | fields))


def row_of(body: Body) -> tuple[Any, Array]:
    """Return a body's record, and the same memory as numbers."""
    rows = body_rows(world_of(floor_and_wall()), [body])
    return rows[0], rows_as_numbers(rows)[0]
