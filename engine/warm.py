"""Compilation ahead of the first query."""

from __future__ import annotations

from typing import Final

import numpy as np

from engine.batch import find_collisions, find_object_collisions_many, resolve
from engine.body import Body, body_rows
from engine.cells import Cell
from engine.geometry import Leaf, Shape
from engine.layout import QUERY_DTYPE
from engine.pose import Pose
from engine.query import CollisionCall, Move, Mover
from engine.step import step_many, update_many
from engine.trees import step_down_many, strike_many
from engine.world import World

_CELL: Final = 0x01000100


def warmup() -> None:
    """Compile, or load from the cache, all that queries and ticks run.

    The first query of each kind would do it, and take the time then. Compiled code is kept on disk until
    the engine's sources change (`engine.kernels.compile`), so that only the first process compiles.
    """
    floor = Shape([(-5, -5, 0), (5, -5, 0), (0, 5, 0)], [(0, 1, 2)], Leaf((0, 0, 0, 10), (0,)))
    world = World([Cell(_CELL, Pose(_CELL), floor)])
    world.prepare()
    start, end = Pose(_CELL, (0, 0, 1)), Pose(_CELL, (0, 0, 0.5))
    move = Move(Mover([(0, 0, 0, 0.5)]), end, _CELL, start=start)
    resolve(world, move)
    find_collisions(world, CollisionCall(move))
    find_object_collisions_many(world, np.zeros(0, dtype=QUERY_DTYPE))
    bodies = body_rows(world, [Body(start, [(0, 0, 0, 0.5)])])
    step_many(world, bodies, 0.1, 1)
    update_many(world, bodies, 1.0)
    spheres, ways = [(0.0, 0.0, 0.25, 0.5)], [(0.0, 0.0, -0.5)]
    strike_many(world, 0, spheres, ways)
    step_down_many(world, 0, spheres, ways, [(0.0, 0.0, 1.0)], [0.5], [1.0])
