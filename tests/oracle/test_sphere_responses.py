"""CSphere as an obstacle, what is done about a hit: every way out of each response.

The obstacle is about the origin unless it says otherwise; with `TWO` the sum of the radii is exactly 2.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from oracle_obstacles import ATOM, EAST_CELL, TWO, approaching, contact, moved_by, stepping
from oracle_worlds import CELL, vec, xyz

from oracle.arithmetic import f32
from oracle.constants import EPS, Z_LANDING
from oracle.enums import PERFECT_CLIP_OI, TransitionState
from oracle.errors import UndeterminedError
from oracle.plane import Plane
from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.transition import Transition

    Step = Callable[[float, int], float]
    Point = tuple[float, float, float]

OK, COLLIDED = TransitionState.OK, TransitionState.COLLIDED
ADJUSTED, SLID = TransitionState.ADJUSTED, TransitionState.SLID

NOWHERE = (0.0, 0.0, 0.0)
LEVEL = Plane(vec(0.0, 0.0, 1.0), 0.0)


def obstacle(center: Point = NOWHERE) -> Sphere:
    """Return a sphere of 1.5 metres; with the mover's 0.5 the radii make 2."""
    return Sphere(vec(*center), 1.5)


def lower(made: Transition, *, radsum: float = TWO) -> TransitionState:
    """Step down onto the obstacle, from a height that need not be a float32."""
    path, s0 = made.sphere_path, made.sphere_path.global_sphere[0]
    return obstacle().step_sphere_down(path, made.collision_info, s0, Vector3(*xyz(s0.center)), radsum)


class TestStepDown:
    """CSphere::step_sphere_down (07 4)."""

    def test_raised_onto_the_top(self) -> None:
        """07 4.6…16: t = (2 - 1.5)/1; the plane through the obstacle's top, which counts as water."""
        check = (0.0, 0.0, 1.5)
        made = approaching(check, check)
        assert lower(made) == ADJUSTED
        assert moved_by(made, check) == (0.0, 0.0, 0.5)
        assert contact(made) == (1, (0.0, 0.0, 1.0, -1.5), 1, CELL)
        assert made.sphere_path.walk_interp == 0.5

    def test_amount_and_interpolation(self) -> None:
        """07 4.3, 4.6, 4.7: sd = 4 * 0.5 = 2, t = 0.25, w = 0.75 * 0.5; the rise stays 0.5."""
        check = (0.0, 0.0, 1.5)
        made = approaching(check, check, step_down_amt=4.0, walk_interp=0.5)
        assert lower(made) == ADJUSTED
        assert moved_by(made, check) == (0.0, 0.0, 0.5)
        assert made.sphere_path.walk_interp == 0.375

    def test_raised_onto_the_side(self) -> None:
        """07 4.6…14: radii of 1.25, 0.75 beside: sqrt(1.5625 - 0.5625) - 0.5 up; normal (3, 0, 4)/5."""
        made = approaching((0.75, 0.0, 0.5), (0.75, 0.0, 0.5))
        assert lower(made, radsum=1.25 - EPS) == ADJUSTED
        assert moved_by(made, (0.75, 0.0, 0.5)) == (0.0, 0.0, 0.5)
        n = (f32(0.8 * 0.75), 0.0, f32(0.8))
        d = f32(-(f32(1.5 * n[2]) * n[2] + f32(1.5 * n[0]) * n[0]))
        assert contact(made)[1] == (*n, d)

    def test_the_caller_s_way_becomes_the_normal(self) -> None:
        """07 4.10, 4.11: also where the answer is OK because it is too steep."""
        made, disp = approaching((0.0, 0.0, 1.5), (0.0, 0.0, 1.5), walkable_allowance=1.0), vec(0.0, 0.0, 1.5)
        path = made.sphere_path
        assert obstacle().step_sphere_down(path, made.collision_info, path.global_sphere[0], disp, TWO) == OK
        assert xyz(disp) == (0.0, 0.0, 1.0)
        assert contact(made)[0] == 0

    def test_only_what_is_flat_enough(self, next32: Step) -> None:
        """07 4.12: the allowance itself is too steep."""
        for allowance, result in ((1.0, OK), (next32(1.0, -1), ADJUSTED)):
            made = approaching((0.0, 0.0, 1.5), (0.0, 0.0, 1.5), walkable_allowance=allowance)
            assert lower(made) == result

    def test_feet_that_do_not_touch(self) -> None:
        """07 4.2: at the radius sum they do; beyond, one sphere is free."""
        for z, result in ((TWO, ADJUSTED), (math.nextafter(TWO, 3.0), OK)):
            made = approaching(NOWHERE, NOWHERE)
            made.sphere_path.global_sphere[0].center.z = z
            assert lower(made) == result

    def test_the_head_sends_the_feet(self, next32: Step) -> None:
        """07 4.2, 4.6: the head at 1.75 overlaps; the feet at 2 - 2^-22 are raised. Beyond it is OK."""
        check = (0.0, 0.0, 2.0 - ATOM)
        made = approaching(check, check, head=(0.0, 0.0, 1.75))
        assert lower(made) == ADJUSTED
        assert moved_by(made, check) == (0.0, 0.0, ATOM)
        radsum = f32(TWO)
        for x, result in ((radsum, COLLIDED), (next32(radsum, 1), OK)):
            beside = approaching((0.0, 0.0, 3.0), (0.0, 0.0, 3.0), head=(x, 0.0, 0.0))
            assert lower(beside, radsum=radsum) == result

    def test_no_way_down(self) -> None:
        """07 4.4: |amount * interpolation| below EPS; EPS itself raises by EPS, to w = 0."""
        for amount, result in ((EPS, ADJUSTED), (math.nextafter(EPS, 0.0), COLLIDED), (-EPS / 2.0, COLLIDED)):
            made = approaching(NOWHERE, NOWHERE, step_down_amt=amount)
            made.sphere_path.global_sphere[0].center.z = TWO
            assert lower(made) == result
            assert made.sphere_path.walk_interp == (0.0 if result == ADJUSTED else 1.0)

    def test_nothing_to_rise(self) -> None:
        """07 4.8: feet at exactly 2 have t = 0, w = 1, which is no less than 1; 2^-22 lower it is."""
        for z, result in ((2.0, COLLIDED), (2.0 - ATOM, ADJUSTED)):
            made = approaching((0.0, 0.0, z), (0.0, 0.0, z), head=(0.0, 0.0, 1.75))
            assert lower(made) == result

    @pytest.mark.parametrize(
        ("t", "result"),
        [(1.125, COLLIDED), (1.1, COLLIDED), (1.0999999999999999, ADJUSTED), (1.09375, ADJUSTED)],
    )
    def test_too_far_up(self, t: float, result: TransitionState) -> None:
        """07 4.8: 1 - 1.1 is below -0.1 as a double, 1 - 1.0999999999999999 is not."""
        made = approaching(NOWHERE, NOWHERE)
        made.sphere_path.global_sphere[0].center.z = 2.0 - t
        assert lower(made) == result

    def test_feet_beside_are_undetermined(self) -> None:
        """07 4.6 and 07 11: the head overlaps, the feet are 3 beside: the root of 4 - 9."""
        made = approaching((3.0, 0.0, 0.0), (3.0, 0.0, 0.0), head=NOWHERE)
        with pytest.raises(UndeterminedError, match=r"not known: .*07 4\.6"):
            lower(made)

    def test_feet_at_the_rim(self) -> None:
        """07 4.6: exactly 2 beside, the root is 0: t = -z = 0.5."""
        made = approaching((2.0, 0.0, -0.5), (2.0, 0.0, -0.5), head=NOWHERE, walkable_allowance=-1.0)
        assert lower(made) == ADJUSTED
        assert moved_by(made, (2.0, 0.0, -0.5)) == (0.0, 0.0, 0.5)
        assert contact(made)[1] == (1.0, 0.0, 0.0, -1.5)


class TestStepUp:
    """CSphere::step_sphere_up (07 5)."""

    def step(self, made: Transition) -> TransitionState:
        """Step up onto the obstacle."""
        s0 = made.sphere_path.global_sphere[0]
        return obstacle().step_sphere_up(made, s0, vec(*xyz(s0.center)), TWO)

    def test_too_high(self, next32: Step) -> None:
        """07 5.1, 5.2: 2 - 1 metres are stepped if the mover steps 1 metre, and no ULP less."""
        for height, stepped in ((1.0, True), (next32(1.0, -1), False)):
            made = stepping(approaching((-2.0, 0.0, 1.0), (-1.5, 0.0, 1.0)), succeeds=1)
            made.object_info.step_up_height = height
            assert (self.step(made) == OK) is stepped
            assert bool(made.step_up_normals) is stepped

    def test_too_high_slides_with_the_feet(self) -> None:
        """07 5.2: 6.A with sphere 0: (0.5, 0.5, 0) loses its x."""
        made = stepping(approaching((-2.0, 0.0, 0.0), (-1.5, 0.5, 0.0)), succeeds=1)
        made.collision_info.set_contact_plane(LEVEL, 0)
        assert self.step(made) == SLID
        assert moved_by(made, (-1.5, 0.5, 0.0)) == (-0.5, 0.0, 0.0)

    def test_the_normal_is_neither_unit_nor_moved_over_the_border(self) -> None:
        """07 5.3: from the obstacle's centre to where the sphere was, as the numbers stand."""
        made = approaching((190.0, 0.0, 1.5), (-1.5, 0.0, 1.5), to_cell=EAST_CELL)
        made.object_info.step_up_height = 5.0
        made = stepping(made, succeeds=1)
        assert self.step(made) == OK
        assert made.step_up_normals == [(190.0, 0.0, 1.5)]

    def test_a_failed_step_slides(self) -> None:
        """07 5.4: step_up_slide answers, with the path's own normal; the contact plane is given up."""
        made = approaching((-2.0, 0.0, 1.0), (-1.5, 0.5, 1.0), step_up=1)
        made.object_info.step_up_height = 5.0
        made.collision_info.set_contact_plane(LEVEL, 0)
        made.collision_info.last_known_contact_plane.assign(LEVEL)
        made.sphere_path.step_up_normal.assign(vec(0.0, -1.0, 0.0))
        assert self.step(stepping(made, succeeds=0)) == SLID
        assert moved_by(made, (-1.5, 0.5, 1.0)) == (0.0, -0.5, 0.0)
        assert (made.sphere_path.step_up, contact(made)[0]) == (0, 0)


class TestSlideAlong:
    """CSphere::slide_sphere of step_sphere_up (07 6.A)."""

    def slide(self, made: Transition, disp: Point = NOWHERE, sphere_num: int = 0) -> TransitionState:
        """Slide a sphere of the mover along the obstacle."""
        path = made.sphere_path
        return obstacle().slide_sphere_along(path, made.collision_info, vec(*disp), sphere_num)

    def grounded(self, curr: Point, check: Point, **more: int) -> Transition:
        """Return a path with a level contact plane."""
        made = approaching(curr, check, **more)
        made.collision_info.set_contact_plane(LEVEL, 0)
        return made

    def test_along_the_line_of_both_planes(self) -> None:
        """07 6.A.5…9: n x cn is the y axis; of (0.5, 0.5, -0.25) only y remains."""
        check = (-1.5, 0.5, -0.25)
        made = self.grounded((-2.0, 0.0, 0.0), check)
        assert self.slide(made) == SLID
        assert moved_by(made, check) == (-0.5, 0.0, 0.25)
        assert xyz(made.collision_info.collision_normal) == (-1.0, 0.0, 0.0)

    def test_a_line_that_is_no_unit(self) -> None:
        """07 6.A.9.3: divided by the squared length once: with a normal of 2 the result is the same."""
        made = approaching((-2.0, 0.0, 0.0), (-1.5, 0.5, 0.0))
        made.collision_info.set_contact_plane(Plane(vec(0.0, 0.0, 2.0), 0.0), 0)
        assert self.slide(made) == SLID
        assert moved_by(made, (-1.5, 0.5, 0.0)) == (-0.5, 0.0, 0.0)

    def test_every_axis_counts(self) -> None:
        """07 6.A.5, 6.A.9: a wall that faces y under a ceiling of x: the line is z."""
        check = (0.5, -1.5, 0.25)
        made = approaching((0.0, -2.0, 0.0), check)
        made.collision_info.set_contact_plane(Plane(vec(1.0, 0.0, 0.0), 0.0), 0)
        assert self.slide(made) == SLID
        assert moved_by(made, check) == (-0.5, -0.5, 0.0)

    def test_too_short_a_slide(self) -> None:
        """07 6.A.9.5: below EPS, squared, it collides; 0.0141 and 0.0142 lie on either side."""
        for y, result in ((0.0141, COLLIDED), (0.0142, SLID)):
            made = self.grounded((-2.0, 0.0, 0.0), (-1.5, f32(y), 0.0))
            assert self.slide(made) == result
            assert made.collision_info.collision_normal_valid == 1

    def test_the_length_counts_in_every_axis(self) -> None:
        """07 6.A.9.5: a slide along z or x alone is long enough too."""
        ceiling = approaching((0.0, -2.0, 0.0), (0.0, -1.5, 0.5))
        ceiling.collision_info.set_contact_plane(Plane(vec(1.0, 0.0, 0.0), 0.0), 0)
        assert self.slide(ceiling) == SLID
        assert self.slide(self.grounded((0.0, -2.0, 0.0), (0.5, -1.5, 0.0))) == SLID

    def test_no_line(self, next32: Step) -> None:
        """07 6.A.9…11: the squared length k² against EPS; along y nothing moves, so a line collides."""
        k = 0.01414213515818119
        for size, result in ((k, SLID), (next32(k, 1), COLLIDED)):
            made = approaching((-2.0, 0.0, 0.0), (-1.5, 0.0, 0.0))
            made.collision_info.set_contact_plane(Plane(vec(0.0, 0.0, size), 0.0), 0)
            assert self.slide(made) == result

    def test_parallel_takes_the_component_away(self) -> None:
        """07 6.A.11: above the obstacle, of (0.5, 0.25, -0.5) the z goes."""
        check = (0.5, 0.25, 1.5)
        made = self.grounded((0.0, 0.0, 2.0), check)
        assert self.slide(made) == SLID
        assert moved_by(made, check) == (0.0, 0.0, 0.5)

    def test_the_other_component_too(self) -> None:
        """07 6.A.11: beside it with a plane that faces x or y."""
        for curr, check, back, n in (
            ((2.0, 0.0, 0.0), (1.5, 0.5, 0.5), (0.5, 0.0, 0.0), (1.0, 0.0, 0.0)),
            ((0.0, 2.0, 0.0), (0.5, 1.5, 0.5), (0.0, 0.5, 0.0), (0.0, 1.0, 0.0)),
        ):
            made = approaching(curr, check)
            made.collision_info.set_contact_plane(Plane(vec(*n), 0.0), 0)
            assert self.slide(made) == SLID
            assert moved_by(made, check) == back

    @pytest.mark.parametrize("axis", [0, 1, 2])
    def test_an_opposed_way_collides(self, axis: int) -> None:
        """07 6.A.10: the *argument*, not the normal, is compared with the plane, strictly."""
        unit, against = [0.0] * 3, [0.0] * 3
        unit[axis], against[axis] = 1.0, -ATOM
        for disp, result in ((NOWHERE, SLID), (tuple(against), COLLIDED)):
            made = approaching((2.0 * unit[0], 2.0 * unit[1], 2.0 * unit[2]), NOWHERE)
            made.collision_info.set_contact_plane(Plane(vec(*unit), 0.0), 0)
            assert self.slide(made, disp) == result

    def test_from_the_middle_it_collides(self) -> None:
        """07 6.A.2: shorter than EPS there is no normal, and none is set."""
        made = self.grounded((EPS / 2.0, 0.0, 0.0), (0.5, 0.5, 0.0))
        assert self.slide(made) == COLLIDED
        assert made.collision_info.collision_normal_valid == 0

    def test_the_last_known_plane_need_not_be_valid(self) -> None:
        """07 6.A.4: without contact its normal is taken as it is."""
        check = (-1.5, 0.5, -0.25)
        made = approaching((-2.0, 0.0, 0.0), check)
        made.collision_info.last_known_contact_plane.assign(LEVEL)
        assert self.slide(made) == SLID
        assert moved_by(made, check) == (-0.5, 0.0, 0.25)

    def test_across_a_border(self) -> None:
        """07 6.A.6, 6.A.7: the movement is 192 - 1.5 - 190 = 0.5 east; the normal still is (190, 0, 0)."""
        check = (-1.5, 0.5, 0.0)
        made = approaching((190.0, 0.0, 0.0), check, to_cell=EAST_CELL)
        made.collision_info.set_contact_plane(LEVEL, 0)
        assert self.slide(made) == SLID
        assert moved_by(made, check) == (-0.5, 0.0, 0.0)
        assert xyz(made.collision_info.collision_normal) == (1.0, 0.0, 0.0)

    def test_the_other_sphere(self) -> None:
        """07 6.A.1: number 1 slides by its own centres: from (-2, 0, 0), though the feet were above."""
        check = (-1.5, 0.5, -3.0)
        made = approaching((-2.0, 0.0, -3.0), check, head=(-1.5, 0.5, 0.0))
        made.collision_info.set_contact_plane(LEVEL, 0)
        assert self.slide(made, sphere_num=1) == SLID
        assert xyz(made.collision_info.collision_normal) == (-1.0, 0.0, 0.0)


class TestSlideOff:
    """CSphere::slide_sphere of the head (07 6.C)."""

    def test_from_the_middle_it_collides(self, next32: Step) -> None:
        """07 6.C.2: the distance from the centre against EPS."""
        for x, result in ((EPS, SLID), (next32(EPS, -1), COLLIDED)):
            made = approaching((x, 0.0, 0.0), (0.5, 0.5, 0.0))
            s0 = made.sphere_path.global_sphere[0]
            made.collision_info.set_contact_plane(LEVEL, 0)
            path, coll = made.sphere_path, made.collision_info
            assert obstacle().slide_sphere_off(path, coll, s0, 0) == result
            assert coll.collision_normal_valid == int(result == SLID)


class TestLand:
    """CSphere::land_on_sphere (07 7.1)."""

    def test_a_landing_begins(self) -> None:
        """07 7.1.3…5: the normal (3, 0, 4)/5; position and cell are kept, the interpolation starts anew."""
        made = approaching((3.0, 0.0, 4.0), (1.0, 0.0, 1.0), head=(1.0, 0.0, 3.0), walk_interp=0.25)
        assert obstacle().land_on_sphere(made.sphere_path) == ADJUSTED
        sp = made.sphere_path
        fifth = 1.0 / 5.0
        assert xyz(sp.step_up_normal) == (f32(fifth * 3.0), 0.0, f32(fifth * 4.0))
        assert (sp.collide, sp.walk_interp, sp.walkable_allowance) == (1, 1.0, Z_LANDING)
        assert xyz(sp.backup_check_pos.frame.origin) == (1.0, 0.0, 1.0)
        assert sp.backup_cell is sp.check_cell

    def test_from_the_middle_it_collides(self, next32: Step) -> None:
        """07 7.1.2: the distance against EPS; nothing is changed below."""
        for z, result in ((EPS, ADJUSTED), (next32(EPS, -1), COLLIDED)):
            made = approaching((0.0, 0.0, z), (0.0, 0.0, 0.0))
            assert obstacle().land_on_sphere(made.sphere_path) == result
            assert made.sphere_path.collide == int(result == ADJUSTED)


class TestPoint:
    """CSphere::collide_with_point (07 7.2)."""

    def stop(self, made: Transition, *, state: int = PERFECT_CLIP_OI, sphere_num: int = 0) -> TransitionState:
        """Stop at the obstacle."""
        made.object_info.state = state
        path = made.sphere_path
        return obstacle().collide_with_point(
            made.object_info, path, made.collision_info, path.global_sphere[sphere_num], TWO, sphere_num
        )

    def test_an_ordinary_mover_just_collides(self, next32: Step) -> None:
        """07 7.2.1: the normal from where it was; from nearer than EPS there is none."""
        for x, valid in ((EPS, 1), (next32(EPS, -1), 0)):
            made = approaching((x, 0.0, 0.0), (0.5, 0.0, 0.0))
            assert self.stop(made, state=0) == COLLIDED
            assert made.collision_info.collision_normal_valid == valid
            assert moved_by(made, (0.5, 0.0, 0.0)) == NOWHERE

    def test_a_perfect_mover_stops_where_it_touches(self) -> None:
        """07 7.2.5…9: from -5 by 4 towards radii of 2: t = (20 - 8)/16 = 0.75."""
        check = (-1.0, 0.0, 0.0)
        made = approaching((-5.0, 0.0, 0.0), check)
        assert self.stop(made) == ADJUSTED
        assert moved_by(made, check) == (-1.0, 0.0, 0.0)
        assert xyz(made.collision_info.collision_normal) == (-1.0, 0.0, 0.0)

    @pytest.mark.parametrize("axis", [0, 1, 2])
    def test_every_axis(self, axis: int) -> None:
        """07 7.2.6…8: the same along y and z."""

        def along(value: float) -> Point:
            return tuple(value if i == axis else 0.0 for i in range(3))  # type: ignore[return-value]

        made = approaching(along(-5.0), along(-1.0))
        assert self.stop(made) == ADJUSTED
        assert moved_by(made, along(-1.0)) == along(-1.0)
        assert xyz(made.collision_info.collision_normal) == along(-1.0)

    def test_the_end_of_the_movement_counts(self) -> None:
        """07 7.2.5: from -4 to -2 is t = 1 (b = 8, c = 12, q = 4: (8 - 4)/4); 2^-22 less does not reach."""
        for x, result in ((-2.0, ADJUSTED), (-2.0 - 2.0 * ATOM, COLLIDED)):
            made = approaching((-4.0, 0.0, 0.0), (x, 0.0, 0.0))
            assert self.stop(made) == result
            assert made.collision_info.collision_normal_valid == int(result == ADJUSTED)

    def test_too_early_a_touch(self) -> None:
        """07 7.2.5: a gap of 2^-10 in a movement of 4 is t = 2^-12 above EPS, of 8 it is 2^-13 below."""
        for move, result in ((4.0, ADJUSTED), (8.0, COLLIDED)):
            x = -2.0 - 2.0**-10
            made = approaching((x, 0.0, 0.0), (x + move, 0.0, 0.0))
            assert self.stop(made) == result

    def test_a_mover_that_never_touches(self) -> None:
        """07 7.2.5: passing by at 2.25 gives -1."""
        made = approaching((-5.0, 2.25, 0.0), (-1.0, 2.25, 0.0))
        assert self.stop(made) == COLLIDED

    def test_the_head_by_its_own_way(self) -> None:
        """07 7.2: sphere 1 went from (-5, 0, 0) to (-1, 0, 0)."""
        check = (-1.0, 0.0, -9.0)
        made = approaching((-5.0, 0.0, -9.0), check, head=(-1.0, 0.0, 0.0))
        assert self.stop(made, sphere_num=1) == ADJUSTED
        assert moved_by(made, check) == (-1.0, 0.0, 0.0)

    def test_across_a_border(self) -> None:
        """07 7.2.3, 7.2.4: the movement knows the border (192 - 5 - 183 = 4), the distance does not.

        With the obstacle at 188 of the *current* block: od = 183 - 188 = -5, t = 0.75, one metre back; the
        normal is from 188 to -6 of the next block, halved.
        """
        made = approaching((183.0, 0.0, 0.0), (-5.0, 0.0, 0.0), to_cell=EAST_CELL, state=PERFECT_CLIP_OI)
        path, coll = made.sphere_path, made.collision_info
        other = obstacle((188.0, 0.0, 0.0))
        s0 = path.global_sphere[0]
        assert other.collide_with_point(made.object_info, path, coll, s0, TWO, 0) == ADJUSTED
        assert moved_by(made, (-5.0, 0.0, 0.0)) == (-1.0, 0.0, 0.0)
        assert xyz(coll.collision_normal) == (-1.0, 0.0, 0.0)
