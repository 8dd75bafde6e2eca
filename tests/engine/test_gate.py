"""Walks without bounding spheres: they find the same, and who must not go that way."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest
from engine_scenes import R, floor_and_wall, world_of
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from conformance.bench.scenes import make_scene
from engine import Leaf, Node, Plan, Shape, Stage, World, step_down_many, strike_many
from engine import layout as at
from engine.compiling.enclosure import gate_radius
from engine.constants import EPS, FLOOR_Z, GATE_LEAST, GATE_MOST, GATE_WAY
from engine.kernels.bsp_node import in_bounds
from engine.kernels.bsp_poly import sphere_intersects_poly, sphere_intersects_solid
from engine.kernels.bsp_walkable import find_walkable, hits_walkable
from engine.kernels.polygon import polygon_hits_sphere_slow_but_sure
from engine.kernels.polygon_edges import HIT
from engine.tracing_interpreter import Interpreter

if TYPE_CHECKING:
    from collections.abc import Callable

    from engine.kernels.types import Array

AS_WRITTEN = Interpreter({})
BOUNDS = Plan(Stage.BOUNDS)
SPHERES = 2_000
WALKS = [
    (sphere_intersects_poly, ((0.0, 0.0, -1.0), at.NO_POLYGON)),
    (find_walkable, ((0.0, 0.0, -1.0), (0.0, 0.0, 1.0))),
    (hits_walkable, ((0.0, 0.0, 1.0),)),
]
"""The walks that need no bounding spheres, with what else they take."""
NAMES = ["strike", "step down", "support"]


def taken(
    walk: Callable[..., object], *rest: object, x: float = 0.0, r: float = R, plan: Plan = BOUNDS
) -> int:
    """Return how often a walk above the floor goes without bounding spheres."""
    world = world_of(floor_and_wall())
    row = world.new_row(plan=plan)
    row[at.WALK_INTERP], row[at.WALKABLE_ALLOWANCE] = 1.0, FLOOR_Z
    walk(world.floats, world.ints, row, world.tree_of(0), (x, 0.0, 0.25, r), *rest)
    return int(row[at.SKIPPED_BOUNDS])


@pytest.mark.parametrize(("walk", "rest"), WALKS, ids=NAMES)
@pytest.mark.parametrize(
    ("r", "times"),
    [(R, 1), (GATE_LEAST, 1), (GATE_MOST, 1), (0.9 * GATE_LEAST, 0), (1.1 * GATE_MOST, 0), (math.nan, 0)],
)
def test_spheres_of_a_mover_s_size(
    walk: Callable[..., object], rest: tuple[object, ...], r: float, times: int
) -> None:
    """Neither a speck, of which EPS is a part that counts, nor a giant, of which roundings are."""
    assert taken(walk, *rest, r=r) == times


@pytest.mark.parametrize(("walk", "rest"), WALKS, ids=NAMES)
def test_the_root_s_sphere_is_always_tested(walk: Callable[..., object], rest: tuple[object, ...]) -> None:
    """It stops what is elsewhere, and a centre that is nowhere."""
    assert [taken(walk, *rest, x=x) for x in (20.0, math.inf, math.nan)] == [0, 0, 0]


@pytest.mark.parametrize(("walk", "rest"), WALKS, ids=NAMES)
def test_all_are_tested_if_the_plan_says_so(walk: Callable[..., object], rest: tuple[object, ...]) -> None:
    """Retail's own way, test by test."""
    assert taken(walk, *rest, plan=Plan.none()) == 0


def test_a_movement_beyond_all_measure_needs_them() -> None:
    """Back along it a sphere may come to where float32 ends, which is near everything."""
    up = (0.0, 0.0, 1.0)
    assert taken(find_walkable, (0.0, 0.0, -0.5 * GATE_WAY), up) == 1
    assert taken(find_walkable, (0.0, 0.0, -2.0 * GATE_WAY), up) == 0
    assert taken(find_walkable, (math.nan, 0.0, 0.0), up) == 0


def test_solid_matter_needs_them() -> None:
    """A solid leaf counts by its flag, from whatever distance its node's sphere lets through."""
    assert taken(sphere_intersects_solid, 1) == 0


def short_of_its_polygon(open_gate: bool) -> World:
    """Return a wall at x = 0 in a leaf with a sphere about its middle only; perhaps with the wrong gate."""
    corners = [(0.0, 4.0, 0.0), (0.0, 4.0, 3.0), (0.0, -4.0, 3.0), (0.0, -4.0, 0.0)]
    bounds = (0.0, 0.0, 1.0, 9.0)
    tree = Node((1.0, 0.0, 0.0, 5.0), bounds, Leaf((0.0, 0.0, 1.5, 1.0), (0,)), Leaf(bounds))
    world = world_of(Shape(corners, [range(4)], tree))
    if open_gate:
        world.floats[at.NODE_FLOATS * (world.tree_of(0) + at.GATE) + at.GATE_RADIUS] = GATE_MOST
    return world


@pytest.mark.parametrize(("open_gate", "struck"), [(False, 0), (True, 1)])
def test_what_is_outside_of_its_bounding_sphere_is_not_found(*, open_gate: bool, struck: int) -> None:
    """As in retail; through a gate that is open by mistake it would be."""
    sphere, way = [[0.25, 3.0, 1.5, R]], [[-1.0, 0.0, 0.0]]
    assert strike_many(short_of_its_polygon(open_gate), 0, sphere, way)[0].tolist() == [struck]
    assert strike_many(short_of_its_polygon(open_gate), 0, sphere, way, plan=Plan.none())[0].tolist() == [0]


def random_spheres(world: World, rng: np.random.Generator) -> Array:
    """Return spheres of many sizes in and about a cell's box."""
    low, high = world.shapes[0].bounds.reshape(2, 3)
    centers = rng.uniform(low - 1.0, high + 1.0, size=(SPHERES, 3))
    return np.column_stack([centers, rng.uniform(0.5 * GATE_LEAST, 1.5, SPHERES)])


@pytest.mark.parametrize("name", ["room", "building"])
def test_the_answers_are_those_with_all_tests(name: str) -> None:
    """On every bit, of strikes and of steps down in furnished rooms; many of them find something."""
    world, rng = make_scene(name).world, np.random.default_rng(29)
    assert gate_radius(world.shapes[0]) == GATE_MOST
    spheres, ways = random_spheres(world, rng), rng.normal(size=(SPHERES, 3))
    ups = ways / np.linalg.norm(ways, axis=1)[:, None]
    level = np.full(SPHERES, 0.0), np.ones(SPHERES)
    short = *strike_many(world, 0, spheres, ways), *step_down_many(world, 0, spheres, -ways, ups, *level)
    full = (
        *strike_many(world, 0, spheres, ways, plan=Plan.none()),
        *step_down_many(world, 0, spheres, -ways, ups, *level, plan=Plan.none()),
    )
    assert [answer.tobytes() for answer in short] == [answer.tobytes() for answer in full]
    assert (short[1] >= 0).sum() > SPHERES // 10
    assert (short[4] >= 0).sum() > SPHERES // 20


COORDINATES = st.floats(-60.0, 60.0, width=32)
POINTS = st.tuples(COORDINATES, COORDINATES, COORDINATES)


@settings(deadline=None)
@given(
    st.tuples(POINTS, POINTS, POINTS),
    st.integers(0, 2),
    st.floats(GATE_LEAST, GATE_MOST, width=32),
    st.floats(-1.0, 2.0),
)
def test_what_is_hit_passes_the_bounding_sphere(
    corners: tuple[tuple[float, float, float], ...], k: int, r: float, beyond: float
) -> None:
    """Of spheres straight out from a corner that the bounding sphere goes through, within two EPS of it."""
    points = np.array(corners)
    middle = np.float32((points.min(axis=0) + points.max(axis=0)) / 2.0).astype(np.float64)
    ways = points - middle
    lengths = np.linalg.norm(ways, axis=1)
    assume(lengths.min() > 0.01)
    bounds = (*middle, np.nextafter(np.float32(lengths.max()), np.float32(np.inf)))
    shape = Shape(points, [(0, 1, 2)], Leaf(bounds, (0,)))
    assume(gate_radius(shape) == GATE_MOST)
    x, y, z = np.float32(points[k] + (r - EPS + beyond * EPS) / lengths[k] * ways[k]).astype(np.float64)
    code = polygon_hits_sphere_slow_but_sure(shape.polygon_floats, 0, (x, y, z, r))[0]
    within = AS_WRITTEN.function(in_bounds)(shape.node_floats.ravel(), 0, (x, y, z, r))
    assert code != HIT or within
