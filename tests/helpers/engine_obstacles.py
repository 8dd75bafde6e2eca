"""One obstacle in an empty cell, and a mover that is tested against it.

Unless a test says otherwise the obstacle is at the block's origin, and has a radius of 1 metre; the mover's
spheres have one of 0.5.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from engine_scenes import CELL, at

from engine import Cell, Move, Mover, ObjectCall, Obstacle, PathState, Pose, Seed, Target, World
from engine import find_object_collisions as find
from engine.constants import STATE_NAMES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from engine import Shape

EPS = float(np.float32(0.0002))
RADIUS = 0.5
"""Of the mover's spheres."""
STEP_UP = 0.25
"""The mover's step-up height: lower than any obstacle."""
FLOOR_Z = 0.6641741394996643
"""Smallest normal z one can walk on."""

CONTACT = 0x3
"""In contact, on a walkable."""
CLIPPED = 0x8
PERFECT = 0x48
"""Path clipped, perfectly."""

HERE = Pose(CELL)


def f32(x: float) -> float:
    """Round to float32."""
    return float(np.float32(x))


def above(x: float) -> float:
    """Return the next float32."""
    return float(np.nextafter(np.float32(x), np.float32(np.inf)))


def mover(*offsets: Sequence[float], state: int = 0, **fields: Any) -> Mover:
    """Return a mover with a sphere at each offset, or at its origin."""
    spheres = [(*offset, RADIUS) for offset in offsets or [(0.0, 0.0, 0.0)]]
    return Mover(spheres, state=state, **({"step_up_height": STEP_UP, "step_down_height": 1.5} | fields))


def world(*obstacles: Obstacle, environment: Shape | None = None) -> World:
    """Return a world of one cell at the block's origin, with obstacles in it."""
    return World([Cell(CELL, HERE, environment, obstacles)])


def call(
    obstacle: Obstacle,
    who: Mover,
    start: Sequence[float] | Pose,
    end: Sequence[float],
    *,
    target: Target = Target.FIRST_SHAPE,
    seed: Seed | None = None,
    **path: float,
) -> Any:
    """Test a mover at `end` that has come from `start`; `path` are fields of `PathState`."""
    given = {"walk_interp": 1.0, "walkable_allowance": FLOOR_Z} | path
    begin = start if isinstance(start, Pose) else at(*start)
    move = Move(who, at(*end), CELL, start=begin, seed=seed or Seed())
    return find(world(obstacle), ObjectCall(move, target, 0, PathState(**given)))  # type: ignore[arg-type]


def answer(result: Any) -> str:
    """Return the name of the TransitionState."""
    return STATE_NAMES[int(result["result"])]


def origin(result: Any) -> list[float]:
    """Return where the mover is in the end."""
    return [float(v) for v in result["check"][5:]]


def contact(result: Any) -> list[float] | None:
    """Return normal and d of the contact plane, which must be water in the cell, or None."""
    if not result["contact_plane_valid"]:
        return None
    assert (result["contact_plane_is_water"], result["contact_plane_cell_id"]) == (1, CELL)
    return [float(v) for v in result["contact_plane"]]


def normal(result: Any) -> list[float] | None:
    """Return the collision normal, or None."""
    return [float(v) for v in result["collision_normal"]] if result["collision_normal_valid"] else None
