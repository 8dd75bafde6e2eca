"""Shortcuts change no bit: the same answers with all of them, with each alone, and with none."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from grazing_moves import grazing_moves, hall, littered
from random_moves import random_bodies, random_moves, world_at

from conformance.strategies.worlds.sites import SITES
from engine import Plan, Stage, UndeterminedError, body_rows, resolve_many, step_many
from engine.probes import without_work

if TYPE_CHECKING:
    from engine.query import Rows
    from engine.world import World

QUERIES = 1_000
"""In each site; with its seven plans in all sites more than 50,000."""
GRAZES, HALL_GRAZES = 1_000, 6_000
"""In each site, and in the hall; few of the latter are far enough from everything to be flights."""


def resolved(world: World, rows: Rows, plan: Plan) -> Rows:
    """Return the answers, those included of which retail's is not known."""
    try:
        return resolve_many(world, rows, plan=plan)
    except UndeterminedError as error:
        answers: Rows = error.results
        return answers


def assert_alike(world: World, rows: Rows) -> None:
    """Assert that no set of shortcuts changes an answer, and that none but those of the set are taken."""
    without = without_work(resolved(world, rows, Plan.none()))
    for skip in (*Stage, Plan().skip):
        short = resolved(world, rows, Plan(skip=skip))
        assert without_work(short) == without
        counts = zip(Stage, short["skipped"].sum(axis=0), strict=True)
        assert all(stage in skip for stage, count in counts if count)


def queries_of(name: str) -> Rows:
    """Return random moves in a site; the seed is the site's own."""
    return random_moves(name, np.random.default_rng(sorted(SITES).index(name)), QUERIES)


def test_there_are_sites() -> None:
    """Enough for what the number of queries promises."""
    assert len(SITES) * QUERIES * (len(Stage) + 1) > 50_000


@pytest.mark.parametrize("name", sorted(SITES))
def test_moves_are_answered_alike(name: str) -> None:
    """In every site, with every set of shortcuts, on every bit of every output; some are taken."""
    assert_alike(world_at(name), queries_of(name))


@pytest.mark.parametrize("name", sorted(SITES))
def test_what_hardly_touches_is_answered_alike(name: str) -> None:
    """A bound that is too small by a part of a radius shows here, and hardly ever in moves at random."""
    ground = littered(name)
    assert_alike(ground.world, grazing_moves(ground, np.random.default_rng(5), GRAZES))


def test_who_flies_past_things_is_answered_alike() -> None:
    """In a hall with room to fly in, where every second move takes a shortcut and many are stopped."""
    rows = grazing_moves(hall(), np.random.default_rng(5), HALL_GRAZES)
    assert_alike(hall().world, rows)
    found = resolved(hall().world, rows, Plan())
    assert 0.2 < np.mean(found["collision_normal_valid"] != 0.0) < 0.8
    skipped = dict(zip(Stage, (found["skipped"] > 0.0).sum(axis=0), strict=True))
    assert skipped[Stage.FLIGHT] > 20
    assert skipped[Stage.OBJECTS] > 0.5 * HALL_GRAZES


def test_every_shortcut_is_taken_somewhere() -> None:
    """The property above is about something: each stage is skipped more than a hundred times."""
    skipped = np.zeros(len(Stage))
    for name in sorted(SITES):
        rows = random_moves(name, np.random.default_rng(7), 500)
        skipped += resolved(world_at(name), rows, Plan())["skipped"].sum(axis=0)
    assert (skipped > 100).all(), dict(zip(Stage, skipped, strict=True))


@pytest.mark.parametrize("name", sorted(SITES))
def test_bodies_tick_alike(name: str) -> None:
    """A body that flies, falls and lands is the same after each of many ticks."""
    world = world_at(name)
    bodies = random_bodies(name, np.random.default_rng(11), 40)
    short, full = body_rows(world, bodies), body_rows(world, bodies)
    for _ in range(20):
        step_many(world, short, 0.05, 1)
        step_many(world, full, 0.05, 1, plan=Plan.none())
        assert without_work(short) == without_work(full)
    assert not full["skipped"].any()
