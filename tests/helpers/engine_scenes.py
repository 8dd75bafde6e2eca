"""Small worlds for tests of the engine."""

from __future__ import annotations

import numpy as np

from engine import Cell, Leaf, Mover, Node, Pose, Shape, World

CELL = 0xA9B40111
"""Id of the only cell."""
HALF_TURN_OF_45_DEGREES = (0.9238795, 0.0, 0.0, 0.38268343)
"""A yaw of 45 degrees, as w, x, y, z."""
R = float(np.float32(0.48))
"""Radius of the usual mover, metres."""


def triangle(size: float = 5.0, z: float = 0.0) -> Shape:
    """Return a floor: one triangle facing up."""
    corners = [(-size, -size, z), (size, -size, z), (0.0, size, z)]
    return Shape(corners, [(0, 1, 2)], Leaf((0.0, 0.0, z, 2.0 * size), (0,)), name="floor")


def floor_and_wall() -> Shape:
    """Return a floor, and a wall at x = 1 that faces back to the origin, behind a splitting plane."""
    vertices = [(-5, -5, 0), (5, -5, 0), (5, 5, 0), (-5, 5, 0), (1, -5, 0), (1, -5, 3), (1, 5, 3), (1, 5, 0)]
    bounds = (0.0, 0.0, 1.0, 9.0)
    tree = Node((1.0, 0.0, 0.0, -1.0), bounds, Leaf(bounds, (0, 1)), Leaf(bounds, (0, 1)))
    return Shape(vertices, [(0, 1, 2, 3), (4, 5, 6, 7)], tree, name="corner")


def seed_world() -> World:
    """Return the world that this project starts from: a floor in a cell turned by 45 degrees."""
    return World([Cell(CELL, Pose(CELL, (100.0, 50.0, 94.0), HALF_TURN_OF_45_DEGREES), triangle())])


def world_of(shape: Shape, **cell: object) -> World:
    """Return a world of one cell at the block's origin, prepared."""
    return prepared(World([Cell(CELL, Pose(CELL), shape, **cell)]))  # type: ignore[arg-type]


def prepared(world: World) -> World:
    """Return a world of which enough has been asked for all shortcuts to be taken."""
    world.prepare()
    return world


def mover(state: int = 0, *, spheres: int = 1) -> Mover:
    """Return a mover of one or two spheres, the usual steps, and gravity."""
    centers = [(0.0, 0.0, 0.0, R), (0.0, 0.0, 0.875, R)]
    return Mover(centers[:spheres], state=state, step_up_height=0.6, step_down_height=1.5)


def at(x: float, y: float, z: float) -> Pose:
    """Return a pose in the only cell."""
    return Pose(CELL, (x, y, z))
