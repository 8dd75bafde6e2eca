"""How much work a mover may ask for: retail has no bound, so that a speck would walk for years.

A move goes in steps of the first sphere's radius (05, 2), and a place is looked for in rings of positions
that are a radius apart (05, 8). What is asked for in words is held to the bounds here, with numbers in the
error; rows that are given as they are, by the kernels (`engine.layout.STATUS_ENDLESS`).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from engine.constants import BLOCK_EDGE, MAX_STEPS, MAX_VELOCITY, SPECK
from engine.errors import QueryError
from engine.layout import RADIUS

if TYPE_CHECKING:
    from engine.kernels.types import Array
    from engine.query import Rows


def check_way(start: Array | None, end: Array, radius: float, where: str) -> None:
    """Check that a move, or a placement, comes to an end.

    Parameters
    ----------
    start, end : ndarray, shape (8,)
        Poses as `engine.pose.pose_row` writes them; without a start the mover is put down.
    radius : float
        Of the first sphere, scaled, metres.
    where : str
        What it is, for the error.

    Raises
    ------
    QueryError
        If it takes more than `MAX_STEPS` steps, or puts down a speck.
    """
    if start is not None:
        _check_steps(_distance(start, end), radius, where)
    elif radius < SPECK:
        raise QueryError(where, f"radius {radius:.6g} m where at least {SPECK:.6g} m can be put down")


def check_tick(rows: Rows, seconds: float) -> None:
    """Check that no body, however fast, takes more than `MAX_STEPS` steps in a tick.

    Raises
    ------
    QueryError
        Naming the first one that might.
    """
    radii = np.where(rows["num_sphere"] > 0, rows["spheres"][:, 0, RADIUS] * rows["scale"], math.inf)
    for index in np.flatnonzero(seconds * MAX_VELOCITY > MAX_STEPS * radii):
        _check_steps(seconds * MAX_VELOCITY, float(radii[index]), f"body {index}")


def _distance(start: Array, end: Array) -> float:
    blocks = int(start[0]) >> 16, int(end[0]) >> 16
    east = (blocks[1] >> 8) - (blocks[0] >> 8)
    north = (blocks[1] & 0xFF) - (blocks[0] & 0xFF)
    x, y, z = (end[-3:] - start[-3:]).tolist()
    return math.hypot(x + BLOCK_EDGE * east, y + BLOCK_EDGE * north, z)


def _check_steps(distance: float, radius: float, where: str) -> None:
    if distance > MAX_STEPS * radius:
        found = f"{distance:.6g} m with a sphere of radius {radius:.6g} m"
        raise QueryError(where, f"{found}: more than {MAX_STEPS} steps")
