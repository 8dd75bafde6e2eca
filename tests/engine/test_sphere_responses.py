"""CSphere as an obstacle, what is done about a hit: step up, slide, land, stop at a point (07, 3 and 5-7)."""

from __future__ import annotations

from dataclasses import replace
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
from hypothesis import given, settings
from hypothesis import strategies as st

from engine import ContactPlane, Obstacle, Pose, Seed
from engine.kernels.sphere_responses import find_time_of_collision

if TYPE_CHECKING:
    from collections.abc import Sequence

BALL = Obstacle(HERE, spheres=[(0.0, 0.0, 0.0, 1.0)])
Z_LANDING = 0.08715569972991943
NEVER = -1.0
TOLERANCE = 1e-9
"""Relative error of a squared distance; float64's own is 1e-16, times a few operations."""
FLOOR = Seed(last_known=ContactPlane((0.0, 0.0, 1.0, 0.5), CELL))
"""The ground that a mover slides along: level."""

TIMES: list[tuple[str, Sequence[float], Sequence[float], float, float]] = [
    ("a 4, dot -6, c 6.75: (6 - 3) / 4", (2, 0, 0), (-3, 0, 0), 1.5, 0.75),
    ("inside already", (2, 0, 0), (-1, 0, 0), 1.5, -1.0),
    ("touching counts as inside", (2, 0, 0), (-1.5, 0, 0), 1.5, -1.0),
    ("no movement", (0, 0, 0), (-3, 0, 0), 1.5, -1.0),
    ("a movement of 1 centimetre is one too short", (0.01, 0, 0), (-3, 0, 0), 1.5, -1.0),
    ("passing by at 2 metres", (2, 0, 0), (-3, 2, 0), 1.5, -1.0),
    ("grazing: disc 0, 6 / 4", (2, 0, 0), (-3, 1.5, 0), 1.5, 1.5),
    ("moving away: b -6, q 3, so (q + b) / a", (2, 0, 0), (3, 0, 0), 1.5, -0.75),
    ("each axis has its part: a 9, dot -18, c 33.75: (18 - 4.5) / 9", (1, 2, 2), (-2, -4, -4), 1.5, 1.5),
]


@pytest.mark.parametrize(("_why", "m", "d", "radsum", "t"), TIMES, ids=[item[0] for item in TIMES])
def test_when_moving_spheres_meet(
    _why: str, m: Sequence[float], d: Sequence[float], radsum: float, t: float
) -> None:
    """07 3; -1 for never."""
    assert find_time_of_collision(*map(float, m), *map(float, d), radsum) == t


coordinates = st.tuples(*[st.floats(-8.0, 8.0, width=32)] * 3)


@settings(deadline=None)  # the first call compiles
@given(m=coordinates, d=coordinates, radsum=st.floats(0.125, 4.0, width=32))
def test_spheres_that_meet_are_as_far_apart_as_their_radii(
    m: tuple[float, float, float], d: tuple[float, float, float], radsum: float
) -> None:
    """The time is a root of |d + t m|^2 = radsum^2; the tolerance is far above float64's roundings."""
    t = find_time_of_collision(*m, *d, radsum)
    if t != NEVER:
        reached = sum((di + t * mi) ** 2 for mi, di in zip(m, d, strict=True))
        size = sum(di * di + t * t * mi * mi for mi, di in zip(m, d, strict=True))
        assert abs(reached - radsum * radsum) <= TOLERANCE * (1.0 + size)


def slide(start: Sequence[float], end: Sequence[float], **given: Any) -> Any:
    """Run into a ball that is too high to step on."""
    return call(BALL, mover(state=CONTACT), start, end, **({"seed": FLOOR} | given))


def test_who_cannot_step_up_slides_along_the_crease() -> None:
    """07 6.A: from (-1.5, 2) by (0.5, -1) to (-1, 1).

    The normal is (-0.6, 0.8), the crease (0.8, 0.6); of the movement 0.8 * 0.5 - 0.6 = -0.2 are left.
    """
    result = slide((-1.5, 2, 0), (-1, 1, 0))
    assert answer(result) == "SLID"
    nx, ny = f32(0.4 * -1.5), f32(0.4 * 2.0)
    ex, ey = f32(1.0 * ny - 0.0), f32(0.0 - 1.0 * nx)
    length = (0.0 + ey * ey) + ex * ex
    d = ey * -1.0 + ex * 0.5
    ox, oy = f32(f32(ex * d) * (1.0 / length)), f32(f32(ey * d) * (1.0 / length))
    assert origin(result) == [f32(-1.0 + f32(ox - 0.5)), f32(1.0 + f32(oy + 1.0)), 0.0]
    assert origin(result)[:2] == pytest.approx([-1.66, 1.88])
    assert normal(result) == pytest.approx([-0.6, 0.8, 0.0])


def test_a_slide_that_leads_nowhere_is_a_collision() -> None:
    """Straight into it: nothing of the movement is left (07 6.A.9.5). The normal stays."""
    result = slide((-2, 0, 0), (-1, 0, 0))
    assert (answer(result), origin(result)) == ("COLLIDED", [-1.0, 0.0, 0.0])
    assert normal(result) == [-1.0, 0.0, 0.0]


def test_how_short_a_slide_may_be() -> None:
    """Its square must reach 0.0002, all three axes together: 0.0142 are enough, 0.0141 are not."""
    for sideways, expected in ((0.0142, "SLID"), (0.0141, "COLLIDED")):
        result = slide((-2, 0, 0), (-1, f32(sideways), 0))
        assert answer(result) == expected


def test_a_normal_along_the_ground_s_is_undone() -> None:
    """07 6.A.11: what goes up or down meets the ground's own normal, and is put back by all of the way."""
    assert origin(slide((0, 0, 2), (0, 0, 1))) == [0.0, 0.0, 2.0]
    assert answer(slide((0, 0, 2), (0, 0, 1))) == "SLID"


def test_below_the_ball_there_is_no_way_out() -> None:
    """07 6.A.10: the displacement is against the ground's normal."""
    result = slide((0, 0, -2), (0, 0, -1))
    assert (answer(result), origin(result)) == ("COLLIDED", [0.0, 0.0, -1.0])


def test_without_any_known_ground_everything_is_parallel() -> None:
    """07 6.A.4: the last known plane counts, valid or not; here it is nothing at all."""
    result = slide((-2, 0, 0), (-1, 0, 0), seed=Seed())
    assert (answer(result), origin(result)) == ("SLID", [-2.0, 0.0, 0.0])


def test_the_contact_plane_comes_first() -> None:
    """A wall as the ground: the crease with it runs upwards."""
    wall = Seed(contact=ContactPlane((0.0, 1.0, 0.0, 0.0), CELL), last_known=FLOOR.last_known)
    result = slide((-2, 0, 0), (-1, 0, 0.5), seed=wall)
    assert (answer(result), origin(result)) == ("SLID", [-2.0, 0.0, 0.5])


def test_a_slide_counts_the_way_from_the_block_that_it_began_in() -> None:
    """07 6.A.6-7: from 191 in the block to the west to 0 here is a metre; the normal knows nothing of it."""
    start = Pose(0xA8B40111, (190.0, 0.0, 0.0))
    result = call(BALL, mover(state=CONTACT), start, (-1, 0.5, 0), seed=FLOOR)
    # the current centre reads as (190, 0, 0): normal (1, 0, 0), crease (0, -1, 0) with the ground
    assert normal(result) == [1.0, 0.0, 0.0]
    assert origin(result) == [f32(-1.0 - 1.0), 0.5, 0.0]


def test_the_same_centre_is_a_collision_without_a_normal() -> None:
    """07 6.A.2, 6.C.2, 7.1.2 and 7.2.1: there is no direction to be pushed in."""
    inside = (0, 0, 0)
    for state in (CONTACT, 0, CLIPPED):
        result = call(BALL, mover(state=state), inside, (1, 0, 0), seed=FLOOR)
        assert (answer(result), normal(result), result["collide"]) == ("COLLIDED", None, 0)
    head = mover((3, 0, 0), (0, 0, 0), state=CONTACT)
    assert answer(call(BALL, head, inside, (1, 0, 0), seed=FLOOR)) == "COLLIDED"


def test_how_high_is_too_high() -> None:
    """07 5.2: to step on the top takes 1.5 - 1.25 = 0.25, less than a step of 0.26 and more than one of 0.24.

    Who steps ends on top, on water; who does not slides back.
    """
    for height, expected, z in ((0.26, "OK", 1.5), (0.24, "SLID", 2.0)):
        who = mover(state=CONTACT, step_up_height=height)
        result = call(BALL, who, (0, 0, 2), (0, 0, 1.25), seed=FLOOR)
        assert answer(result) == expected
        assert origin(result)[2] == pytest.approx(z, abs=1e-6)
        assert result["contact_plane_is_water"] == (expected == "OK")


def test_a_step_up_that_fails_slides() -> None:
    """07 5.4: there is no room on top for the second sphere.

    The normal of the step, (-0.5, 0, 1.5), is not normalised; of the way (0.5, 0.3, -0.25) the crease with
    the ground leaves 0.3 along y.
    """
    shelf = replace(BALL, spheres=[(0, 0, 0, 1), (0, 0, 4, 1)])
    who = mover((0, 0, 0), (0, 0, 1.3), state=CONTACT, step_up_height=1.0)
    result = call(shelf, who, (-0.5, 0, 1.5), (0, 0.3, 1.25), seed=FLOOR)
    assert result["step_up_normal"].tolist() == [-0.5, 0.0, 1.5]
    assert (answer(result), origin(result)) == ("SLID", [-0.5, f32(0.3), 1.5])
    assert (result["contact_plane_valid"], result["step_up"]) == (0, 0)


def test_the_head_slides() -> None:
    """07 6.C: only sphere 1 overlaps; it slides as along any obstacle, with its own centres.

    Its normal is (-1, 0, 0), the crease with the ground runs along y: 0.5 of the way are left.
    """
    two = mover((0, 0, -3), (0, 0, 0), state=CONTACT)
    result = call(BALL, two, (-2, 0, 0), (-1, 0.5, 0), seed=FLOOR)
    assert (answer(result), origin(result)) == ("SLID", [-2.0, 0.5, 0.0])
    assert normal(result) == [-1.0, 0.0, 0.0]


def test_in_the_air_a_landing_begins() -> None:
    """07 7.1: it is noted with a normal of unit length, and tried from where the mover is."""
    result = call(BALL, mover(), (0, -3, 4), (0, -0.6, 0.8), walk_interp=0.5)
    assert (answer(result), origin(result)) == ("ADJUSTED", [0.0, f32(-0.6), f32(0.8)])
    assert result["collide"] == 1
    assert result["step_up_normal"].tolist() == [0.0, f32(0.2 * -3.0), f32(0.2 * 4.0)]
    assert (result["walkable_allowance"], result["walk_interp"]) == (Z_LANDING, 1.0)
    assert normal(result) is None


def test_in_the_air_the_head_stops() -> None:
    """07 8.7: what only sphere 1 touches ends the movement."""
    result = call(BALL, mover((0, 0, -3), (0, 0, 0)), (-2, 0, 0), (-1, 0, 0))
    assert (answer(result), normal(result)) == ("COLLIDED", [-1.0, 0.0, 0.0])


def test_a_missile_stops_at_what_its_first_sphere_touches() -> None:
    """07 8.7: the second sphere of a clipped mover is never tested."""
    for offsets, expected, struck in (
        ([(0, 0, 0)], "COLLIDED", [-1.0, 0.0, 0.0]),
        ([(0, 0, -3), (0, 0, 0)], "OK", None),
    ):
        result = call(BALL, mover(*offsets, state=CLIPPED), (-2, 0, 0), (-1, 0, 0))
        assert (answer(result), normal(result)) == (expected, struck)


def test_contact_comes_before_clipping() -> None:
    """07 8.7: a clipped mover on the ground slides."""
    result = call(BALL, mover(state=CONTACT | CLIPPED), (-1.5, 2, 0), (-1, 1, 0), seed=FLOOR)
    assert answer(result) == "SLID"


def test_a_perfectly_clipped_mover_stops_where_it_touches() -> None:
    """07 7.2, from x = -3 to -1: three quarters of the way, and the normal of that place."""
    result = call(BALL, mover(state=PERFECT), (-3, 0, 0), (-1, 0, 0))
    assert (answer(result), origin(result)) == ("ADJUSTED", [-1.5, 0.0, 0.0])
    assert normal(result) == [-1.0, 0.0, 0.0]


def test_a_perfectly_clipped_mover_that_touches_from_the_beginning_stops_dead() -> None:
    """07 7.2.5: there is no time of collision."""
    result = call(BALL, mover(state=PERFECT), (-1.5, 0, 0), (-1, 0, 0))
    assert (answer(result), origin(result), normal(result)) == ("COLLIDED", [-1.0, 0.0, 0.0], None)


def test_a_perfectly_clipped_mover_knows_of_blocks_only_for_its_way() -> None:
    """07 7.2.3-4: its way from the block to the west is 2 metres, but its beginning reads as x = 189."""
    start = Pose(0xA8B40111, (189.0, 0.0, 0.0))
    result = call(BALL, mover(state=PERFECT), start, (-1, 0, 0))
    assert (answer(result), normal(result)) == ("COLLIDED", None)
