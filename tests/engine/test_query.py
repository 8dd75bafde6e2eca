"""Queries: written into rows as given, refused where they are wrong."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from engine_scenes import CELL, R, at, mover, triangle, world_of

from engine import (
    Cell,
    CollisionCall,
    ContactPlane,
    Move,
    Mover,
    Obstacle,
    PathState,
    Pose,
    PoseError,
    QueryError,
    Seed,
    World,
)
from engine.layout import NO_OBJECT
from engine.query import collision_rows, move_rows

FLOOR = triangle()
WORLD = world_of(FLOOR, objects=[Obstacle.solid(FLOOR, Pose(CELL))])
MOVE = Move(mover(3), at(1, 0, R), CELL, start=at(0, 0, R))


def test_a_move_fills_a_row() -> None:
    """Mover, poses and seed, float32 as retail stores them."""
    plane = ContactPlane((0, 0, 1, -0.1), CELL, is_water=True)
    seed = Seed(plane, plane, (0.5, 0, 3), 2)
    (row,) = move_rows(WORLD, [replace(MOVE, seed=seed, mover=mover(3, spheres=2))])
    assert row["num_sphere"] == 2
    assert row["spheres"][1].tolist() == [0, 0, 0.875, R]
    assert row["step_up_height"] == np.float32(0.6)
    assert row["state"] == 3
    assert row["start"].tolist() == [CELL, 1, 0, 0, 0, 0, 0, R]
    assert row["end"].tolist() == [CELL, 1, 0, 0, 0, 1, 0, R]
    assert row["contact_plane"].tolist() == row["last_known_contact_plane"].tolist()
    assert row["contact_plane"][3] == np.float32(-0.1)
    assert row["contact_plane_is_water"] == row["last_known_contact_plane_valid"] == 1
    assert row["sliding_normal"].tolist() == [0.5, 0, 3]
    assert row["frames_stationary_fall"] == 2
    assert row["placement_allows_sliding"] == 1


def test_a_placement_has_no_start() -> None:
    """Without a start the mover is put down."""
    (row,) = move_rows(WORLD, [replace(MOVE, start=None)])
    assert row["has_start"] == 0


def test_a_collision_call_names_its_target() -> None:
    """The cell's own tree, or one of its objects, with the path as given."""
    path = PathState(step_down=1, step_down_amt=0.5, walk_interp=1.0)
    own, thing = collision_rows(WORLD, [CollisionCall(MOVE, path=path), CollisionCall(MOVE, 0)])
    assert (own["target_cell"], own["target_object"]) == (0, NO_OBJECT)
    assert (own["step_down"], own["step_down_amt"]) == (1, 0.5)
    assert thing["target_object"] == 0


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"mover": Mover([])}, "move 0, mover, spheres: 0 spheres where 1 or 2 are needed"),
    ({"mover": Mover([(0, 0, 0, 1)] * 3)}, "move 0, mover, spheres: 3 spheres where 1 or 2 are needed"),
    ({"mover": Mover([(0, 0, 0, 0)])}, "move 0, mover, spheres: the first sphere has no radius"),
    (
        {"mover": Mover([(0, 0, 0, 1)], scale=np.inf)},
        "move 0, mover, scale: inf at (0,) is not a finite float32",
    ),
    ({"begin_cell": 5}, "move 0, begin cell: 0x00000005 is not in the world"),
    (
        {"seed": Seed(ContactPlane((0, 0, 1), CELL))},
        "move 0, seed, contact_plane: shape (3,) where (4,) is needed",
    ),
    ({"end": Pose(CELL, (0, 0, np.nan))}, "move 0, end, origin: nan at (2,) is not a finite float32"),
    ({"start": Pose(CELL, rotation=(1e30, 0, 0, 0))}, "move 0, start, rotation: squared length inf"),
    ({"start": Pose(CELL, rotation=(0, 0, 0, 2))}, "move 0, start, rotation: squared length 4.0"),
]


@pytest.mark.parametrize(("changed", "message"), WRONG)
def test_wrong_moves_are_refused(changed: dict[str, Any], message: str) -> None:
    """The error says which move, which part, and the offending value."""
    with pytest.raises((QueryError, PoseError)) as caught:
        move_rows(WORLD, [replace(MOVE, **changed)])
    assert str(caught.value).startswith(message)


def test_wrong_collision_calls_are_refused() -> None:
    """A call comes from somewhere and strikes something that exists."""
    with pytest.raises(QueryError, match="call 0, start: a collision call comes from somewhere"):
        collision_rows(WORLD, [CollisionCall(replace(MOVE, start=None))])
    with pytest.raises(QueryError, match=r"call 0, object: 1 does not exist \(1 objects\)"):
        collision_rows(WORLD, [CollisionCall(MOVE, 1)])
    empty = World([Cell(CELL, Pose(CELL), None)])
    with pytest.raises(QueryError, match="call 0, cell: it has no tree to collide with"):
        collision_rows(empty, [CollisionCall(MOVE)])
