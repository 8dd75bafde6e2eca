"""CCylSphere as an obstacle, what is done about a hit: step up, slide, land, stop (07, 10.3-10.7)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest
from engine_obstacles import (
    CLIPPED,
    CONTACT,
    HERE,
    PERFECT,
    answer,
    call,
    f32,
    mover,
    normal,
    origin,
)
from engine_scenes import CELL

from engine import ContactPlane, Obstacle, Pose, Seed

if TYPE_CHECKING:
    from collections.abc import Sequence

PILLAR = Obstacle(HERE, cylspheres=[(0.0, 0.0, 0.0, 1.0, 2.0)])
"""Radius 1, from 0 to 2 metres."""
FLOOR = Seed(last_known=ContactPlane((0.0, 0.0, 1.0, 0.5), CELL))
"""The ground that a mover slides along: level."""
Z_LANDING = 0.08715569972991943


def test_who_cannot_step_up_slides_along_the_side() -> None:
    """07 10.5: from (-1.5, 2) by (0.5, -1): -0.2 of the crease (0.8, 0.6) are left."""
    result = call(PILLAR, mover(state=CONTACT), (-1.5, 2, 1), (-1, 1, 1), seed=FLOOR)
    assert answer(result) == "SLID"
    assert normal(result) == pytest.approx([-0.6, 0.8, 0.0])
    assert origin(result) == pytest.approx([-1.66, 1.88, 1.0])


def test_a_step_onto_the_cap() -> None:
    """07 10.6.1: 0.5 + 2 - 2.25 = 0.25 takes a step that is not shorter; then it stands at 2.5, on water."""
    for height, expected, z in ((0.25, "OK", 2.5), (0.2499, "SLID", 3.0)):
        who = mover(state=CONTACT, step_up_height=height)
        result = call(PILLAR, who, (0, 0, 3), (0, 0, 2.25), seed=FLOOR)
        assert (answer(result), origin(result)) == (expected, [0.0, 0.0, z])
        assert result["contact_plane_is_water"] == (expected == "OK")


def test_the_normal_of_a_step_is_turned_once_more() -> None:
    """07 10.6.3: a quarter of a turn of the object makes (0, 1, 0) of (1, 0, 0).

    The step fails for want of room on top; then the mover slides along what the normal says: of its way
    (-1, 0.5) is left what goes along y, or along x.
    """
    turned = Pose(CELL, (0, 0, 0), (f32(math.sqrt(0.5)), 0, 0, f32(math.sqrt(0.5))))
    for pose, expected, place in ((HERE, [1, 0, 0], [2, 0.5, 1.75]), (turned, [0, 1, 0], [1, 0, 1.75])):
        towers = Obstacle(pose, cylspheres=[(0, 0, 0, 1, 2), (0, 0, 3, 1, 2)])
        who = mover((0, 0, 0), (0, 0, 1.2), state=CONTACT, step_up_height=1.0)
        result = call(towers, who, (2, 0, 1.75), (1, 0.5, 1.75), seed=FLOOR)
        assert result["step_up_normal"].tolist() == pytest.approx(expected, abs=1e-6)
        assert answer(result) == "SLID"
        assert origin(result) == pytest.approx(place, abs=1e-6)


def test_the_head_slides() -> None:
    """07 10.8.5: only sphere 1 overlaps; it slides with its own displacement and centres."""
    two = mover((0, 0, -3), (0, 0, 1), state=CONTACT)
    result = call(PILLAR, two, (-2, 0, 0), (-1, 0.5, 0), seed=FLOOR)
    assert (answer(result), origin(result)) == ("SLID", [-2.0, 0.5, 0.0])
    assert normal(result) == [-1.0, 0.0, 0.0]


LANDINGS: list[tuple[str, Sequence[float], Sequence[float], list[float]]] = [
    ("from beside", (-3, 0, 1), (-1, 0, 1), [-1.0, 0.0, 0.0]),
    ("from above", (0.5, 0, 4), (0.5, 0, 2), [0.0, 0.0, 1.0]),
    ("from below", (0.5, 0, -2), (0.5, 0, 0), [0.0, 0.0, -1.0]),
    ("on the spot counts as from above", (0.5, 0, 2), (0.5, 0, 2), [0.0, 0.0, 1.0]),
    (
        "from the edge, at the sum of the radii, is from above",
        (0, f32(1.4998), 4),
        (0, 1, 2),
        [0.0, 0.0, 1.0],
    ),
]


@pytest.mark.parametrize(("_why", "start", "end", "expected"), LANDINGS, ids=[item[0] for item in LANDINGS])
def test_in_the_air_a_landing_begins(
    _why: str, start: Sequence[float], end: Sequence[float], expected: list[float]
) -> None:
    """07 10.3 and 10.7: with the normal of where the mover comes from."""
    result = call(PILLAR, mover(), start, end)
    assert (answer(result), origin(result)) == ("ADJUSTED", [f32(v) for v in end])
    assert (result["collide"], result["walkable_allowance"]) == (1, Z_LANDING)
    assert result["step_up_normal"].tolist() == expected


def test_in_the_air_the_head_stops() -> None:
    """07 10.8.5: what only sphere 1 touches ends the movement."""
    result = call(PILLAR, mover((0, 0, -3), (0, 0, 1)), (-2, 0, 0), (-1, 0, 0))
    assert (answer(result), normal(result)) == ("COLLIDED", [-1.0, 0.0, 0.0])


def test_a_missile_stops_at_what_its_first_sphere_touches() -> None:
    """07 10.8.5: the second sphere of a clipped mover is never tested."""
    for offsets, expected, struck in (
        ([(0, 0, 1)], "COLLIDED", [-1.0, 0.0, 0.0]),
        ([(0, 0, -3), (0, 0, 1)], "OK", None),
    ):
        result = call(PILLAR, mover(*offsets, state=CLIPPED), (-2, 0, 0), (-1, 0, 0))
        assert (answer(result), normal(result)) == (expected, struck)


PERFECT_CLIPS: list[tuple[str, dict[str, Any], str, list[float], list[float] | None]] = [
    (
        "side: a 4, dot -6, disc 9",
        {"start": (-3, 0, 1), "end": (-1, 0, 1)},
        "ADJUSTED",
        [-1.5, 0, 1],
        [-1, 0, 0],
    ),
    (
        "cap: (0.5 + 2 - 4) / -2",
        {"start": (0.5, 0, 4), "end": (0.5, 0, 2)},
        "ADJUSTED",
        [0.5, 0, 2.5],
        [0, 0, 1],
    ),
    (
        "below: -(-2 + 0.5) / 2",
        {"start": (0.5, 0, -2), "end": (0.5, 0, 0)},
        "ADJUSTED",
        [0.5, 0, -0.5],
        [0, 0, -1],
    ),
    ("corner to side", {"start": (-3, 0, 4), "end": (-1, 0, 2)}, "ADJUSTED", [-1.5, 0, 2.5], [-1, 0, 0]),
    ("corner to cap", {"start": (-2.75, 0, 4), "end": (-0.75, 0, 2)}, "ADJUSTED", [-1.25, 0, 2.5], [0, 0, 1]),
    (
        "corner from below",
        {"start": (-2.75, 0, -2), "end": (-0.75, 0, 0)},
        "ADJUSTED",
        [-1.25, 0, -0.5],
        [0, 0, -1],
    ),
    ("cap, level: no time", {"start": (0.5, 0, 2), "end": (0.75, 0, 2)}, "COLLIDED", [0.75, 0, 2], None),
    (
        "side, straight up: no root",
        {"start": (-1.4999, 0, 1), "end": (-1.4997, 0, 1.5)},
        "COLLIDED",
        [-1.4997, 0, 1.5],
        None,
    ),
]


@pytest.mark.parametrize(
    ("_why", "given", "expected", "place", "struck"), PERFECT_CLIPS, ids=[item[0] for item in PERFECT_CLIPS]
)
def test_a_perfectly_clipped_mover_stops_where_it_touches(
    _why: str, given: dict[str, Any], expected: str, place: list[float], struck: list[float] | None
) -> None:
    """07 10.4: the whole way takes 1; it touches after 0.75."""
    result = call(PILLAR, mover(state=PERFECT), **given)
    assert answer(result) == expected
    assert origin(result) == [f32(v) for v in place]
    assert normal(result) == struck


def test_the_second_sphere_is_moved_to_where_the_first_would_touch() -> None:
    """07 10.4.3: the way begins at sphere 0's centre, whichever sphere is meant.

    Sphere 1 moves from (-3, 0, 1) to (-1, 0, 1), sphere 0 is 3 metres below: the cylinder is taken to be
    reached from (-3, 0, -2), where the way leads up by 3 metres; and by those the mover is moved down.
    """
    two = mover((0, 0, -3), (0, 0, 0), state=PERFECT & ~CLIPPED)
    result = call(PILLAR, two, (-3, 0, 1), (-1, 0, 1))
    assert answer(result) == "ADJUSTED"
    # m = (-1, 0, 1) - (-3, 0, -2) = (2, 0, 3), side: t 0.75, off (1.5, 0, 2.25);
    # (-3, 0, -2) + off - (-1, 0, 1) = (-0.5, 0, -0.75)
    assert origin(result) == [-1.5, 0.0, 0.25]
    assert normal(result) == [-1.0, 0.0, 0.0]
