"""A query does as much work in a large world as in the part of it that it touches."""

from __future__ import annotations

import pytest
from engine_scenes import R, floor_and_wall, triangle

from engine import Cell, ContactPlane, LandBlock, Move, Mover, Obstacle, Pose, Seed, Shape, World
from engine import layout as at
from engine.batch import resolve_many

BLOCK = 0xA9B4
HALL, ROOM = BLOCK << 16 | 0x100, BLOCK << 16 | 0x101
LAND = BLOCK << 16 | 1
FAR = 0x2030
"""Block of what is only there."""
COUNTERS = ("nodes_visited", "polygons_tested", "cells_listed", "objects_tested")


def near() -> tuple[list[Cell], dict[int, list[Obstacle]]]:
    """Return two rooms on top of each other's floors, and what stands in them and outside."""
    shape = floor_and_wall()
    chest = Obstacle.solid(triangle(1.0, 0.25), Pose(HALL, (-2, 0, 0)))
    barrel = Obstacle(Pose(HALL, (-2, 2, 0)), cylspheres=[(0, 0, 0, 0.5, 1.0)], id=1)
    cells = [
        Cell(HALL, Pose(HALL), shape, [chest, barrel], [ROOM]),
        Cell(ROOM, Pose(ROOM), shape, [barrel], [HALL]),
    ]
    return cells, {LAND: [chest, barrel]}


def far(shape: Shape) -> tuple[list[Cell], dict[int, list[Obstacle]]]:
    """Return 1,000 cells with ten objects each, far from those."""
    ids = [(FAR + k // 250) << 16 | 0x100 + k % 250 for k in range(1000)]
    things = {cell: [Obstacle.solid(shape, Pose(cell)) for _ in range(10)] for cell in ids}
    return [Cell(cell, Pose(cell), shape, things[cell]) for cell in ids], {}


@pytest.fixture(scope="module")
def worlds() -> tuple[World, World]:
    """Return the small world, and the same one among others; the others come first."""
    cells, shadows = near()
    others, _ = far(triangle())
    blocks = [LandBlock(BLOCK, [0.0] * 81)]
    more = [LandBlock(FAR + k, [0.0] * 81) for k in range(4)]
    return World(cells, blocks, (), shadows), World([*others, *cells], [*more, *blocks], (), shadows)


LEVEL = ContactPlane((0, 0, 1, 0), HALL)
WALKER = Mover([(0, 0, 0, R), (0, 0, 0.875, R)], state=3, step_up_height=0.6, step_down_height=1.5)


@pytest.mark.parametrize("cell", [HALL, LAND])
@pytest.mark.parametrize("end", [(-1.5, 0.0, R), (-2.0, 1.0, R), (0.5, 0.5, R), (-0.5, -0.5, R + 2)])
def test_the_counters_do_not_grow_with_the_world(
    cell: int, end: tuple[float, ...], worlds: tuple[World, World]
) -> None:
    """The same nodes, polygons, cells and objects are looked at; and the answers are the same."""
    move = Move(WALKER, Pose(cell, end), cell, start=Pose(cell, (-0.5, 0.25, R)), seed=Seed(LEVEL, LEVEL))
    small, large = (resolve_many(world, [move])[0] for world in worlds)
    assert [small[name] for name in COUNTERS] == [large[name] for name in COUNTERS]
    assert small["cells_listed"] > 0
    assert small["objects_tested"] > 0
    assert small["curr"].tobytes() == large["curr"].tobytes()


def test_the_large_world_is_large(worlds: tuple[World, World]) -> None:
    """And only what is in the row's lists has room for all of it: it is not cleared."""
    small, large = worlds
    assert large.num_objects == small.num_objects + 10_000
    assert len(large.cell_ids) == len(small.cell_ids) + 1000 + 4 * 64
    assert at.STATE_SIZE < len(small.new_row()) < len(large.new_row())


def test_ids_are_found_without_a_search_through_the_world(worlds: tuple[World, World]) -> None:
    """The table has at least four entries for each, so that few lie in another's way."""
    entries = int(worlds[1].ints[at.WORLD_IDS_MASK]) + 1
    assert entries >= 4 * (1002 + 5)
