"""Grids and lattices are made when enough has been asked of a world, and not before; no answer changes."""

from __future__ import annotations

import math
import pickle
from threading import Barrier, Thread
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_scenes import CELL, R, at, mover, triangle
from random_moves import random_moves

from conformance.candidates.engine_ops.worlds import build_world
from conformance.strategies.worlds.sites import SITES, site
from engine import (
    Cell,
    Move,
    Plan,
    Pose,
    Prepared,
    Stage,
    UndeterminedError,
    World,
    layout,
    resolve,
    resolve_many,
    strike_many,
)
from engine import world as world_module
from engine.compiling import near
from engine.probes import without_work
from engine.query import move_rows

if TYPE_CHECKING:
    from engine.query import Rows

ENOUGH = near._FEWEST
"""Queries of a world of one polygon."""
FALL = Move(mover(spheres=2), at(0.0, 0.0, R + 0.0005), CELL, start=at(0.0, 0.0, 0.75))
"""To half a millimetre above the floor: too near for a free flight, and it touches nothing."""


def floor_world() -> World:
    """Return a world of one polygon, of which nothing has been asked."""
    return World([Cell(CELL, Pose(CELL), triangle())])


def is_prepared(world: World) -> bool:
    """Say whether a world's first tree has both a grid and a lattice; there is never only one of them."""
    grid = world.ints[world.ints[layout.WORLD_CLEARANCES]] != layout.NO_CLEARANCE
    gate = layout.NODE_FLOATS * (world.tree_of(0) + layout.GATE)
    assert grid == (world.floats[gate + layout.LATTICE_COUNTS] > 0.0)
    return bool(grid)


def falls(world: World, count: int) -> Rows:
    """Return rows of so many falls."""
    return np.repeat(move_rows(world, [FALL]), count)


def answers(world: World, rows: Rows) -> dict[str, bytes]:
    """Return all that is answered but for the work that it took."""
    try:
        results = resolve_many(world, rows)
    except UndeterminedError as error:
        results = error.results
    return without_work(results)


def test_a_single_query_makes_none() -> None:
    """Nor does a world that is only made."""
    world = floor_world()
    arrays = world.arrays
    assert resolve(world, FALL)["result"] == 1
    assert not is_prepared(world)
    assert world.arrays is arrays


def test_a_large_batch_makes_them_first() -> None:
    """And takes the shortcut with its first query."""
    world = floor_world()
    skipped = resolve_many(world, falls(world, ENOUGH))["skipped"][:, list(Stage).index(Stage.WALKS)]
    assert is_prepared(world)
    assert (skipped > 0.0).all()


def test_small_batches_add_up() -> None:
    """The one that makes them is that with which they are enough."""
    world = floor_world()
    rows = falls(world, ENOUGH // 4)
    for number in range(1, 5):
        resolve_many(world, rows)
        assert is_prepared(world) == (number == 4)


@pytest.mark.parametrize("prepare", [False, True])
def test_a_prepared_query_keeps_what_the_world_had(prepare: bool) -> None:
    """However often it is asked: to count would take half as long as the answer."""
    world = floor_world()
    if prepare:
        world.prepare()
    query = Prepared(world, FALL)
    for _ in range(2 * ENOUGH):
        query.run()
    assert is_prepared(world) == prepare
    world.prepare()
    assert (query.run()["skipped"][list(Stage).index(Stage.WALKS)] > 0.0) == prepare


@pytest.mark.parametrize("plan", [Plan.none(), Plan(Stage.BOUNDS | Stage.OBJECTS)])
def test_who_looks_nothing_up_makes_none(plan: Plan) -> None:
    """However much is asked; the next one who does makes them."""
    world = floor_world()
    resolve_many(world, falls(world, 2 * ENOUGH), plan=plan)
    assert not is_prepared(world)
    resolve(world, FALL)
    assert is_prepared(world)


def test_strikes_make_none() -> None:
    """Walks that are asked for by themselves are always made."""
    world = floor_world()
    strike_many(world, 0, np.tile((0.0, 0.0, 0.25, 0.5), (2 * ENOUGH, 1)), np.zeros((2 * ENOUGH, 3)))
    resolve(world, FALL)
    assert not is_prepared(world)


def test_a_world_without_polygons_has_nothing_to_make() -> None:
    """Its arrays stay what they are."""
    cell = Cell(CELL, Pose(CELL), None)
    world = World([cell])
    arrays = world.arrays
    resolve_many(world, falls(world, 2 * ENOUGH))
    assert world.arrays is arrays


def test_they_are_made_ahead_once() -> None:
    """`prepare` makes them; another one does nothing."""
    world = floor_world()
    world.prepare()
    assert is_prepared(world)
    arrays = world.arrays
    world.prepare()
    resolve_many(world, falls(world, 2 * ENOUGH))
    assert world.arrays is arrays


def test_arrays_that_somebody_holds_are_left_as_they_are() -> None:
    """Another thread may be at work on them; the new ones begin with what they say, but for the tables."""
    world = floor_world()
    floats, ints = world.arrays
    copies = floats.copy(), ints.copy()
    world.prepare()
    assert (floats.tobytes(), ints.tobytes()) == tuple(copy.tobytes() for copy in copies)
    gate = world.tree_of(0) + layout.GATE
    changed = np.flatnonzero(world.floats[: len(floats)] != floats)
    assert set(changed // layout.NODE_FLOATS) == {gate}
    changed = np.flatnonzero(world.ints[: len(ints)] != ints)
    assert set(changed) - {ints[layout.WORLD_CLEARANCES]} <= {layout.NODE_INTS * gate + k for k in range(2)}


@pytest.mark.parametrize("name", sorted(SITES))
def test_answers_are_the_same_before_and_after(name: str) -> None:
    """In every site of the random worlds, on every bit of every output."""
    place = site(name)
    world = build_world(place.world, place.geometries)
    rows = random_moves(name, np.random.default_rng(17), 300)
    arrays = world.arrays
    before = answers(world, rows)
    assert world.arrays is arrays
    world.prepare()
    assert world.arrays is not arrays
    assert answers(world, rows) == before


def test_threads_that_ask_at_once_make_them_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """One does; the others go on without, and nobody waits. All get the same answers."""
    world, made = floor_world(), []

    def counted(*given: Any) -> Any:
        made.append(given)
        return near.with_what_is_near(*given)

    monkeypatch.setattr(world_module, "with_what_is_near", counted)
    rows, start = falls(world, ENOUGH), Barrier(4)
    found: list[list[bytes]] = []

    def ask() -> None:
        start.wait()
        found.append(answers(world, rows))

    threads = [Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(made) == 1
    assert is_prepared(world)
    assert len(found) == 4
    assert all(one == found[0] for one in found)


def test_what_could_not_be_made_is_made_later(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever is interrupted leaves a world as it was."""
    world = floor_world()
    with monkeypatch.context() as patch:
        patch.setattr(world_module, "with_what_is_near", _interrupted)
        with pytest.raises(KeyboardInterrupt):
            resolve_many(world, falls(world, ENOUGH))
    assert not is_prepared(world)
    resolve(world, FALL)
    assert is_prepared(world)


def _interrupted(*_: Any) -> Any:
    raise KeyboardInterrupt


@pytest.mark.parametrize("prepare", [False, True])
def test_a_world_that_was_pickled_goes_on(prepare: bool) -> None:
    """Before or after; its copy has what it has, and can make what it hasn't."""
    world = floor_world()
    if prepare:
        world.prepare()
    copied = pickle.loads(pickle.dumps(world))  # noqa: S301 - written here
    assert is_prepared(copied) == prepare
    copied.prepare()
    assert is_prepared(copied)
    assert answers(copied, falls(copied, 3)) == answers(world, falls(world, 3))


def test_many_polygons_need_many_queries() -> None:
    """What is made takes longer, the more there are; a world without any never has enough."""
    tree: Any = type("Tree", (), {"shape": triangle()})
    assert near.queries_expected_to_pay([tree] * 3) == ENOUGH
    assert near.queries_expected_to_pay([tree] * 3 * ENOUGH) == 3 * ENOUGH
    assert near.queries_expected_to_pay([]) == math.inf
