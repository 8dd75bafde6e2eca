"""CCylSphere as an obstacle: who overlaps, and standing on the cap (07, 10.1, 10.2, 10.8 and 10.9)."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from engine_obstacles import (
    CLIPPED,
    CONTACT,
    EPS,
    HERE,
    RADIUS,
    above,
    answer,
    call,
    contact,
    f32,
    mover,
    origin,
)
from engine_scenes import CELL

from engine import Obstacle, Pose, Weenie

PILLAR = Obstacle(HERE, cylspheres=[(0.0, 0.0, 0.0, 1.0, 2.0)])
"""Radius 1, from 0 to 2 metres."""
CREATURE = replace(PILLAR, weenie=Weenie(creature=True))
RADSUM = f32((1.0 - EPS) + RADIUS)
"""07 10.8.1: grouped otherwise than a sphere's."""
REACH = (RADIUS - EPS) + 1.0
"""07 10.1.2: how far from half the height a centre may be."""
FAR = (3.0, 0.0, 1.0)

ASKS_FOR_OVERLAP: list[dict[str, float]] = [
    {"insert_type": 1},
    {"obstruction_ethereal": 1},
    {"obstruction_ethereal": 1, "step_down": 1, "step_down_amt": 0.5},
    {"check_walkable": 1},
]


@pytest.mark.parametrize("path", ASKS_FOR_OVERLAP)
def test_a_touch_of_the_side_is_an_overlap(path: dict[str, float]) -> None:
    """At exactly the sum of the radii; the next float32 is clear."""
    assert answer(call(PILLAR, mover(), FAR, (0, RADSUM, 1), **path)) == "COLLIDED"
    assert answer(call(PILLAR, mover(), FAR, (0, above(RADSUM), 1), **path)) == "OK"


@pytest.mark.parametrize("path", ASKS_FOR_OVERLAP)
def test_a_touch_of_a_cap_is_an_overlap(path: dict[str, float]) -> None:
    """Both caps reach EPS less than half the height and the sphere's radius, rounded nowhere."""
    top = f32(np.float32(1.0 + REACH))
    top = top if top - 1.0 <= REACH else float(np.nextafter(np.float32(top), np.float32(0)))
    for z, expected in ((top, "COLLIDED"), (above(top), "OK"), (-0.4997, "COLLIDED"), (-0.4999, "OK")):
        assert answer(call(PILLAR, mover(), FAR, (0, 0, z), **path)) == expected


@pytest.mark.parametrize("path", ASKS_FOR_OVERLAP)
def test_the_second_sphere_reaches_caps_with_its_own_radius(path: dict[str, float]) -> None:
    """And the side with the first one's."""
    two = replace(mover(), spheres=[(0, 0, 0, RADIUS), (0, 0, 4, 0.125)])
    for end, expected in (
        ((0, 0, -1.9), "COLLIDED"),  # sphere 1 at 2.1 of 2.1248
        ((0, 0, -1.8), "OK"),
        ((1.49, 0, -3), "COLLIDED"),
        ((1.51, 0, -3), "OK"),
    ):
        assert answer(call(PILLAR, two, FAR, end, **path)) == expected


@pytest.mark.parametrize(
    "path", [*ASKS_FOR_OVERLAP, {"collide": 1}, {}, {"step_down": 1, "step_down_amt": 1}]
)
@pytest.mark.parametrize("state", [0, CONTACT, CLIPPED])
def test_who_is_far_away_is_not_concerned(path: dict[str, float], state: int) -> None:
    """Whatever is asked, nothing changes."""
    result = call(PILLAR, mover((0, 0, 0), (0, 0, 1), state=state), FAR, (2, 0, 0.5), **path)
    assert (answer(result), origin(result)) == ("OK", [2.0, 0.0, 0.5])


def test_an_object_places_and_scales_its_cylinders_but_does_not_tilt_them() -> None:
    """Lying on its side, (0, 0, 1) comes to (0, -1, 0): the low point; the cylinder stands upright there.

    It is twice as large: from (0, -2, 0) it reaches up to 4 metres, and its side to 2.
    """
    lying = Pose(CELL, (10, 20, 30), (f32(math.sqrt(0.5)), f32(math.sqrt(0.5)), 0, 0))
    pillar = Obstacle(lying, scale=2.0, cylspheres=[(0, 0, 1, 1, 2)])
    for end, expected in (
        ((10, 18, 34.49), "COLLIDED"),
        ((10, 18, 34.51), "OK"),
        ((12.49, 18, 32), "COLLIDED"),
        ((12.51, 18, 32), "OK"),
    ):
        assert answer(call(pillar, mover(), (0, 0, 30), end, insert_type=1)) == expected


def test_an_object_of_the_next_block_is_192_metres_away() -> None:
    """Its cylinder is taken into the block of the check position."""
    north = Obstacle(Pose(0xA9B50111), cylspheres=[(0, 0, 0, 1, 2)])
    for y, expected in ((191.0, "COLLIDED"), (-1.0, "OK"), (1.0, "OK")):
        assert answer(call(north, mover(), (0, 190, 0), (0, y, 1), insert_type=1)) == expected


def test_a_step_down_ends_on_the_cap() -> None:
    """07 10.2: 2 + 0.5 - 2.25 = 0.25 up, half of the step; the point is (0, 0, 0.25 - 0.5 + 2.25)."""
    result = call(PILLAR, mover(), (0.5, 0, 3), (0.5, 0, 2.25), step_down=1, step_down_amt=0.5)
    assert (answer(result), origin(result)) == ("ADJUSTED", [0.5, 0.0, 2.5])
    assert contact(result) == [0.0, 0.0, 1.0, -2.0]
    assert result["walk_interp"] == 0.5


STEPS_DOWN: list[tuple[str, dict[str, Any], str]] = [
    ("0.54 up of 0.5 leave -0.08", {"end": (0, 0, 1.96)}, "ADJUSTED"),
    ("0.56 up of 0.5 leave -0.12", {"end": (0, 0, 1.94)}, "COLLIDED"),
    ("a step of nothing", {"end": (0, 0, 2.25), "step_down_amt": 0.000199}, "COLLIDED"),
    ("a step that is smaller than the way up", {"end": (0, 0, 2.25), "step_down_amt": 0.2}, "COLLIDED"),
    ("beside the cap, but within the radius", {"end": (1.4, 0, 2.25)}, "ADJUSTED"),
    ("a creature's, too", {"end": (0, 0, 2.25), "obstacle": CREATURE}, "ADJUSTED"),
    ("no allowance refuses it", {"end": (0, 0, 2.25), "walkable_allowance": 1.0}, "ADJUSTED"),
]


@pytest.mark.parametrize(("_why", "given", "expected"), STEPS_DOWN, ids=[why for why, _, _ in STEPS_DOWN])
def test_both_sides_of_each_limit_of_a_step_down(_why: str, given: dict[str, Any], expected: str) -> None:
    """07 10.2.2 and 10.2.4; there is no exemption and no walkable test."""
    asked = {"obstacle": PILLAR, "step_down": 1, "step_down_amt": 0.5} | given
    result = call(asked.pop("obstacle"), mover(), (0, 0, 3), **asked)
    assert answer(result) == expected
    assert (contact(result) is None) == (expected == "COLLIDED")


def test_only_the_second_sphere_reaches_down() -> None:
    """The first is solved for all the same: it is above the cap, so that no step is left."""
    result = call(PILLAR, mover((0, 0, 0), (0, 0, -1)), (0, 0, 4), (0, 0, 3), step_down=1, step_down_amt=0.5)
    assert answer(result) == "COLLIDED"


def test_a_landing_goes_back_along_the_way() -> None:
    """07 10.8.6, from (-1, 0, 4) to (0, 0, 2): back by a quarter of (-1, 0, 2), onto a plane at z = 2."""
    result = call(PILLAR, mover(), (-1, 0, 4), (0, 0, 2), collide=1)
    assert (answer(result), origin(result)) == ("ADJUSTED", [-0.25, 0.0, 2.5])
    assert contact(result) == [0.0, 0.0, 1.0, -2.0]
    assert result["walk_interp"] == 0.75


LANDINGS: list[tuple[str, dict[str, Any], str]] = [
    ("level movements have no time", {"start": (-3, 0, 1), "end": (-1, 0, 1)}, "COLLIDED"),
    ("nor does one of 0.1 millimetres", {"start": (-3, 0, 1.0001), "end": (-1, 0, 1)}, "COLLIDED"),
    (
        "where z is right x is -1 - 0.25 * 1.9 = -1.475",
        {"start": (-2.9, 0, 4), "end": (-1, 0, 2)},
        "ADJUSTED",
    ),
    ("x would be -1.5: beside the cap", {"start": (-3, 0, 4), "end": (-1, 0, 2)}, "OK"),
    ("from below the way is undone twice", {"start": (0, 0, -3), "end": (0, 0, -0.25)}, "COLLIDED"),
    ("(2.5 - 2) / 0.463 = 1.08 of the way", {"start": (0, 0, 2.463), "end": (0, 0, 2)}, "ADJUSTED"),
    ("(2.5 - 2) / 0.446 = 1.12 of the way", {"start": (0, 0, 2.446), "end": (0, 0, 2)}, "COLLIDED"),
]


@pytest.mark.parametrize(("_why", "given", "expected"), LANDINGS, ids=[why for why, _, _ in LANDINGS])
def test_ways_out_of_a_landing(_why: str, given: dict[str, Any], expected: str) -> None:
    """07 10.8.6.1-4."""
    result = call(PILLAR, mover(), collide=1, **given)
    assert answer(result) == expected


def test_a_landing_asks_whether_anything_overlaps() -> None:
    """07 10.8.6: sphere 1 is enough, sphere 0 is what lands."""
    two = mover((0, 0, 0), (0, 0, -1))
    assert answer(call(PILLAR, two, (0, 0, 5), (0, 0, 3), collide=1)) == "COLLIDED"
    assert answer(call(PILLAR, mover(), (0, 0, 5), (0, 0, 3), collide=1)) == "OK"
