"""What is brought near before a query's turn: what it will look up, whatever stands in the rows."""

from __future__ import annotations

import math
from itertools import repeat
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from conformance.bench.sampling import contact_walk, free_flight, tree_calls
from conformance.bench.scenes import CELL, make_scene
from conformance.bench.spots import Surfaces
from engine import Cell, Pose, QueryError, World, find_collisions_many, resolve_many
from engine import layout as at
from engine.kernels.ahead import bring_near
from engine.kernels.approach import MOST, NO_STEPS, STEPS, approach, approach_flight, is_huge, is_large
from engine.kernels.collisions import collide
from engine.kernels.flight import fly_through
from engine.kernels.lattice import NOWHERE, cube_at, half, is_unknown, listed, lists_of, nothing_near
from engine.kernels.octets import BYTES, octet
from engine.memory import rows_as_numbers
from engine.plan import Plan
from engine.probes import count_reordered
from engine.tracing_interpreter import Interpreter

if TYPE_CHECKING:
    from conformance.bench.scenes import BenchScene
    from engine.kernels.types import Array
    from engine.query import Rows

CALLS = 300
MOVES = 1200
"""Enough to be sorted."""
NOT_A_PLACE = (math.nan, math.inf, -math.inf, 1e300, -1e300)
NOT_A_CELL = (-1.0, 1.0, math.nan, math.inf, 1e300)
"""Indices of no cell of a world of one."""


@pytest.fixture(scope="module")
def building() -> BenchScene:
    """Return a scene that no second cache holds."""
    return make_scene("building")


@pytest.fixture(scope="module")
def calls(building: BenchScene) -> Rows:
    """Return calls of movers on the ground."""
    return tree_calls(building, Surfaces(building.geometry), np.random.default_rng(1), CALLS).rows


def brought(world: World, rows: Rows) -> list[list[tuple[bool, int]]]:
    """Return what has been brought in the turn of each row, as in a batch, and in those before the first.

    Each is a place, and whether it is one of the world's floats.
    """
    floats, ints = world.arrays
    places: list[tuple[bool, int]] = []
    noted = {bring_near: lambda array, first, _: places.append((array is floats, int(first)))}
    step: Any = Interpreter(noted).function(approach)
    numbers = rows_as_numbers(rows)
    steps, turns = NO_STEPS, []
    with np.errstate(all="ignore"):
        for row in [*numbers, *repeat(numbers[-1], STEPS - 1)]:
            places.clear()
            steps = step(floats, ints, row, row[at.Q_TARGET_CELL], steps)
            turns.append(list(places))
    return turns


def polygons_near(scene: BenchScene, center: Array) -> list[int]:
    """Return the polygons that the cube of a point of the tree lists."""
    told: Any = {
        name: Interpreter({}).function(name) for name in (cube_at, half, is_unknown, listed, lists_of)
    }
    ints, root = scene.world.ints, scene.world.tree_of(0)
    entry, cube = told[cube_at](scene.world.floats, ints, root, *center)
    assert entry != NOWHERE
    word = told[half](ints, ints[entry], cube)
    if told[is_unknown](word):
        return []
    return [told[half](ints, told[lists_of](ints, root), i) for i in range(*told[listed](word))]


def looked_up(scene: BenchScene, rows: Rows) -> list[Array]:
    """Return where the first sphere of each call is first looked up, in the frame of the tree."""
    end = rows["end"][:, -3:] + rows["spheres"][:, 0, :3]
    places: Array = scene.to_cell(end - np.array(scene.pose.origin))
    return list(places)


def test_the_polygons_of_a_call_are_brought_in_the_turn_before_its_own(
    building: BenchScene, calls: Rows
) -> None:
    """They are those that its sphere's cube lists, the first of them; and there are some."""
    turns = brought(building.world, calls)
    found = 0
    for call, center in enumerate(looked_up(building, calls)):
        expected = polygons_near(building, center)[: int(MOST)]
        assert [place for of_floats, place in turns[call + STEPS - 1] if of_floats] == expected
        found += len(expected)
    assert found > 2 * CALLS


def test_a_call_looks_up_where_it_was_expected_to(building: BenchScene, calls: Rows) -> None:
    """What the kernel that looks it up is told of the first sphere is what was computed ahead of it."""
    asked: list[tuple[float, ...]] = []
    world = building.world

    def note(_wf: Any, _wi: Any, _s: Any, _root: int, sphere: tuple[float, ...], _: int) -> bool:
        asked.append(sphere[:3])
        return False

    watched: Any = Interpreter({nothing_near: note}).function(collide)
    some = calls[0:40:2].copy()
    rows = rows_as_numbers(some)
    for row, center in zip(rows, looked_up(building, some), strict=True):
        asked.clear()
        watched(world.floats, world.ints, world.new_row(), row, np.zeros(at.RESULT_SIZE))
        assert asked[0] == pytest.approx(center, abs=1e-3)


@pytest.mark.parametrize("place", NOT_A_PLACE)
def test_nothing_is_brought_for_who_is_in_no_cube(building: BenchScene, calls: Rows, place: float) -> None:
    """A place that is no number, or beyond all cubes, is looked up nowhere."""
    rows = calls[:3].copy()
    rows["end"][:, -1] = place
    assert brought(building.world, rows) == [[]] * (len(rows) + STEPS - 1)


@pytest.mark.parametrize("cell", NOT_A_CELL)
def test_nothing_is_brought_for_a_cell_that_is_not_there(
    building: BenchScene, calls: Rows, cell: float
) -> None:
    """A row that names no cell is refused in its turn, and not looked into before."""
    rows = calls[:3].copy()
    rows["target_cell"] = cell
    assert brought(building.world, rows) == [[]] * (len(rows) + STEPS - 1)


def test_nothing_is_brought_for_a_cell_without_a_tree(calls: Rows) -> None:
    """It has no gate, nor has it a place before the first of the numbers."""
    rows = calls[:3].copy()
    assert brought(World([Cell(CELL, Pose(CELL), None)]), rows) == [[]] * (len(rows) + STEPS - 1)


def put_strangers(rows: Rows, cell: str) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Have some rows name no cell, in a field, or no place; tell which do neither."""
    others = np.ones(len(rows), dtype=bool)
    for k, (nowhere, place) in enumerate(zip(NOT_A_CELL, NOT_A_PLACE, strict=True)):
        rows[cell][7 + 10 * k] = nowhere
        rows["end"][8 + 10 * k, -3:] = place
        others[7 + 10 * k : 9 + 10 * k] = False
    return others


def test_strangers_between_others_change_no_answer(building: BenchScene, calls: Rows) -> None:
    """Each call is answered as it is alone, whoever comes after it."""
    world, rows = building.world, calls.copy()
    alone = np.concatenate([find_collisions_many(world, rows[i : i + 1]) for i in range(len(rows))])
    others = put_strangers(rows, "target_cell")
    out = np.zeros(len(rows), dtype=at.RESULT_DTYPE)
    with pytest.raises(QueryError, match="row 7"):
        find_collisions_many(world, rows, out=out)
    assert out[others].tobytes() == alone[others].tobytes()


def test_strangers_between_movers_change_no_answer(building: BenchScene) -> None:
    """Each move is answered as it is without knowing who comes next; the first of them may begin nowhere."""
    rows = contact_walk(building, Surfaces(building.geometry), np.random.default_rng(2), MOVES).rows
    put_strangers(rows, "begin_cell")
    answers = [np.zeros(len(rows), dtype=at.RESULT_DTYPE) for _ in range(2)]
    for coherent, out in enumerate(answers):
        with count_reordered() as reordered, pytest.raises(QueryError, match="row 17"):
            resolve_many(building.world, rows, coherent=bool(coherent), out=out)
        assert reordered.queries == coherent * len(rows)
    assert answers[0].tobytes() == answers[1].tobytes()


def test_only_in_a_large_world_calls_are_approached(building: BenchScene) -> None:
    """A cache holds a room as a whole, but not sixteen."""
    large: Any = Interpreter({}).function(is_large)
    room = make_scene("room").world
    assert large(building.world.floats, building.world.ints)
    assert not large(room.floats, room.ints)


def brought_for_flight(world: World, row: Array) -> list[int]:
    """Return which of the world's integers are brought near for a move through the air."""
    floats, ints = world.arrays
    places: list[int] = []

    def note(array: Array, first: int, _: int) -> None:
        assert array is ints
        places.append(int(first))

    with np.errstate(all="ignore"):
        step: Any = Interpreter({bring_near: note}).function(approach_flight)
        step(floats, ints, row)
    return places


def looked_at_in_flight(world: World, row: Array) -> list[int]:
    """Return which of the world's integers hold the cubes that a move looks at, one after the other."""
    floats, ints = world.arrays
    read: Any = Interpreter({}).function(octet)
    places: list[int] = []

    def note(numbers: Array, place: int) -> int:
        places.append(int(place) // int(BYTES))
        byte: int = read(numbers, place)
        return byte

    watched: Any = Interpreter({octet: note}).function(fly_through)
    out, after = np.zeros(at.RESULT_SIZE), np.zeros(at.RESULT_SIZE)
    assert watched(floats, ints, world.new_row(plan=Plan()), row, out, after)
    return places


def test_what_a_flight_looks_at_is_brought(building: BenchScene) -> None:
    """The four cubes, of which the one above or below lies beside the middle one, and nothing else."""
    building.world.prepare()
    rows = rows_as_numbers(free_flight(building, np.random.default_rng(4), 100).rows)
    for row in rows:
        middle, beside, east_west, north_south = looked_at_in_flight(building.world, row)[:4]
        assert brought_for_flight(building.world, row) == [middle, east_west, north_south]
        assert abs(beside - middle) <= 1


@pytest.mark.parametrize("place", NOT_A_PLACE)
def test_nothing_is_brought_for_a_flight_to_nowhere(building: BenchScene, place: float) -> None:
    """A way whose middle is no number, or beyond all cubes, is not looked up."""
    building.world.prepare()
    rows = free_flight(building, np.random.default_rng(4), 1).rows
    rows["end"][:, -1] = place
    assert brought_for_flight(building.world, rows_as_numbers(rows)[0]) == []


@pytest.mark.parametrize("cell", NOT_A_CELL)
def test_nothing_is_brought_for_a_flight_in_no_cell(building: BenchScene, cell: float) -> None:
    """A row that names no cell is refused in its turn."""
    building.world.prepare()
    rows = free_flight(building, np.random.default_rng(4), 1).rows
    rows["begin_cell"] = cell
    assert brought_for_flight(building.world, rows_as_numbers(rows)[0]) == []


def test_only_in_a_huge_world_flights_are_approached(building: BenchScene) -> None:
    """What a flight looks up of sixteen rooms stays in a cache, what it does of a dungeon doesn't."""
    huge: Any = Interpreter({}).function(is_huge)
    dungeon = make_scene("dungeon").world
    assert huge(dungeon.floats, dungeon.ints)
    assert not huge(building.world.floats, building.world.ints)


def test_strangers_between_flights_change_no_answer() -> None:
    """In a dungeon each flight is answered as it is alone, whoever comes after it."""
    dungeon = make_scene("dungeon")
    dungeon.world.prepare()
    rows = free_flight(dungeon, np.random.default_rng(5), CALLS).rows
    alone = np.concatenate([resolve_many(dungeon.world, rows[i : i + 1]) for i in range(len(rows))])
    others = put_strangers(rows, "begin_cell")
    out = np.zeros(len(rows), dtype=at.RESULT_DTYPE)
    with pytest.raises(QueryError, match="row 17"):
        resolve_many(dungeon.world, rows, out=out)
    assert out[others].tobytes() == alone[others].tobytes()
    assert (out["skipped"][others, 3] > 0).all()
