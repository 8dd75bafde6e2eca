"""Moves that would not end for years are refused, with what makes them so long."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import pytest
from engine_scenes import CELL, at, floor_and_wall, world_of

from engine import (
    Body,
    Cell,
    Move,
    Mover,
    Obstacle,
    QueryError,
    World,
    body_rows,
    layout,
    resolve_many,
    step_many,
    update_many,
)
from engine.constants import IS_VIEWER, MAX_STEPS, SPECK
from engine.effort import check_way
from engine.query import move_rows

WORLD = world_of(floor_and_wall())
RADIUS = 2.0**-10


def mover(radius: float) -> Mover:
    """Return a mover of one sphere."""
    return Mover([(0.0, 0.0, 0.0, radius)])


def test_the_longest_move_has_just_so_many_steps() -> None:
    """One float more is too long; the way across blocks counts."""
    longest = MAX_STEPS * RADIUS
    start, end = np.zeros(8), np.zeros(8)
    end[5] = longest
    check_way(start, end, RADIUS, "move")
    end[5] = np.nextafter(longest, np.inf)
    with pytest.raises(QueryError, match=r"move: .* more than 200000 steps"):
        check_way(start, end, RADIUS, "move")
    end[:] = 0.0
    end[0] = float(0x0200_0000)
    with pytest.raises(QueryError, match=r"move: 384 m with a sphere of radius 0\.000976562 m"):
        check_way(start, end, RADIUS, "move")


def test_a_speck_does_not_move_far() -> None:
    """The error names the move."""
    move = Move(mover(1e-30), at(1.0, 0.0, 0.0), CELL, start=at(0.0, 0.0, 0.0))
    with pytest.raises(QueryError, match="move 0: 1 m with a sphere of radius 1e-30 m"):
        move_rows(WORLD, [move])


def test_a_speck_is_not_put_down() -> None:
    """There are too many places to try about it."""
    move_rows(WORLD, [Move(mover(SPECK), at(0.0, 0.0, 0.0), CELL)])
    with pytest.raises(QueryError, match="move 0: radius 5e-05 m"):
        move_rows(WORLD, [Move(mover(SPECK / 2), at(0.0, 0.0, 0.0), CELL)])


def test_a_speck_does_not_tick() -> None:
    """It might be as fast as bodies are; one without spheres does not collide, and may."""
    rows = body_rows(WORLD, [Body(at(0.0, 0.0, 1.0), []), Body(at(0.0, 0.0, 1.0), [(0.0, 0.0, 0.0, 1e-30)])])
    with pytest.raises(QueryError, match="body 1: 5 m with a sphere"):
        step_many(WORLD, rows, 0.1, 1)
    with pytest.raises(QueryError, match="body 1: 10 m with a sphere"):
        update_many(WORLD, rows, 1.0)
    step_many(WORLD, rows[:1], 0.1, 1)


@pytest.mark.parametrize(
    ("field", "place", "far"), [("start", -1, -1e6), ("end", -1, 1e6), ("end", -2, -5e5)]
)
def test_a_row_that_takes_a_long_way_is_named(field: str, place: int, far: float) -> None:
    """Rows may be changed after they have been made; nothing is in the way, and the others are answered."""
    rows = move_rows(WORLD, [Move(mover(0.5), at(1.0, 0.0, 1.0), CELL, start=at(0.0, 0.0, 1.0))] * 3)
    expected = resolve_many(WORLD, rows)
    rows[field][1, place] = far
    out = np.zeros(3, dtype=layout.RESULT_DTYPE)
    with pytest.raises(QueryError, match="row 1: more than 200000 steps"):
        resolve_many(WORLD, rows, out=out)
    assert out["status"].tolist() == [layout.STATUS_OK, layout.STATUS_ENDLESS, layout.STATUS_OK]
    assert out[[0, 2]].tobytes() == expected[[0, 2]].tobytes()


@pytest.mark.parametrize("far", [2.0**31, 1e19, 1e30, np.inf, np.nan])
@pytest.mark.parametrize("field", ["start", "end"])
def test_every_row_comes_to_an_end(field: str, far: float) -> None:
    """Also one of more steps than there are integers; a step that is lost beside its place ends it."""
    rows = move_rows(WORLD, [Move(mover(0.5), at(1.0, 0.0, 1.0), CELL, start=at(0.0, 0.0, 1.0))] * 2)
    rows[field][1, -1] = far
    out = np.zeros(2, dtype=layout.RESULT_DTYPE)
    with suppress(QueryError):
        resolve_many(WORLD, rows, out=out)
    assert out["status"][0] == layout.STATUS_OK
    assert out["status"][1] in (layout.STATUS_OK, layout.STATUS_ENDLESS)


@pytest.mark.parametrize("viewer", [False, True])
def test_the_longest_row_is_walked(viewer: bool) -> None:
    """A row just as long as a move may be is no error, though a viewer has one step more."""
    begin, end = at(0.0, -0.25, 1.0), at(0.0, MAX_STEPS * RADIUS - 0.25, 1.0)
    who = Mover([(0.0, 0.0, 0.0, RADIUS)], state=IS_VIEWER if viewer else 0)
    rows = move_rows(WORLD, [Move(who, end, CELL, start=begin)])
    assert resolve_many(WORLD, rows)["status"].tolist() == [layout.STATUS_OK]
    rows["end"][0, -2] += 3 * RADIUS
    with pytest.raises(QueryError, match="row 0: more than 200000 steps"):
        resolve_many(WORLD, rows)


def test_a_row_that_puts_down_a_speck_is_named() -> None:
    """Where it fits at once no other place is tried; inside a boulder there would be no end."""
    boulder = Obstacle(at(0.0, 0.0, 0.0), spheres=[(0.0, 0.0, 0.0, 1.0)])
    world = World([Cell(CELL, at(0.0, 0.0, 0.0), floor_and_wall(), objects=[boulder])])
    rows = move_rows(world, [Move(mover(0.5), at(0.0, 0.0, z), CELL) for z in (0.5, 3.0)])
    rows["spheres"][:, 0, -1] = SPECK / 2
    with pytest.raises(QueryError, match=r"row 0: .* too small to be put down"):
        resolve_many(world, rows[:1])
    assert resolve_many(world, rows[1:])["result"].tolist() == [1.0]


def test_a_body_s_row_that_asks_for_a_long_way_is_named() -> None:
    """Velocities are held to a bound, accelerations and places are not; the other body ticks."""
    rows = body_rows(WORLD, [Body(at(0.0, 0.0, 1.0), [(0.0, 0.0, 0.0, 0.5)], transient_state=0x80)] * 2)
    rows["acceleration"][1, 1] = 1e17
    with pytest.raises(QueryError, match="row 1: more than 200000 steps"):
        step_many(WORLD, rows, 0.1, 2)
    assert rows["status"].tolist() == [layout.STATUS_OK, layout.STATUS_ENDLESS]


def test_a_body_whose_bits_are_no_number_is_no_warning() -> None:
    """A row may hold any number."""
    rows = body_rows(WORLD, [Body(at(0.0, 0.0, 1.0), [(0.0, 0.0, 0.0, 0.5)])])
    rows["transient_state"] = np.nan
    step_many(WORLD, rows, 0.1, 1)
