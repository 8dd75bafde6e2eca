"""Lattices: every polygon that a sphere can touch is listed, and who must not do without a walk."""

from __future__ import annotations

import math
import tracemalloc
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_scenes import CELL, R, floor_and_wall, mover, prepared, triangle, world_of
from engine_scenes import at as near
from hypothesis import given, settings
from hypothesis import strategies as st

from conformance.bench.sampling import tree_calls
from conformance.bench.scenes import make_scene
from conformance.bench.spots import Surfaces
from engine import Cell, Leaf, Move, Node, Plan, Pose, Shape, Stage, World, find_collisions_many, resolve
from engine import layout as at
from engine.compiling import lattice
from engine.constants import EPS, FLOOR_Z, LATTICE_REACH
from engine.kernels.bsp_poly import sphere_intersects_poly, sphere_intersects_solid
from engine.kernels.bsp_walkable import find_walkable
from engine.kernels.lattice import no_ground_near, nothing_near
from engine.kernels.polygon import polygon_hits_sphere_slow_but_sure
from engine.kernels.polygon_edges import HIT
from engine.tracing_interpreter import Interpreter

if TYPE_CHECKING:
    from collections.abc import Iterator

    from engine.kernels.types import Array, Ints

INTERPRETER = Interpreter({})
LOOK_UP: Any = INTERPRETER.function(nothing_near)
NO_GROUND: Any = INTERPRETER.function(no_ground_near)
WALKS = Plan(Stage.WALKS)
ROOM = make_scene("room").world
FLOOR = world_of(floor_and_wall())


def is_clear(world: World, x: float, y: float, z: float, r: float, center_check: int = 0) -> bool:
    """Say whether the lattice of a world's first cell knows that nothing is near."""
    sphere = tuple(np.float64(value) for value in (x, y, z, r))
    row = world.new_row(plan=WALKS)
    clear = bool(LOOK_UP(world.floats, world.ints, row, world.tree_of(0), sphere, center_check))
    assert row[at.SKIPPED_WALKS] == clear
    return clear


def has_no_ground(world: World, sphere: tuple[float, ...], up: tuple[float, ...], allowance: float) -> bool:
    """Say whether the lattice of a world's first cell knows that there is nothing to stand on."""
    numbers = (tuple(np.float64(value) for value in values) for values in (sphere, up))
    row = world.new_row(plan=WALKS)
    row[at.WALKABLE_ALLOWANCE] = allowance
    none = bool(NO_GROUND(world.floats, world.ints, row, world.tree_of(0), *numbers))
    assert row[at.SKIPPED_WALKS] == none
    return none


def gate_of(world: World) -> tuple[Array, Ints]:
    """Return the numbers and the integers of the gate of a world's first tree."""
    gate = world.tree_of(0) + at.GATE
    floats = world.floats[at.NODE_FLOATS * gate :][: int(at.NODE_FLOATS)]
    return floats, world.ints[at.NODE_INTS * gate :][: int(at.NODE_INTS)]


def words_of(world: World) -> Ints:
    """Return the words of all blocks that are kept."""
    floats, ints = gate_of(world)
    counts = floats[at.LATTICE_COUNTS :][:3].astype(int)
    blocks = world.ints[ints[at.LATTICE_TABLE] :][: counts.prod() >> 3 * int(at.LATTICE_BLOCK)]
    places = np.unique(blocks)[:, np.newaxis] + np.arange(1 << 3 * int(at.LATTICE_BLOCK) - 1)
    pairs = world.ints[places].ravel()
    return np.column_stack((pairs, pairs >> int(at.WORD_BITS))).ravel() & int(at.WORD_MASK)


def counts_in(words: Ints) -> Ints:
    """Return how many polygons words list."""
    counts: Ints = words >> int(at.WORD_COUNT_SHIFT) & int(at.CROWDED)
    return counts


@pytest.mark.parametrize(
    ("center", "r", "center_check", "clear"),
    [
        ((-1.5, 0.0, 1.5), R, 0, True),
        ((-1.5, 0.0, 1.5), R, 1, True),
        ((-1.5, 0.0, R), R, 0, True),
        ((-1.5, 0.0, R - 0.01), R, 0, False),
        ((1.0 - R + 0.01, 0.0, 1.5), R, 0, False),
        ((-1.5, 0.0, 1.5), LATTICE_REACH, 0, True),
        ((-1.5, 0.0, 1.5), 1.01 * LATTICE_REACH, 0, False),
        ((-1.5, 0.0, 1.5), -R, 0, False),
        ((-1.5, 0.0, 1.5), math.nan, 0, False),
        ((-1.5, 0.0, 1.5), 0.0, 0, True),
        ((-1.5, 0.0, 90.0), R, 0, False),
        ((math.nan, 0.0, 1.5), R, 0, False),
        ((math.inf, 0.0, 1.5), R, 0, False),
    ],
    ids=[
        "in mid-air",
        "where nothing is solid",
        "standing on the floor",
        "in the floor",
        "in the wall",
        "as large as may be",
        "a larger one",
        "of a negative radius",
        "of no size",
        "a point",
        "outside of the box",
        "nowhere",
        "at infinity",
    ],
)
def test_what_is_known(center: tuple[float, float, float], r: float, center_check: int, clear: bool) -> None:
    """Of spheres in the box that touch nothing; of all others the tree is asked."""
    assert is_clear(FLOOR, *center, r, center_check) == clear


@pytest.mark.parametrize(
    ("plan", "taken"), [(Plan(), True), (WALKS, True), (Plan(Plan().skip & ~Stage.WALKS), False)]
)
def test_walks_are_made_if_the_plan_says_so(plan: Plan, taken: bool) -> None:
    """A mover that falls too near to a wall for a free flight, and touches nothing, makes none otherwise."""
    move = Move(mover(spheres=2), near(0.45, 0.0, 1.0), CELL, start=near(0.45, 0.0, 1.3))
    skipped = resolve(FLOOR, move, plan=plan)["skipped"][list(Stage).index(Stage.WALKS)]
    assert (skipped > 0.0) == taken


@pytest.mark.parametrize(
    ("sphere", "up", "allowance", "none"),
    [
        ((-1.5, 0.0, 0.6, R), (0.0, 0.0, 1.0), FLOOR_Z, True),
        ((-1.5, 0.0, 0.3, R), (0.0, 0.0, 1.0), FLOOR_Z, False),
        ((0.9, 0.0, 1.5, R), (0.0, 0.0, 1.0), FLOOR_Z, True),
        ((0.9, 0.0, 1.5, R), (-1.0, 0.0, 0.0), FLOOR_Z, False),
        ((0.9, 0.0, 1.5, R), (0.0, 0.0, 1.0), -0.5, False),
        ((-1.5, 0.0, 0.6, 1.1 * LATTICE_REACH), (0.0, 0.0, 1.0), FLOOR_Z, False),
        ((-1.5, 0.0, 90.0, R), (0.0, 0.0, 1.0), FLOOR_Z, False),
    ],
    ids=[
        "above the floor",
        "in the floor",
        "in the wall",
        "in the wall, which is up",
        "in the wall, if that will do",
        "a larger sphere",
        "outside of the box",
    ],
)
def test_ground(sphere: tuple[float, ...], up: tuple[float, ...], allowance: float, none: bool) -> None:
    """What is touched and flat enough is ground, by whatever the question calls flat."""
    assert has_no_ground(FLOOR, sphere, up, allowance) == none


@settings(deadline=None, max_examples=200)
@given(
    st.tuples(st.floats(0.1, 0.9), st.floats(0.1, 0.9), st.floats(0.1, 0.9)),
    st.sampled_from([0.05, 0.25, 0.48]),
    st.sampled_from([FLOOR_Z, 0.0, -1.0]),
)
def test_no_ground_is_missed(where: tuple[float, float, float], r: float, allowance: float) -> None:
    """In a furnished room: where none is known to be, the walk puts the sphere on nothing."""
    low, high = ROOM.shapes[0].bounds.reshape(2, 3)
    center = np.float32(low + np.array(where) * (high - low)).astype(np.float64)
    if has_no_ground(ROOM, (*center, r), (0.0, 0.0, 1.0), allowance):
        row = ROOM.new_row()
        row[at.WALKABLE_ALLOWANCE], row[at.WALK_INTERP] = allowance, 1.0
        way, up = (0.0, 0.0, -0.5), (0.0, 0.0, 1.0)
        found = find_walkable(ROOM.floats, ROOM.ints, row, ROOM.tree_of(0), (*center, r), way, up)
        assert found == (at.NO_POLYGON, tuple(center))
        assert row[at.WALK_INTERP] == 1.0


def test_a_centre_in_solid_matter_that_touches_no_polygon() -> None:
    """Who asks for solid matter needs the walk, who asks for polygons does not."""
    corners = [(-4.0, -4.0, 0.0), (4.0, -4.0, 0.0), (4.0, 4.0, 0.0), (-4.0, 4.0, 0.0), (0.0, 0.0, -4.0)]
    bounds = (0.0, 0.0, 0.0, 9.0)
    tree = Node((0.0, 0.0, 1.0, 0.0), bounds, Leaf(bounds, (1,)), Leaf(bounds, (0,), solid=True))
    world = world_of(Shape(corners, [range(4), (0, 1, 4)], tree))
    row, root = world.new_row(), world.tree_of(0)
    below = 0.0, 2.5, -2.0, R
    assert sphere_intersects_solid(world.floats, world.ints, row, root, below, 1)
    assert not sphere_intersects_solid(world.floats, world.ints, row, root, below, 0)
    assert [is_clear(world, *below, flag) for flag in (0, 1)] == [True, False]


@pytest.mark.parametrize(
    ("center", "r", "known"),
    [
        ((0.0, 0.0, 0.06), 0.05, True),
        ((0.0, 0.0, -0.06), 0.05, False),
        ((0.0, 0.0, 0.06), EPS, False),
        ((0.0, 0.0, 0.06), math.nextafter(EPS, 1.0), True),
        ((0.0, 0.0, -0.0001), 0.0, False),
    ],
    ids=[
        "before it",
        "in it",
        "of no reach",
        "of hardly any",
        "a point in it, to retail before it",
    ],
)
def test_solid_matter_beside_a_centre(center: tuple[float, float, float], r: float, known: bool) -> None:
    """It counts if the centre is in it: no walk is needed to tell, but for a sphere without reach."""
    corners = [(-4.0, -4.0, -0.25), (4.0, -4.0, -0.25), (4.0, 4.0, -0.25), (-4.0, 4.0, -0.25)]
    bounds = (0.0, 0.0, 0.0, 9.0)
    tree = Node((0.0, 0.0, 1.0, 0.0), bounds, Leaf(bounds, ()), Leaf(bounds, (0,), solid=True))
    world = world_of(Shape(corners, [range(4)], tree))
    assert any(words_of(world) & at.WORD_SOLID)
    assert is_clear(world, *center, r, 1) == known
    solid = sphere_intersects_solid(
        world.floats, world.ints, world.new_row(), world.tree_of(0), (*center, r), 1
    )
    assert not (known and solid)


def hit(world: World, x: float, y: float, z: float, r: float) -> Iterator[int]:
    """Yield the polygons of a world's first shape that a sphere touches."""
    shape = world.shapes[0]
    for k in range(len(shape.polygon_offsets)):
        if polygon_hits_sphere_slow_but_sure(world.floats, world.polygon(0, k), (x, y, z, r))[0] == HIT:
            yield k


@settings(deadline=None, max_examples=300)
@given(
    st.tuples(st.floats(-0.3, 1.3), st.floats(-0.3, 1.3), st.floats(-0.3, 1.3)),
    st.floats(0.0, 0.625, width=32),
)
def test_nothing_is_missed(where: tuple[float, float, float], r: float) -> None:
    """In a furnished room, and around it: of what is known to be clear, no polygon is touched."""
    low, high = ROOM.shapes[0].bounds.reshape(2, 3)
    center = np.float32(low + np.array(where) * (high - low)).astype(np.float64)
    if is_clear(ROOM, *center, r, 1):
        row, root = ROOM.new_row(), ROOM.tree_of(0)
        assert list(hit(ROOM, *center, r)) == []
        assert not sphere_intersects_solid(ROOM.floats, ROOM.ints, row, root, (*center, r), 1)


def test_most_spheres_that_touch_nothing_are_known() -> None:
    """In a room, of spheres of a human's size that strike nothing, without which it would be for nothing."""
    rng = np.random.default_rng(3)
    row = ROOM.new_row()
    low, high = ROOM.shapes[0].bounds.reshape(2, 3)
    free = known = 0
    for center in rng.uniform(low, high, size=(200, 3)):
        walk = ROOM.floats, ROOM.ints, row, ROOM.tree_of(0), (*center, R)
        struck, poly = sphere_intersects_poly(*walk, (0.0, 0.0, 0.0), at.NO_POLYGON)
        if not struck and poly == at.NO_POLYGON:
            free += 1
            known += is_clear(ROOM, *center, R)
    assert free > 100
    assert known > 0.9 * free


@pytest.mark.parametrize("name", ["room", "building"])
def test_single_calls_are_answered_alike(name: str) -> None:
    """Strides beside walls and steps down, with it and without: the same bytes but for counters of work."""
    scene = make_scene(name)
    rows = tree_calls(scene, Surfaces(scene.geometry), np.random.default_rng(31), 2_000).rows
    short, full = (find_collisions_many(scene.world, rows, plan=plan) for plan in (WALKS, Plan.none()))
    for field in set(short.dtype.names) - {"nodes_visited", "polygons_tested", "skipped"}:
        assert np.ascontiguousarray(short[field]).tobytes() == np.ascontiguousarray(full[field]).tobytes()
    assert short["skipped"].sum() > 1_000
    assert short["nodes_visited"].sum() < full["nodes_visited"].sum()


def test_a_list_that_lacks_a_polygon_would_be_noticed() -> None:
    """Without its lists, the lattice calls the floor clear: what the property above is there for."""
    world = world_of(floor_and_wall())
    floats, ints = gate_of(world)
    table = int(ints[at.LATTICE_TABLE])
    blocks = int(floats[at.LATTICE_COUNTS :][:3].prod()) >> 3 * int(at.LATTICE_BLOCK)
    for first in np.unique(world.ints[table : table + blocks]):
        world.ints[first : first + 32] = 0
    sphere = -1.5, 0.0, 0.2, R
    assert list(hit(world, *sphere)) == [0]
    assert is_clear(world, *sphere)


@pytest.mark.parametrize("name", ["_LISTED_PER_POLYGON", "_MOST_LISTED"])
def test_lists_without_room_are_crowded(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """Nothing is known of their cubes; of cubes that nothing is near, everything is."""
    monkeypatch.setattr(lattice, name, 0)
    world = world_of(floor_and_wall())
    counts = counts_in(words_of(world))
    assert set(counts.tolist()) == {0, int(at.CROWDED)}
    assert not is_clear(world, -1.5, 0.0, R, R)
    assert is_clear(world, -1.5, 0.0, 1.7, R)


def pile(count: int) -> World:
    """Return so many triangles, a millimetre above each other."""
    corners = [(x, y, 0.001 * k) for k in range(count) for x, y in ((-1.0, -1.0), (1.0, -1.0), (0.0, 1.0))]
    polygons = [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(count)]
    return world_of(Shape(corners, polygons, Leaf((0.0, 0.0, 0.0, 9.0), tuple(range(count)))))


@pytest.mark.parametrize(("count", "most"), [(30, 30), (31, 31), (40, 31)])
def test_long_lists_are_crowded(count: int, most: int) -> None:
    """A cube that is near to more polygons than a word can count says nothing."""
    world = pile(count)
    assert counts_in(words_of(world)).max() == most
    assert is_clear(world, 0.0, 0.0, 0.02, 0.0) == (most < at.CROWDED)


def test_geometry_without_bounds_is_not_listed_everywhere() -> None:
    """Needles may be touched from anywhere: a lattice that noted each in every cube would take all memory."""
    rng = np.random.default_rng(5)
    needle = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 1e-7, 0.0)])
    needles = rng.uniform(-50.0, 50.0, size=(2_000, 1, 3)) + needle
    count = len(needles)
    polygons = np.arange(3 * count).reshape(-1, 3).tolist()
    tracemalloc.start()
    world = world_of(
        Shape(needles.reshape(-1, 3), polygons, Leaf((0.0, 0.0, 0.0, 200.0), tuple(range(count))))
    )
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert set(counts_in(words_of(world)).tolist()) == {int(at.CROWDED)}
    assert most < 100 * 2**20


def test_neighbours_share_their_lists() -> None:
    """Of a plain floor most cubes list the same: kept are a few lists, and few blocks."""
    words = words_of(world_of(triangle(20.0)))
    listing = words[counts_in(words) > 0]
    assert len(listing) > 50
    assert len(np.unique(listing >> int(at.WORD_LIST_SHIFT))) == 1


def test_cells_of_one_shape_share_a_lattice() -> None:
    """It belongs to the tree; a tree without polygons has none."""
    shape, bare = triangle(), Shape([], [], Leaf((0, 0, 0, 1)))
    world = prepared(
        World(
            [
                Cell(CELL, Pose(CELL), shape),
                Cell(CELL + 1, Pose(CELL), bare),
                Cell(CELL + 2, Pose(CELL), shape),
            ]
        )
    )
    one, none, same = (world.tree_of(index) for index in range(3))
    assert one == same
    counts = [world.floats[at.NODE_FLOATS * (root + at.GATE) + at.LATTICE_COUNTS] for root in (one, none)]
    assert counts[0] > 0.0
    assert counts[1] == 0.0


@pytest.mark.parametrize("size", [0.1, 10.0, 1e6])
def test_a_lattice_is_not_larger_than_its_geometry_pays_for(size: float) -> None:
    """However large the box is."""
    floats, _ = gate_of(world_of(triangle(size)))
    counts = floats[at.LATTICE_COUNTS :][:3]
    assert 1 << 3 * int(at.LATTICE_BLOCK) <= counts.prod() <= lattice._CUBES_PER_POLYGON
    assert (counts / floats[at.LATTICE_PER_METRE] >= (2 * size, 2 * size, 0.0)).all()


def test_a_lattice_is_coarser_if_it_would_take_long(monkeypatch: pytest.MonkeyPatch) -> None:
    """However many polygons are held against however many cubes."""
    fine = gate_of(make_scene("room").world)[0][at.LATTICE_PER_METRE]
    monkeypatch.setattr(lattice, "_MOST_TESTS", 10_000)
    assert gate_of(make_scene("room").world)[0][at.LATTICE_PER_METRE] < 0.5 * fine
