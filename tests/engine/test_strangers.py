"""Rows made for another world, or changed: they are refused by number, and the others answered."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import engine
from engine import (
    Body,
    Cell,
    CollisionCall,
    ContactPlane,
    Leaf,
    Move,
    Mover,
    ObjectCall,
    Obstacle,
    Part,
    Pose,
    QueryError,
    Seed,
    Shape,
    World,
)
from engine import layout as at
from engine.body import body_rows
from engine.object_call import object_rows
from engine.query import collision_rows, move_rows

if TYPE_CHECKING:
    from collections.abc import Callable

CELL = 0xA9B40100
HERE, THERE = Pose(CELL, (50.0, 50.0, 0.0)), Pose(CELL, (50.2, 50.0, 0.0))
FLOOR = Shape(
    [(-5.0, -5.0, 0.0), (5.0, -5.0, 0.0), (0.0, 5.0, 0.0)], [(0, 1, 2)], Leaf((0.0, 0.0, 0.0, 10.0), (0,))
)
SOLID = Obstacle(HERE, state=0x10001, parts=[Part(FLOOR)])
HOLLOW = Obstacle(HERE, state=0x10001)
PLANE = ContactPlane((0.0, 0.0, 1.0, 0.0), CELL)
MOVE = Move(Mover([(0.0, 0.0, 0.5, 0.5)], step_down_height=1.5), THERE, CELL, HERE, Seed(PLANE, PLANE))
WORLD = World([Cell(CELL, HERE, FLOOR, objects=[SOLID, HOLLOW]), Cell(CELL + 1, HERE, None)])

MAKERS: dict[str, Callable[[], Any]] = {
    "resolve_many": lambda: move_rows(WORLD, [MOVE] * 3),
    "find_collisions_many": lambda: collision_rows(WORLD, [CollisionCall(MOVE)] * 3),
    "find_object_collisions_many": lambda: object_rows(WORLD, [ObjectCall(MOVE)] * 3),
}
NO_INDEX = (-2.0, 2.0, 1e300, math.inf, math.nan)
"""Indices of nothing in a world of two cells and two objects."""
NO_ID = (-1.0, -float(CELL), 2.0**32, math.inf, math.nan)
"""Numbers that are no cell's id, in any world."""
STRANGE = [
    *((name, "begin_cell", value) for name in MAKERS for value in NO_INDEX),
    *((name, "num_sphere", value) for name in MAKERS for value in (-1.0, 3.0, math.nan)),
    *(("find_collisions_many", "target_object", value) for value in (1.0, *NO_INDEX)),
    *(("find_collisions_many", "target_cell", value) for value in (-1.0, 1.0, *NO_INDEX)),
]


@pytest.mark.parametrize(("name", "field", "value"), STRANGE)
def test_a_strange_row_is_named_and_the_others_are_answered(name: str, field: str, value: float) -> None:
    """The second of three rows names what is not there: the first and the third have their answers."""
    rows, ask = MAKERS[name](), getattr(engine, name)
    expected = ask(WORLD, rows)
    rows[field][1] = value
    out = np.zeros(3, dtype=at.RESULT_DTYPE)
    with pytest.raises(QueryError, match="row 1: it names a cell or an object"):
        ask(WORLD, rows, out=out)
    assert out["status"].tolist() == [at.STATUS_OK, at.STATUS_STRANGE, at.STATUS_OK]
    assert out[[0, 2]].tobytes() == expected[[0, 2]].tobytes()


@pytest.mark.parametrize("name", MAKERS)
@pytest.mark.parametrize("field", ["start", "end"])
@pytest.mark.parametrize("value", NO_ID)
def test_a_row_that_is_nowhere_is_named(name: str, field: str, value: float) -> None:
    """A position's cell id may be that of no cell in the world, but it is one."""
    rows, ask = MAKERS[name](), getattr(engine, name)
    rows[field][1, 0] = value
    with pytest.raises(QueryError, match="row 1: it names a cell or an object"):
        ask(WORLD, rows)
    rows[field][1, 0] = CELL + 7
    ask(WORLD, rows)


@pytest.mark.parametrize("kind", [0.0, 1.0, 2.0, 3.0, 4.0])
@pytest.mark.parametrize("value", NO_INDEX)
def test_strange_objects_of_every_kind_of_call(kind: float, value: float) -> None:
    """Whatever is asked of an object, or of a cell, it has to be there."""
    rows = MAKERS["find_object_collisions_many"]()[:1]
    rows["target_kind"], rows["target_cell"], rows["target_object"] = kind, value, value
    with pytest.raises(QueryError, match="row 0"):
        engine.find_object_collisions_many(WORLD, rows)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        *(("cell", value) for value in NO_INDEX),
        *(("cell_id", value) for value in NO_ID),
        *(("num_sphere", value) for value in (-1.0, 3.0, math.nan)),
        *(("num_records", value) for value in (-1.0, 257.0, math.nan)),
    ],
)
def test_a_strange_body_is_named_and_the_others_tick(field: str, value: float) -> None:
    """A body in a cell that is not there does not tick."""
    body = Body(HERE, [(0.0, 0.0, 0.5, 0.5)], transient_state=0x80, velocity=(1.0, 0.0, 0.0))
    rows = body_rows(WORLD, [replace(body, pose=HERE)] * 3)
    expected = engine.step_many(WORLD, rows.copy(), 1 / 30, 1)
    rows[field][1] = value
    with pytest.raises(QueryError, match="row 1"):
        engine.step_many(WORLD, rows, 1 / 30, 1)
    assert rows[[0, 2]].tobytes() == expected[[0, 2]].tobytes()


def test_who_has_left_the_world_is_no_stranger() -> None:
    """A move that begins in no cell fails as retail's does (FT-1)."""
    rows = MAKERS["resolve_many"]()
    rows["begin_cell"] = at.NO_CELL
    assert engine.resolve_many(WORLD, rows)["result"].tolist() == [0.0, 0.0, 0.0]


def test_rows_of_a_larger_world_are_refused() -> None:
    """A row made for a world of two cells begins in the second, which a world of one doesn't have."""
    rows = move_rows(WORLD, [replace(MOVE, begin_cell=CELL + 1)])
    with pytest.raises(QueryError, match="row 0"):
        engine.resolve_many(World([Cell(CELL, HERE, FLOOR)]), rows)
