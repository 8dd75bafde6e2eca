"""Shortcuts about geometry that is none: what is not finite, not flat or not positive is near everything."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from engine_scenes import CELL, R, at, mover, prepared, triangle, world_of
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from engine import (
    Building,
    BuildingPortal,
    Cell,
    EngineError,
    LandBlock,
    Leaf,
    Move,
    Mover,
    Node,
    Obstacle,
    Part,
    Plan,
    Portal,
    Pose,
    Shape,
    World,
    resolve,
)
from engine.compiling.balls import bounding_balls, planes_of
from engine.constants import BOUND_MOST
from engine.probes import without_work

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from hypothesis.strategies import DrawFn

    Point = tuple[float, float, float]

HAS_BSP = 0x10001
"""State of an obstacle that is collided with by its parts."""
WIDE = (0.0, 0.0, 0.0, 10.0)
"""Sphere about whatever is near the origin."""
WARPED = [(-4.0, -4.0, 2.0), (4.0, -4.0, -2.0), (4.0, 4.0, 2.0), (-4.0, 4.0, -2.0)]
"""A square whose corners are 2 m off its plane, z = 0."""
NEEDLE = [
    (3.806212902069092, 0.9624040722846985, -0.8287050724029541),
    (4.665707588195801, -2.0198075771331787, 1.32631254196167),
    (4.071483135223389, 0.04198923334479332, -0.1635911911725998),
]
"""Three points of a line, but for a micrometre."""
BEYOND_NEEDLE = (4.847044944763184, -2.648998737335205, 1.780981183052063)
"""In line with the needle, 0.68 m from its end: inside all of its edges, as float32 has them."""
SPECK = [(1e-20, 2e-20, 2e-20), (3e-20, 1e-20, 2e-20), (3e-20, 2e-20, 1e-20)]
"""So small a triangle that its normal is infinite."""


def answer(world: World, move: Move, plan: Plan) -> Mapping[str, bytes | str]:
    """Return all that is answered but for the work that it took, or the error."""
    try:
        result = resolve(world, move, plan=plan)
    except EngineError as error:
        return {"error": str(error)}
    return without_work(result)


def skipped(world: World, move: Move) -> list[int]:
    """Return how often each shortcut is taken; the answer is that without them."""
    assert answer(world, move, Plan()) == answer(world, move, Plan.none())
    return [int(count) for count in resolve(world, move)["skipped"]]


def strikes(world: World, move: Move) -> bool:
    """Say whether retail lets the mover not go where it wants to."""
    reached = resolve(world, move, plan=Plan.none())["check"][-3:]
    return not np.array_equal(reached, np.array(move.end.origin, dtype=np.float32))


def leaf(corners: Sequence[Point], sphere: Sequence[float] = WIDE) -> Shape:
    """Return one polygon in one leaf."""
    return Shape(corners, [tuple(range(len(corners)))], Leaf(sphere, (0,)))


def across(y: float, z: float, x: float = 0.0) -> Move:
    """Return a move along y by half a metre, to y."""
    return Move(mover(), at(x, y, z), CELL, start=at(x, y - 0.5, z))


@pytest.mark.parametrize("radius", [-20.0, -5.0, 5.0])
def test_a_negative_sphere_of_a_part_reaches_as_far(radius: float) -> None:
    """Retail squares the sum of both radii: what has a sphere of -20 m is struck within 19.52 m."""
    part = leaf([(-1, 1, -1), (1, 1, -1), (0, 1, 1)], (0.0, 0.0, 0.0, radius))
    world = world_of(
        triangle(50.0, -20.0), objects=[Obstacle(at(0, 0, 0), state=HAS_BSP, parts=[Part(part)])]
    )
    assert strikes(world, across(0.7, 0.0))
    assert skipped(world, across(0.7, 0.0))[1] == 0
    assert any(skipped(world, across(40.0, 0.0)))


def test_a_negative_sphere_of_a_house_reaches_as_far() -> None:
    """The outside of a building is a part as well."""
    cell = 0xA9B40001
    house = leaf([(11, 13, 0), (13, 13, 0), (12, 13, 3)], (12.0, 12.0, 0.0, -10.0))
    portals = [BuildingPortal(0xA9B40100, -1)]
    world = World(
        landblocks=[LandBlock(0xA9B4, [0.0] * 81)], buildings=[Building(Pose(cell), house, portals)]
    )
    ends = [Pose(cell, (12.0, y, 1.5)) for y in (12.0, 12.75)]
    move = Move(mover(), ends[1], cell, start=ends[0])
    assert strikes(world, move)
    assert skipped(world, move)[1] == 0


@pytest.mark.parametrize(
    ("sphere", "steps"),
    [(WIDE, 2), ((0.0, 0.0, 0.0, -10.0), 0), ((0.0, 0.0, 0.0, 1e5), 0), ((1e15, 0.0, 0.0, 1e15), 0)],
    ids=["a sphere", "a negative one", "a huge one", "a plane's"],
)
@pytest.mark.parametrize("inner", [False, True], ids=["leaf", "node"])
def test_no_flight_past_spheres_that_do_not_bound(sphere: tuple[float, ...], steps: int, inner: bool) -> None:
    """Of a negative radius a larger ball overlaps less; of a huge one roundings are larger than slack."""
    floor = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]
    tree = Node((0, 0, 1, 0), sphere, Leaf(WIDE, (0,)), Leaf(WIDE)) if inner else Leaf(sphere, (0,))
    world = world_of(Shape(floor, [(0, 1, 2)], tree))
    assert skipped(world, across(0.0, 3.0))[3] == steps


@pytest.mark.parametrize(
    ("corners", "end"),
    [
        (WARPED, (4.9, -4.3, 0.0)),
        (NEEDLE, BEYOND_NEEDLE),
        (SPECK, (-5.0, 0.1, -1.0)),
        ([(1.0, 2.0, 3.0)] * 3, (-5.0, 0.1, -1.0)),
    ],
    ids=["a warped square", "a needle", "a speck", "a point"],
)
def test_no_flight_where_nothing_is(corners: list[Point], end: Point) -> None:
    """Retail strikes such polygons from afar, and so does the engine."""
    start = (end[0], end[1] - 0.25, end[2])
    move = Move(mover(), Pose(CELL, end), CELL, start=Pose(CELL, start))
    assert strikes(world_of(leaf(corners)), move)
    assert skipped(world_of(leaf(corners)), move)[3] == 0


def test_only_flat_near_and_fat_polygons_have_balls() -> None:
    """And no plane that is not finite is used to tell what is beyond it."""
    far = [(x + 2.0 * BOUND_MOST, y, z) for x, y, z in WARPED]
    fan = [*WARPED, *NEEDLE, *SPECK, *far, (-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (0.0, 1.0, 0.0)]
    polygons = [(0, 1, 2, 3), (4, 5, 6), (7, 8, 9), (10, 11, 12), (14, 15, 16)]
    shape = Shape(fan, polygons, Leaf(WIDE, range(5)))
    floats, records = shape.polygon_floats, shape.polygon_offsets
    assert np.isinf(bounding_balls(floats, records)[:, 3]).tolist() == [True, True, True, True, False]
    assert np.isinf(floats[records[2] : records[2] + 3]).any()
    assert np.isnan(planes_of(floats, records)).all(axis=1).tolist() == [False, False, True, False, False]


@pytest.mark.parametrize("stage", [1, 3], ids=["objects", "flight"])
@pytest.mark.parametrize("radius", [-3.0, 3.0])
def test_a_negative_second_sphere_reaches_as_far(radius: float, stage: int) -> None:
    """As the sum of radii is squared; the first sphere has to have a radius, the second need not."""
    who = Mover([(0, 0, 0, R), (0, 0, 0, radius)], step_up_height=0.6, step_down_height=1.5)
    ball = Obstacle(at(0.0, 2.0, 0.0), spheres=[(0.0, 0.0, 0.0, 0.25)])
    world = world_of(triangle(50.0, -20.0), objects=[ball])
    assert skipped(world, Move(who, at(0, 0, 0), CELL, start=at(0, -0.5, 0)))[stage] == 0
    assert skipped(world, Move(who, at(0, -9, 0), CELL, start=at(0, -9.5, 0)))[3] > 0


@pytest.mark.parametrize(
    "thing",
    [
        Obstacle(at(0, 0, 50), scale=1e30, spheres=[(0.0, 0.0, 1e30, 1.0)]),
        Obstacle(at(0, 0, 50), scale=1e10, cylspheres=[(0.0, 0.0, 0.0, 1.0, 1e30)]),
    ],
    ids=["a sphere", "a cylinder"],
)
def test_objects_beyond_all_measure_are_tested(thing: Obstacle) -> None:
    """Where retail's float32 is infinite, and differences are NaN, a bound says nothing."""
    assert skipped(world_of(triangle(50.0, -20.0), objects=[thing]), across(0.0, 0.0))[1:4] == [0, 0, 0]


@pytest.mark.parametrize(("length", "skips"), [(1.0, True), (2.0**20, False)])
def test_portals_behind_steep_planes_are_looked_behind(length: float, skips: bool) -> None:
    """A normal of 2**20 makes roundings of a point in a cell's frame longer than any slack."""
    shape = Shape([], [], Leaf((0, 0, 0, 1)), [(length, 0.0, 0.0, 0.0)])
    other = Cell(CELL + 1, Pose(CELL), shape)
    world = prepared(World([Cell(CELL, Pose(CELL), triangle(), portals=[Portal(CELL + 1)]), other]))
    assert any(skipped(world, across(0.0, 3.0, x=-3.0))[:4]) == skips


GRID = st.integers(-8, 8).map(lambda n: n / 4.0)
HOSTILE = st.sampled_from((0.0, 1e-20, -1e-20, 1e-30, 1e-4, 1e5, -1e9, 1e18, 3e38))
NUMBERS = st.one_of(GRID, GRID, GRID, GRID, HOSTILE)
POINTS = st.tuples(NUMBERS, NUMBERS, NUMBERS)
NEAR = st.tuples(GRID, GRID, GRID)
SPHERES = st.one_of(
    st.just(WIDE),
    st.tuples(GRID, GRID, GRID, st.sampled_from((4.0, -4.0, -0.48, 0.0, -20.25, 1e9))),
    st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS),
)
PLANES = st.one_of(
    st.sampled_from(((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, -1.0, 0.25), (0.0, 2.0, 0.0, 0.0))),
    st.tuples(GRID, GRID, GRID, NUMBERS),
)


@st.composite
def shapes(draw: DrawFn) -> Shape:
    """Draw a shape of up to three polygons, with spheres that may bound nothing."""
    corners = draw(st.lists(POINTS, min_size=3, max_size=6))
    indices = st.integers(0, len(corners) - 1)
    polygons = draw(st.lists(st.lists(indices, min_size=2, max_size=5), min_size=1, max_size=3))
    leaves = Leaf(draw(SPHERES), range(len(polygons)), draw(st.booleans()))
    sides = leaves, Leaf(draw(SPHERES), range(len(polygons)))
    tree = Node(draw(PLANES), draw(SPHERES), *sides) if draw(st.booleans()) else leaves
    return Shape(corners, polygons, tree, draw(st.none() | st.lists(PLANES, max_size=2)))


@st.composite
def worlds(draw: DrawFn) -> World:
    """Draw a room, another one behind a portal, and a thing of such a shape in the first."""
    parts = [Part(draw(shapes()), scale=draw(st.sampled_from((1.0, 0.5, 1e-20, 1e20))))]
    thing = Obstacle(Pose(CELL, draw(NEAR)), state=HAS_BSP, parts=parts)
    other = Cell(CELL + 1, Pose(CELL, draw(NEAR)), draw(shapes()))
    portals = draw(st.sampled_from(([], [Portal(CELL + 1)])))
    return prepared(World([Cell(CELL, Pose(CELL), draw(shapes()), [thing], portals=portals), other]))


@settings(deadline=None, max_examples=150, suppress_health_check=[HealthCheck.too_slow])
@given(
    worlds(),
    NEAR,
    st.tuples(*[st.sampled_from((-0.5, 0.0, 0.25, 1.0))] * 3),
    st.sampled_from((None, 0.48, -0.48, -3.0)),
    st.sampled_from((0, 0x3, 0x103)),
)
def test_shortcuts_change_nothing_about_degenerate_geometry(
    world: World, start: Point, way: Point, second: float | None, state: int
) -> None:
    """Whatever the polygons, spheres and planes are, the answer is the same with shortcuts and without."""
    spheres = [(0.0, 0.0, 0.0, R)] + ([] if second is None else [(0.0, 0.0, 0.5, second)])
    who = Mover(spheres, state=state, step_up_height=0.6, step_down_height=1.5)
    end = tuple(a + b for a, b in zip(start, way, strict=True))
    move = Move(who, Pose(CELL, end), CELL, start=Pose(CELL, start))
    assert answer(world, move, Plan()) == answer(world, move, Plan.none())
