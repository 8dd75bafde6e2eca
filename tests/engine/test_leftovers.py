"""What a transition leaves in its row is nothing to the next, though half of the row is not cleared."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from random_moves import random_bodies, random_moves, world_at

from conformance.strategies.worlds.sites import SITES
from engine import (
    Plan,
    UndeterminedError,
    body_rows,
    find_collisions_many,
    find_object_collisions_many,
    resolve_many,
    step_many,
)
from engine import layout as at
from engine.constants import TARGET_CELL
from engine.world import World

if TYPE_CHECKING:
    from collections.abc import Callable

    from engine.kernels.types import Array
    from engine.query import Rows

QUERIES = 400
"""In each site, of each kind."""
BODIES, TICKS = 20, 20
LEFTOVERS = (0.0, np.nan, -7.25e3)
"""What may stand in a row where it is not cleared."""


def assert_left_alone(monkeypatch: pytest.MonkeyPatch, ask: Callable[[], bytes]) -> None:
    """Assert that answers are the same whatever stands in a row, before each call of the engine."""
    take = World.take_row
    answers = set()
    for number in LEFTOVERS:

        def filled(world: World, plan: Plan, number: float = number) -> Array:
            row = take(world, plan)
            row[at.CLEARED_SIZE : at.STATE_SIZE] = number
            return row

        monkeypatch.setattr(World, "take_row", filled)
        answers.add(ask())
    assert len(answers) == 1


def alone(ask: Callable[[World, Rows], Rows], world: World, rows: Rows) -> bytes:
    """Return the answers to rows that are asked one by one: none leaves anything but to a filled row."""
    answers = []
    for i in range(len(rows)):
        try:
            answers.append(ask(world, rows[i : i + 1]).tobytes())
        except UndeterminedError as error:
            answers.append(error.results.tobytes())
    return b"".join(answers)


def calls_of(name: str) -> Rows:
    """Return single calls at the ends of random moves, in every state of a path."""
    rng = np.random.default_rng(3)
    rows = random_moves(name, rng, QUERIES)
    count = len(rows)
    rows["target_kind"], rows["target_cell"] = TARGET_CELL, rows["begin_cell"]
    rows["target_object"] = at.NO_OBJECT
    rows["insert_type"] = rng.choice([0, 0, 0, 1, 2], size=count)
    for flag in ("step_down", "check_walkable", "collide", "obstruction_ethereal"):
        rows[flag] = rng.random(count) < 0.2
    rows["step_down_amt"], rows["walk_interp"] = 1.5, 1.0
    rows["walkable_allowance"] = np.float32(0.2)
    return rows


@pytest.mark.parametrize("name", sorted(SITES))
def test_moves(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Moves, and placements."""
    world, rows = world_at(name), random_moves(name, np.random.default_rng(2), QUERIES)
    assert_left_alone(monkeypatch, lambda: alone(resolve_many, world, rows))


@pytest.mark.parametrize("name", sorted(SITES))
def test_calls_of_cells(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Single calls of a cell with all that is in it."""
    world, rows = world_at(name), calls_of(name)
    assert_left_alone(monkeypatch, lambda: alone(find_object_collisions_many, world, rows))


@pytest.mark.parametrize("name", sorted(SITES))
def test_calls_of_trees(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Single calls of a cell's tree, which may step up and run an insert of their own."""
    world, rows = world_at(name), calls_of(name)
    rows = rows[[world.tree_of(int(cell)) != at.NO_TREE for cell in rows["target_cell"]]]
    assert_left_alone(monkeypatch, lambda: alone(find_collisions_many, world, rows))


@pytest.mark.parametrize("name", sorted(SITES))
def test_bodies(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Bodies that tick."""
    world = world_at(name)
    bodies = random_bodies(name, np.random.default_rng(11), BODIES)

    def ticked() -> bytes:
        rows = body_rows(world, bodies)
        for _ in range(TICKS):
            for i in range(len(rows)):
                step_many(world, rows[i : i + 1], 0.05, 1)
        return rows.tobytes()

    assert_left_alone(monkeypatch, ticked)
