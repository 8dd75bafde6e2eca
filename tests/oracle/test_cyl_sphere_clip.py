"""CCylSphere::collide_with_point: where a perfectly clipped mover touches a cylinder (07 10.4).

The cylinder stands on the origin, 2 metres high; the radii make exactly 2, the mover's is 0.5. Every step
below is of 07 10.4.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from oracle_obstacles import ATOM, EAST_CELL, TWO, approaching, moved_by
from oracle_worlds import vec, xyz

from oracle import cyl_sphere_clip
from oracle.arithmetic import f32
from oracle.constants import EPS
from oracle.cyl_sphere import CylSphere
from oracle.cyl_sphere_clip import Approach
from oracle.enums import PERFECT_CLIP_OI, TransitionState
from oracle.vector import Vector3

if TYPE_CHECKING:
    from oracle.transition import Transition

    Point = tuple[float, float, float]

COLLIDED, ADJUSTED = TransitionState.COLLIDED, TransitionState.ADJUSTED
NOWHERE = (0.0, 0.0, 0.0)


def stop(
    made: Transition,
    *,
    state: int = PERFECT_CLIP_OI,
    sphere_num: int = 0,
    radsum: float = TWO,
    low: Point = NOWHERE,
) -> TransitionState:
    """Stop at the cylinder."""
    made.object_info.state = state
    path, shape = made.sphere_path, CylSphere(vec(*low), 2.0, 1.5)
    s = path.global_sphere[sphere_num]
    disp = Vector3(*(a - b for a, b in zip(xyz(s.center), low, strict=True)))
    return shape.collide_with_point(made.object_info, path, made.collision_info, s, disp, radsum, sphere_num)


def outcome(curr: Point, check: Point) -> tuple[TransitionState, Point, Point | None]:
    """Move a perfect mover; return the answer, how far it was moved back, and the collision normal."""
    made = approaching(curr, check)
    result = stop(made)
    ci = made.collision_info
    return result, moved_by(made, check), xyz(ci.collision_normal) if ci.collision_normal_valid else None


class TestOrdinary:
    """A mover without perfect clipping."""

    def test_it_just_collides(self) -> None:
        """10.4.1, 10.4.2: with the normal of the side that it came from, normalised."""
        made = approaching((-3.0, -4.0, 1.0), (-1.0, 0.0, 1.0))
        assert stop(made, state=0) == COLLIDED
        fifth = 1.0 / 5.0
        assert xyz(made.collision_info.collision_normal) == (f32(fifth * -3.0), f32(fifth * -4.0), 0.0)
        assert moved_by(made, (-1.0, 0.0, 1.0)) == NOWHERE

    @pytest.mark.parametrize("state", [0, PERFECT_CLIP_OI])
    def test_from_the_axis_there_is_no_normal(self, state: int) -> None:
        """10.4.1: with radii of 0, beside by half of EPS."""
        made = approaching((EPS / 2.0, 0.0, 1.0), (-1.0, 0.0, 1.0))
        assert stop(made, state=state, radsum=0.0) == COLLIDED
        assert made.collision_info.collision_normal_valid == 0


class TestCap:
    """From above or below within the radius (10.4.5)."""

    def test_from_above(self) -> None:
        """10.4.4.2: down by 2 from 4: t = (0.5 + 2 - 4)/-2 = 0.75: at 2.5."""
        assert outcome((0.0, 0.5, 4.0), (0.0, 0.5, 2.0)) == (ADJUSTED, (0.0, 0.0, 0.5), (0.0, 0.0, 1.0))

    def test_from_below(self) -> None:
        """10.4.4.2: up by 2 from -2: t = -((-2 + 0.5)/2) = 0.75: at -0.5."""
        assert outcome((0.0, 0.5, -2.0), (0.0, 0.5, 0.0)) == (ADJUSTED, (0.0, 0.0, -0.5), (0.0, 0.0, -1.0))

    def test_a_slanted_way(self) -> None:
        """10.4.5: 0.75 of (1, 0.5, -2), though that leads beyond no rim: only height is looked at."""
        assert outcome((0.0, 0.0, 4.0), (1.0, 0.5, 2.0)) == (ADJUSTED, (-0.25, -0.125, 0.5), (0.0, 0.0, 1.0))

    def test_level(self) -> None:
        """10.4.4.1: |mz| below EPS collides: 2^-13 is, 2^-12 is not and touches half way."""
        assert outcome((0.0, 0.0, 2.5 + 2.0**-14), (0.0, 0.0, 2.5 - 2.0**-14))[0] == COLLIDED
        found = outcome((0.0, 0.0, 2.5 + 2.0**-13), (0.0, 0.0, 2.5 - 2.0**-13))
        assert found == (ADJUSTED, (0.0, 0.0, 2.0**-13), (0.0, 0.0, 1.0))

    def test_exactly_eps_is_not_level(self) -> None:
        """10.4.4.1: strictly below; the next double towards zero is level."""
        for mz, level in ((-EPS, False), (EPS, False), (math.nextafter(EPS, 0.0), True)):
            way = Approach(vec(*NOWHERE), 0.5, Vector3(0.0, 0.0, mz), vec(*NOWHERE), 2.0)
            touch = cyl_sphere_clip._touch_cap(CylSphere(vec(*NOWHERE), 2.0, 1.5), way, Vector3())
            assert (touch is None) is level

    @pytest.mark.parametrize(
        ("curr", "check", "result"),
        [
            (2.5, 2.0, ADJUSTED),
            (2.5 - ATOM, 2.0, COLLIDED),
            (3.0, 2.5, ADJUSTED),
            (3.0, 2.5 + ATOM, COLLIDED),
            (-0.5, 0.0, ADJUSTED),
            (-0.5 + ATOM, 0.0, COLLIDED),
            (-1.0, -0.5, ADJUSTED),
            (-1.0, -0.5 - ATOM, COLLIDED),
        ],
    )
    def test_beginning_and_end_count(self, curr: float, check: float, result: TransitionState) -> None:
        """10.4.7: t = 0 and t = 1 do, by 2^-22 outside of that they do not."""
        found = outcome((0.0, 0.0, curr), (0.0, 0.0, check))
        assert (found[0], found[2] is None) == (result, result == COLLIDED)


class TestSide:
    """From beside at the cylinder's height (10.4.6)."""

    def test_the_first_touch(self) -> None:
        """10.4.6: from -5 by 4: a = 16, b = 20, disc = 400 - 21*16, q = 8; t = 12/16; one metre back."""
        found = outcome((-5.0, 0.0, 1.0), (-1.0, 0.0, 1.0))
        assert found == (ADJUSTED, (-1.0, 0.0, 0.0), (-1.0, 0.0, 0.0))
        found = outcome((0.0, -5.0, 1.0), (0.0, -1.0, 1.0))
        assert found == (ADJUSTED, (0.0, -1.0, 0.0), (0.0, -1.0, 0.0))

    def test_the_height_comes_along(self) -> None:
        """10.4.6, 10.4.8: three quarters of a rise of 0.25 are kept; the normal stays level."""
        found = outcome((-5.0, 0.0, 1.0), (-1.0, 0.0, 1.25))
        assert found == (ADJUSTED, (-1.0, 0.0, -0.0625), (-1.0, 0.0, 0.0))

    def test_passing_by(self) -> None:
        """10.4.6: at y = 2 the radicand is 1600 - 25*64 = 0 and counts: t = 40/64; at 2.5 it is negative."""
        assert outcome((-5.0, 2.0, 1.0), (3.0, 2.0, 1.0)) == (ADJUSTED, (-3.0, 0.0, 0.0), (0.0, 1.0, 0.0))
        assert outcome((-5.0, 2.5, 1.0), (3.0, 2.5, 1.0))[0] == COLLIDED

    def test_without_movement(self) -> None:
        """10.4.6: a below EPS: 2^-14 is, 2^-12 is not; from -2 - 2^-7 half of 2^-6 touches."""
        x = -2.0 - 2.0**-7
        assert outcome((x, 0.0, 1.0), (x + 2.0**-7, 0.0, 1.0))[0] == COLLIDED
        found = outcome((x, 0.0, 1.0), (x + 2.0**-6, 0.0, 1.0))
        assert found == (ADJUSTED, (-(2.0**-7), 0.0, 0.0), (-1.0, 0.0, 0.0))

    def test_moving_away(self) -> None:
        """10.4.6: b = -20, so the second root is taken, and t < 0."""
        assert outcome((-5.0, 0.0, 1.0), (-9.0, 0.0, 1.0))[0] == COLLIDED

    def test_from_within_the_tolerance_through_to_the_other_side(self) -> None:
        """10.4.6: at -(2 - 2^-14), beyond the radius sum but not beyond it and EPS: b - q = -2^-11 < 0.

        By 8: a = 64, b = 16 - 2^-11, q = 16, t = (16 + 16 - 2^-11)/64: at +2.
        """
        x = -(2.0 - 2.0**-14)
        found = outcome((x, 0.0, 1.0), (x + 8.0, 0.0, 1.0))
        assert found == (ADJUSTED, (2.0 - (x + 8.0), 0.0, 0.0), (1.0, 0.0, 0.0))

    def test_the_end_of_the_movement_counts(self) -> None:
        """10.4.6: from -4 to -2 is t = 1; 2^-21 less does not reach."""
        assert outcome((-4.0, 0.0, 1.0), (-2.0, 0.0, 1.0))[0] == ADJUSTED
        assert outcome((-4.0, 0.0, 1.0), (-2.0 - 2.0 * ATOM, 0.0, 1.0))[0] == COLLIDED


class TestCorner:
    """From beside, and from above or below (10.4.4)."""

    def test_within_the_rim(self) -> None:
        """10.4.4.2, 10.4.4.3: down by 2 from 4: t = 0.75; at x = -3 + 1.5 that is above the cap."""
        found = outcome((-3.0, 0.0, 4.0), (-1.0, 0.0, 2.0))
        assert found == (ADJUSTED, (-0.5, 0.0, 0.5), (0.0, 0.0, 1.0))

    def test_within_the_rim_from_below(self) -> None:
        """10.4.4.2: up by 2 from -2, the normal points down."""
        found = outcome((0.0, -3.0, -2.0), (0.0, -1.0, 0.0))
        assert found == (ADJUSTED, (0.0, -0.5, -0.5), (0.0, 0.0, -1.0))

    def test_the_rim_is_the_side_s(self) -> None:
        """10.4.4.4: 4 >= 4: from -3.5 the plane is met at -2, the side at (7 - 4)/4; 2^-21 nearer is cap."""
        found = outcome((-3.5, 0.0, 4.0), (-1.5, 0.0, 2.0))
        assert found == (ADJUSTED, (-0.5, 0.0, 0.5), (-1.0, 0.0, 0.0))
        x = -3.5 + 2.0 * ATOM
        assert outcome((x, 0.0, 4.0), (x + 2.0, 0.0, 2.0))[2] == (0.0, 0.0, 1.0)
        found = outcome((0.0, -3.5, 4.0), (0.0, -1.5, 2.0))
        assert found == (ADJUSTED, (0.0, -0.5, 0.5), (0.0, -1.0, 0.0))

    def test_the_side_is_met_later(self) -> None:
        """10.4.4.4.2…4: the plane at t = 0.5 and x = -4; a = 64, b = 64, disc = 4096 - 60*64, t = 48/64."""
        found = outcome((-8.0, 0.0, 4.0), (0.0, 0.0, 1.0))
        assert found == (ADJUSTED, (-2.0, 0.0, 0.75), (-1.0, 0.0, 0.0))

    def test_the_side_is_never_met(self) -> None:
        """10.4.4.4.3: passing by at y = 3, disc = 4096 - 69*64 < 0: the time of the plane is kept, t = 0.5.

        There it is at (-4, 3): that, halved and normalised, is the normal.
        """
        fifth = 1.0 / 2.5
        found = outcome((-8.0, 3.0, 4.0), (0.0, 3.0, 1.0))
        assert found == (ADJUSTED, (-4.0, 0.0, 1.5), (f32(fifth * -2.0), f32(fifth * 1.5), 0.0))

    def test_straight_down_beside(self) -> None:
        """10.4.4.4.1: no level movement: a = 0 collides; with 2^-6 there is one, and no root."""
        assert outcome((-3.0, 0.0, 4.0), (-3.0, 0.0, 2.0))[0] == COLLIDED
        assert outcome((-3.0, 0.0, 4.0), (-3.0 + 2.0**-7, 0.0, 2.0))[0] == COLLIDED
        assert outcome((0.0, 3.0, 4.0), (2.0**-6, 3.0, 2.0))[0] == ADJUSTED

    def test_exactly_eps_of_level_movement_is_no_movement(self) -> None:
        """10.4.4.4.3: a = EPS passes |a| < EPS and fails a > EPS: the time of the plane is kept."""
        m = Vector3(math.sqrt(EPS), 0.0, -2.0)
        assert m.x * m.x == EPS
        way = Approach(vec(-3.0, 0.0, 4.0), 0.5, m, vec(-3.0, 0.0, 4.0), 2.0)
        touch = cyl_sphere_clip._touch_corner(CylSphere(vec(*NOWHERE), 2.0, 1.5), way)
        assert touch is not None
        assert touch.time == 0.75
        assert xyz(touch.off) == (f32(m.x * 0.75), 0.0, -1.5)

    def test_a_side_root_outside_of_the_movement(self) -> None:
        """10.4.7: moving away from beside: the plane is met at x = -4.5, the side at t < 0."""
        assert outcome((-3.0, 0.0, 4.0), (-5.0, 0.0, 2.0))[0] == COLLIDED


class TestHead:
    """Sphere 1 is stopped by the way from where sphere 0 was (10.4.3)."""

    def test_from_the_feet_to_the_head(self) -> None:
        """10.4.3: head at (-1, 0, 1.5), the feet were at (-5, 0, 1): 0.75 of (4, 0, 0.5).

        Back from the head by (-5, 0, 1) + (3, 0, 0.375) - (-1, 0, 1.5).
        """
        check = (-1.0, 0.0, 1.0)
        made = approaching((-5.0, 0.0, 1.0), check, head=(-1.0, 0.0, 1.5))
        assert stop(made, sphere_num=1) == ADJUSTED
        assert moved_by(made, check) == (-1.0, 0.0, -0.125)

    def test_a_corner_that_is_level_for_the_feet(self) -> None:
        """10.4.4.1: the head came from (-3, 0, 4), which is a corner; from the feet it is level."""
        made = approaching((-3.0, 0.0, 2.0), (-1.0, 0.0, 0.0), head=(-1.0, 0.0, 2.0))
        assert stop(made, sphere_num=1) == COLLIDED
        assert made.collision_info.collision_normal_valid == 0

    def test_its_own_radius_counts_upward(self) -> None:
        """10.4.4.2: a head of 1 metre touches the cap at 3: t = (1 + 2 - 4)/(2 - 4) from the feet at 4."""
        made = approaching((0.0, 0.0, 4.0), (0.0, 0.0, 1.0), head=(0.0, 0.0, 2.0), head_radius=1.0)
        assert stop(made, sphere_num=1) == ADJUSTED
        assert moved_by(made, (0.0, 0.0, 1.0)) == (0.0, 0.0, 1.0)


def test_across_a_border() -> None:
    """10.4.3, 10.4.8: the movement knows the border (192 + 2 - 190 = 4), the move back does not.

    With the cylinder at 195: od = -5, t = 0.75; 190 + 3 - 2 is wrong by a block, as in retail.
    """
    check = (2.0, 0.0, 1.0)
    made = approaching((190.0, 0.0, 1.0), check, to_cell=EAST_CELL)
    assert stop(made, low=(195.0, 0.0, 0.0)) == ADJUSTED
    assert moved_by(made, check) == (191.0, 0.0, 0.0)
    assert xyz(made.collision_info.collision_normal) == (-1.0, 0.0, 0.0)
