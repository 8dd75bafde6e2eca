"""Moves that would not end for years are refused, with what makes them so long."""

from __future__ import annotations

import numpy as np
import pytest
from engine_scenes import CELL, at, floor_and_wall, world_of

from engine import Body, Move, Mover, QueryError, body_rows, step_many, update_many
from engine.effort import MAX_STEPS, SPECK, check_way
from engine.query import move_rows

WORLD = world_of(floor_and_wall())
RADIUS = 2.0**-10


def mover(radius: float) -> Mover:
    """Return a mover of one sphere."""
    return Mover([(0.0, 0.0, 0.0, radius)])


def test_the_longest_move_has_just_so_many_steps() -> None:
    """One float more is too long; the way across blocks counts."""
    longest = MAX_STEPS * RADIUS
    start, end = np.zeros(8), np.zeros(8)
    end[5] = longest
    check_way(start, end, RADIUS, "move")
    end[5] = np.nextafter(longest, np.inf)
    with pytest.raises(QueryError, match=r"move: .* more than 200000 steps"):
        check_way(start, end, RADIUS, "move")
    end[:] = 0.0
    end[0] = float(0x0200_0000)
    with pytest.raises(QueryError, match=r"move: 384 m with a sphere of radius 0\.000976562 m"):
        check_way(start, end, RADIUS, "move")


def test_a_speck_does_not_move_far() -> None:
    """The error names the move."""
    move = Move(mover(1e-30), at(1.0, 0.0, 0.0), CELL, start=at(0.0, 0.0, 0.0))
    with pytest.raises(QueryError, match="move 0: 1 m with a sphere of radius 1e-30 m"):
        move_rows(WORLD, [move])


def test_a_speck_is_not_put_down() -> None:
    """There are too many places to try about it."""
    move_rows(WORLD, [Move(mover(SPECK), at(0.0, 0.0, 0.0), CELL)])
    with pytest.raises(QueryError, match="move 0: radius 5e-05 m"):
        move_rows(WORLD, [Move(mover(SPECK / 2), at(0.0, 0.0, 0.0), CELL)])


def test_a_speck_does_not_tick() -> None:
    """It might be as fast as bodies are; one without spheres does not collide, and may."""
    rows = body_rows(WORLD, [Body(at(0.0, 0.0, 1.0), []), Body(at(0.0, 0.0, 1.0), [(0.0, 0.0, 0.0, 1e-30)])])
    with pytest.raises(QueryError, match="body 1: 5 m with a sphere"):
        step_many(WORLD, rows, 0.1, 1)
    with pytest.raises(QueryError, match="body 1: 10 m with a sphere"):
        update_many(WORLD, rows, 1.0)
    step_many(WORLD, rows[:1], 0.1, 1)
