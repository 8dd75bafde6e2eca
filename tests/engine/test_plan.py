"""Shortcuts: when they are taken, and the nearest misses, where they must not be."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from engine_scenes import CELL, R, at, mover, prepared, triangle, world_of

from engine import (
    Cell,
    LandBlock,
    Leaf,
    Move,
    Node,
    Obstacle,
    Plan,
    Portal,
    Pose,
    Prepared,
    Restriction,
    Seed,
    Shape,
    Stage,
    World,
    resolve,
)
from engine.compiling.balls import bounding_balls
from engine.constants import BOUND_CORNER, BOUND_SLACK, CONTACT, EDGE_SLIDE, FLIGHT_STEPS, ON_WALKABLE
from engine.layout import PLAN
from engine.probes import without_work

if TYPE_CHECKING:
    from engine import Mover

STRIDE = 0.25
"""Metres along x."""
OTHER = CELL + 1
REACH = R + 0.5 * STRIDE
"""Radius of the ball about a sphere and its stride, metres, without slack."""


def stride(who: Mover, x: float, z: float, **move: Any) -> Move:
    """Return a move along x at a height."""
    return Move(who, at(x + STRIDE, 0.0, z), CELL, start=at(x, 0.0, z), **move)


def taken(world: World, move: Move, stage: Stage) -> int:
    """Return how often a shortcut is taken where there is no other; the answer is the same as without it."""
    short, full = resolve(world, move, plan=Plan(skip=stage)), resolve(world, move, plan=Plan.none())
    assert without_work(short) == without_work(full)
    assert not full["skipped"].any()
    return int(short["skipped"][list(Stage).index(stage)])


@pytest.mark.parametrize(
    ("height", "steps"),
    [(REACH + 2.0 * BOUND_SLACK, 1), (REACH + 0.5 * BOUND_SLACK, 0), (R + 0.01, 0), (R - 0.01, 0)],
)
def test_a_flight_is_free_where_the_floor_is_out_of_reach(height: float, steps: int) -> None:
    """By the ball about the whole stride and its slack; just within, and touching, every test is made."""
    assert taken(world_of(triangle()), stride(mover(), 0.0, height), Stage.FLIGHT) == steps


def test_a_flight_is_free_in_all_of_its_sub_steps() -> None:
    """A move of four radii takes five sub-steps, none of which tests anything."""
    move = Move(mover(), at(1.0, 0.0, 3.0), CELL, start=at(-1.0, 0.0, 3.0))
    assert taken(world_of(triangle()), move, Stage.FLIGHT) == 5
    assert resolve(world_of(triangle()), move)["nodes_visited"] == 1


def test_a_flight_ends_where_its_cell_does() -> None:
    """The sub-step that leaves the cell is made in full, and finds that there is no other."""
    shape = triangle()
    corners, bounds = [(-5, -5, 0), (5, -5, 0), (0, 5, 0)], (0.0, 0.0, 0.0, 10.0)
    bounded = Shape(corners, [(0, 1, 2)], Leaf(bounds, (0,)), [(-1, 0, 0, 0)])
    move = Move(mover(), at(0.75, 0.0, 3.0), CELL, start=at(-0.75, 0.0, 3.0))
    assert taken(world_of(shape), move, Stage.FLIGHT) == 4
    assert taken(world_of(bounded), move, Stage.FLIGHT) == 2


@pytest.mark.parametrize(
    "move",
    [
        stride(mover(CONTACT | ON_WALKABLE), 0.0, 3.0),
        stride(mover(), 0.0, 3.0, seed=Seed(sliding_normal=(1.0, 0.0, 0.0))),
        replace(stride(mover(), 0.0, 3.0), start=None),
        Move(mover(), at(R * FLIGHT_STEPS, 0.0, 3.0), CELL, start=at(-R, 0.0, 3.0)),
    ],
    ids=["in contact", "sliding", "placement", "many sub-steps"],
)
def test_no_flight_of_who_does_not_fly(move: Move) -> None:
    """Who looks for ground, slides or is put down; a move too long to be bounded by one ball."""
    assert taken(world_of(triangle(200.0)), move, Stage.FLIGHT) == 0


def leaf_world(*polygons: list[int], plane: tuple[float, ...] | None = None, **world: Any) -> World:
    """Return a world of polygons above a mover's head, in one leaf, or behind a splitting plane."""
    corners = [(-1, -1, 5), (0, 1, 5), (1, -1, 5), (0, -0.5, 5), (-1, -1, 5)]
    bounds = (0.0, 0.0, 0.0, 20.0)
    leaf = Leaf(bounds, range(len(polygons)))
    tree = leaf if plane is None else Node(plane, bounds, leaf, Leaf(bounds))
    return prepared(World([Cell(CELL, Pose(CELL), Shape(corners, polygons, tree))], **world))


@pytest.mark.parametrize(
    ("world", "steps"),
    [
        (leaf_world([0, 1, 2]), 1),
        (leaf_world([0, 4]), 0),
        (leaf_world([0, 1, 2], plane=(0.0, 0.0, 1.0, 0.0)), 1),
        (leaf_world([0, 1, 2], plane=(0.0, 0.0, 1.5, 0.0)), 0),
        (leaf_world([0, 1, 2], restrictions={CELL: Restriction()}), 0),
    ],
    ids=["a triangle", "a degenerate polygon", "a plane", "a plane that is not unit", "nobody is admitted"],
)
def test_no_flight_where_bounds_do_not_hold(world: World, steps: int) -> None:
    """A polygon whose plane is NaN is struck from anywhere; a bad normal misleads; a door is kept shut."""
    assert taken(world, stride(mover(), 0.0, 2.0), Stage.FLIGHT) == steps


def test_only_convex_polygons_have_balls() -> None:
    """What is inside all edges of another polygon need not be near its vertices."""
    shape = Shape(
        [(-1, -1, 5), (0, 1, 5), (1, -1, 5), (0, 0.5, 5)],
        [(0, 2, 1), (0, 2, 1, 3), (0, 2, 3)],
        Leaf((0, 0, 5, 3), (0, 1, 2)),
    )
    radii = bounding_balls(shape.polygon_floats, shape.polygon_offsets)[:, 3]
    assert np.isfinite(radii).tolist() == [True, False, True]
    assert radii[0] == pytest.approx(4.0 / 3.0)


def two_rooms() -> World:
    """Return two empty rooms, west and east of x = 0, with a portal between them."""
    rooms = []
    for cell, other, side in ((CELL, OTHER, -1.0), (OTHER, CELL, 1.0)):
        shape = Shape([], [], Leaf((0.0, 0.0, 0.0, 1.0)), [(side, 0.0, 0.0, 0.0)])
        rooms.append(Cell(cell, Pose(CELL), shape, portals=[Portal(other)]))
    return World(rooms)


@pytest.mark.parametrize(
    ("distance", "lists"),
    [(R + 2.0 * BOUND_SLACK, 1), (R + 0.5 * BOUND_SLACK, 0), (R, 0), (0.0, 0), (-0.1, 0)],
)
def test_no_one_looks_behind_a_portal_out_of_reach(distance: float, lists: int) -> None:
    """By the sphere's radius and slack from the plane that bounds the other room."""
    still = at(-distance, 0.0, 0.0)
    move = Move(mover(), still, CELL, start=still)
    assert taken(two_rooms(), move, Stage.PORTALS) == lists
    assert resolve(two_rooms(), move)["cells_listed"] == (2 if distance < R + 0.01 else 1)


def test_a_portal_to_a_cell_without_planes_is_always_looked_behind() -> None:
    """Such a cell is reached from everywhere."""
    open_room = Cell(OTHER, Pose(CELL), Shape([], [], Leaf((0.0, 0.0, 0.0, 1.0))))
    world = prepared(World([Cell(CELL, Pose(CELL), triangle(), portals=[OTHER]), open_room]))
    assert taken(world, stride(mover(), 0.0, 3.0), Stage.PORTALS) == 0
    assert taken(world, stride(mover(), 0.0, 3.0), Stage.FLIGHT) == 0


THINGS = {
    "ball": Obstacle(at(3.0, 0.0, 0.0), spheres=[(0.0, 0.0, 0.0, 1.0)]),
    "drum": Obstacle(at(3.0, 0.0, -0.5), cylspheres=[(0.0, 0.0, 0.0, 0.5, 1.0)]),
    "scaled ball": Obstacle(at(3.0, 0.0, 0.0), spheres=[(0.0, 0.0, 0.0, 0.5)], scale=2.0),
}
"""Each is bounded by a ball of one metre about (3, 0, 0)."""


@pytest.mark.parametrize("name", THINGS)
@pytest.mark.parametrize(
    ("gap", "passed"), [(2.0 * BOUND_SLACK, 1), (0.5 * BOUND_SLACK, 0), (0.001, 0), (-0.01, 0)]
)
def test_objects_out_of_reach_are_passed_over(name: str, gap: float, passed: int) -> None:
    """By the ball about them, the mover's corner and slack, wherever a sub-step ends."""
    world = world_of(triangle(50.0, -20.0), objects=[THINGS[name]])
    move = stride(mover(EDGE_SLIDE), 3.0 - 1.0 - BOUND_CORNER * R - gap - STRIDE, 0.0)
    assert min(taken(world, move, Stage.OBJECTS), 1) == passed


@pytest.mark.parametrize("state", [EDGE_SLIDE, EDGE_SLIDE | CONTACT | ON_WALKABLE], ids=["flies", "walks"])
@pytest.mark.parametrize("stage", [Stage.OBJECTS, Stage.FLIGHT])
def test_a_low_cylinder_is_hit_beside_its_edge(state: int, stage: Stage) -> None:
    """Level and upright distance are compared one by one: a sphere reaches farther there than it is large."""
    disc = Obstacle(at(3.0, 0.0, 0.0), cylspheres=[(0.0, 0.0, 0.0, 0.1, 0.02)])
    world = world_of(triangle(50.0, -20.0), objects=[disc])
    move = stride(mover(state), 3.0 - 0.1 - R + 0.01 - STRIDE, R)
    assert resolve(world, move, plan=Plan.none())["step_up_normal"].tolist() == [-1.0, 0.0, 0.0]
    assert taken(world, move, stage) == 0


@pytest.mark.parametrize(("height", "passed"), [(0.1, 1), (0.5 * BOUND_SLACK, 0), (0.0, 0), (-0.01, 0)])
def test_the_ground_far_below_is_passed_over(height: float, passed: int) -> None:
    """By slack above both triangles."""
    block = 0xA9B4
    world = World(landblocks=[LandBlock(block, [0.0] * 81)])
    cell = (block << 16) + 1
    ends = (Pose(cell, (12.0, 12.0, R + height)), Pose(cell, (12.25, 12.0, R + height)))
    move = Move(mover(), ends[1], cell, start=ends[0])
    assert min(taken(world, move, Stage.GROUND), 1) == passed


def test_a_trace_takes_no_shortcut() -> None:
    """It tells of every call of a tree."""
    world = world_of(triangle())
    assert world.new_row(plan=Plan())[PLAN] == Plan().skip
    assert world.new_row(trace_capacity=8, plan=Plan())[PLAN] == 0.0


def test_prepared_queries_take_shortcuts() -> None:
    """Unless they are told not to."""
    world, move = world_of(triangle()), stride(mover(), 0.0, 3.0)
    assert Prepared(world, move).run()["skipped"].tolist() == [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]
    assert not Prepared(world, move, plan=Plan.none()).run()["skipped"].any()
